#include "methods/extensions/interchange/ampl_names.hpp"

#include <algorithm>
#include <cctype>
#include <map>

#include <fmt/format.h>

namespace dmocbench {

namespace {

/// Names of unknowns or rows, block by block, by the symbols of their blocks (`BlockWords`).
class AmplNames {
 public:
  explicit AmplNames(const Transcription& program)
      : q_(without_spaces(program.problem().configuration_names())),
        u_(without_spaces(program.problem().control_names())) {}

  template <class Kind>
  [[nodiscard]] std::vector<std::string> of(const std::vector<Block<Kind>>& blocks) const {
    std::vector<std::string> names;
    std::map<std::string, int> numbers;  // how many components have a symbol so far
    for (const Block<Kind>& block : blocks) {
      int& number = numbers[symbol_of(block, "{0}", "{1}")];
      for (Eigen::Index i = 0; i < block.width; ++i) {
        const std::string name = symbol_of(block, component_of(block, i), std::to_string(++number));
        const bool is_series = block.support == Support::nodes || block.support == Support::intervals;
        for (std::size_t k = 0; k < block.length; ++k) {
          names.push_back(is_series ? fmt::format("{}[{}]", name, k) : name);
        }
      }
    }
    return names;
  }

 private:
  static std::vector<std::string> without_spaces(std::vector<std::string> names) {
    for (std::string& name : names) {
      std::ranges::replace_if(
          name, [](unsigned char letter) { return std::isspace(letter) != 0; }, '_');
    }
    return names;
  }

  template <class Kind>
  [[nodiscard]] static std::string symbol_of(const Block<Kind>& block, const std::string& component,
                                             const std::string& number) {
    return fmt::format(fmt::runtime(block.words.symbol), component, number, block.stage + 1, block.node);
  }
  template <class Kind>
  [[nodiscard]] std::string component_of(const Block<Kind>& block, Eigen::Index i) const {
    const auto number = static_cast<std::size_t>(block.component + i);
    if (block.words.names == ComponentNames::configuration) return q_[number];
    return block.words.names == ComponentNames::control ? u_[number] : "";
  }

  std::vector<std::string> q_;
  std::vector<std::string> u_;
};

}  // namespace

std::vector<std::string> ampl_variable_names(const Transcription& program) {
  return AmplNames(program).of(program.blocks().unknowns());
}

std::vector<std::string> ampl_row_names(const Transcription& program) {
  return AmplNames(program).of(program.blocks().rows());
}

}  // namespace dmocbench
