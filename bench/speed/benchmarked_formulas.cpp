#include "bench/speed/benchmarked_formulas.hpp"

#include <algorithm>
#include <iterator>
#include <numeric>
#include <random>
#include <utility>

#include "bench/run/uniform_01.hpp"
#include "methods/expression/replay.hpp"
#include "methods/transcription/elements/element.hpp"
#include "methods/transcription/elements/tableau.hpp"
#include "methods/transcription/motions/grid.hpp"
#include "problems/registry.hpp"

namespace dmocbench::speed {

namespace {

/// Numbers around 1, the same on every run: no radius vanishes, and every angle is an ordinary one.
Eigen::VectorXd random_numbers(std::mt19937_64& generator, std::size_t size) {
  return Eigen::VectorXd::NullaryExpr(static_cast<Eigen::Index>(size), [&] { return 0.5 + uniform_01(generator); });
}

Grid uneven_grid() {
  std::mt19937_64 generator(1);
  Eigen::VectorXd nodes(static_cast<Eigen::Index>(BenchmarkedFormulas::intervals + 1));
  nodes << 0.0, random_numbers(generator, BenchmarkedFormulas::intervals);
  std::partial_sum(nodes.begin(), nodes.end(), nodes.begin());
  return Grid::from_nodes(nodes / nodes[nodes.size() - 1]);
}

std::unique_ptr<Problem> problem_of(const Formulas& formulas) {
  auto problem = make_problem(formulas.problem);
  if (formulas.links > 0) problem->set_parameter("links", formulas.links);
  return problem;
}

}  // namespace

BenchmarkedFormulas::BenchmarkedFormulas(Formulas formulas)
    : formulas_(std::move(formulas)),
      program_(*problem_of(formulas_), *make_element(formulas_.method), gauss_tableau(formulas_.stages),
               uneven_grid()) {
  std::mt19937_64 generator(1);
  x_ = random_numbers(generator, program_.variable_count());
  multipliers_ = random_numbers(generator, program_.constraint_count());
  const auto bound = program_.bind(x_, multipliers_, objective_factor);
  columns_.assign(bound.begin(), bound.end());
  for (std::size_t k = 0; k < intervals; ++k) {
    for (const Tape::Input& input : columns_) by_interval_.push_back(input.data[input.same_for_all ? 0 : k]);
  }
}

Schedule fused(const BenchmarkedFormulas& formulas) {
  // Copies in this thread's graph, where equal expressions are shared.
  std::vector<Expression> all;
  for (const Schedule* part : formulas.schedules()) {
    std::vector<Expression> inputs;
    inputs.reserve(part->input_count());
    for (std::size_t i = 0; i < part->input_count(); ++i) inputs.push_back(Expression::input(i));
    std::ranges::copy(replay<Expression>(*part, inputs), std::back_inserter(all));
  }
  return Schedule(all);
}

}  // namespace dmocbench::speed
