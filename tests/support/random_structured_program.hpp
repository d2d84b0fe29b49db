#pragma once

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "methods/program/nonlinear_program.hpp"
#include "methods/transcription/derivatives/series_assembly.hpp"
#include "tests/support/random_points.hpp"

namespace dmocbench::tests {

/// Sizes and kinds of a random program with the structure of a transcription.
struct RandomShape {
  enum class Hessian : unsigned char {
    definite,         ///< a sum of squares in every interval
    hidden,           ///< the same less a multiple of the squares of an interval's own equalities
    indefinite,       ///< any symmetric one, shifted by a random multiple of the unit matrix
    nearly_singular,  ///< fewer squares than unknowns, and a small shift
  };
  std::size_t intervals = 1;
  Eigen::Index node = 1;       ///< unknowns of a node
  bool rows_at_nodes = false;  ///< as many rows at nodes (DMOC), or in intervals (collocation)
  Eigen::Index rates = 0;      ///< further unknowns of an interval with as many rows
  Eigen::Index controls = 1;
  Eigen::Index inequalities = 0;        ///< inequalities of an interval
  bool horizon = false;                 ///< one unknown of the border, which all intervals read
  std::array<bool, 2> velocity{};       ///< as many further unknowns at an end as a node has
  std::array<Eigen::Index, 2> fixed{};  ///< fixed unknowns of the first and the last node
  Eigen::Index conditions = 0;          ///< rows of the border, which read both ends
  bool condition_is_inequality = false;
  bool fixes_control = false;
  bool rates_cost_nothing = false;  ///< as where the dynamics are linear and the cost reads states and controls only
  bool drops_entries = false;
  bool nearly_dependent = false;  ///< one interval's equalities nearly depend on each other
  double roughness = 0.0;         ///< how much intervals differ
  double coupling = 1.0;          ///< size of what is not an increment
  Hessian hessian = Hessian::definite;

  [[nodiscard]] std::string label() const {
    const auto text = [](auto number) { return std::to_string(number); };
    return "N " + text(intervals) + ", node " + text(node) + (rows_at_nodes ? " rows at nodes" : " rows in intervals") +
           ", rates " + text(rates) + ", controls " + text(controls) + ", inequalities " + text(inequalities) +
           ", horizon " + text(horizon) + ", velocities " + text(velocity[0]) + text(velocity[1]) + ", fixed " +
           text(fixed[0]) + ' ' + text(fixed[1]) + ", conditions " + text(conditions) +
           (condition_is_inequality ? " inequality" : "") + (fixes_control ? ", fixed control" : "") +
           (rates_cost_nothing ? ", rates cost nothing" : "") + (drops_entries ? ", dropped entries" : "") +
           (nearly_dependent ? ", nearly dependent" : "") + ", roughness " + text(roughness) + ", coupling " +
           text(coupling) + ", Hessian " + text(static_cast<int>(hessian));
  }
};

/// A quadratic program with random numbers, ½xᵀHx + gᵀx such that Jx lies in its bounds, stored column by column like
/// the programs of transcriptions, but made without them.
class RandomStructuredProgram final : public NonlinearProgram {
 public:
  RandomStructuredProgram(const RandomShape& shape, unsigned seed) : shape_(shape), random_(seed) {
    append_unknowns();
    append_rows();
    append_jacobian();
    append_hessian();
    set_bounds();
    gradient_ = random_.vector(static_cast<Eigen::Index>(structure_.unknowns.size()));
  }

  [[nodiscard]] std::size_t variable_count() const override { return structure_.unknowns.size(); }
  [[nodiscard]] std::size_t constraint_count() const override { return structure_.rows.size(); }
  [[nodiscard]] const Eigen::VectorXd& variable_lower() const override { return variable_lower_; }
  [[nodiscard]] const Eigen::VectorXd& variable_upper() const override { return variable_upper_; }
  [[nodiscard]] const Eigen::VectorXd& constraint_lower() const override { return row_lower_; }
  [[nodiscard]] const Eigen::VectorXd& constraint_upper() const override { return row_upper_; }
  [[nodiscard]] const BlockPattern& jacobian_structure() const override { return jacobian_pattern_; }
  [[nodiscard]] const BlockPattern& hessian_structure() const override { return hessian_pattern_; }
  [[nodiscard]] const IntervalStructure* interval_structure() const override { return &structure_; }

