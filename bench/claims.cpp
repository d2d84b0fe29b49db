// The table of claims: what the paper states, what was measured, and the verdict.
#include <cstdio>
#include <exception>

#include <fmt/format.h>

#include "bench/claims/predicates.hpp"
#include "bench/experiment/experiment.hpp"
#include "bench/experiment/result_file.hpp"

namespace dmocbench {

namespace {

Table claim_table(const std::vector<Claim>& claims) {
  Table table({"claim", "where", "paper", "measured", "verdict"});
  for (const Claim& claim : claims) {
    Row row;
    row.set("claim", claim.id);
    row.set("where", claim.where);
    row.set("paper", claim.paper);
    row.set("measured", claim.measured);
    row.set("verdict", std::string(name_of(claim.verdict)));
    table.append(std::move(row));
  }
  return table;
}

std::string markdown(const std::vector<Claim>& claims) {
  std::string text =
      "# The paper's claims, measured\n\n| claim | where | paper | measured | verdict |\n|---|---|---|---|---|\n";
  for (const Claim& claim : claims) {
    text += fmt::format("| {} | {} | {} | {} | {} |\n", claim.id, claim.where, claim.paper, claim.measured,
                        name_of(claim.verdict));
  }
  return text;
}

void print(const std::vector<Claim>& claims) {
  for (const Claim& claim : claims) {
    fmt::print("{:<11} {:<50} {}\n", name_of(claim.verdict), claim.id, claim.where);
    fmt::print("{:12}paper:    {}\n", "", claim.paper);
    fmt::print("{:12}measured: {}\n", "", claim.measured);
  }
  for (const ClaimVerdict verdict :
       {ClaimVerdict::reproduced, ClaimVerdict::differs, ClaimVerdict::floor, ClaimVerdict::not_yet}) {
    const auto count =
        std::count_if(claims.begin(), claims.end(), [&](const Claim& c) { return c.verdict == verdict; });
    fmt::print("{}{} {}", verdict == ClaimVerdict::reproduced ? "" : ", ", count, name_of(verdict));
  }
  fmt::print("\n");
}

}  // namespace

}  // namespace dmocbench

int main(int argc, char** argv) try {
  dmocbench::CommandLine line(
      "Judges the claims of the paper by the tables of a results folder; writes claims.md and claims.csv there.",
      "claims");
  std::filesystem::path out = "results";
  line.option("--out", out, "the results folder").shows_default();
  return dmocbench::run_program(line, argc, argv, [&] {
    const auto claims = dmocbench::judge_claims(dmocbench::ResultTables::read(out));
    dmocbench::write_file(out / "claims.csv", dmocbench::claim_table(claims).csv());
    dmocbench::write_file(out / "claims.md", dmocbench::markdown(claims));
    dmocbench::print(claims);
    return 0;
  });
} catch (const std::exception& error) {  // what is set up before run_program can guard it
  std::fputs(error.what(), stderr);
  return 2;
}
