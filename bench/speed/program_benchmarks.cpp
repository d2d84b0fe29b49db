#include <functional>

#include "bench/speed/benchmark_name.hpp"
#include "bench/speed/benchmarks.hpp"
#include "problems/registry.hpp"

namespace dmocbench::speed {

namespace {

/// A subject that is made when it is first wanted: of some hundred benchmarks most are left out of a run.
class SubjectOnDemand {
 public:
  explicit SubjectOnDemand(Formulas formulas) : formulas_(std::move(formulas)) {}

  [[nodiscard]] const Formulas& formulas() const noexcept { return formulas_; }
  Subject& get() {
    if (!subject_) subject_ = std::make_unique<Subject>(formulas_);
    return *subject_;
  }

 private:
  Formulas formulas_;
  std::unique_ptr<Subject> subject_;
};

/// An evaluation of the program: what it does, of which formulas, and how many numbers come out.
struct Evaluation {
  std::string quantity;
  std::function<void(Subject&, Eigen::VectorXd& result)> evaluate;
  std::function<const Schedule&(const IntervalFunctions&)> schedule;
  std::function<std::size_t(const Transcription&)> size;
};

std::vector<Evaluation> evaluations() {
  return {{"residual", [](Subject& s, Eigen::VectorXd& result) { s.program().constraints(s.x(), result); },
           [](const IntervalFunctions& f) -> const Schedule& { return f.rows.schedule; },
           [](const Transcription& program) { return program.constraint_count(); }},
          {"jacobian", [](Subject& s, Eigen::VectorXd& result) { s.program().jacobian(s.x(), result); },
           [](const IntervalFunctions& f) -> const Schedule& { return f.jacobian.schedule; },
           [](const Transcription& program) { return program.jacobian_structure().size(); }},
          {"hessian",
           [](Subject& s, Eigen::VectorXd& result) {
             s.program().hessian(s.x(), Subject::objective_factor, s.multipliers(), result);
           },
           [](const IntervalFunctions& f) -> const Schedule& { return f.hessian.schedule; },
           [](const Transcription& program) { return program.hessian_structure().size(); }}};
}

/// Every turn of the timed loop carries the evaluations out, one after the other.
void evaluate_repeatedly(benchmark::State& state, Subject& subject, const std::vector<Evaluation>& several) {
  std::vector<Eigen::VectorXd> results;
  Work work;
  for (const Evaluation& evaluation : several) {
    const std::size_t size = evaluation.size(subject.program());
    results.emplace_back(static_cast<Eigen::Index>(size));
    work += work_of(evaluation.schedule(subject.functions()), subject,
                    static_cast<double>(size) / static_cast<double>(Subject::intervals));
  }
  for ([[maybe_unused]] auto turn : state) {
    for (std::size_t i = 0; i < several.size(); ++i) {
      several[i].evaluate(subject, results[i]);
      benchmark::DoNotOptimize(results[i].data());
    }
    benchmark::ClobberMemory();
  }
  count_intervals(state, work);
}

void register_formulas(const Formulas& formulas) {
  const auto subject = std::make_shared<SubjectOnDemand>(formulas);
  const auto add = [&](const std::string& quantity, const std::vector<Evaluation>& several) {
    const BenchmarkName name{.way = "program",
                             .quantity = quantity,
                             .problem = formulas.label(),
                             .method = formulas.method,
                             .stages = formulas.stages,
                             .instruction_set = std::string(name_of(preferred_instruction_set()))};
    benchmark::RegisterBenchmark(name.text().c_str(), [subject, several](benchmark::State& state) {
      evaluate_repeatedly(state, subject->get(), several);
    });
  };
  const std::vector<Evaluation> all = evaluations();
  for (const Evaluation& evaluation : all) add(evaluation.quantity, {evaluation});
  add("separate", all);
}

}  // namespace

void register_program_benchmarks() {
  constexpr int most_stages = 3;
  constexpr int fewest_links = 2;
  constexpr int most_links = 8;
  for (const std::string& method : element_names()) {
    for (int stages = 1; stages <= most_stages; ++stages) {
      for (const std::string& problem : paper_problem_names()) {
        register_formulas({.problem = problem, .method = method, .stages = stages});
      }
      for (int links = fewest_links; links <= most_links; ++links) {
        register_formulas({.problem = "link_chain", .links = links, .method = method, .stages = stages});
      }
    }
  }
}

}  // namespace dmocbench::speed
