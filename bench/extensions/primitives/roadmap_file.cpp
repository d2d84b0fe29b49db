#include "bench/extensions/primitives/roadmap_file.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "bench/run/json_place.hpp"
#include "bench/run/result_file.hpp"
#include "methods/error.hpp"

namespace dmocbench {

namespace {

using RoadmapJson = nlohmann::ordered_json;

constexpr const char* roadmap_format = "dmocbench roadmap";
constexpr int roadmap_version = 1;

RoadmapJson numbers_json(const Eigen::VectorXd& numbers) {
  return std::vector<double>(numbers.data(), numbers.data() + numbers.size());
}

RoadmapJson rows_json(const Eigen::MatrixXd& rows) {
  RoadmapJson json = RoadmapJson::array();
  for (Eigen::Index row = 0; row < rows.rows(); ++row) json.push_back(numbers_json(rows.row(row).transpose()));
  return json;
}

Eigen::VectorXd numbers_from(const JsonPlace& place) {
  const std::vector<double> numbers = place.numbers();
  return Eigen::Map<const Eigen::VectorXd>(numbers.data(), static_cast<Eigen::Index>(numbers.size()));
}

Eigen::MatrixXd rows_from(const JsonPlace& place) {
  const std::vector<JsonPlace> rows = place.entries();
  if (rows.empty()) return {};
  Eigen::MatrixXd table(std::ssize(rows), numbers_from(rows.front()).size());
  for (Eigen::Index row = 0; const JsonPlace& each : rows) {
    const Eigen::VectorXd numbers = numbers_from(each);
    if (numbers.size() != table.cols()) throw Error("it is damaged: rows of a table have different lengths");
    table.row(row++) = numbers.transpose();
  }
  return table;
}

Displacement displacement_from(const JsonPlace& place) {
  return {.linear = rows_from(place.at("linear")), .shift = numbers_from(place.at("shift"))};
}

RoadmapJson json_of(const Displacement& displacement) {
  return {{"linear", rows_json(displacement.linear)}, {"shift", numbers_json(displacement.shift)}};
}

RoadmapJson json_of(const Primitive& primitive) {
  return {
      {"first", primitive.first},       {"last", primitive.last},     {"displacement", json_of(primitive.displacement)},
      {"duration", primitive.duration}, {"cost", primitive.cost},     {"q", rows_json(primitive.q)},
      {"v", rows_json(primitive.v)},    {"u", rows_json(primitive.u)}};
}

std::size_t number_from(const JsonPlace& place) { return static_cast<std::size_t>(place.count()); }

Primitive primitive_from(const JsonPlace& place) {
  return {.first = number_from(place.at("first")),
          .last = number_from(place.at("last")),
          .displacement = displacement_from(place.at("displacement")),
          .duration = place.at("duration").count(),
          .cost = place.at("cost").number(),
          .q = rows_from(place.at("q")),
          .v = rows_from(place.at("v")),
          .u = rows_from(place.at("u"))};
}

RoadmapJson json_of(const PrimitiveLibrary& library) {
  RoadmapJson parameters = RoadmapJson::object();
  for (const auto& [name, value] : library.parameters) parameters[name] = value;
  RoadmapJson states = RoadmapJson::array();
  for (const BoundaryState& each : library.states) {
    states.push_back({{"q", numbers_json(each.q)}, {"v", numbers_json(each.v)}});
  }
  RoadmapJson primitives = RoadmapJson::array();
  for (const Primitive& each : library.primitives) primitives.push_back(json_of(each));
  return {{"problem", library.problem},  {"parameters", std::move(parameters)},
          {"step", library.step},        {"intervals_per_step", library.intervals_per_step},
          {"states", std::move(states)}, {"primitives", std::move(primitives)}};
}

PrimitiveLibrary library_from(const JsonPlace& content) {
  PrimitiveLibrary library{.problem = content.at("problem").text(),
                           .step = content.at("step").number(),
                           .intervals_per_step = content.at("intervals_per_step").count()};
  for (const auto& [name, value] : content.at("parameters").members()) {
    library.parameters.emplace_back(name, value.number());
  }
  for (const JsonPlace& each : content.at("states").entries()) {
    library.states.push_back({.q = numbers_from(each.at("q")), .v = numbers_from(each.at("v"))});
  }
  for (const JsonPlace& each : content.at("primitives").entries()) library.primitives.push_back(primitive_from(each));
  return library;
}

std::vector<RoadmapNode> nodes_from(const JsonPlace& content, const PrimitiveLibrary& library) {
  std::vector<RoadmapNode> nodes;
  for (const JsonPlace& each : content.at("nodes").entries()) {
    nodes.push_back({.state = number_from(each.at("state")), .moved = displacement_from(each)});
    const Displacement& moved = nodes.back().moved;
    const Eigen::Index n = library.states.empty() ? 0 : library.states.front().q.size();
    if (moved.linear.rows() != n || moved.linear.cols() != n || moved.shift.size() != n) {
      throw Error("it is damaged: a node has the wrong size");
    }
  }
  return nodes;
}

/// The part after "content", whose checksum is right.
RoadmapJson checked_content(std::string_view text) {
  RoadmapJson json = json_in(std::string(text), "it");
  const JsonPlace place(json, "its JSON");
  if (!place.has("format") || json["format"] != roadmap_format) throw Error("it is not a roadmap");
  if (const JsonPlace version = place.at("version"); version.json() != roadmap_version) {
    throw Error("it has version {}, but this program reads version {}", version.number(), roadmap_version);
  }
  const RoadmapJson& content = place.at("content").json();
  if (place.at("crc32").text() != checksum_of(content.dump())) {
    throw Error("it is damaged: its checksum does not match its content");
  }
  return content;
}

StoredRoadmap roadmap_from(const JsonPlace& content, const Problem& problem) {
  PrimitiveLibrary library = library_from(content);
  library.require_made_for(problem);
  std::vector<RoadmapEdge> edges;
  for (const JsonPlace& each : content.at("edges").entries()) {
    const std::vector<JsonPlace> ends = each.entries();
    if (ends.size() != 3) throw Error("it is damaged: an edge does not have three numbers");
    edges.push_back({.from = number_from(ends[0]), .to = number_from(ends[1]), .primitive = number_from(ends[2])});
  }
  Roadmap roadmap(library, nodes_from(content, library), std::move(edges));
  StoredRoadmap stored{.library = std::move(library),
                       .roadmap = std::move(roadmap),
                       .start = number_from(content.at("start")),
                       .goal = number_from(content.at("goal"))};
  if (std::max(stored.start, stored.goal) >= stored.roadmap.nodes().size()) {
    throw Error("it is damaged: the start or the goal is not a node");
  }
  return stored;
}

}  // namespace

std::string roadmap_text(const StoredRoadmap& stored) {
  RoadmapJson content = json_of(stored.library);
  RoadmapJson nodes = RoadmapJson::array();
  for (const RoadmapNode& each : stored.roadmap.nodes()) {
    RoadmapJson node{{"state", each.state}};
    node.update(json_of(each.moved));
    nodes.push_back(std::move(node));
  }
  RoadmapJson edges = RoadmapJson::array();
  for (const RoadmapEdge& each : stored.roadmap.edges()) edges.push_back({each.from, each.to, each.primitive});
  content["nodes"] = std::move(nodes);
  content["edges"] = std::move(edges);
  content["start"] = stored.start;
  content["goal"] = stored.goal;
  const std::string checksum = checksum_of(content.dump());
  return RoadmapJson{{"format", roadmap_format},
                     {"version", roadmap_version},
                     {"crc32", checksum},
                     {"content", std::move(content)}}
             .dump() +
         "\n";
}

StoredRoadmap roadmap_of(std::string_view text, const Problem& problem) {
  const RoadmapJson content = checked_content(text);
  return roadmap_from({content, "its JSON"}, problem);
}

void write_roadmap(const std::filesystem::path& file, const StoredRoadmap& stored) {
  write_file(file, roadmap_text(stored));
}

StoredRoadmap read_roadmap(const std::filesystem::path& file, const Problem& problem) {
  const std::string text = read_file(file);
  try {
    return roadmap_of(text, problem);
  } catch (const Error& error) {
    throw Error("{} cannot be used as the roadmap of {}: {}", file.string(), problem.name(), error.what());
  }
}

}  // namespace dmocbench
