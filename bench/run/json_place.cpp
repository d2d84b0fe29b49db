#include "bench/run/json_place.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "methods/error.hpp"

namespace dmocbench {

namespace {

/// What stands at a place, cut short for a sentence.
std::string shown(const nlohmann::ordered_json& json) {
  constexpr std::size_t most_shown = 40;
  if (json.is_structured()) return json.is_object() ? "an object" : "an array";
  const std::string text = json.dump(-1, ' ', true, nlohmann::ordered_json::error_handler_t::replace);
  return text.size() > most_shown ? text.substr(0, most_shown) + " ..." : text;
}

}  // namespace

void JsonPlace::refuse(const char* wanted) const {
  throw Error(fmt::format("{}: {} is {}, not {}", file_, path_.empty() ? "its content" : path_, shown(*json_), wanted));
}

JsonPlace JsonPlace::inner(const nlohmann::ordered_json& json, const std::string& key) const {
  return {json, file_, path_.empty() ? key : path_ + " " + key};
}

bool JsonPlace::has(const std::string& key) const { return json_->is_object() && json_->contains(key); }

JsonPlace JsonPlace::at(const std::string& key) const {
  if (!json_->is_object()) refuse("an object");
  const auto found = json_->find(key);
  if (found == json_->end()) throw Error(fmt::format("{}: {} is missing", file_, inner(*json_, key).path_));
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

bool JsonPlace::boolean() const {
  if (!json_->is_boolean()) refuse("true or false");
  return json_->get<bool>();
}

std::vector<std::string> JsonPlace::texts() const {
  std::vector<std::string> texts;
  for (const JsonPlace& entry : entries()) texts.push_back(entry.text());
  return texts;
}

}  // namespace dmocbench
