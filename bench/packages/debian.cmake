# Debian packages: `cpack -G DEB` in the build folder makes `dmocbench`, the program with its figures, `python3-dmocbench`,
# the package for Python, and `libdmocbench-dev`, headers and libraries for compiling programs. A package contains the files
# that `cmake --install` installs for a component; `complete_debian` adds man pages and files that Debian requires.
include_guard(GLOBAL)

set(CPACK_PACKAGE_NAME dmocbench)
set(CPACK_PACKAGE_VERSION ${PROJECT_VERSION})
set(CPACK_PACKAGE_VENDOR "the dmocbench authors")
set(CPACK_VERBATIM_VARIABLES ON)
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_DIRECTORY ${PROJECT_BINARY_DIR}/packages)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_COMPONENTS_ALL program development)
if(TARGET dmocbench_python)
  list(APPEND CPACK_COMPONENTS_ALL python)
endif()
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "") # each package has its own

# The builder of a package is its maintainer: DEBFULLNAME and DEBEMAIL, as for Debian's own tools, or git's user.
function(dmocbench_ask_who variable environment git_name otherwise)
  set(answer "$ENV{${environment}}")
  if(NOT answer)
    execute_process(
      COMMAND git config ${git_name}
      WORKING_DIRECTORY ${PROJECT_SOURCE_DIR}
      OUTPUT_VARIABLE answer
      OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
  endif()
  if(NOT answer)
    set(answer "${otherwise}")
  endif()
  set(${variable} "${answer}" PARENT_SCOPE)
endfunction()
dmocbench_ask_who(name DEBFULLNAME user.name "the dmocbench authors")
dmocbench_ask_who(address DEBEMAIL user.email nobody@localhost)
set(DMOCBENCH_MAINTAINER "${name} <${address}>" CACHE STRING "Maintainer of the Debian packages")
set(CPACK_PACKAGE_CONTACT "${DMOCBENCH_MAINTAINER}")

set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_DEBIAN_PACKAGE_PRIORITY optional)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)

set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME dmocbench)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SECTION math)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_DEPENDS "fonts-dejavu-core, gnuplot-nox | gnuplot")
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SUGGESTS libdmocbench-dev)
set(CPACK_COMPONENT_PROGRAM_DESCRIPTION
    "benchmark of DMOC and collocation for optimal control
Solves optimal control problems of mechanical systems with DMOC (Discrete
Mechanics and Optimal Control), Hamiltonian and tangent-space collocation,
and shooting, and compares accuracy, structure and cost of the solutions in
tables and figures. Your own problems are loaded from shared libraries, which
libdmocbench-dev builds from one header each.")

set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-dmocbench)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS "python3, python3-numpy")
set(CPACK_DEBIAN_PYTHON_PACKAGE_SUGGESTS "dmocbench, python3-matplotlib, python3-pandas")
set(CPACK_COMPONENT_PYTHON_DESCRIPTION
    "optimal control with DMOC and collocation in Python
State an optimal control problem of a mechanical system as a Python class,
solve it with DMOC and collocation at the speed of C++, get solutions as
numpy arrays, and compare the methods with the experiments of dmocbench.")

# The static libraries have no dependencies included: linking them needs the libraries they were compiled with.
set(adolc)
get_property(with_adolc GLOBAL PROPERTY DMOCBENCH_WITH_ADOLC)
if(with_adolc)
  set(adolc ", libadolc-dev")
endif()
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libdmocbench-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS
    "coinor-libipopt-dev, libboost-dev, libeigen3-dev (>= 3.4), libfmt-dev, liblapack-dev, liblapacke-dev, libmumps-seq-dev, libnlopt-dev, pkg-config${adolc}"
)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_RECOMMENDS
    "cmake (>= 3.25), dmocbench (= ${PROJECT_VERSION}-${CPACK_DEBIAN_PACKAGE_RELEASE}), g++, libcli11-dev, nlohmann-json3-dev, zlib1g-dev")
set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION
    "libraries of dmocbench: optimal control with DMOC and collocation
Headers, static libraries and CMake files: a language for Lagrangians,
forces and costs with exact derivatives, DMOC, collocation and shooting,
solvers, diagnostics, and dmocbench_add_problems, which builds a library of
your own problems for the program dmocbench.")

set(CPACK_DMOCBENCH_SOURCE ${PROJECT_SOURCE_DIR}) # names that begin with CPACK_ reach the script
set(CPACK_PRE_BUILD_SCRIPTS ${CMAKE_CURRENT_LIST_DIR}/complete_debian.cmake)
include(CPack)