  [[nodiscard]] double objective(const VectorIn& x) override {
    Eigen::VectorXd gradient_at_x(x.size());
    gradient(x, gradient_at_x);
    return 0.5 * (gradient_at_x + gradient_).dot(x);
  }
  void gradient(const VectorIn& x, VectorOut result) override {
    result = gradient_;
    hessian_pattern_.for_each([&](Eigen::Index e, int row, int column) {
      result[row] += hessian_[e] * x[column];
      if (row != column) result[column] += hessian_[e] * x[row];
    });
  }
  void constraints(const VectorIn& x, VectorOut result) override {
    result.setZero();
    jacobian_pattern_.for_each([&](Eigen::Index e, int row, int column) { result[row] += jacobian_[e] * x[column]; });
  }
  void jacobian(const VectorIn& /*x*/, VectorOut values) override { values = jacobian_; }
  void hessian(const VectorIn& /*x*/, double objective_factor, const VectorIn& /*multipliers*/,
               VectorOut values) override {
    values = objective_factor * hessian_;
  }

 private:
  /// An unknown or a row as an interval sees it.
  struct Local {
    SeriesPlace place;
    std::size_t pivot;  ///< rows: the unknown, as a number of `local_unknowns_`, whose increment it determines
  };
  static constexpr std::size_t none = static_cast<std::size_t>(-1);
  static std::size_t size(Eigen::Index count) { return static_cast<std::size_t>(count); }

  void append_unknowns() {
    const std::size_t N = structure_.intervals = shape_.intervals;
    Places& places = structure_.unknowns;
    const auto column = [&](Place::Kind kind, std::size_t length) { return places.append(kind, 0, length); };
    for (Eigen::Index i = 0; i < shape_.node; ++i) nodes_.push_back(column(Place::Kind::node, N + 1));
    for (const std::size_t right : {0U, 1U}) {
      for (const std::size_t first : nodes_) local_unknowns_.emplace_back(first + right);
    }
    for (Eigen::Index i = 0; i < shape_.rates + shape_.controls; ++i) {
      inner_.push_back(column(Place::Kind::interval, N));
      local_unknowns_.emplace_back(inner_.back());
    }
    for (const std::size_t end : {0U, 1U}) {
      for (const std::size_t first : nodes_) ends_[end].push_back(first + end * N);
      for (Eigen::Index i = 0; shape_.velocity[end] && i < shape_.node; ++i) {
        ends_[end].push_back(places.append(Place::Kind::node, end * N, 1));
      }
    }
    if (!shape_.horizon) return;
    local_unknowns_.emplace_back(places.append(Place::Kind::border, 0, 1), true);
  }

  void append_rows() {
    const std::size_t N = shape_.intervals;
    Places& places = structure_.rows;
    const std::size_t node = size(shape_.node);
    const auto column = [&](Place::Kind kind, std::size_t length) { return places.append(kind, 0, length); };
    for (std::size_t i = 0; shape_.rows_at_nodes && i < node; ++i) {
      node_rows_.push_back(column(Place::Kind::node, N + 1));
      local_rows_.push_back({SeriesPlace(node_rows_.back()), i + node});
      local_rows_.push_back({SeriesPlace(node_rows_.back() + 1), i});
    }
    for (std::size_t i = 0; !shape_.rows_at_nodes && i < node; ++i) append_own_row(i + node, column);
    for (std::size_t i = 0; i < size(shape_.rates); ++i) append_own_row(2 * node + i, column);
    first_inequality_ = places.size();
    for (Eigen::Index i = 0; i < shape_.inequalities; ++i) append_own_row(none, column);
    single_rows_ = places.size();
    for (const std::size_t end : {0U, 1U}) {
      const bool own = !shape_.rows_at_nodes && shape_.velocity[end];
      for (std::size_t i = 0; own && i < node; ++i) places.append(Place::Kind::node, end * N, 1);
    }
    first_condition_ = places.size();
    if (shape_.conditions > 0) places.append(Place::Kind::border, 0, size(shape_.conditions));
  }

