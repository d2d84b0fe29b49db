#include <algorithm>
#include <memory>

#include "methods/expression/replay.hpp"
#include "methods/transcription/derivatives/adolc_recording.hpp"
#include "methods/transcription/derivatives/recorded_number.hpp"
#include "methods/transcription/derivatives/whole_part.hpp"

namespace dmocbench {

namespace {

/// Sums of a formula over all intervals, recorded by ADOL-C at once as a function of all unknowns.
class WholeRecording {
 public:
  /// `output_of(o, k)` is the number of the sum to which output o of interval k belongs.
  template <class OutputOf>
  WholeRecording(const Schedule& schedule, const LocalInputs& numbers, const WholePart& part, std::size_t outputs,
                 const OutputOf& output_of)
      // One output has a gradient, of which ADOL-C's reverse sweeps are the way; many are swept forward.
      : tag_(outputs == 1 && schedule.input_count() > 0),
        input_count_(schedule.input_count()),
        intervals_(part.intervals),
        output_count_(outputs) {
    number_inputs(numbers, part);
    // More than it needs, so that ADOL-C keeps all of it in memory and not in files; untouched memory costs nothing.
    constexpr std::size_t most_entries = std::size_t{1} << 26U;
    const auto entries =
        static_cast<unsigned>(std::min(most_entries, 65536 + 4 * intervals_ * (schedule.steps().size() + 16)));
    trace_on(tag(), 0, entries, 4 * entries, entries, 16 * entries);
    {
      std::vector<RecordedNumber> independents;
      for (std::size_t i = 0; i < point_.size(); ++i) {
        const auto independent = std::make_shared<adouble>();
        *independent <<= 1.0;
        independents.emplace_back(independent);
      }
      std::vector<RecordedNumber> sums(outputs, RecordedNumber(0.0));
      for (std::size_t k = 0; k < intervals_; ++k) {
        std::vector<RecordedNumber> inputs;
        for (std::size_t i = 0; i < input_count_; ++i) inputs.push_back(independents[input(i, k)]);
        const std::vector<RecordedNumber> values =
            replay<RecordedNumber>(schedule, std::span<const RecordedNumber>(inputs));
        for (std::size_t o = 0; o < values.size(); ++o) sums[output_of(o, k)] = sums[output_of(o, k)] + values[o];
      }
      for (const RecordedNumber& sum : sums) {
        adouble dependent = sum.variable();
        double value = 0.0;
        dependent >>= value;
      }
    }
    trace_off();
    // Recordings made afterwards would carry the memory of as many variables through each of their sweeps.
    setStoreManagerType(ADOLC_LOCATION_SINGLETONS);
    setStoreManagerType(ADOLC_LOCATION_BLOCKS);
  }

  [[nodiscard]] short tag() const noexcept { return tag_.number(); }
  [[nodiscard]] int input_count() const noexcept { return static_cast<int>(point_.size()); }
  [[nodiscard]] int output_count() const noexcept { return static_cast<int>(output_count_); }
  /// All unknowns, then what each interval reads else.
  [[nodiscard]] double* point(DerivativeBackEnd::Inputs inputs) {
    for (std::size_t i = 0; i < input_count_; ++i) {
      for (std::size_t k = 0; k < intervals_; ++k) {
        point_[input(i, k)] = inputs[i].data[inputs[i].same_for_all ? 0 : k];
      }
    }
    return point_.data();
  }

 private:
  void number_inputs(const LocalInputs& numbers, const WholePart& part) {
    numbers_.resize(input_count_ * intervals_);
    std::size_t next = part.unknowns.size();
    for (std::size_t i = 0; i < input_count_; ++i) {
      const bool is_unknown = i >= numbers.unknown(0) && i < numbers.step();
      for (std::size_t k = 0; k < intervals_; ++k) {
        numbers_[i * intervals_ + k] = is_unknown ? part.unknown(i - numbers.unknown(0), k) : next++;
      }
    }
    point_.resize(next);
  }
  [[nodiscard]] std::size_t input(std::size_t i, std::size_t k) const { return numbers_[i * intervals_ + k]; }

