// ampl_ipopt STUB.nl: Ipopt on a program as AMPL's library reads it, answered by STUB.sol. A solver of AMPL's kind, to
// which we are just one of those that write such files.
#include <cstdio>
#include <exception>
#include <utility>

#if __has_include(<coin-or/IpIpoptApplication.hpp>)
#include <coin-or/IpIpoptApplication.hpp>
#include <coin-or/IpTNLP.hpp>
#else
#include <IpIpoptApplication.hpp>
#include <IpTNLP.hpp>
#endif

#include <fmt/format.h>

#include "tests/extensions/interchange/asl_program.hpp"

namespace dmocbench::tests {
namespace {

/// The places of sparse entries, in their order, and their values.
class EntryList {
 public:
  explicit EntryList(const SparseEntries& structure) {
    for (const auto& [place, value] : structure) places_.push_back(place);
  }
  [[nodiscard]] Ipopt::Index size() const { return static_cast<Ipopt::Index>(places_.size()); }
  void write_places(Ipopt::Index* rows, Ipopt::Index* columns) const {
    for (std::size_t e = 0; e < places_.size(); ++e) {
      rows[e] = static_cast<Ipopt::Index>(places_[e].first);
      columns[e] = static_cast<Ipopt::Index>(places_[e].second);
    }
  }
  void write_values(const SparseEntries& entries, Ipopt::Number* values) const {
    for (std::size_t e = 0; e < places_.size(); ++e) {
      const auto entry = entries.find(places_[e]);
      values[e] = entry == entries.end() ? 0.0 : entry->second;
    }
  }

 private:
  std::vector<std::pair<Eigen::Index, Eigen::Index>> places_;
};

class ReadProgram final : public Ipopt::TNLP {
 public:
  explicit ReadProgram(const AslProgram& program)
      : program_(program),
        jacobian_(program.jacobian(program.start)),
        hessian_(program.hessian(program.start, 1.0, Eigen::VectorXd::Ones(program.rows))) {}

