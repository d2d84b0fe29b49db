#pragma once

#include <Eigen/Core>
#include <dmocbench/version.hpp>
#include <dmocbench_build_tag.hpp>

// The properties in which two builds must agree before one may use problems of the other: each entry "name=value;"
// affects the memory layout. A macro, since it has to be one text in the file of a library, where it is read before any
// code of that library runs.
// NOLINTBEGIN(cppcoreguidelines-macro-usage)
#define DMOCBENCH_TEXT_OF(value) #value
#define DMOCBENCH_TEXT(value) DMOCBENCH_TEXT_OF(value)
#ifdef __clang__
#define DMOCBENCH_COMPILER "clang " DMOCBENCH_TEXT(__clang_major__)
#else
#define DMOCBENCH_COMPILER "g++ " DMOCBENCH_TEXT(__GNUC__)
#endif
#ifdef _GLIBCXX_DEBUG
#define DMOCBENCH_CHECKED_CONTAINERS "yes"
#else
#define DMOCBENCH_CHECKED_CONTAINERS "no"
#endif
#if defined(__SANITIZE_ADDRESS__)
#define DMOCBENCH_SANITIZER "address"
#elif defined(__SANITIZE_THREAD__)
#define DMOCBENCH_SANITIZER "thread"
#else
#define DMOCBENCH_SANITIZER "none"
#endif
#define DMOCBENCH_BUILD_TAG \
  "dmocbench problems: version=" DMOCBENCH_VERSION ";headers=" DMOCBENCH_HEADERS                     \
  ";compiler=" DMOCBENCH_COMPILER ";strings of C++11=" DMOCBENCH_TEXT(_GLIBCXX_USE_CXX11_ABI)        \
  ";checked containers=" DMOCBENCH_CHECKED_CONTAINERS ";sanitizer=" DMOCBENCH_SANITIZER              \
  ";Eigen=" DMOCBENCH_TEXT(EIGEN_WORLD_VERSION) "." DMOCBENCH_TEXT(EIGEN_MAJOR_VERSION) "." DMOCBENCH_TEXT( \
      EIGEN_MINOR_VERSION) ";alignment by Eigen=" DMOCBENCH_TEXT(EIGEN_MAX_ALIGN_BYTES)              \
  ";aligned malloc=" DMOCBENCH_TEXT(EIGEN_MALLOC_ALREADY_ALIGNED) ";"
// NOLINTEND(cppcoreguidelines-macro-usage)
