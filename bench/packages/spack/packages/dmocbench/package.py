# A repository of Spack with one package, made from the sources in which it lies:
#   spack repo add bench/packages/spack && spack install dmocbench@main
import os

from spack.package import *


class Dmocbench(CMakePackage):
    """DMOC and collocation for optimal control of mechanical systems, side by side."""

    homepage = "https://doi.org/10.1051/cocv/2010012"
    git = "file://" + os.path.abspath(os.path.join(os.path.dirname(__file__), "..", "..", "..", "..", ".."))

    license("BSD-3-Clause")
    version("main", branch="main")

    variant("adolc", default=False, description="Offer derivatives by ADOL-C")

    depends_on("cxx", type="build")
    depends_on("cmake@3.25:", type="build")
    depends_on("ninja", type="build")
    depends_on("pkgconfig", type="build")
    depends_on("boost@1.74:")
    depends_on("cli11")
    depends_on("eigen@3.4:")
    depends_on("fmt@9:")
    depends_on("ipopt")
    depends_on("mumps~mpi")
    depends_on("netlib-lapack+lapacke")
    depends_on("nlohmann-json")
    depends_on("nlopt")
    depends_on("tl-expected")
    depends_on("xsimd@10:")
    depends_on("adol-c", when="+adolc")
    depends_on("gnuplot", type="run")

    generator("ninja")

    def cmake_args(self):
        return [
            self.define_from_variant("DMOCBENCH_ADOLC", "adolc"),
            self.define("DMOCBENCH_WARNINGS_AS_ERRORS", False),
            self.define("DMOCBENCH_TESTS", False),
        ]
