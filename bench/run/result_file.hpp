#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "methods/tables/table.hpp"

namespace dmocbench {

/// A folder for results. It makes missing folders, parents included, and its destructor removes those that are still
/// empty.
class OutputFolder {
 public:
  /// Makes the folder and checks that files can be written there. Removes the leftovers of programs that were killed on
  /// this machine: hidden files that end with the number of a process that has ended; unless `leftovers_stay`, for a
  /// folder with too many files to search. Throws `Error` on failure.
  explicit OutputFolder(const std::filesystem::path& folder, bool leftovers_stay = false);
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;
  ~OutputFolder();

 private:
  OutputFolder() = default;

  std::vector<std::filesystem::path> made_;  // innermost first
};

/// Throws `Error` unless the name of a table, given by --name, is valid for a file in the results folder: not empty, at
/// most 100 letters, no slash, no control character, and no dot or dash in front.
void require_name_of_table(const std::string& name);

/// The name of this machine, fit to be part of a file's name: letters, digits and dashes.
[[nodiscard]] const std::string& host_name();

/// The hidden name next to a file under which this process writes it: ".NAME.HOST.PROCESS". Machines that share a file
/// system may have processes with equal numbers.
[[nodiscard]] std::filesystem::path temporary_name(const std::filesystem::path& file);

/// Throws `Error` if `write_file` could not write there: no folder, a name that is too long, no rights. Creates no
/// file.
void require_writable(const std::filesystem::path& path);

/// Writes a file whole or not at all: to a temporary name in the same folder, then renamed; a link stays a link. An
/// existing path that is not a regular file (a device, a pipe), or is this program's own output, is written into, never
/// replaced. Throws `Error` (and removes the temporary file) if the disk is full or the folder cannot be written.
void write_file(const std::filesystem::path& path, std::string_view content);

/// Appends a line to a file, in one piece, so that a process that is killed leaves whole lines. It does not wait for
/// the disk. Throws `Error`, and leaves the file unchanged, if the line cannot be written.
void append_to_file(const std::filesystem::path& path, std::string_view line);

/// Waits until a file is on the disk. Throws `Error` if it cannot be written there.
void force_to_disk(const std::filesystem::path& path);

/// The CRC-32 of a text, as in zlib, gzip and the program crc32.
[[nodiscard]] std::uint32_t crc_32(std::string_view text);
/// The same in eight hexadecimal digits.
[[nodiscard]] std::string checksum_of(std::string_view text);

/// Gives this process exclusive use of a name in a results folder during its lifetime, so that two runs never mix.
class ResultLock {
 public:
  /// `prefix`: folder and name of the table. Throws `Error` if another process has them.
  explicit ResultLock(const std::filesystem::path& prefix);
  ResultLock(const ResultLock&) = delete;
  ResultLock& operator=(const ResultLock&) = delete;
  ~ResultLock();

 private:
  std::filesystem::path file_;
  int descriptor_ = -1;
};

}  // namespace dmocbench
