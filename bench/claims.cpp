// The table of claims: the paper's statements, the measurements, and the verdicts.

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "bench/claims/claims_table.hpp"
#include "bench/run/command_line.hpp"
#include "bench/run/experiment.hpp"
#include "bench/run/result_file.hpp"

namespace dmocbench::claims_program {

void print(const std::vector<JudgedClaim>& claims) {
  for (const JudgedClaim& claim : claims) {
    print_line(
        fmt::format("{:<11} {:<50} {}, {}", name_of(claim.verdict), claim.id(), name_of(claim.whose), claim.where));
    print_line(fmt::format("{:12}states:   {}", "", claim.states));
    print_line(fmt::format("{:12}measured: {}", "", claim.measured()));
    if (!claim.reason().empty()) print_line(fmt::format("{:12}reason:   {}", "", claim.reason()));
  }
  fmt::print("{}\n{}\n", fmt::join(section_lines(claims), "\n"), fmt::join(closing_lines(claims), "\n"));
}

int judge_all(CommandLine& line) {
  std::filesystem::path out = "results";
  std::vector<std::string> required;
  line.option("--out", out, "the results folder");
  line.list("--require", required, "claims that must be reproduced (otherwise the exit code is 1)");
  line.exit_code_1("a claim named with --require is not reproduced");
  line.parse();
  const ResultTables tables = ResultTables::read(out);
  std::vector<JudgedClaim> claims = judge_claims(tables);
  if (!tables.has_any()) {
    throw Error(
        fmt::format("{0} contains no table that a claim reads; run an experiment with --out {0} first", out.string()));
  }
  mark_missing_evidence(claims, out);
  const std::vector<std::string> missed = not_reproduced(claims, required);
  write_file(out / "claims.csv", claims_table(claims).csv());
  write_file(out / "findings.csv", findings_table(claims).csv());
  write_file(out / "claims_rows.csv", claims_rows_table(claims).csv());
  write_file(out / "claims.json", claims_json(claims).dump(1) + "\n");
  write_file(out / "claims.md", claims_markdown(claims));
  print(claims);
  for (const std::string& sentence : missed) fmt::print(stderr, "claims: {}\n", sentence);
  return missed.empty() ? 0 : 1;
}

int run(int argc, char** argv) {
  return run_program(
      "claims",
      "Evaluates the paper's claims on the tables in a results folder and writes claims.md and claims.csv there.", argc,
      argv, judge_all);
}

}  // namespace dmocbench::claims_program
