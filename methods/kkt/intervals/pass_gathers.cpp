#include "methods/kkt/intervals/pass_gathers.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>

#include "methods/kkt/intervals/pass_blocks.hpp"

namespace dmocbench::kkt {

namespace {

/// Puts entries of `LocalEntry`, whose columns are (x', u, x, s, 1), where a pass has them.
class PassPlaces {
 public:
  PassPlaces(const IntervalEntries& entries, const EliminationPlan& plan)
      : blocks_{entries.shape},
        n_(entries.shape.node),
        u_end_(next_size(entries.shape)),
        places_of_rows_(places_of_rows(plan)) {}

  void add(const LocalEntry& entry) {
    term_ = {.source = entry.source, .first = entry.first};
    switch (entry.block) {
      case LocalEntry::Block::equality:
        return add_equality(entry.row, entry.column);
      case LocalEntry::Block::carry:
        return add_carry(entry.row, entry.column);
      case LocalEntry::Block::hessian:
        return add_hessian(entry.row, entry.column);
      case LocalEntry::Block::inequality:
        return put(blocks_.inequalities()(place_in_inequality(entry.column), entry.row));
    }
  }
  /// Entries with as many terms come together, so that the processor can foresee how many they are.
  [[nodiscard]] std::vector<PassGather> take() const {
    std::vector<std::vector<PassGather>> by_count;
    for (const auto& [slot, terms] : terms_) {
      const std::size_t count = std::ranges::max(terms, {}, &std::vector<PassGather::Term>::size).size();
      if (by_count.size() < count) by_count.resize(count);
      for (std::size_t i = 0; i < count; ++i) {
        PassGather gather{.slot = slot, .is_last = i + 1 == count};
        for (std::size_t r = 0; r < gather.terms.size(); ++r) {
          // Where there is none, zero times any other.
          gather.terms[r] = i < terms[r].size() ? terms[r][i] : some_term(terms);
          if (i >= terms[r].size()) gather.terms[r].sign = 0.0;
        }
        by_count[count - 1].push_back(gather);
      }
    }
    std::vector<PassGather> gathers;
    for (const auto& of_count : by_count) gathers.insert(gathers.end(), of_count.begin(), of_count.end());
    return gathers;
  }

 private:
  using TermsOfQuad = std::array<std::vector<PassGather::Term>, 4>;

  [[nodiscard]] static PassGather::Term some_term(const TermsOfQuad& terms) {
    return std::ranges::find_if(terms, [](const auto& of_entry) { return !of_entry.empty(); })->front();
  }
  [[nodiscard]] bool is_one(int column) const { return column == u_end_ + state_size(blocks_.shape); }
  /// The place in (x, u) of a column of u or x.
  [[nodiscard]] int input(int column) const { return column < u_end_ ? column : column - u_end_; }

  void put(int slot, double sign = 1.0) {
    term_.sign = sign;
    terms_[slot / 4 * 4][static_cast<std::size_t>(slot % 4)].push_back(term_);
  }
  [[nodiscard]] int place_in_inequality(int column) const {
    const int last = blocks_.inequalities().rows - 4;
    if (column < 0) return last + 1;
    if (is_one(column)) return last;
    return column < n_ ? column : node_height(blocks_.shape) + input(column);
  }
  /// D, x' less x, takes the place of x': what reads x' reads x too.
  void add_equality(int row, int column) {
    if (is_one(column)) return put(blocks_.residual()(row, 0), -1.0);
    const int place = places_of_rows_[static_cast<std::size_t>(row)];
    if (column < n_) put(blocks_.equality()(place, column));
    put(blocks_.inputs()(column < n_ ? column : input(column), place), -1.0);
  }
  /// s' = -J_{k+1,k} D + J_{k+1,u} u. The terms of s' are subtracted from the rows of the next interval.
  void add_carry(int row, int column) {
    const int place = places_of_rows_[static_cast<std::size_t>(row)];
    if (column >= n_) return put(blocks_.carry()(column - n_, place), -1.0);
    put(blocks_.carry()(column, place));
    term_.from_before = true;
    put(blocks_.inputs()(column, place), -1.0);
  }
  void add_hessian(int row, int column) {
    if (is_one(column)) return put(row < n_ ? blocks_.next()(row, n_) : blocks_.form()(row, u_end_));
    if (column < n_) {
      put(blocks_.next()(row, column));
      if (row != column) put(blocks_.next()(column, row));
    } else if (row < n_) {
      put(blocks_.mixed()(input(column), row));
    } else {
      put(blocks_.form()(row, input(column)));
      if (row != column) put(blocks_.form()(input(column), row));
    }
  }

  PassInputBlocks<Shape> blocks_;
  int n_;
  int u_end_;
  std::vector<int> places_of_rows_;
  PassGather::Term term_;
  std::map<int, TermsOfQuad> terms_;
};

}  // namespace

std::vector<PassGather> pass_gathers(const IntervalEntries& entries, const EliminationPlan& plan) {
  PassPlaces places(entries, plan);
  for (const LocalEntry& entry : entries.local) places.add(entry);
  return places.take();
}

std::vector<int> pass_units(const IntervalEntries& entries) {
  std::vector<int> slots;
  const BlockPlace form = PassInputBlocks<Shape>{entries.shape}.form();
  for (int column = entries.shape.node; column < next_size(entries.shape); ++column) {
    if (entries.is_fixed_column(column)) slots.push_back(form(column, column));
  }
  return slots;
}

std::vector<int> places_of_rows(const EliminationPlan& plan) {
  std::vector<int> places;
  // The first unit entries belong to s, which enters each equality once.
  for (int row = 0; row < plan.shape.rows; ++row) {
    places.push_back(plan.unit_entries[static_cast<std::size_t>(row)] % plan.shape.rows);
  }
  return places;
}

}  // namespace dmocbench::kkt
