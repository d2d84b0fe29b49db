# A recipe of Conan 2 for the sources in which it lies:
#   conan create bench/packages/conan --build=missing
# Ipopt, MUMPS and LAPACKE are those of the system, because one MUMPS has to serve Ipopt and us.
import os

from conan import ConanFile
from conan.tools.cmake import CMake, CMakeDeps, CMakeToolchain, cmake_layout
from conan.tools.files import copy
from conan.tools.gnu import PkgConfigDeps
from conan.tools.system.package_manager import Apt, Brew, Dnf


class DmocbenchConan(ConanFile):
    name = "dmocbench"
    version = "0.1.0"
    license = "BSD-3-Clause"
    description = "DMOC and collocation for optimal control of mechanical systems, side by side"
    settings = "os", "compiler", "build_type", "arch"
    package_type = "static-library"
    requires = (
        "boost/1.83.0",
        "cli11/2.4.2",
        "eigen/3.4.0",
        "fmt/10.2.1",
        "nlohmann_json/3.11.3",
        "nlopt/2.7.1",
        "tl-expected/1.1.0",
        "xsimd/13.0.0",
    )
    tool_requires = "cmake/[>=3.25]"

    def export_sources(self):
        root = os.path.join(self.recipe_folder, "..", "..", "..")
        copy(self, "*", root, self.export_sources_folder, excludes=("build*", "results*", ".git/*"))

    def requirements(self):
        if self.settings.arch == "x86_64":
            self.requires("xbyak/7.21")

    def system_requirements(self):
        Apt(self).install(["coinor-libipopt-dev", "libmumps-seq-dev", "liblapacke-dev", "pkg-config"])
        Dnf(self).install(["coin-or-Ipopt-devel", "MUMPS-devel", "lapack-devel", "pkgconf"])
        Brew(self).install(["ipopt", "mumps", "lapack", "pkgconf"])

    def layout(self):
        cmake_layout(self)

    def generate(self):
        toolchain = CMakeToolchain(self)
        toolchain.cache_variables["DMOCBENCH_WARNINGS_AS_ERRORS"] = False
        toolchain.cache_variables["DMOCBENCH_ADOLC"] = False
        toolchain.cache_variables["DMOCBENCH_TESTS"] = False
        toolchain.generate()
        CMakeDeps(self).generate()
        PkgConfigDeps(self).generate()

    def build(self):
        cmake = CMake(self)
        cmake.configure()
        cmake.build()

    def package(self):
        CMake(self).install()

    def package_info(self):  # the package's own CMake files say what to link
        self.cpp_info.builddirs.append(os.path.join("lib", "cmake", "dmocbench"))
        self.cpp_info.set_property("cmake_find_mode", "none")
