// The table of claims: what the paper states, what was measured, and the verdict.

#include <algorithm>
#include <ranges>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "bench/claims/claim.hpp"
#include "bench/experiment/experiment.hpp"
#include "bench/experiment/result_file.hpp"

namespace dmocbench::programs {

const Columns<JudgedClaim> columns{
    {"claim", "", "short name", &JudgedClaim::id},
    {"where", "", "in the paper", &JudgedClaim::where},
    {"paper", "", "what it states", &JudgedClaim::states},
    {"measured", "", "what was measured", &JudgedClaim::measured},
    {"verdict", "", "by the tables", [](const JudgedClaim& claim) { return name_of(claim.verdict); }},
};

std::string markdown(const Table& claims) {
  std::string text = fmt::format("# The paper's claims, measured\n\n| {} |\n|", fmt::join(claims.columns(), " | "));
  for (std::size_t i = 0; i < claims.columns().size(); ++i) text += "---|";
  for (const Row& claim : claims.rows()) {
    const auto field = [&](const std::string& column) { return claim.text(column); };
    text += fmt::format("\n| {} |", fmt::join(claims.columns() | std::views::transform(field), " | "));
  }
  return text + "\n";
}

void print(const std::vector<JudgedClaim>& claims) {
  for (const JudgedClaim& claim : claims) {
    fmt::print("{0:<11} {1:<50} {2}\n{5:12}paper:    {3}\n{5:12}measured: {4}\n", name_of(claim.verdict), claim.id,
               claim.where, claim.states, claim.measured, "");
  }
  std::vector<std::string> counts;
  for (const ClaimVerdict verdict :
       {ClaimVerdict::reproduced, ClaimVerdict::differs, ClaimVerdict::floor, ClaimVerdict::not_yet}) {
    counts.push_back(
        fmt::format("{} {}", std::ranges::count(claims, verdict, &JudgedClaim::verdict), name_of(verdict)));
  }
  fmt::print("{}\n", fmt::join(counts, ", "));
}

int judge_all(CommandLine& line) {
  std::filesystem::path out = "results";
  line.option("--out", out, "the results folder");
  line.parse();
  const std::vector<JudgedClaim> claims = judge_claims(ResultTables::read(out));
  const Table table = table_of(columns, claims);
  write_file(out / "claims.csv", table.csv());
  write_file(out / "claims.md", markdown(table));
  print(claims);
  return 0;
}

}  // namespace dmocbench::programs

int main(int argc, char** argv) {
  return dmocbench::run_program(
      "claims",
      "Judges the claims of the paper by the tables of a results folder; writes claims.md and claims.csv there.", argc,
      argv, dmocbench::programs::judge_all);
}