  AdolcTag tag_;
  std::size_t input_count_;  // of an interval
  std::size_t intervals_;
  std::size_t output_count_;
  std::vector<std::size_t> numbers_;  // of the independent variable of every input and interval
  std::vector<double> point_;
};

/// Colours of the unknowns: two that have an entry in the same row have different colours, so that one sweep in the
/// direction of all unknowns of a colour gives their columns. Greedy, in the order of the unknowns, as ColPack does.
std::vector<int> colours(std::size_t unknowns, std::size_t rows, const std::vector<WholePart::Entry>& entries) {
  std::vector<std::vector<std::size_t>> rows_of(unknowns);
  std::vector<std::vector<std::size_t>> columns_of(rows);
  for (const WholePart::Entry& entry : entries) {
    rows_of[entry.column].push_back(entry.row);
    columns_of[entry.row].push_back(entry.column);
  }
  std::vector<int> colour(unknowns, -1);
  std::vector<std::size_t> taken_by;  // per colour, the last unknown that may not have it
  for (std::size_t j = 0; j < unknowns; ++j) {
    for (const std::size_t row : rows_of[j]) {
      for (const std::size_t other : columns_of[row]) {
        if (colour[other] >= 0) taken_by[static_cast<std::size_t>(colour[other])] = j;
      }
    }
    std::size_t free = 0;
    while (free < taken_by.size() && taken_by[free] == j) ++free;
    if (free == taken_by.size()) taken_by.push_back(unknowns);
    colour[j] = static_cast<int>(free);
  }
  return colour;
}

int count_of(const std::vector<int>& colours) { return colours.empty() ? 0 : 1 + *std::ranges::max_element(colours); }

/// Both triangles of the Hessian, without the rows of unknowns that all intervals share: their entries are read from
/// the columns of these unknowns, which get colours of their own.
std::vector<int> symmetric_colours(const WholePart& part) {
  std::vector<WholePart::Entry> entries;
  std::size_t rows = part.unknowns.size();
  for (const auto& [value, i, j] : part.hessian) {
    if (!part.is_global[i]) entries.push_back({value, i, j});
    if (!part.is_global[j]) entries.push_back({value, j, i});
  }
  for (std::size_t j = 0; j < part.unknowns.size(); ++j) entries.push_back({0, j, j});
  for (std::size_t g = 0; g < part.unknowns.size(); ++g) {
    if (!part.is_global[g]) continue;
    for (std::size_t j = 0; j < part.unknowns.size(); ++j, ++rows) {
      entries.push_back({0, rows, g});
      entries.push_back({0, rows, j});
    }
  }
  return colours(part.unknowns.size(), rows, entries);
}

AdolcMatrix seeds_of(const std::vector<int>& colours, int height) {
  AdolcMatrix seeds(height, count_of(colours));
  for (std::size_t j = 0; j < colours.size(); ++j) seeds(j, static_cast<std::size_t>(colours[j])) = 1.0;
  return seeds;
}

/// Exact derivatives by ADOL-C, which differentiates cost, rows and ℓ of the whole program, each recorded once.
///
/// An evaluation is one call of `gradient`, of `fov_forward` for the Jacobian, or of `hess_mat` for the Hessian, in as
/// many directions as columns have colours. (Debian's ADOL-C is built without ColPack, so its sparse drivers are not
/// there; the pattern is known here anyway.) For threads see `AdolcDerivatives`.
class AdolcWholeDerivatives final : public DerivativeBackEnd {
 public:
  AdolcWholeDerivatives(const LocalFunctions& functions, const DerivativePlaces& places)
      : part_(functions, places),
        plans_(places),
        cost_(functions.cost, functions.inputs, part_, 1, [](std::size_t, std::size_t) { return std::size_t{0}; }),
        rows_(functions.rows.schedule, functions.inputs, part_, part_.rows.size(),
              [&](std::size_t o, std::size_t k) { return part_.row(functions.rows.places[o], k); }),
        lagrangian_(functions.lagrangian, functions.inputs, part_, 1,
                    [](std::size_t, std::size_t) { return std::size_t{0}; }),
        column_colours_(colours(part_.unknowns.size(), part_.rows.size(), part_.jacobian)),
        symmetric_colours_(symmetric_colours(part_)),
        cost_gradient_(static_cast<std::size_t>(cost_.input_count())),
        row_values_(part_.rows.size()),
        column_seeds_(seeds_of(column_colours_, rows_.input_count())),
        columns_(rows_.output_count(), count_of(column_colours_)),
        symmetric_seeds_(seeds_of(symmetric_colours_, lagrangian_.input_count())),
        curvatures_(lagrangian_.input_count(), count_of(symmetric_colours_)) {}

  void gradient(Inputs inputs, VectorOut result) override {
    begin_whole(plans_.gradient, result);
    if (part_.gradient.empty()) return;
    require_adolc(::gradient(cost_.tag(), cost_.input_count(), cost_.point(inputs), cost_gradient_.data()), "gradient");
    for (const std::size_t j : part_.gradient) {
      result[static_cast<Eigen::Index>(part_.unknowns[j])] += cost_gradient_[j];
    }
  }

  void jacobian(Inputs inputs, VectorOut values) override {
    begin_whole(plans_.jacobian, values);
    if (part_.jacobian.empty()) return;
    require_adolc(fov_forward(rows_.tag(), rows_.output_count(), rows_.input_count(), count_of(column_colours_),
                              rows_.point(inputs), column_seeds_.rows(), row_values_.data(), columns_.rows()),
                  "fov_forward");
    for (const auto& [value, i, j] : part_.jacobian) {
      values[static_cast<Eigen::Index>(value)] += columns_(i, static_cast<std::size_t>(column_colours_[j]));
    }
  }

  void hessian(Inputs inputs, VectorOut values) override {
    begin_whole(plans_.hessian, values);
    if (part_.hessian.empty()) return;
    require_adolc(hess_mat(lagrangian_.tag(), lagrangian_.input_count(), count_of(symmetric_colours_),
                           lagrangian_.point(inputs), symmetric_seeds_.rows(), curvatures_.rows()),
                  "hess_mat");
    for (const auto& [value, i, j] : part_.hessian) {
      const auto& [row, column] = part_.is_global[i] ? std::pair(j, i) : std::pair(i, j);
      values[static_cast<Eigen::Index>(value)] +=
          curvatures_(row, static_cast<std::size_t>(symmetric_colours_[column]));
    }
  }

 private:
  WholePart part_;
  DerivativePlaces plans_;
  WholeRecording cost_;
  WholeRecording rows_;
  WholeRecording lagrangian_;
  std::vector<int> column_colours_;
  std::vector<int> symmetric_colours_;
  std::vector<double> cost_gradient_;
  std::vector<double> row_values_;
  AdolcMatrix column_seeds_;
  AdolcMatrix columns_;
  AdolcMatrix symmetric_seeds_;
  AdolcMatrix curvatures_;
};

}  // namespace

// Declared where it is used, as `make_adolc_derivatives` is.
std::unique_ptr<DerivativeBackEnd> make_adolc_whole_derivatives(const LocalFunctions& functions,
                                                                const DerivativePlaces& places) {
  return std::make_unique<AdolcWholeDerivatives>(functions, places);
}

}  // namespace dmocbench
