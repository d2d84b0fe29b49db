// The headers of AMPL's library define macros for everything, so that nothing else is included behind them.
#include "tests/extensions/interchange/asl_program.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>

#include "methods/error.hpp"

extern "C" {
#include <asl.h>
#include <getstub.h>
}
#undef filename

// The macros of the library cast, and its functions take what they only read as if they wrote it.
// NOLINTBEGIN(cppcoreguidelines-pro-type-*,google-readability-casting,readability-*,modernize-*,bugprone-*,cppcoreguidelines-*,misc-*)
namespace dmocbench::tests {

struct AslProgram::Library {
  ASL* asl;
  explicit Library(AslReader reader) : asl(ASL_alloc(reader == AslReader::whole ? ASL_read_fgh : ASL_read_pfgh)) {}
  Library(const Library&) = delete;
  Library& operator=(const Library&) = delete;
  ~Library() { ASL_free(&asl); }
};

namespace {

/// AMPL's infinity is a large number.
Eigen::VectorXd bounds_of(const real* values, Eigen::Index size) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  Eigen::VectorXd result = Eigen::Map<const Eigen::VectorXd>(values, size);
  for (double& bound : result) {
    if (std::abs(bound) >= 1e300) bound = std::copysign(infinity, bound);
  }
  return result;
}

void require(fint error, const char* what) {
  if (error != 0) throw Error(std::string("the library cannot evaluate ") + what);
}

}  // namespace

AslProgram::AslProgram(const std::filesystem::path& file, AslReader reader)
    : reader_(reader), library_(std::make_unique<Library>(reader)) {
  ASL* asl = library_->asl;
  return_nofile = 1;
  std::string name = file.string();
  FILE* nl = jac0dim(name.data(), static_cast<fint>(name.size()));
  if (nl == nullptr) throw Error("the library cannot read " + name);
  variables = n_var;
  rows = n_con;
  const auto allocate = [&](Eigen::Index size) {
    return static_cast<real*>(M1alloc(static_cast<std::size_t>(std::max<Eigen::Index>(size, 1)) * sizeof(real)));
  };
  X0 = allocate(variables);
  LUv = allocate(variables);
  Uvx = allocate(variables);
  LUrhs = allocate(rows);
  Urhsx = allocate(rows);
  const int error = reader == AslReader::whole ? fgh_read(nl, ASL_return_read_err)
                                               : pfgh_read(nl, ASL_return_read_err | ASL_findgroups);
  if (error != 0) throw Error("the library refuses " + name + " with code " + std::to_string(error));
  start = Eigen::Map<const Eigen::VectorXd>(X0, variables);
  variable_lower = bounds_of(LUv, variables);
  variable_upper = bounds_of(Uvx, variables);
  row_lower = bounds_of(LUrhs, rows);
  row_upper = bounds_of(Urhsx, rows);
  for (int i = 0; i < n_var; ++i) variable_names.emplace_back(var_name(i));
  for (int i = 0; i < n_con; ++i) row_names.emplace_back(con_name(i));
}

AslProgram::~AslProgram() = default;

double AslProgram::objective(const Eigen::VectorXd& x) const {
  ASL* asl = library_->asl;
  fint error = 0;
  const double value = objval(0, const_cast<real*>(x.data()), &error);
  require(error, "the objective");
  return value;
}

Eigen::VectorXd AslProgram::gradient(const Eigen::VectorXd& x) const {
  ASL* asl = library_->asl;
  fint error = 0;
  Eigen::VectorXd result(variables);
  objgrd(0, const_cast<real*>(x.data()), result.data(), &error);
  require(error, "the gradient");
  return result;
}

Eigen::VectorXd AslProgram::constraints(const Eigen::VectorXd& x) const {
  ASL* asl = library_->asl;
  fint error = 0;
  Eigen::VectorXd result(rows);
  conval(const_cast<real*>(x.data()), result.data(), &error);
  require(error, "the constraints");
  return result;
}

SparseEntries AslProgram::jacobian(const Eigen::VectorXd& x) const {
  ASL* asl = library_->asl;
  fint error = 0;
  std::vector<real> values(static_cast<std::size_t>(nzc));
  jacval(const_cast<real*>(x.data()), values.data(), &error);
  require(error, "the Jacobian");
  SparseEntries entries;
  for (int i = 0; i < n_con; ++i) {
    for (const cgrad* entry = Cgrad[i]; entry != nullptr; entry = entry->next) {
      entries[{i, entry->varno}] = values[static_cast<std::size_t>(entry->goff)];
    }
  }
  return entries;
}

SparseEntries AslProgram::hessian(const Eigen::VectorXd& x, double factor, const Eigen::VectorXd& multipliers) const {
  static_cast<void>(objective(x));  // second derivatives are those of the last point
  static_cast<void>(constraints(x));
  return reader_ == AslReader::whole ? hessian_by_directions(factor, multipliers)
                                     : hessian_by_parts(factor, multipliers);
}

SparseEntries AslProgram::hessian_by_directions(double factor, const Eigen::VectorXd& multipliers) const {
  ASL* asl = library_->asl;
  Eigen::VectorXd direction = Eigen::VectorXd::Zero(variables);
  Eigen::VectorXd column(variables);
  SparseEntries entries;
  for (Eigen::Index j = 0; j < variables; ++j) {
    direction[j] = 1.0;
    hvcomp(column.data(), direction.data(), -1, &factor, const_cast<real*>(multipliers.data()));
    direction[j] = 0.0;
    for (Eigen::Index i = j; i < variables; ++i) {
      if (column[i] != 0.0) entries[{i, j}] = column[i];
    }
  }
  return entries;
}

SparseEntries AslProgram::hessian_by_parts(double factor, const Eigen::VectorXd& multipliers) const {
  ASL* asl = library_->asl;
  std::vector<real> values(static_cast<std::size_t>(sphsetup(-1, 1, 1, 1)));
  sphes(values.data(), -1, &factor, const_cast<real*>(multipliers.data()));
  SparseEntries entries;
  const fint* const heads = sputinfo->hcolstarts;
  for (int column = 0; column < n_var; ++column) {
    for (fint e = heads[column]; e < heads[column + 1]; ++e) {
      entries[{column, sputinfo->hrownos[e]}] = values[static_cast<std::size_t>(e)];  // of the upper triangle
    }
  }
  return entries;
}

void AslProgram::write_solution(const std::string& message, int code, Eigen::VectorXd x, Eigen::VectorXd duals) const {
  ASL* asl = library_->asl;
  solve_result_num = code;
  std::string text = message;
  Option_Info options{};
  options.wantsol = 1;  // a file, as for AMPL
  write_sol(text.data(), x.data(), duals.data(), &options);
}

}  // namespace dmocbench::tests
// NOLINTEND(cppcoreguidelines-pro-type-*,google-readability-casting,readability-*,modernize-*,bugprone-*,cppcoreguidelines-*,misc-*)
