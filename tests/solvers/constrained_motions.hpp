#pragma once

#include <cstdint>
#include <memory>
#include <utility>
#include <vector>

#include <Eigen/QR>
#include <gtest/gtest.h>

#include "tests/support/solving.hpp"

namespace dmocbench::tests {

/// What is given of the ends of a motion.
enum class Ends : std::uint8_t { given, free_last_velocity, free_last, free_first_velocity };

/// A mechanism of three coordinates with an end that is not given completely.
template <class Mechanism>
class WithOpenEnds final : public Mechanism {
 public:
  explicit WithOpenEnds(Ends ends) : ends_(ends) {}
  [[nodiscard]] std::string name() const override { return "with_open_ends"; }
  [[nodiscard]] std::unique_ptr<Problem> clone() const override { return Problem::clone(); }
  [[nodiscard]] ProblemBounds bounds() const override {
    ProblemBounds bounds = Mechanism::bounds();
    for (Eigen::Index i = 0; i < 3; ++i) {
      if (ends_ == Ends::free_last_velocity || ends_ == Ends::free_last) bounds.last.free_velocity(i);
      if (ends_ == Ends::free_last) bounds.last.free_configuration(i);
      if (ends_ == Ends::free_first_velocity) bounds.first.free_velocity(i);
    }
    return bounds;
  }

 private:
  Ends ends_;
};

/// Rows have full rank and leave two controls per stage, and these freedoms of the ends less their conditions.
template <class Mechanism>
void expect_full_rank(const Scheme& scheme, const std::vector<std::pair<Ends, Eigen::Index>>& freedoms_of_ends) {
  constexpr Eigen::Index intervals = 6;
  for (const auto& [ends, freedoms] : freedoms_of_ends) {
    const WithOpenEnds<Mechanism> problem(ends);
    const auto program = transcribe(problem, scheme, Grid::uniform(intervals));
    const Eigen::MatrixXd jacobian = free_columns(*program, sample(*program, guessed_motion(problem)));
    Eigen::ColPivHouseholderQR<Eigen::MatrixXd> factors(jacobian);
    factors.setThreshold(1e-9);
    EXPECT_EQ(factors.rank(), jacobian.rows()) << static_cast<int>(ends);
    EXPECT_EQ(jacobian.cols() - jacobian.rows(), 2 * intervals * scheme.stages + freedoms) << static_cast<int>(ends);
  }
}

}  // namespace dmocbench::tests
