#include "bench/speed/start_benchmarks.hpp"

#include <benchmark/benchmark.h>

namespace dmocbench::speed {

bool initialize(const char* program, std::span<char* const> flags, const std::vector<std::string>& ours) {
  static std::vector<std::string> arguments;  // the library keeps a pointer to the program's name
  arguments = {program, "--benchmark_repetitions=5", "--benchmark_min_time=0.05",
               "--benchmark_enable_random_interleaving=true"};
  arguments.insert(arguments.end(), ours.begin(), ours.end());
  arguments.insert(arguments.end(), flags.begin(), flags.end());
  std::vector<char*> pointers;
  pointers.reserve(arguments.size() + 1);
  for (std::string& argument : arguments) pointers.push_back(argument.data());
  int count = static_cast<int>(pointers.size());
  pointers.push_back(nullptr);
  benchmark::Initialize(&count, pointers.data());
  return !benchmark::ReportUnrecognizedArguments(count, pointers.data());
}

}  // namespace dmocbench::speed
