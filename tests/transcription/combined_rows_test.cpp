// The rows of Hamiltonian collocation, combined such that the momenta cancel, are DMOC's rows.

#include <string>

#include <gtest/gtest.h>

#include "problems/orbital_transfer.hpp"
#include "problems/two_link_manipulator.hpp"
#include "tests/support/random_points.hpp"
#include "tests/support/solving.hpp"

namespace dmocbench {
namespace {

/// Entry `first` + k of every column of a quantity is its value at node or in interval k.
template <class HeadOf>
Eigen::VectorXd entries_at(const Eigen::VectorXd& vector, Eigen::Index count, Eigen::Index k, const HeadOf& head_of) {
  return Eigen::VectorXd::NullaryExpr(
      count, [&](Eigen::Index i) { return vector[static_cast<Eigen::Index>(head_of(i)) + k]; });
}

/// The unknowns of DMOC among those of Hamiltonian collocation: q, interior Q̇ and U.
Eigen::VectorXd without_momenta(const ProgramBlocks& from, const ProgramBlocks& to, const Eigen::VectorXd& x) {
  Eigen::VectorXd result(static_cast<Eigen::Index>(to.variable_count()));
  for (const UnknownBlock& target : to.unknowns()) {
    const UnknownBlock& source = from.unknown(target.kind, target.stage);
    const Eigen::Index size = target.width * static_cast<Eigen::Index>(target.length);
    result.segment(target.index(), size) = x.segment(source.index(), size);
  }
  return result;
}

/// What DMOC's rows of interval k are by those of Hamiltonian collocation, r_i = P_i - L_v and r'_i = Ṗ_i - L_q - f:
///   left + p_k        =  r_s - h Σ_i ã_si r'_i,
///   right - p_{k+1}   = -r_s - h Σ_i (b_i - ã_si) r'_i,
///   stage equation j  =  r_s - r_j - h Σ_i (ã_si - ã_ji) r'_i.
class CombinedRows {
 public:
  CombinedRows(Transcription& hamiltonian, const Eigen::VectorXd& x)
      : tableau_(hamiltonian.tableau()), blocks_(hamiltonian.blocks()), steps_(hamiltonian.steps(x)) {
    rows_.resize(static_cast<Eigen::Index>(hamiltonian.constraint_count()));
    hamiltonian.constraints(x, rows_);
  }

  [[nodiscard]] Eigen::VectorXd left(Eigen::Index k) const {
    return momentum_row(k, last()) - force_rows(k, tableau_.a_conjugate.row(last()));
  }
  [[nodiscard]] Eigen::VectorXd right(Eigen::Index k) const {
    return -momentum_row(k, last()) - force_rows(k, tableau_.b.transpose() - tableau_.a_conjugate.row(last()));
  }
  [[nodiscard]] Eigen::VectorXd stage_equation(Eigen::Index k, Eigen::Index j) const {
    return momentum_row(k, last()) - momentum_row(k, j) -
           force_rows(k, tableau_.a_conjugate.row(last()) - tableau_.a_conjugate.row(j));
  }

 private:
  [[nodiscard]] Eigen::Index last() const { return tableau_.stages() - 1; }
  [[nodiscard]] Eigen::VectorXd row(Equation kind, Eigen::Index k, Eigen::Index stage) const {
    const RowBlock& block = blocks_.row(kind, stage);
    return entries_at(rows_, block.width, k, [&](Eigen::Index i) { return block.at(i); });
  }
  [[nodiscard]] Eigen::VectorXd momentum_row(Eigen::Index k, Eigen::Index stage) const {
    return row(Equation::momentum, k, stage);
  }
  [[nodiscard]] Eigen::VectorXd force_rows(Eigen::Index k, const Eigen::RowVectorXd& weights) const {
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(blocks_.unknown(Quantity::configuration).width);
    for (Eigen::Index i = 0; i < weights.size(); ++i) sum += weights[i] * row(Equation::euler_lagrange, k, i);
    return steps_[k] * sum;
  }

  const Tableau& tableau_;
  const ProgramBlocks& blocks_;
  Eigen::VectorXd steps_;
  Eigen::VectorXd rows_;
};

void expect_dmocs_rows(const Problem& problem, const std::string& family, int stages) {
  SCOPED_TRACE(problem.name() + " " + family + " s=" + std::to_string(stages));
  constexpr Eigen::Index intervals = 5;
  const Grid grid = tests::graded_grid(intervals);
  const auto dmoc = tests::transcribe(problem, {"dmoc", stages, family}, grid);
  const auto hamiltonian = tests::transcribe(problem, {"hamiltonian", stages, family}, grid);
  const ProgramBlocks& blocks = dmoc->blocks();
  const Eigen::Index n = problem.configuration_size();
  tests::RandomPoints random;
  for (int point = 0; point < 20; ++point) {
    const Eigen::VectorXd x = random.vector(static_cast<Eigen::Index>(hamiltonian->variable_count()), 0.5, 1.5);
    Eigen::VectorXd rows(static_cast<Eigen::Index>(dmoc->constraint_count()));
    dmoc->constraints(without_momenta(hamiltonian->blocks(), blocks, x), rows);
    const CombinedRows combined(*hamiltonian, x);
    const auto momentum = [&](Eigen::Index k) {
      return entries_at(x, n, k, [&](Eigen::Index i) { return hamiltonian->blocks().unknown(Quantity::second).at(i); });
    };
    const double rounding = 1e-12 * rows.lpNorm<Eigen::Infinity>();
    for (Eigen::Index k = 0; k <= intervals; ++k) {
      Eigen::VectorXd expected = Eigen::VectorXd::Zero(n);
      if (k < intervals) expected += combined.left(k) - momentum(k);
      if (k > 0) expected += combined.right(k - 1) + momentum(k);
      const Eigen::VectorXd found =
          entries_at(rows, n, k, [&](Eigen::Index i) { return blocks.row(Equation::euler_lagrange).at(i); });
      EXPECT_LT((found - expected).lpNorm<Eigen::Infinity>(), rounding);
    }
    for (Eigen::Index k = 0; k < intervals; ++k) {
      for (Eigen::Index j = 0; j + 1 < stages; ++j) {
        const Eigen::VectorXd found =
            entries_at(rows, n, k, [&](Eigen::Index i) { return blocks.row(Equation::euler_lagrange, j).at(i); });
        EXPECT_LT((found - combined.stage_equation(k, j)).lpNorm<Eigen::Infinity>(), rounding);
      }
    }
  }
}

TEST(CombinedRows, OfHamiltonianCollocationAreThoseOfDmocForAllTableaus) {
  const OrbitalTransfer orbit;
  const TwoLinkManipulator two_link;
  for (const Problem* problem : {static_cast<const Problem*>(&orbit), static_cast<const Problem*>(&two_link)}) {
    for (const std::string& family : tableau_names()) {
      for (const int stages : tableau_stages(family)) expect_dmocs_rows(*problem, family, stages);
    }
  }
}

}  // namespace
}  // namespace dmocbench
