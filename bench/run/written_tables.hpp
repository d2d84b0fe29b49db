#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json_fwd.hpp>

namespace dmocbench {

/// The CRC-32 of a text, that of zlib, gzip and the program crc32.
[[nodiscard]] std::uint32_t crc_32(std::string_view text);

/// What a run's metadata tell of the tables that it has written, as `metadata["tables"]`: an object per file by its
/// name without folder, with its columns, the number of its rows, its checksum ("crc32", eight hexadecimal digits) and
/// the JSON Schema of its rows. Files that are not there, are no tables (.csv) or no regular files are left out. Throws
/// `Error` if one cannot be read.
[[nodiscard]] nlohmann::ordered_json describe_tables(const std::vector<std::filesystem::path>& files);

/// Throws `Error` unless a table's content is what the metadata tell of it: columns, number of rows, checksum.
/// `table` and `source` are the names of the table's file and of that of the metadata, for the sentence.
void require_as_written(const nlohmann::json& metadata, const std::string& source, const std::string& table,
                        std::string_view content);

}  // namespace dmocbench
