// The table of claims: what the paper states, what was measured, and the verdict.
#include <cstdio>
#include <exception>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "bench/claims/claim.hpp"
#include "bench/experiment/experiment.hpp"
#include "bench/experiment/result_file.hpp"

namespace dmocbench {

namespace {

Table claim_table(const std::vector<JudgedClaim>& claims) {
  Table table({"claim", "where", "paper", "measured", "verdict"});
  for (const JudgedClaim& claim : claims) {
    Row row;
    row.set("claim", claim.id);
    row.set("where", claim.where);
    row.set("paper", claim.states);
    row.set("measured", claim.measured);
    row.set("verdict", std::string(name_of(claim.verdict)));
    table.append(std::move(row));
  }
  return table;
}

std::string markdown(const Table& claims) {
  std::string text = fmt::format("# The paper's claims, measured\n\n| {} |\n|", fmt::join(claims.columns(), " | "));
  for (std::size_t i = 0; i < claims.columns().size(); ++i) text += "---|";
  for (const Row& claim : claims.rows()) {
    text += "\n|";
    for (const std::string& column : claims.columns()) text += " " + claim.text(column) + " |";
  }
  return text + "\n";
}

void print(const std::vector<JudgedClaim>& claims) {
  for (const JudgedClaim& claim : claims) {
    fmt::print("{:<11} {:<50} {}\n", name_of(claim.verdict), claim.id, claim.where);
    fmt::print("{:12}paper:    {}\n", "", claim.states);
    fmt::print("{:12}measured: {}\n", "", claim.measured);
  }
  std::vector<std::string> counts;
  for (const ClaimVerdict verdict :
       {ClaimVerdict::reproduced, ClaimVerdict::differs, ClaimVerdict::floor, ClaimVerdict::not_yet}) {
    counts.push_back(
        fmt::format("{} {}", std::ranges::count(claims, verdict, &JudgedClaim::verdict), name_of(verdict)));
  }
  fmt::print("{}\n", fmt::join(counts, ", "));
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
    const dmocbench::Table table = dmocbench::claim_table(claims);
    dmocbench::write_file(out / "claims.csv", table.csv());
    dmocbench::write_file(out / "claims.md", dmocbench::markdown(table));
    dmocbench::print(claims);
    return 0;
  });
} catch (const std::exception& error) {  // what is set up before run_program can guard it
  std::fputs(error.what(), stderr);
  return 2;
}
