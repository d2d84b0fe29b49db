# cmake -D OUTPUT=<header> -D HEADERS=<pattern>|... -P build_tag.cmake
# Writes the header that identifies this dmocbench: a checksum of the headers that problems include. An up-to-date header is
# not touched, so that no source is recompiled.
string(REPLACE "|" ";" patterns "${HEADERS}")
file(GLOB headers LIST_DIRECTORIES false ${patterns})
list(SORT headers)
set(checksums)
foreach(header IN LISTS headers)
  file(SHA256 ${header} checksum)
  string(APPEND checksums ${checksum})
endforeach()
string(SHA256 checksum "${checksums}")
string(SUBSTRING ${checksum} 0 12 checksum)
file(CONFIGURE OUTPUT ${OUTPUT} CONTENT "\
#pragma once

// NOLINTBEGIN(cppcoreguidelines-macro-usage): joined with other texts by the preprocessor
/// A checksum of the headers that problems include.
#define DMOCBENCH_HEADERS \"${checksum}\"
// NOLINTEND(cppcoreguidelines-macro-usage)
")