  template <class Column>
  void append_own_row(std::size_t pivot, const Column& column) {
    local_rows_.push_back({SeriesPlace(column(Place::Kind::interval, shape_.intervals)), pivot});
  }

  void append_jacobian() {
    const std::size_t N = shape_.intervals;
    LocalEntries entries;
    entries.intervals = N;
    std::vector<double> increment;
    for (const Local& row : local_rows_) {
      for (std::size_t j = 0; j < local_unknowns_.size(); ++j) {
        const double increment_there = increment_of(row, j);
        const bool may_be_missing = increment_there == 0.0 && !is_of_one_node(row, j);
        if (may_be_missing && shape_.drops_entries && random_.number(0.0, 1.0) < 0.2) continue;
        entries.rows.push_back(row.place);
        entries.columns.push_back(local_unknowns_[j]);
        increment.push_back(increment_there);
      }
    }
    const AssembledPattern assembled = assemble_pattern(entries);
    jacobian_pattern_ = assembled.pattern;
    const std::vector<SeriesPlace> end_places = extend_pattern(jacobian_pattern_, end_rows());
    jacobian_entries_ = jacobian_pattern_.expand();
    jacobian_.setZero(static_cast<Eigen::Index>(jacobian_pattern_.size()));
    for (std::size_t e = 0; e < increment.size(); ++e) {
      const double base = increment[e] + shape_.coupling * random_.number();
      for (std::size_t k = 0; k < N; ++k) {
        const std::size_t at = assembled.places[e].at(k);
        jacobian_[static_cast<Eigen::Index>(at)] += base + shape_.roughness * random_.number();
      }
    }
    for (const SeriesPlace& place : end_places) jacobian_[static_cast<Eigen::Index>(place.first)] += random_.number();
    if (shape_.nearly_dependent) make_nearly_dependent();
  }

  /// Rows of dynamics are about x_{k+1} - x_k, at both nodes where they are rows of nodes; those of rates about them.
  [[nodiscard]] double increment_of(const Local& row, std::size_t unknown) const {
    const std::size_t node = size(shape_.node);
    if (row.pivot == none) return 0.0;
    if (unknown == row.pivot) return 1.0;
    const bool is_other_end = row.pivot < node ? unknown == row.pivot + node : unknown + node == row.pivot;
    return row.pivot < 2 * node && is_other_end ? -1.0 : 0.0;
  }
  /// Derivatives of a node's row with respect to its own unknowns come from both sides, and from what stands at an end.
  [[nodiscard]] bool is_of_one_node(const Local& row, std::size_t unknown) const {
    const std::size_t node = size(shape_.node);
    if (!shape_.rows_at_nodes || row.pivot == none || row.pivot >= 2 * node) return false;
    return row.pivot < node ? unknown >= node && unknown < 2 * node : unknown < node;
  }

  /// Rows of the ends: those that tie an end's further unknowns to it, and those of the border.
  [[nodiscard]] LocalEntries end_rows() const {
    LocalEntries entries;
    entries.intervals = 1;
    const auto add = [&](std::size_t row, std::size_t unknown) {
      entries.rows.emplace_back(row);
      entries.columns.emplace_back(unknown);
    };
    std::size_t tie = single_rows_;
    for (const std::size_t end : {0U, 1U}) {
      for (std::size_t i = 0; shape_.velocity[end] && i < size(shape_.node); ++i) {
        const std::size_t row = shape_.rows_at_nodes ? node_rows_[i] + end * shape_.intervals : tie++;
        for (const std::size_t unknown : ends_[end]) add(row, unknown);
      }
    }
    for (std::size_t row = first_condition_; row < structure_.rows.size(); ++row) {
      for (const auto& end : ends_) {
        for (const std::size_t unknown : end) add(row, unknown);
      }
      if (shape_.horizon) add(row, structure_.unknowns.size() - 1);
    }
    return entries;
  }

