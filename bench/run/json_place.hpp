#pragma once

#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json_fwd.hpp>

namespace dmocbench {

/// A value in a JSON file that others may have written: a missing value, or one of another type than expected, throws
/// `Error` with the file, the place and the value there. It refers to the JSON, which must outlive it.
class JsonPlace {
 public:
  /// The whole of `json`; `file` is its name for errors.
  JsonPlace(const nlohmann::ordered_json& json, std::string file) : JsonPlace(json, std::move(file), "") {}

  /// True of an object that has this key.
  [[nodiscard]] bool has(const std::string& key) const;
  /// The value of a key. Throws `Error` if this is not an object or lacks the key.
  [[nodiscard]] JsonPlace at(const std::string& key) const;
  /// The keys of an object and their values. Throws `Error` if this is not an object.
  [[nodiscard]] std::vector<std::pair<std::string, JsonPlace>> members() const;
  /// The entries of an array. Throws `Error` if this is not an array.
  [[nodiscard]] std::vector<JsonPlace> entries() const;
  [[nodiscard]] std::string text() const;  ///< the value; throws `Error` if it is not a text
  [[nodiscard]] double number() const;     ///< the value; throws `Error` if it is not a number
  [[nodiscard]] bool boolean() const;      ///< the value; throws `Error` if it is neither true nor false
  /// The value; throws `Error` if it is not a whole number from 0 to a billion.
  [[nodiscard]] int count() const;
  /// The entries of an array of texts.
  [[nodiscard]] std::vector<std::string> texts() const;
  /// The entries of an array of numbers.
  [[nodiscard]] std::vector<double> numbers() const;
  /// The JSON at this place.
  [[nodiscard]] const nlohmann::ordered_json& json() const noexcept { return *json_; }

 private:
  JsonPlace(const nlohmann::ordered_json& json, std::string file, std::string path)
      : json_(&json), file_(std::move(file)), path_(std::move(path)) {}
  /// Throws `Error`: the place is not `wanted`, such as "a text".
  [[noreturn]] void refuse(const char* wanted) const;
  [[nodiscard]] JsonPlace inner(const nlohmann::ordered_json& json, const std::string& key) const;

  const nlohmann::ordered_json* json_;
  std::string file_;
  std::string path_;  // keys with spaces between them; empty for the whole
};

/// The JSON in a text, without values that are nested deeper than in our own files, since copying and writing recurse.
/// Throws `Error` that names `file` if it is not JSON.
[[nodiscard]] nlohmann::ordered_json json_in(const std::string& text, const std::string& file);
/// The same; null if the text is not JSON.
[[nodiscard]] nlohmann::ordered_json json_or_null(const std::string& text);

}  // namespace dmocbench
