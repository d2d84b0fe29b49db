#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "methods/kkt/intervals/shape.hpp"
#include "methods/runtime/instruction_set.hpp"

namespace dmocbench::kkt {

/// Segments of the horizon that are worked on together, one per lane of a vector register; or instances of a program,
/// one whole horizon per lane (`SegmentGroup::is_interleaved`).
inline constexpr int lane_count = 8;

/// The arrays of a Newton system that intervals read; `padded` holds copies of columns that some intervals lack.
enum class Source : unsigned char { jacobian, hessian, diagonal, gradient, rows, compliance, padded };
/// Number of arrays.
inline constexpr std::size_t source_count = 7;

/// One number of every interval: interval k reads entry `first` + k of an array and puts it into (or adds it to) the
/// entry `slot` of its blocks (`LocalBlocks`), and by symmetry also into `mirror` if that is another one.
struct Gather {
  Source source;
  bool adds;
  bool from_before;  ///< reads entry `first` + k - 1, and 0 for the first interval
  std::ptrdiff_t first;
  int slot;
  int mirror;
};

/// One number of every interval that a Newton step is made of: interval k writes it to entry `first` + k.
struct Scatter {
  int index;           ///< entry of `ForwardBlocks`
  bool is_multiplier;  ///< goes to the multipliers' step, else to the variables'
  std::ptrdiff_t first;
};

/// A pivot of the free unknowns' Hessian below this share of its diagonal entry is rounding.
inline constexpr double smallest_pivot_share = 1e-13;
/// Above this share rounding leaves no doubt about its sign, nor about the signs of the pivots that follow.
inline constexpr double certain_pivot_share = 1e-6;

/// The result of the pivots of the free unknowns' Hessians in a group of segments.
enum class FreePivots : unsigned char {
  positive,           ///< all are positive, beyond rounding
  some_negative,      ///< some are negative, none is near zero: their number gives the inertia
  too_many_negative,  ///< of a segment more than its state has entries: whatever its end is, there is no minimum
  near_zero,          ///< some are not positive, and some so near zero that rounding decides
};

/// The plan by which the intervals of a program are eliminated; the same for all of them.
struct EliminationPlan {
  Shape shape{};
  std::vector<Gather> gathers;
  std::vector<Scatter> scatters;
  std::vector<int> node_in_next;     ///< which entry of Z, in the order of elimination, is x_i
  std::vector<double> pivot_scales;  ///< of the equalities: reciprocals of the usual pivots
  std::vector<int> unit_entries;     ///< entries of the blocks that are 1 in every interval
};

/// Eight segments side by side, and where their results stand. All arrays of numbers are lane by lane: entry i of lane
/// l at i * lane_count + l.
struct SegmentGroup {
  std::array<std::ptrdiff_t, lane_count> first{};  ///< their first intervals
  std::array<int, lane_count> length{};            ///< numbers of their intervals: the last one's, or one less
  int steps = 0;                                   ///< the largest length
  int shortest = 0;                                ///< the smallest length
  int recorded_steps = 0;                          ///< for how many steps there is room in `records`: all of them, or
                                                   ///< chunks of a multiple of eight, which the forward sweep
                                                   ///< eliminates again, one after the other, from checkpoints
  double* records = nullptr;                       ///< recorded_steps * RecordBlocks::size(), written backward
  double* checkpoints = nullptr;                   ///< per chunk, if they are several: the value at its end
  double* workspace = nullptr;                     ///< SegmentKernel::workspace_size numbers
  bool has_constants = false;  ///< the workspace holds the numbers that all sweeps of the plan share

  // The cost of a segment as a function of the state X at its first node and the multiplier ν of its last node
  // (README.md, "One interval"):
  // ½XᵀPX + pᵀX + νᵀ(ΦᵀX + γ) - ½νᵀΓν. State x (X, 1, ν) holds P, p, Φ; ν x (1, ν) holds γ, Γ.
  double* value = nullptr;
  double* reachability = nullptr;

  double* state = nullptr;       ///< forward: X at the first node
  double* multiplier = nullptr;  ///< forward: ν
  /// True if the lanes are eight instances of a program and not eight segments of one. Entry e of lane l of every array
  /// is then at e * lane_count + l, and every lane has `steps` intervals, from 0 on. A lane whose pivots fail does not
  /// stop the others.
  bool is_interleaved = false;
  std::array<double, lane_count> lane_pivots_hold{};     ///< of interleaved lanes: 1, or -1 where one did not
  std::array<double, lane_count> lane_smallest_ratio{};  ///< of interleaved lanes

  FreePivots pivots = FreePivots::near_zero;  ///< after `too_many_negative` and `near_zero` there is no value
  std::array<int, lane_count> negative{};     ///< how many pivots of each segment are negative, if `some_negative`
  double smallest_ratio = 0.0;                ///< smallest pivot of the equalities, relative to the usual one
};

/// The input of a backward sweep: the arrays by `Source`, and the weights at the end of a segment
/// (terminal_weights.hpp).
struct NewtonArrays {
  std::array<const double*, source_count> arrays{};
  [[nodiscard]] const double* of(Source source) const { return arrays[static_cast<std::size_t>(source)]; }
  [[nodiscard]] double at(Source source, std::ptrdiff_t entry) const { return of(source)[entry]; }
  const double* terminal_weights = nullptr;  ///< one per entry of the state; of interleaved lanes each its own
};

/// Both sweeps over a group of segments for one shape and one instruction set.
struct SegmentKernel {
  /// The size of the workspace of a group, in numbers.
  std::size_t (*workspace_size)(const EliminationPlan& plan);
  void (*backward)(const EliminationPlan& plan, const NewtonArrays& arrays, SegmentGroup& group);
  /// Uses the arrays of the backward sweep before.
  void (*forward)(const EliminationPlan& plan, const NewtonArrays& arrays, const SegmentGroup& group,
                  double* primal_step, double* multiplier_step);
};

/// Gives the kernel for a shape (segment_group.hpp).
using SegmentKernelChoice = SegmentKernel (*)(const Shape& shape);

// The same source, segment_kernel.cpp, compiled once per instruction set.
[[nodiscard]] SegmentKernel segment_kernel_baseline(const Shape& shape);
[[nodiscard]] SegmentKernel segment_kernel_avx2(const Shape& shape);
[[nodiscard]] SegmentKernel segment_kernel_avx512(const Shape& shape);

}  // namespace dmocbench::kkt