  /// In the interval in the middle the last equality becomes another one, but for a millionth.
  void make_nearly_dependent() {
    const std::size_t k = shape_.intervals / 2;
    const auto equalities = std::count_if(local_rows_.begin(), local_rows_.end(),
                                          [&](const Local& row) { return row.place.first < first_inequality_; });
    if (shape_.rows_at_nodes || equalities < 2) return;
    const std::size_t source = local_rows_[size(equalities) - 2].place.first + k;
    const std::size_t target = local_rows_[size(equalities) - 1].place.first + k;
    for (std::size_t e = 0; e < jacobian_pattern_.size(); ++e) {
      if (static_cast<std::size_t>(jacobian_entries_.rows[e]) != target) continue;
      double other = 0.0;
      for (std::size_t f = 0; f < jacobian_pattern_.size(); ++f) {
        const bool is_other = static_cast<std::size_t>(jacobian_entries_.rows[f]) == source &&
                              jacobian_entries_.columns[f] == jacobian_entries_.columns[e];
        if (is_other) other = jacobian_[static_cast<Eigen::Index>(f)];
      }
      jacobian_[static_cast<Eigen::Index>(e)] = other + 1e-6 * random_.number();
    }
  }

  void append_hessian() {
    const std::size_t N = shape_.intervals;
    LocalEntries entries;
    entries.intervals = N;
    std::vector<std::pair<Eigen::Index, Eigen::Index>> pairs;
    for (std::size_t i = 0; i < local_unknowns_.size(); ++i) {
      for (std::size_t j = 0; j < local_unknowns_.size(); ++j) {
        if (local_unknowns_[i].first < local_unknowns_[j].first) continue;
        entries.rows.push_back(local_unknowns_[i]);
        entries.columns.push_back(local_unknowns_[j]);
        pairs.emplace_back(i, j);
      }
    }
    const AssembledPattern assembled = assemble_pattern(entries);
    hessian_pattern_ = assembled.pattern;
    const LocalEntries ends = end_pairs();
    const std::vector<SeriesPlace> end_places = extend_pattern(hessian_pattern_, ends);
    hessian_.setZero(static_cast<Eigen::Index>(hessian_pattern_.size()));
    const Eigen::MatrixXd base = random_matrix(static_cast<Eigen::Index>(local_unknowns_.size()));
    for (std::size_t k = 0; k < N; ++k) {
      const Eigen::MatrixXd form = quadratic_form(base, k);
      for (std::size_t e = 0; e < pairs.size(); ++e) {
        const std::size_t at = assembled.places[e].at(k);
        hessian_[static_cast<Eigen::Index>(at)] += form(pairs[e].first, pairs[e].second);
      }
    }
    for (std::size_t e = 0; e < end_places.size(); ++e) {
      const bool is_diagonal = ends.rows[e].first == ends.columns[e].first;
      const double share = 0.1 / static_cast<double>(end_places.size());
      hessian_[static_cast<Eigen::Index>(end_places[e].first)] += is_diagonal ? 0.5 : share * random_.number();
    }
  }

  /// Pairs of unknowns of the ends and of the border, lower triangle.
  [[nodiscard]] LocalEntries end_pairs() const {
    LocalEntries entries;
    entries.intervals = 1;
    std::vector<std::size_t> unknowns = ends_[0];
    if (shape_.conditions > 0) unknowns.insert(unknowns.end(), ends_[1].begin(), ends_[1].end());
    if (shape_.horizon) unknowns.push_back(structure_.unknowns.size() - 1);
    for (const std::size_t i : unknowns) {
      for (const std::size_t j : unknowns) {
        if (i < j) continue;
        entries.rows.emplace_back(i);
        entries.columns.emplace_back(j);
      }
    }
    return entries;
  }

  [[nodiscard]] Eigen::MatrixXd random_matrix(Eigen::Index n) {
    return Eigen::MatrixXd::NullaryExpr(n, n, [&](auto, auto) { return random_.number(); });
  }

