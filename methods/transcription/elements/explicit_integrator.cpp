#include "methods/transcription/elements/explicit_integrator.hpp"

#include <array>

#include "methods/choose.hpp"

namespace dmocbench {

namespace {

ExplicitIntegrator classical() {
  ExplicitIntegrator method{"rk4", Eigen::MatrixXd::Zero(4, 4), Eigen::Vector4d(1, 2, 2, 1) / 6.0,
                            Eigen::Vector4d(0.0, 0.5, 0.5, 1.0), 4};
  method.a(1, 0) = 0.5;
  method.a(2, 1) = 0.5;
  method.a(3, 2) = 1.0;
  return method;
}

ExplicitIntegrator midpoint() {
  ExplicitIntegrator method{"midpoint", Eigen::MatrixXd::Zero(2, 2), Eigen::Vector2d(0.0, 1.0),
                            Eigen::Vector2d(0.0, 0.5), 2};
  method.a(1, 0) = 0.5;
  return method;
}

const std::array<ExplicitIntegrator, 2>& integrators() {
  static const std::array<ExplicitIntegrator, 2> table{classical(), midpoint()};
  return table;
}

}  // namespace

std::vector<std::string> explicit_integrator_names() { return names_of(integrators(), &ExplicitIntegrator::name); }

const ExplicitIntegrator& explicit_integrator(std::string_view name) {
  return one_of(integrators(), &ExplicitIntegrator::name, name, "there is no integrator");
}

}  // namespace dmocbench
