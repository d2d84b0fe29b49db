#include "bench/speed/benchmark_name.hpp"

#include <sstream>
#include <vector>

#include "methods/error.hpp"

namespace dmocbench::speed {

namespace {

const std::string tableau_prefix = "gauss_";

}  // namespace

std::string BenchmarkName::text() const {
  std::string name = way + "/" + quantity + "/" + problem;
  if (!method.empty()) name += "/" + method + "/" + tableau_prefix + std::to_string(stages);
  if (!instruction_set.empty()) name += "/" + instruction_set;
  return name;
}

BenchmarkName BenchmarkName::parse(const std::string& text) {
  std::vector<std::string> parts;
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, '/');) parts.push_back(part);
  if (parts.size() < 3 || parts.size() > 6) throw Error("no name of a benchmark per interval: " + text);
  BenchmarkName name{.way = parts[0], .quantity = parts[1], .problem = parts[2], .method = "dmoc"};
  if (parts.size() >= 5) {
    name.method = parts[3];
    name.stages = std::stoi(parts[4].substr(tableau_prefix.size()));
  }
  if (parts.size() == 4 || parts.size() == 6) name.instruction_set = parts.back();
  return name;
}

}  // namespace dmocbench::speed
