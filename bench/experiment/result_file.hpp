#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace dmocbench {

/// Makes the folder, parents included, and checks that files can be written there. Throws `Error` if not.
void prepare_folder(const std::filesystem::path& folder);

/// Writes a file whole or not at all: to a temporary name in the same folder, then renamed. Throws `Error` (and removes
/// the temporary file) if the disk is full or the folder cannot be written.
void write_file(const std::filesystem::path& path, std::string_view content);

/// Appends a line to a file, in one piece, so that a process that is killed leaves whole lines. Nothing waits for the
/// disk. Throws `Error`, and leaves the file as it was, if the line cannot be written.
void append_to_file(const std::filesystem::path& path, std::string_view line);

/// The content of a file. Throws `Error` that names it if it cannot be read.
[[nodiscard]] std::string read_file(const std::filesystem::path& path);

}  // namespace dmocbench
