#include "bench/run/json_place.hpp"

#include <nlohmann/json.hpp>

#include "methods/error.hpp"

namespace dmocbench {

namespace {

/// The JSON at a place, cut short for a sentence.
std::string shown(const nlohmann::ordered_json& json) {
  constexpr std::size_t most_shown = 40;
  if (json.is_structured()) return json.is_object() ? "an object" : "an array";
  const std::string text = json.dump(-1, ' ', true, nlohmann::ordered_json::error_handler_t::replace);
  return text.size() > most_shown ? text.substr(0, most_shown) + " ..." : text;
}

/// The JSON in a text, discarded if there is none.
nlohmann::ordered_json read_json(const std::string& text) {
  using Json = nlohmann::ordered_json;
  constexpr int deepest = 16;
  const auto keeps = [](int depth, Json::parse_event_t /*event*/, Json& /*value*/) { return depth <= deepest; };
  return Json::parse(text, keeps, false);
}

}  // namespace

void JsonPlace::refuse(const char* wanted) const {
  throw Error("{}: {} is {}, not {}", file_, path_.empty() ? "the content" : path_, shown(*json_), wanted);
}

JsonPlace JsonPlace::inner(const nlohmann::ordered_json& json, const std::string& key) const {
  return {json, file_, path_.empty() ? key : path_ + " " + key};
}

bool JsonPlace::has(const std::string& key) const { return json_->is_object() && json_->contains(key); }

JsonPlace JsonPlace::at(const std::string& key) const {
  if (!json_->is_object()) refuse("an object");
  const auto found = json_->find(key);
  if (found == json_->end()) throw Error("{}: {} is missing", file_, inner(*json_, key).path_);
  return inner(*found, key);
}

std::vector<std::pair<std::string, JsonPlace>> JsonPlace::members() const {
  if (!json_->is_object()) refuse("an object");
  std::vector<std::pair<std::string, JsonPlace>> members;
  for (const auto& [key, value] : json_->items()) members.emplace_back(key, inner(value, key));
  return members;
}

std::vector<JsonPlace> JsonPlace::entries() const {
  if (!json_->is_array()) refuse("an array");
  std::vector<JsonPlace> entries;
  for (const auto& value : *json_) entries.push_back(inner(value, std::to_string(entries.size() + 1)));
  return entries;
}

std::string JsonPlace::text() const {
  if (!json_->is_string()) refuse("a text");
  return json_->get<std::string>();
}

double JsonPlace::number() const {
  if (!json_->is_number()) refuse("a number");
  return json_->get<double>();
}

int JsonPlace::count() const {
  constexpr int most = 1'000'000'000;
  const bool is_whole = json_->is_number_unsigned() && json_->get<unsigned long long>() <= most;
  if (!is_whole) refuse("a whole number from 0 to a billion");
  return json_->get<int>();
}

bool JsonPlace::boolean() const {
  if (!json_->is_boolean()) refuse("true or false");
  return json_->get<bool>();
}

std::vector<std::string> JsonPlace::texts() const {
  std::vector<std::string> texts;
  for (const JsonPlace& entry : entries()) texts.push_back(entry.text());
  return texts;
}

std::vector<double> JsonPlace::numbers() const {
  std::vector<double> numbers;
  if (!json_->is_array()) refuse("an array");
  numbers.reserve(json_->size());
  for (const auto& value : *json_) {
    if (!value.is_number()) inner(value, std::to_string(numbers.size() + 1)).refuse("a number");
    numbers.push_back(value.get<double>());
  }
  return numbers;
}

nlohmann::ordered_json json_in(const std::string& text, const std::string& file) {
  nlohmann::ordered_json json = read_json(text);
  if (json.is_discarded()) throw Error("{} is not JSON, or is truncated", file);
  return json;
}

nlohmann::ordered_json json_or_null(const std::string& text) {
  nlohmann::ordered_json json = read_json(text);
  return json.is_discarded() ? nlohmann::ordered_json() : json;
}

}  // namespace dmocbench
