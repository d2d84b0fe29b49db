#include "methods/transcription/element.hpp"

#include <array>

#include "methods/error.hpp"
#include "methods/transcription/dmoc_element.hpp"
#include "methods/transcription/hamiltonian_element.hpp"
#include "methods/transcription/tangent_element.hpp"

namespace dmocbench {

namespace {

template <class Type>
std::unique_ptr<Element> make() {
  return std::make_unique<Type>();
}

using Maker = std::unique_ptr<Element> (*)();

// One line per family.
constexpr std::array registry{
    Maker{make<DmocElement>},
    Maker{make<HamiltonianElement>},
    Maker{make<TangentElement>},
};

}  // namespace

std::vector<std::string> element_names() {
  std::vector<std::string> names;
  for (const Maker create : registry) names.push_back(create()->name());
  return names;
}

std::unique_ptr<Element> make_element(std::string_view name) {
  std::string known;
  for (const Maker create : registry) {
    auto element = create();
    if (element->name() == name) return element;
    known += (known.empty() ? "" : ", ") + element->name();
  }
  throw Error("there is no method \"" + std::string(name) + "\"; choose one of " + known);
}

std::vector<ExpressionVector> all_slopes(const ExpressionVector& left, const ExpressionVector& right,
                                         const std::vector<ExpressionVector>& interior, const Eigen::VectorXd& b,
                                         const Expression& h) {
  std::vector<ExpressionVector> slopes = interior;
  ExpressionVector last = (right - left) / h;
  for (std::size_t j = 0; j < interior.size(); ++j) last -= Expression(b[static_cast<Eigen::Index>(j)]) * interior[j];
  last /= Expression(b[b.size() - 1]);
  slopes.push_back(last);
  return slopes;
}

std::vector<ExpressionVector> stage_values(const ExpressionVector& left, const std::vector<ExpressionVector>& slopes,
                                           const Eigen::MatrixXd& a, const Expression& h) {
  std::vector<ExpressionVector> stages;
  for (Eigen::Index i = 0; i < a.rows(); ++i) {
    ExpressionVector stage = left;
    for (Eigen::Index j = 0; j < a.cols(); ++j) {
      stage += (h * Expression(a(i, j))) * slopes[static_cast<std::size_t>(j)];
    }
    stages.push_back(stage);
  }
  return stages;
}

Expression quadrature_of_cost(const std::vector<TracedProblem::Values>& stages, const Eigen::VectorXd& b,
                              const Expression& h) {
  Expression sum;
  for (Eigen::Index i = 0; i < b.size(); ++i) {
    sum += Expression(b[i]) * stages[static_cast<std::size_t>(i)].running_cost;
  }
  return h * sum;
}

}  // namespace dmocbench
