#include "bench/extensions/primitives/roadmap_file.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "bench/run/result_file.hpp"
#include "bench/run/written_tables.hpp"
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

Eigen::VectorXd numbers_from(const RoadmapJson& json) {
  const auto numbers = json.get<std::vector<double>>();
  return Eigen::Map<const Eigen::VectorXd>(numbers.data(), static_cast<Eigen::Index>(numbers.size()));
}

Eigen::MatrixXd rows_from(const RoadmapJson& json) {
  if (json.empty()) return {};
  const auto rows = static_cast<Eigen::Index>(json.size());
  Eigen::MatrixXd table(rows, static_cast<Eigen::Index>(json.front().size()));
  for (Eigen::Index row = 0; row < rows; ++row) {
    const Eigen::VectorXd numbers = numbers_from(json[static_cast<std::size_t>(row)]);
    if (numbers.size() != table.cols()) throw Error("it is damaged: rows of a table have different lengths");
    table.row(row) = numbers.transpose();
  }
  return table;
}

Displacement displacement_from(const RoadmapJson& json) {
  return {.linear = rows_from(json.at("linear")), .shift = numbers_from(json.at("shift"))};
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

Primitive primitive_from(const RoadmapJson& json) {
  return {.first = json.at("first").get<std::size_t>(),
          .last = json.at("last").get<std::size_t>(),
          .displacement = displacement_from(json.at("displacement")),
          .duration = json.at("duration").get<int>(),
          .cost = json.at("cost").get<double>(),
          .q = rows_from(json.at("q")),
          .v = rows_from(json.at("v")),
          .u = rows_from(json.at("u"))};
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

PrimitiveLibrary library_from(const RoadmapJson& content) {
  PrimitiveLibrary library{.problem = content.at("problem").get<std::string>(),
                           .parameters = {},
                           .step = content.at("step").get<double>(),
                           .intervals_per_step = content.at("intervals_per_step").get<int>(),
                           .states = {},
                           .primitives = {}};
  for (const auto& [name, value] : content.at("parameters").items()) {
    library.parameters.emplace_back(name, value.get<double>());
  }
  for (const RoadmapJson& each : content.at("states")) {
    library.states.push_back({.q = numbers_from(each.at("q")), .v = numbers_from(each.at("v"))});
  }
  for (const RoadmapJson& each : content.at("primitives")) library.primitives.push_back(primitive_from(each));
  return library;
}

std::vector<RoadmapNode> nodes_from(const RoadmapJson& content, const PrimitiveLibrary& library) {
  std::vector<RoadmapNode> nodes;
  for (const RoadmapJson& each : content.at("nodes")) {
    nodes.push_back({.state = each.at("state").get<std::size_t>(), .moved = displacement_from(each)});
    const Displacement& moved = nodes.back().moved;
    const Eigen::Index n = library.states.empty() ? 0 : library.states.front().q.size();
    if (moved.linear.rows() != n || moved.linear.cols() != n || moved.shift.size() != n) {
      throw Error("it is damaged: sizes of nodes do not fit");
    }
  }
  return nodes;
}

/// The part behind "content", whose checksum is right.
RoadmapJson checked_content(std::string_view text) {
  RoadmapJson json = RoadmapJson::parse(text);
  if (json.at("format") != roadmap_format) throw Error("it is no roadmap");
  if (json.at("version") != roadmap_version) {
    throw Error(
        fmt::format("it has version {}, this program reads version {}", json.at("version").dump(), roadmap_version));
  }
  RoadmapJson content = std::move(json.at("content"));
  if (json.at("crc32") != fmt::format("{:08x}", crc_32(content.dump()))) {
    throw Error("it is damaged: its checksum is that of another content");
  }
  return content;
}

StoredRoadmap roadmap_from(const RoadmapJson& content, const Problem& problem) {
  PrimitiveLibrary library = library_from(content);
  library.require_made_for(problem);
  std::vector<RoadmapEdge> edges;
  for (const RoadmapJson& each : content.at("edges")) {
    edges.push_back({.from = each.at(0), .to = each.at(1), .primitive = each.at(2)});
  }
  Roadmap roadmap(library, nodes_from(content, library), std::move(edges));
  StoredRoadmap stored{.library = std::move(library),
                       .roadmap = std::move(roadmap),
                       .start = content.at("start"),
                       .goal = content.at("goal")};
  if (std::max(stored.start, stored.goal) >= stored.roadmap.nodes().size()) {
    throw Error("it is damaged: start or goal is no node");
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
  const std::string checksum = fmt::format("{:08x}", crc_32(content.dump()));
  return RoadmapJson{{"format", roadmap_format},
                     {"version", roadmap_version},
                     {"crc32", checksum},
                     {"content", std::move(content)}}
             .dump() +
         "\n";
}

StoredRoadmap roadmap_of(std::string_view text, const Problem& problem) {
  try {
    return roadmap_from(checked_content(text), problem);
  } catch (const RoadmapJson::exception&) {
    throw Error("it is cut off or no roadmap");
  }
}

void write_roadmap(const std::filesystem::path& file, const StoredRoadmap& stored) {
  write_file(file, roadmap_text(stored));
}

StoredRoadmap read_roadmap(const std::filesystem::path& file, const Problem& problem) {
  const std::string text = read_file(file);
  try {
    return roadmap_of(text, problem);
  } catch (const Error& error) {
    throw Error(fmt::format("{} cannot be used as the roadmap of {}: {}", file.string(), problem.name(), error.what()));
  }
}

}  // namespace dmocbench
