#include "bench/experiments/banded_kkt.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include <Eigen/LU>
#include <lapacke.h>

#include "methods/error.hpp"
#include "methods/kkt/linearisation.hpp"
#include "methods/runtime/long_vectors.hpp"

namespace dmocbench::kkt {

namespace {

constexpr Eigen::Index the_step = 0;
constexpr Eigen::Index the_tangential_step = 1;
constexpr Eigen::Index steps = 2;

lapack_int lapack(std::size_t number) { return static_cast<lapack_int>(number); }

/// Calls `visit(in_jacobian, entry, line, other)` for the entries of Hessian and Jacobian, `other` being an unknown.
template <class Visit>
void for_each_entry(const NonlinearProgram& program, const Visit& visit) {
  for (const bool in_jacobian : {false, true}) {
    const std::size_t first_line = in_jacobian ? program.variable_count() : 0;
    const BlockPattern& pattern = in_jacobian ? program.jacobian_structure() : program.hessian_structure();
    pattern.for_each([&](Eigen::Index entry, int row, int column) {
      visit(in_jacobian, entry, first_line + static_cast<std::size_t>(row), static_cast<std::size_t>(column));
    });
  }
}

/// Where a line of the KKT matrix stands along the horizon; lines are sorted by it.
struct Key {
  static constexpr std::size_t border = std::numeric_limits<std::size_t>::max();
  std::size_t place = border;  // 2 k for node k, 2 k + 1 for interval k
  int rank = 0;                // at one place
  friend auto operator<=>(const Key& a, const Key& b) = default;
  [[nodiscard]] bool in_border() const { return place == border; }
};

/// Rows of a node stand before its unknowns, those of an interval behind: so an interval's rows stand between the two
/// nodes that they couple.
Key key_of(const Place& place, bool is_row) {
  if (place.kind == Place::Kind::border) return {};
  const bool of_node = place.kind == Place::Kind::node;
  return {2 * place.index + (of_node ? 0 : 1), is_row == of_node ? 1 : 2};
}
constexpr Key key_of_copy(std::size_t interval) { return {2 * interval + 1, 1}; }
constexpr Key key_of_tie(std::size_t interval) { return {2 * interval + 2, 0}; }

/// A row of the border that reads unknowns of one place only, such as a condition on the state at one end, needs no
/// line of the border: it goes to that place.
void bring_home_rows_of_one_place(const NonlinearProgram& program, std::vector<Key>& keys) {
  constexpr std::size_t unseen = Key::border - 1;
  std::vector<std::size_t> place(keys.size(), unseen);
  for_each_entry(program, [&](bool in_jacobian, Eigen::Index /*entry*/, std::size_t row, std::size_t unknown) {
    const std::size_t read = keys[unknown].place;
    if (!in_jacobian || !keys[row].in_border() || read == Key::border) return;  // T is everywhere
    place[row] = place[row] == unseen || place[row] == read ? read : Key::border;
  });
  for (std::size_t row = program.variable_count(); row < keys.size(); ++row) {
    if (!keys[row].in_border() || place[row] == Key::border) continue;
    keys[row] = {place[row] == unseen ? 0 : place[row], 1};
  }
}

/// Gives every line, copy and tie its position.
void number(const std::vector<Key>& keys, std::size_t unknowns, std::size_t intervals, NodeOrder& order) {
  struct Item {
    Key key;
    std::size_t* position;
  };
  std::vector<Item> items;
  order.lines.resize(keys.size());
  for (std::size_t line = 0; line < keys.size(); ++line) {
    if (!keys[line].in_border()) {
      items.push_back({keys[line], &order.lines[line].at});
    } else if (line >= unknowns) {
      order.lines[line] = {true, order.border_size++};
    } else {
      order.copies.push_back({line, std::vector<std::size_t>(intervals), std::vector<std::size_t>(intervals - 1)});
    }
  }
  for (NodeOrder::Copies& copies : order.copies) {
    for (std::size_t k = 0; k < intervals; ++k) items.push_back({key_of_copy(k), &copies.of_intervals[k]});
    for (std::size_t k = 0; k + 1 < intervals; ++k) items.push_back({key_of_tie(k), &copies.ties[k]});
  }
  std::ranges::stable_sort(items, {}, &Item::key);
  for (const Item& item : items) *item.position = order.band_size++;
  for (const NodeOrder::Copies& copies : order.copies) order.lines[copies.unknown].at = copies.of_intervals.front();
}

void measure_bandwidth(const NonlinearProgram& program, NodeOrder& order) {
  const auto widen = [&](std::size_t a, std::size_t b) {
    order.half_bandwidth = std::max(order.half_bandwidth, std::max(a, b) - std::min(a, b));
  };
  for_each_entry(program, [&](bool /*in_jacobian*/, Eigen::Index /*entry*/, std::size_t first, std::size_t second) {
    const NodeOrder::Line i = order.place(first, second);
    const NodeOrder::Line j = order.place(second, first);
    if (!i.in_border && !j.in_border) widen(i.at, j.at);
  });
  for (const NodeOrder::Copies& copies : order.copies) {
    for (std::size_t k = 0; k < copies.ties.size(); ++k) {
      widen(copies.ties[k], copies.of_intervals[k]);
      widen(copies.ties[k], copies.of_intervals[k + 1]);
    }
  }
}

}  // namespace

NodeOrder::Line NodeOrder::place(std::size_t line, std::size_t other) const {
  for (const Copies& of_one : copies) {
    if (of_one.unknown == line) return {false, of_one.of_intervals[intervals[other]]};
  }
  return lines[line];
}

NodeOrder node_order(const NonlinearProgram& program) {
  const IntervalStructure* const structure = program.interval_structure();
  if (structure == nullptr || structure->intervals == 0) {
    throw Error("a program without an interval structure has no band");
  }
  std::vector<Key> keys;
  structure->unknowns.for_each([&](const Place& place) { keys.push_back(key_of(place, false)); });
  structure->rows.for_each([&](const Place& place) { keys.push_back(key_of(place, true)); });
  bring_home_rows_of_one_place(program, keys);
  NodeOrder order;
  for (const Key& key : keys) {
    order.intervals.push_back(key.in_border() ? 0 : std::min(key.place / 2, structure->intervals - 1));
  }
  number(keys, program.variable_count(), structure->intervals, order);
  measure_bandwidth(program, order);
  return order;
}

BandedKkt::BandedKkt(const NonlinearProgram& program)
    : order_(node_order(program)),
      unknowns_(static_cast<Eigen::Index>(program.variable_count())),
      is_free_(free_variables(program)),
      leading_(3 * order_.half_bandwidth + 1) {
  const auto size = static_cast<Eigen::Index>(order_.band_size);
  const auto border = static_cast<Eigen::Index>(order_.border_size);
  is_free_.resize(order_.lines.size(), true);
  band_.resize(leading_ * order_.band_size);
  exchanged_.resize(order_.band_size);
  border_.resize(size, border);
  corner_.resize(border, border);
  sides_.resize(size, steps + border);
  corner_sides_.resize(border, steps);
  find_entries(program);
}

/// LAPACK stores entry (i, j) of a band at row kl + ku + i - j of column j; the first kl rows are for the fill-in of
/// exchanged rows. Null in the lower left: of the border and its mirror image one is kept.
double* BandedKkt::place_of(std::size_t first, std::size_t second) {
  const NodeOrder::Line i = order_.place(first, second);
  const NodeOrder::Line j = order_.place(second, first);
  if (!i.in_border && !j.in_border) return band_entry(i.at, j.at);
  if (i.in_border && !j.in_border) return nullptr;
  Eigen::MatrixXd& block = i.in_border ? corner_ : border_;
  return &block(static_cast<Eigen::Index>(i.at), static_cast<Eigen::Index>(j.at));
}

double* BandedKkt::band_entry(std::size_t row, std::size_t column) {
  return &band_[2 * order_.half_bandwidth + row - column + column * leading_];
}

void BandedKkt::find_entries(const NonlinearProgram& program) {
  for_each_entry(program, [&](bool in_jacobian, Eigen::Index number, std::size_t line, std::size_t other) {
    if (!is_free_[line] || !is_free_[other]) return;
    double* at = place_of(line, other);
    double* mirror = line == other ? nullptr : place_of(other, line);
    if (at == nullptr) std::swap(at, mirror);
    entries_.push_back({in_jacobian, number, static_cast<Eigen::Index>(line), static_cast<Eigen::Index>(other), at,  //
                        mirror});
  });
  for (const NodeOrder::Copies& copies : order_.copies) {
    for (std::size_t k = 0; k < copies.ties.size(); ++k) {
      for (const std::size_t copy : {k, k + 1}) {
        const double value = copy == k ? -1.0 : 1.0;
        ties_.push_back({band_entry(copies.ties[k], copies.of_intervals[copy]), value});
        ties_.push_back({band_entry(copies.of_intervals[copy], copies.ties[k]), value});
      }
    }
  }
  for (std::size_t line = 0; line < order_.lines.size(); ++line) diagonal_.push_back(place_of(line, line));
}

void BandedKkt::assemble(const KktMatrix& matrix) {
  std::ranges::fill(band_, 0.0);
  border_.setZero();
  corner_.setZero();
  for (const Entry& entry : entries_) {
    *entry.at = entry.value(matrix);
    if (entry.mirror != nullptr) *entry.mirror = *entry.at;
  }
  for (const Tie& tie : ties_) *tie.at = tie.value;
  for (std::size_t line = 0; line < diagonal_.size(); ++line) {
    const auto i = static_cast<Eigen::Index>(line);
    const bool is_unknown = i < unknowns_;
    *diagonal_[line] += !is_free_[line] ? 1.0 : is_unknown ? matrix.diagonal[i] : -matrix.compliance_of(i - unknowns_);
  }
}

double BandedKkt::factorisation_operations() const {
  // The loops of dgbtf2: column j is divided by its pivot and subtracted from those up to the last one that a row
  // exchanged so far reaches. dgbtrf does the same by blocks.
  const auto size = static_cast<long long>(order_.band_size);
  const auto width = static_cast<long long>(order_.half_bandwidth);
  long long last_column = 0;
  double count = 0.0;
  for (long long j = 0; j < size; ++j) {
    const long long below = std::min(width, size - 1 - j);
    const long long pivot_row = exchanged_[static_cast<std::size_t>(j)] - 1;  // LAPACK counts from 1
    last_column = std::max(last_column, std::min(pivot_row + width, size - 1));
    count += static_cast<double>(below) * static_cast<double>(1 + last_column - j);
  }
  return count;
}

/// (A, B; Bᵀ, C)(y, z) = (a, c) with the band A factorised: z from the Schur complement of A, then y.
bool BandedKkt::substitute() {
  const lapack_int width = lapack(order_.half_bandwidth);
  const auto sides = static_cast<lapack_int>(sides_.cols());
  const lapack_int failed =
      LAPACKE_dgbtrs_work(LAPACK_COL_MAJOR, 'N', lapack(order_.band_size), width, width, sides, band_.data(),
                          lapack(leading_), exchanged_.data(), sides_.data(), lapack(order_.band_size));
  if (failed != 0) return false;
  if (border_.cols() == 0) return true;
  const auto of_border = sides_.rightCols(border_.cols());
  const Eigen::MatrixXd complement = corner_ - border_.transpose() * of_border;
  const Eigen::PartialPivLU<Eigen::MatrixXd> factors(complement);
  corner_sides_ = factors.solve(corner_sides_ - border_.transpose() * sides_.leftCols(steps)).eval();
  sides_.leftCols(steps) -= of_border * corner_sides_;
  return true;
}

double& BandedKkt::side_of(std::size_t line, Eigen::Index side) {
  const NodeOrder::Line at = order_.lines[line];
  return (at.in_border ? corner_sides_ : sides_)(static_cast<Eigen::Index>(at.at), side);
}

Eigen::VectorXd BandedKkt::solution_of(Eigen::Index side) {
  Eigen::VectorXd solution(static_cast<Eigen::Index>(order_.lines.size()));
  for (std::size_t line = 0; double& number : solution) number = side_of(line++, side);
  return solution;
}

/// The matrix times a vector of unknowns and multipliers; fixed unknowns neither move nor have a line of their own.
Eigen::VectorXd BandedKkt::product(const KktMatrix& matrix, const Eigen::VectorXd& vector) const {
  Eigen::VectorXd product = Eigen::VectorXd::Zero(vector.size());
  product.head(unknowns_) = matrix.diagonal.cwiseProduct(vector.head(unknowns_));
  if (matrix.compliance.size() > 0) {
    product.tail(matrix.compliance.size()) = -matrix.compliance.cwiseProduct(vector.tail(matrix.compliance.size()));
  }
  for (const Entry& entry : entries_) {
    const double value = entry.value(matrix);
    product[entry.line] += value * vector[entry.other];
    if (entry.line != entry.other) product[entry.other] += value * vector[entry.line];
  }
  return product;
}

bool BandedKkt::curves_upwards(const KktMatrix& matrix, const Eigen::VectorXd& tangential_step) const {
  constexpr double smallest_curvature = 1e-12;
  const Eigen::VectorXd products = product(matrix, tangential_step);
  double curvature = tangential_step.dot(products);
  for (Eigen::Index i = unknowns_; i < products.size(); ++i) {
    const double compliance = matrix.compliance_of(i - unknowns_);
    if (compliance > 0.0) curvature += products[i] * products[i] / compliance;
  }
  return curvature >= smallest_curvature * tangential_step.squaredNorm();
}

FactorisationStatus BandedKkt::solve(const KktMatrix& matrix, const KktRightHandSide& right_hand_side,
                                     const KktStep& step) {
  constexpr double largest_residual = 1e-9;  // as a share of the right-hand side
  const bool has_border = order_.border_size > 0;
  const Eigen::Index rows = right_hand_side.constraints.size();
  assemble(matrix);
  const lapack_int size = lapack(order_.band_size);
  const lapack_int width = lapack(order_.half_bandwidth);
  const lapack_int failed = LAPACKE_dgbtrf_work(LAPACK_COL_MAJOR, size, size, width, width, band_.data(),
                                                lapack(leading_), exchanged_.data());
  if (failed != 0) return has_border ? FactorisationStatus::untrusted : FactorisationStatus::singular;
  Eigen::VectorXd wanted(unknowns_ + rows);
  wanted << -right_hand_side.gradient, -right_hand_side.constraints;
  sides_.leftCols(steps).setZero();
  sides_.rightCols(border_.cols()) = border_;
  for (std::size_t line = 0; double& number : wanted) {
    if (!is_free_[line]) number = 0.0;
    side_of(line, the_tangential_step) = static_cast<Eigen::Index>(line) < unknowns_ ? number : 0.0;
    side_of(line++, the_step) = number;
  }
  if (!substitute()) return FactorisationStatus::singular;
  Eigen::VectorXd tangential_step = solution_of(the_tangential_step);
  tangential_step.tail(rows).setZero();
  if (!is_finite(tangential_step)) return FactorisationStatus::singular;
  if (!curves_upwards(matrix, tangential_step)) return FactorisationStatus::wrong_inertia;
  const Eigen::VectorXd solution = solution_of(the_step);
  if (!is_finite(solution)) return FactorisationStatus::singular;
  step.primal = solution.head(unknowns_);
  step.multipliers = solution.tail(rows);
  const auto residual = [&] { return largest_of(product(matrix, solution) - wanted); };
  if (has_border && !(residual() <= largest_residual * largest_of(wanted))) return FactorisationStatus::untrusted;
  return FactorisationStatus::solved;
}

}  // namespace dmocbench::kkt