  [[nodiscard]] Eigen::MatrixXd quadratic_form(const Eigen::MatrixXd& base, std::size_t interval) {
    const Eigen::Index n = base.rows();
    Eigen::MatrixXd factor = base + shape_.roughness * random_matrix(n);
    if (shape_.rates_cost_nothing) factor.middleCols(2 * shape_.node, shape_.rates).setZero();
    using Hessian = RandomShape::Hessian;
    if (shape_.hessian == Hessian::indefinite) return 0.5 * (factor + factor.transpose());
    const Eigen::Index squares = shape_.hessian == Hessian::nearly_singular ? std::max<Eigen::Index>(1, n / 3) : n;
    Eigen::MatrixXd form = factor.topRows(squares).transpose() * factor.topRows(squares);
    if (shape_.hessian != Hessian::hidden) return form;
    constexpr double weight = 5.0;
    for (const Local& row : local_rows_) {
      if (row.place.first < node_rows_.size() * (shape_.intervals + 1) || row.place.first >= first_inequality_)
        continue;
      const Eigen::VectorXd derivatives = derivatives_of(row.place.first + interval, interval);
      form -= weight * derivatives * derivatives.transpose();
    }
    return form;
  }

  /// Of a row, with respect to the unknowns of its interval.
  [[nodiscard]] Eigen::VectorXd derivatives_of(std::size_t row, std::size_t interval) const {
    Eigen::VectorXd derivatives = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(local_unknowns_.size()));
    for (std::size_t e = 0; e < jacobian_pattern_.size(); ++e) {
      if (static_cast<std::size_t>(jacobian_entries_.rows[e]) != row) continue;
      for (std::size_t j = 0; j < local_unknowns_.size(); ++j) {
        const std::size_t unknown = local_unknowns_[j].at(interval);
        if (static_cast<std::size_t>(jacobian_entries_.columns[e]) != unknown) continue;
        derivatives[static_cast<Eigen::Index>(j)] = jacobian_[static_cast<Eigen::Index>(e)];
      }
    }
    return derivatives;
  }

  void set_bounds() {
    const auto n = static_cast<Eigen::Index>(structure_.unknowns.size());
    const auto m = static_cast<Eigen::Index>(structure_.rows.size());
    variable_lower_.setConstant(n, -unbounded);
    variable_upper_.setConstant(n, unbounded);
    const auto fix = [&](std::size_t unknown) {
      variable_lower_[static_cast<Eigen::Index>(unknown)] = 0.0;
      variable_upper_[static_cast<Eigen::Index>(unknown)] = 0.0;
    };
    for (const std::size_t end : {0U, 1U}) {
      for (std::size_t i = 0; i < size(shape_.fixed[end]); ++i) fix(ends_[end][i]);
    }
    for (std::size_t k = 0; shape_.fixes_control && k < shape_.intervals; ++k) fix(inner_.back() + k);
    row_lower_.setZero(m);
    row_upper_.setZero(m);
    const auto soften = [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) row_upper_[static_cast<Eigen::Index>(i)] = 1.0;
    };
    soften(first_inequality_, single_rows_);
    if (shape_.condition_is_inequality) soften(first_condition_, structure_.rows.size());
  }

  RandomShape shape_;
  RandomPoints random_;
  IntervalStructure structure_;
  std::vector<std::size_t> nodes_;  // first entries of columns
  std::vector<std::size_t> inner_;
  std::vector<std::size_t> node_rows_;
  std::array<std::vector<std::size_t>, 2> ends_;  // unknowns of the first and of the last node, further ones behind
  std::vector<SeriesPlace> local_unknowns_;
  std::vector<Local> local_rows_;
  std::size_t first_inequality_ = 0;
  std::size_t single_rows_ = 0;
  std::size_t first_condition_ = 0;
  BlockPattern jacobian_pattern_;
  BlockPattern hessian_pattern_;
  SparsityPattern jacobian_entries_;
  Eigen::VectorXd jacobian_;
  Eigen::VectorXd hessian_;
  Eigen::VectorXd gradient_;
  Eigen::VectorXd variable_lower_;
  Eigen::VectorXd variable_upper_;
  Eigen::VectorXd row_lower_;
  Eigen::VectorXd row_upper_;
};

}  // namespace dmocbench::tests
