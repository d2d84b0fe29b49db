#pragma once

/// Declares NAME, a text of the program that ends with a zero: the content of a file of the sources, by its path from
/// their root. The assembler reads the file, so that data stay files of their own kind. At namespace scope, outside of
/// all namespaces.
// NOLINTBEGIN(cppcoreguidelines-macro-usage): a text for the assembler
#define DMOCBENCH_EMBEDDED_FILE(name, file)                                           \
  asm(".pushsection .rodata\n.global dmocbench_file_" #name "\ndmocbench_file_" #name \
      ":\n.incbin \"" DMOCBENCH_SOURCE_DIR "/" file "\"\n.byte 0\n.popsection\n");    \
  extern "C" const char dmocbench_file_##name[]
// NOLINTEND(cppcoreguidelines-macro-usage)
