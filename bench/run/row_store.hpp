#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "methods/runtime/clock.hpp"

namespace dmocbench {

/// The entries of a run in a file NAME.rows: rows of cases, or tables of stages.
///
/// Rows of a run that is not complete are in one place. Its first line is the header, a JSON object with the identity
/// of the run (`identity_of`): everything that its rows depend on but for times. Every further line is an entry, a JSON
/// object too, appended when its work is done, so that a run that is killed has lost nothing that it had finished. Each
/// line begins with the checksum of its rest. A torn or damaged last line is dropped; damage elsewhere is an error.
/// An interrupted run is resumed by reading its own store. A part of a run (--part) is a store with some of the cases,
/// and --join reads several of them. A process (--jobs) writes a store that its parent reads. The table NAME.csv is a
/// view of the rows, written when the run ends or is interrupted; a complete run removes its store. Rows of other
/// problems are in the table alone (`KeptRows`), because users have tables without stores.
///
/// It is a plain file because one process appends, under the lock of its run, and readers take all of it: there is
/// nothing to query, and a torn last line is the only trace of a crash. SQLite would replace some forty lines of this
/// class, need schemas for entries of two kinds, and lock files in ways that shared file systems of clusters often
/// lack.
class RowStore {
 public:
  /// No file: entries are dropped.
  RowStore() = default;
  /// The store of a run with this header (`header_of_store`) in a file, which is neither read nor written yet.
  RowStore(std::filesystem::path file, nlohmann::ordered_json header);

  /// Where it lies.
  [[nodiscard]] const std::filesystem::path& file() const noexcept { return file_; }
  /// Its header.
  [[nodiscard]] const nlohmann::ordered_json& header() const noexcept { return header_; }
  /// The entries of the file, if it is there and of a run of the same identity. They are dropped with the first
  /// `append` unless they are kept. Throws `Error` if the file is damaged.
  [[nodiscard]] std::vector<nlohmann::ordered_json> resume() const;
  /// Adds an entry that is written together with the next appended one.
  void keep(const nlohmann::ordered_json& entry);
  /// Writes an entry. It waits for the disk at most once in 20 s. Throws `Error` if the file cannot be written, and
  /// leaves it as it was.
  void append(const nlohmann::ordered_json& entry);
  /// Waits until all entries are on the disk. Throws `Error` if the file cannot be written.
  void sync();
  /// Removes the file.
  void remove() const;

 private:
  std::filesystem::path file_;
  nlohmann::ordered_json header_;
  std::string kept_;       ///< lines that the file is made of by the first `append`
  bool has_file_ = false;  ///< it is made
  Clock::time_point last_sync_;
};

/// The content of a store.
struct StoredEntries {
  std::filesystem::path file;                   ///< where it lies
  nlohmann::ordered_json header;                ///< null if not even this line is whole
  std::vector<nlohmann::ordered_json> entries;  ///< in the order in which they were appended
};

/// Reads a store. Throws `Error` that names the file and the line if one before the last is damaged.
[[nodiscard]] StoredEntries read_store(const std::filesystem::path& file);

/// The program and its options, as all rows of a run depend on them: version, compiler, instruction set, libraries (of
/// problems by name and checksum), checksum of the program, parameters of problems, options. `metadata` describes the
/// run (`describe_run`), `options` are `CommandLine::values_for_results`.
[[nodiscard]] nlohmann::ordered_json identity_of(const std::string& experiment, const nlohmann::ordered_json& metadata,
                                                 const std::map<std::string, std::string>& options,
                                                 const nlohmann::ordered_json& parameters = {});

/// The header of the store of a run: its identity, and the commit, the time and the machine of the run.
[[nodiscard]] nlohmann::ordered_json header_of_store(nlohmann::ordered_json identity,
                                                     const nlohmann::ordered_json& metadata);

/// Throws `Error` with the first difference unless a store was written by a run of the same identity as `header`:
/// "parameters orbital_transfer revolutions is 3, not 2".
void require_same_run(const StoredEntries& store, const nlohmann::ordered_json& header);

}  // namespace dmocbench
