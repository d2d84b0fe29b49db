#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json_fwd.hpp>

namespace dmocbench {

/// The CRC-32 of a text, as in zlib, gzip and the program crc32.
[[nodiscard]] std::uint32_t crc_32(std::string_view text);

/// The description of the tables that a run has written, as `metadata["tables"]`: an object per file by its
/// name without folder, with its columns, the number of its rows, its checksum ("crc32", eight hexadecimal digits) and
/// the JSON Schema of its rows. Paths that do not exist or are not regular .csv files are left out. Throws
/// `Error` if one cannot be read.
[[nodiscard]] nlohmann::ordered_json describe_tables(const std::vector<std::filesystem::path>& files);

/// Throws `Error` unless a table's content agrees with the metadata: columns, number of rows, checksum.
/// `table` and `source` are the names of the table's file and of the metadata file, for the sentence.
void require_as_written(const nlohmann::json& metadata, const std::string& source, const std::string& table,
                        std::string_view content);

}  // namespace dmocbench