  bool get_nlp_info(Ipopt::Index& n, Ipopt::Index& m, Ipopt::Index& of_jacobian, Ipopt::Index& of_hessian,
                    IndexStyleEnum& style) override {
    n = static_cast<Ipopt::Index>(program_.variables);
    m = static_cast<Ipopt::Index>(program_.rows);
    of_jacobian = jacobian_.size();
    of_hessian = hessian_.size();
    style = C_STYLE;
    return true;
  }
  bool get_bounds_info(Ipopt::Index n, Ipopt::Number* lower, Ipopt::Number* upper, Ipopt::Index m,
                       Ipopt::Number* row_lower, Ipopt::Number* row_upper) override {
    Eigen::Map<Eigen::VectorXd>(lower, n) = program_.variable_lower;
    Eigen::Map<Eigen::VectorXd>(upper, n) = program_.variable_upper;
    Eigen::Map<Eigen::VectorXd>(row_lower, m) = program_.row_lower;
    Eigen::Map<Eigen::VectorXd>(row_upper, m) = program_.row_upper;
    return true;
  }
  bool get_starting_point(Ipopt::Index n, bool /*wants_x*/, Ipopt::Number* x, bool /*wants_z*/, Ipopt::Number* /*z_l*/,
                          Ipopt::Number* /*z_u*/, Ipopt::Index /*m*/, bool /*wants_multipliers*/,
                          Ipopt::Number* /*multipliers*/) override {
    Eigen::Map<Eigen::VectorXd>(x, n) = program_.start;
    return true;
  }
  bool eval_f(Ipopt::Index n, const Ipopt::Number* x, bool /*is_new*/, Ipopt::Number& value) override {
    value = program_.objective(Eigen::Map<const Eigen::VectorXd>(x, n));
    return true;
  }
  bool eval_grad_f(Ipopt::Index n, const Ipopt::Number* x, bool /*is_new*/, Ipopt::Number* gradient) override {
    Eigen::Map<Eigen::VectorXd>(gradient, n) = program_.gradient(Eigen::Map<const Eigen::VectorXd>(x, n));
    return true;
  }
  bool eval_g(Ipopt::Index n, const Ipopt::Number* x, bool /*is_new*/, Ipopt::Index m, Ipopt::Number* rows) override {
    Eigen::Map<Eigen::VectorXd>(rows, m) = program_.constraints(Eigen::Map<const Eigen::VectorXd>(x, n));
    return true;
  }
  bool eval_jac_g(Ipopt::Index n, const Ipopt::Number* x, bool /*is_new*/, Ipopt::Index /*m*/, Ipopt::Index /*size*/,
                  Ipopt::Index* rows, Ipopt::Index* columns, Ipopt::Number* values) override {
    if (values == nullptr) {
      jacobian_.write_places(rows, columns);
    } else {
      jacobian_.write_values(program_.jacobian(Eigen::Map<const Eigen::VectorXd>(x, n)), values);
    }
    return true;
  }
  bool eval_h(Ipopt::Index n, const Ipopt::Number* x, bool /*is_new*/, Ipopt::Number factor, Ipopt::Index m,
              const Ipopt::Number* multipliers, bool /*are_new*/, Ipopt::Index /*size*/, Ipopt::Index* rows,
              Ipopt::Index* columns, Ipopt::Number* values) override {
    if (values == nullptr) {
      hessian_.write_places(rows, columns);
    } else {
      hessian_.write_values(program_.hessian(Eigen::Map<const Eigen::VectorXd>(x, n), factor,
                                             Eigen::Map<const Eigen::VectorXd>(multipliers, m)),
                            values);
    }
    return true;
  }
  void finalize_solution(Ipopt::SolverReturn status, Ipopt::Index n, const Ipopt::Number* x,
                         const Ipopt::Number* /*z_l*/, const Ipopt::Number* /*z_u*/, Ipopt::Index m,
                         const Ipopt::Number* /*rows*/, const Ipopt::Number* multipliers, Ipopt::Number /*value*/,
                         const Ipopt::IpoptData* /*data*/, Ipopt::IpoptCalculatedQuantities* /*quantities*/) override {
    const bool is_solved = status == Ipopt::SUCCESS;
    // AMPL's dual of a row is the derivative of the optimum by its bound.
    program_.write_solution(is_solved ? "Ipopt: optimal" : "Ipopt: failed", is_solved ? 0 : 500,
                            Eigen::Map<const Eigen::VectorXd>(x, n),
                            -Eigen::Map<const Eigen::VectorXd>(multipliers, m));
  }

 private:
  const AslProgram& program_;
  EntryList jacobian_;
  EntryList hessian_;
};

int solve_file(const char* file) {
  const AslProgram program(file, AslReader::partially_separable);
  const Ipopt::SmartPtr<Ipopt::IpoptApplication> ipopt = new Ipopt::IpoptApplication(false);
  ipopt->Options()->SetNumericValue("tol", 1e-12);
  ipopt->Options()->SetIntegerValue("print_level", 0);
  ipopt->Options()->SetStringValue("sb", "yes");
  // As our own call does; relaxed bounds would move the answer.
  ipopt->Options()->SetNumericValue("bound_relax_factor", 0.0);
  if (ipopt->Initialize() != Ipopt::Solve_Succeeded) return 1;
  return ipopt->OptimizeTNLP(new ReadProgram(program)) == Ipopt::Solve_Succeeded ? 0 : 1;
}

}  // namespace
}  // namespace dmocbench::tests

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fputs("usage: ampl_ipopt STUB.nl\n", stderr);
    return 2;
  }
  try {
    return dmocbench::tests::solve_file(argv[1]);
  } catch (const std::exception& error) {
    fmt::print(stderr, "ampl_ipopt: {}\n", error.what());
    return 2;
  }
}
