"""The Python package, for pip: CMake builds its module. Needs the packages that bench/install lists."""

import os
import re
from pathlib import Path

from skbuild import setup

os.environ.setdefault("SKBUILD_BUILD_OPTIONS", "dmocbench_python")  # what is built, and not all
version = re.search(r"\n  VERSION (\S+)", Path("CMakeLists.txt").read_text()).group(1)
setup(
    name="dmocbench",
    version=version,
    description="State optimal control problems of mechanical systems, solve them by DMOC and collocation, compare",
    license="BSD-3-Clause",
    python_requires=">=3.9",
    install_requires=["numpy"],
    packages=["dmocbench"],
    package_dir={"": "bench/python"},
    package_data={"dmocbench": ["py.typed", "*.pyi"]},
    cmake_args=["-DDMOCBENCH_TESTS=OFF", "-DDMOCBENCH_ADOLC=OFF", "-DDMOCBENCH_PYTHON_DIR=bench/python"],
    cmake_install_target="install-python",
)
