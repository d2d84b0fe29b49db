// What no table may hold, put into every column that decides on a claim: no claim is reproduced by it.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>
#include <random>
#include <ranges>
#include <set>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <sys/stat.h>

#include "bench/claims/claim.hpp"
#include "bench/run/described_tables.hpp"
#include "bench/run/result_file.hpp"
#include "tests/bench/all_tables_for_claims.hpp"
#include "tests/support/sentence_of_error.hpp"
#include "tests/support/temporary_folder.hpp"

namespace dmocbench {
namespace {

using tests::Rows;

using Judgements = std::map<std::string, JudgedClaim>;

bool reads(const std::vector<ReadRows>& read, const std::string& table) {
  return std::ranges::count(read, table + ".csv", &ReadRows::table) > 0;
}

class DoctoredClaims : public tests::InTemporaryFolder {
 protected:
  void SetUp() override {
    InTemporaryFolder::SetUp();
    for (auto& [name, rows] : rows_) {
      const ColumnNames& columns = columns_[name] = tests::declared_columns(name);
      // Solvers and back ends are no matter to most claims, but are part of the keys.
      for (Row& row : rows) {
        const auto add = [&](const char* column, const char* text) {
          if (std::ranges::count(columns, column) > 0 && row.text(column).empty()) row.set(column, text);
        };
        add("solver", "ipopt");
        add("derivatives", "tape");
      }
      write(name, columns, rows);
    }
    tables_ = ResultTables::read(folder());
    whole_ = judgements_of(tables_);
    std::erase_if(columns_, [&](const auto& table) { return !is_read(table.first); });  // by claims of extensions
  }
  /// Whether a claim reads the table.
  [[nodiscard]] bool is_read(const std::string& name) const {
    return std::ranges::any_of(std::views::values(whole_), [&](const auto& claim) { return reads(claim.rows, name); });
  }
  /// Writes a table without telling its run.
  void slip_in(const std::string& name, const ColumnNames& columns, const Rows& rows) const {
    Table table(columns);
    for (const Row& row : rows) table.append(row);
    write_quickly(name + ".csv", table.csv());
  }
  /// Writes a table, and the metadata of a run that has come to its end with it.
  void write(const std::string& name, const ColumnNames& columns, const Rows& rows) const {
    slip_in(name, columns, rows);
    nlohmann::ordered_json tables = describe_tables({folder() / (name + ".csv")});
    tables.front()["schema"] = tests::declared_schema(name);
    write_quickly(name + ".json", nlohmann::ordered_json{{"complete", true}, {"tables", tables}}.dump());
  }
  /// Thousands of files that nobody needs on the disk.
  void write_quickly(const std::string& name, const std::string& content) const {
    std::ofstream(folder() / name, std::ios::binary) << content;
  }
  /// The table with a text in a column of some rows.
  [[nodiscard]] Judgements with(
      const std::string& name, const std::string& column, const std::string& text,
      const std::function<bool(const Row&)>& where = [](const Row&) { return true; }) {
    Rows doctored = rows_.at(name);
    for (Row& row : doctored) {
      if (where(row) && !row.text(column).empty()) row.set(column, text);
    }
    return judge_with(name, columns_.at(name), doctored);
  }
  [[nodiscard]] Judgements without(const std::string& name, const std::string& column) {
    ColumnNames columns = columns_.at(name);
    std::erase(columns, column);
    return judge_with(name, columns, rows_.at(name));
  }
  /// Another table in the place of one; the others are those that were read. Judges the claims that read this table,
  /// and those that do not tell what they read.
  [[nodiscard]] Judgements judge_with(const std::string& name, const ColumnNames& columns, const Rows& rows) {
    write(name, columns, rows);
    tables_.forget(name);
    Judgements judged = judgements_of(tables_, [&](const std::string& id) {
      const std::vector<ReadRows>& read = whole_.at(id).rows;
      return read.empty() || reads(read, name);
    });
    write(name, columns_.at(name), rows_.at(name));
    tables_.forget(name);
    return judged;
  }
  /// Of all tables as they are now.
  [[nodiscard]] Judgements judge() const { return judgements_of(ResultTables::read(folder())); }
  static bool every(const std::string&) { return true; }
  static Judgements judgements_of(const ResultTables& tables,
                                  const std::function<bool(const std::string&)>& is_chosen = every) {
    Judgements judged;
    for (const JudgedClaim& claim : judge_claims(tables, is_chosen)) judged[claim.id()] = claim;
    return judged;
  }

  tests::TableRows rows_ = tests::all_rows();
  std::map<std::string, ColumnNames> columns_;
  ResultTables tables_;  ///< as they are
  Judgements whole_;     ///< of them
};

const std::vector<std::string> no_numbers{"nan", "-nan", "inf", "-inf", "much", ""};

TEST_F(DoctoredClaims, AreAllReproducedByWholeTables) {
  // Slopes cannot be those of the theorem as printed and with one power less.
  const std::string told_otherwise = "orbital_transfer/order_theorem_with_one_power_less";
  std::size_t reproduced = 0;
  for (const auto& [id, claim] : whole_) {
    EXPECT_EQ(claim.measured().find("has no column"), std::string::npos) << id << ": " << claim.measured();
    if (claim.verdict == ClaimVerdict::reproduced) ++reproduced;
    const bool is_judged = (id.starts_with(orbit) || id.starts_with("simulations")) && id != told_otherwise;
    if (is_judged && claim.verdict != ClaimVerdict::measured) {
      EXPECT_EQ(claim.verdict, ClaimVerdict::reproduced) << id << ": " << claim.measured();
    }
  }
  EXPECT_GE(reproduced, 29U);
}

/// A number that decides is one whose change is told or changes the verdict.
TEST_F(DoctoredClaims, AreNeverReproducedWhereANumberThatDecidesIsNone) {
  std::mt19937 random(19);  // NOLINT(cert-msc51-cpp): the same rows each time
  std::size_t deciding = 0;
  for (const auto& [name, columns] : columns_) {
    for (const std::string& column : columns) {
      const Rows& rows = rows_.at(name);
      const auto is_number = [&](const Row& row) { return row.number(column).has_value(); };
      const auto numbers = std::ranges::count_if(rows, is_number);
      if (numbers == 0) continue;
      const auto one = std::uniform_int_distribution<std::ptrdiff_t>(0, numbers - 1)(random);
      for (const bool in_all_rows : {true, false}) {
        std::ptrdiff_t i = 0;
        const auto chosen = [&](const Row& row) { return is_number(row) && (i++ == one || in_all_rows); };
        const auto doctored = [&](const std::string& text) {
          i = 0;
          return with(name, column, text, chosen);
        };
        std::set<std::string> decided;
        for (const char* number : {"1e30", "-1e30", "0.37"}) {
          for (const auto& [id, claim] : doctored(number)) {
            const JudgedClaim& before = whole_.at(id);
            if (before.measured() != claim.measured() || before.verdict != claim.verdict) decided.insert(id);
          }
        }
        if (decided.empty()) continue;
        ++deciding;
        for (const auto& [id, claim] : doctored("5e-324")) {  // finite, but ratios to it are not
          if (claim.measured().find(" inf ") == std::string::npos) continue;
          EXPECT_EQ(claim.verdict, ClaimVerdict::not_judged) << name << ": " << column << ": " << claim.measured();
        }
        for (const std::string& text : no_numbers) {
          Judgements judged = doctored(text);
          for (const std::string& id : decided) {
            EXPECT_NE(judged[id].verdict, ClaimVerdict::reproduced)
                << name << ": " << column << " = \"" << text << "\": " << id << ": " << judged[id].measured();
          }
        }
        if (!in_all_rows) continue;
        Judgements judged = without(name, column);
        for (const std::string& id : decided) {
          EXPECT_NE(judged[id].verdict, ClaimVerdict::reproduced) << name << " without " << column << ": " << id;
        }
      }
    }
  }
  EXPECT_GT(deciding, 100U);
}

/// The orbit's claim of a short name; another's needs its whole name.
std::string id_of(const std::string& claim) {
  return claim.find('/') == std::string::npos ? std::string(orbit) + "/" + claim : claim;
}

struct Deciding {
  std::string table;
  std::string column;
  std::vector<std::string> claims;
};

TEST_F(DoctoredClaims, SayNotJudgedAndNameTheColumn) {
  const std::vector<Deciding> all{
      {"objective", "objective", {"objective_evolution"}},
      {"invariants_momentum", "defect", {"simulations/forced_noether_theorem", "simulations/momentum_preserved"}},
      {"invariants_momentum",
       "defect_in_long_double",
       {"simulations/forced_noether_theorem", "simulations/momentum_preserved"}},
      {"equivalence", "configuration_difference", {"equal_solutions"}},
      {"equivalence", "momentum_difference", {"equal_solutions"}},
      {"equivalence", "control_difference", {"equal_solutions"}},
      {"equivalence", "costate_difference", {"equal_solutions"}},
      {"equivalence", "objective_difference", {"equal_solutions"}},
      {"equivalence", "adjoint_residual", {"order_of_adjoint_scheme"}},
      {"equivalence", "adjoint_residual_by_plain_coefficients", {"order_of_adjoint_scheme"}},
      {"consistency", "momentum_defect_max", {"momentum_consistency"}},
      {"iterations", "minor_iterations", {"minor_iteration_ratio", "minor_iterations_saved_in_phase_1"}},
      {"savings_by_solver_ratios", "round_ratios", {"collocation_takes_longer"}},
      {"invariants_energy_behaviour", "change", {"simulations/energy_does_not_drift"}},
      {"local_minima_minima", "objective", {"examples/local_minima"}},
      {"local_minima_minima", "hamiltonian", {"examples/local_minima"}},
      {"local_minima_shares", "solved", {"examples/local_minima"}},
      {"convergence_indirect_reference", "cost", {"objective_evolution"}},
      {"convergence_equal_accuracy",
       "variables_ratio",
       {"savings_at_equal_state_error", "savings_at_equal_replay_error"}},
      {"equivalence", "forced_form_residual", {"dmoc_is_the_forced_form", "tangent_is_the_acceleration_form"}},
  };
  const auto expect = [](Judgements judged, const Deciding& deciding, const std::string& what) {
    for (const std::string& claim : deciding.claims) {
      const JudgedClaim& found = judged[id_of(claim)];
      EXPECT_EQ(found.verdict, ClaimVerdict::not_judged) << claim << " with " << deciding.column << " " << what;
      EXPECT_NE(found.measured().find(deciding.table + ".csv"), std::string::npos)
          << claim << " with " << deciding.column << " " << what << ": " << found.measured();
      EXPECT_PRED2(tests::says, found.measured(), deciding.column);
    }
  };
  for (const Deciding& deciding : all) {
    for (const std::string& text : no_numbers) expect(with(deciding.table, deciding.column, text), deciding, text);
    expect(without(deciding.table, deciding.column), deciding, "missing");
  }
  expect(with("iterations", "minor_iterations", "0"), all[11], "zero");
}

TEST_F(DoctoredClaims, SayWhatATableLacksAndStopNoOtherClaim) {
  const std::string name = "local_minima_minima";
  const std::filesystem::path file = folder() / (name + ".csv");
  const auto expect = [&](const std::string& sentence) {
    Judgements judged = judge();
    const JudgedClaim& claim = judged["examples/local_minima"];
    EXPECT_EQ(claim.verdict, ClaimVerdict::not_judged) << sentence;
    EXPECT_PRED2(tests::says, claim.measured(), sentence);
    EXPECT_EQ(judged["simulations/symplectic"].verdict, ClaimVerdict::reproduced);
    std::filesystem::remove(file);
    write(name, columns_.at(name), rows_.at(name));
  };
  Rows doubled = rows_.at(name);
  doubled.push_back(doubled.front());
  write(name, columns_.at(name), doubled);
  expect("has the same key as");
  write_file(file, "problem,minimum\none,1\ntwo\n");
  expect("record 3");
  std::filesystem::remove(file);
  ASSERT_EQ(::mkfifo(file.c_str(), 0600), 0);
  expect("not a regular file");
  std::filesystem::remove(file);
  expect("there is no local_minima_minima.csv");
  const std::filesystem::path metadata = folder() / (name + ".json");
  write_file(metadata, R"({"complete": false})");
  expect("interrupted");
  write_file(metadata, "[");
  expect("local_minima_minima.json does not state");
  std::filesystem::remove(metadata);
  expect("the .json file next to it");
  std::filesystem::rename(metadata, folder() / "local_minima.json");
  EXPECT_EQ(judge()["examples/local_minima"].verdict, ClaimVerdict::reproduced) << "its run has a shorter name";
  write_file(folder() / "own_notes.csv", "a,b\n1\n");
  EXPECT_EQ(judge()["examples/local_minima"].verdict, ClaimVerdict::reproduced);
}

TEST_F(DoctoredClaims, SayWhenATableAndItsRunDoNotBelongTogether) {
  const ColumnNames& columns = columns_.at("objective");
  const Rows& rows = rows_.at("objective");
  const auto expect = [&](const std::string& sentence) {
    const JudgedClaim claim = judge()["orbital_transfer/objective_evolution"];
    EXPECT_EQ(claim.verdict, ClaimVerdict::not_judged) << sentence;
    EXPECT_PRED2(tests::says, claim.measured(), sentence);
    write("objective", columns, rows);
  };
  slip_in("objective", columns, {rows.begin(), rows.end() - 1});
  expect("6 rows, but objective.csv has 5");
  ColumnNames more = columns;
  more.emplace_back("wish");
  slip_in("objective", more, rows);
  expect("has the column \"wish\"");
  ColumnNames fewer = columns;
  std::erase(fewer, "objective");
  slip_in("objective", fewer, rows);
  expect("objective.csv lacks the column \"objective\"");
  write_file(folder() / "objective.json", R"({"complete": true})");
  expect("objective.json does not list objective.csv");
  write_file(folder() / "objective.json", R"({"complete": true, "cases": 8, "rows": 6})");
  expect("8 cases");
  EXPECT_EQ(judge()["orbital_transfer/objective_evolution"].verdict, ClaimVerdict::reproduced);
}

/// A table that was changed behind its run is told by its checksum, whatever was changed in whichever table.
TEST_F(DoctoredClaims, AreNotJudgedWhereAnyTableIsNotAsItsRunWroteIt) {
  for (const auto& [name, columns] : columns_) {
    Rows doctored = rows_.at(name);
    Row& last = doctored.back();
    const auto column = std::ranges::find_if(columns, [&](const std::string& c) { return last.number(c).has_value(); });
    ASSERT_NE(column, columns.end()) << name;
    last.set(*column, last.needed(*column) + 1.0);
    slip_in(name, columns, doctored);
    bool is_told = false;
    const Judgements judged = judge();
    for (const JudgedClaim& claim : std::views::values(judged)) {
      if (claim.measured().find(name + ".csv was changed after its run") == std::string::npos) continue;
      is_told = true;
      EXPECT_EQ(claim.verdict, ClaimVerdict::not_judged) << claim.id();
    }
    EXPECT_TRUE(is_told) << name;
    write(name, columns, rows_.at(name));
  }
}

TEST_F(DoctoredClaims, NameTheOrdersThatOneRowLacks) {
  const std::string name = "convergence_indirect_slopes";
  write(name, columns_.at(name), {rows_.at(name).front()});
  const JudgedClaim claim = judge()["orbital_transfer/order_of_convergence"];
  EXPECT_EQ(claim.verdict, ClaimVerdict::not_judged);
  EXPECT_PRED2(tests::says, claim.measured(), "no order of momentum for orbital_transfer, dmoc, gauss 2");
}

TEST_F(DoctoredClaims, CountTheRowsThatTheyLeaveOutNameThemAndSayWhomThatFavours) {
  const auto is_stray = [](const Row& row) {
    return row.text("derivatives") == "dense_differences" && row.text("method") == "dmoc";
  };
  const std::string measured =
      with("derivatives", "status", "step failed", is_stray)["orbital_transfer/automatic_differentiation_saves_time"]
          .measured();
  EXPECT_PRED2(tests::says, measured, "rows left out: not solved with dense_differences or ");
  EXPECT_PRED2(tests::says, measured, "which favours dense_differences with dmoc (");
}

/// The predicate of a claim: the same on every problem.
std::string predicate_of(const std::string& id) { return id.substr(id.find('/') + 1); }

/// What tables may hold in the place of a text.
std::vector<std::string> alternatives_to(const std::string& column, const std::string& text) {
  if (column == "status") return {"step failed", "solved"};
  if (column == "is_motion") return {"no"};
  if (text.find(' ') != std::string::npos) {  // numbers, one of each round
    return {joined_numbers(std::vector<double>(11, 1e-3)), joined_numbers(std::vector<double>(11, 1e3))};
  }
  return {"1e30", "-1e30", "1e-30", "0", "0.37", "1", "2"};
}

/// All rows, and the rows with one text in a column of few texts.
std::vector<tests::Where> groups_of(const Rows& rows, const ColumnNames& columns) {
  std::vector<tests::Where> groups{[](const Row&) { return true; }};
  for (const std::string& column : columns) {
    std::set<std::string> texts;
    for (const Row& row : rows) texts.insert(row.text(column));
    constexpr std::size_t few = 8;
    if (texts.size() < 2 || texts.size() > few) continue;
    for (const std::string& text : texts) groups.push_back(tests::has(column, text));
  }
  return groups;
}

/// A text in a column of some rows.
struct Doctoring {
  std::string table;
  std::string column;
  std::string text;
  tests::Where is_in_group;

  [[nodiscard]] Rows applied_to(Rows rows) const {
    for (Row& row : rows) {
      if (is_in_group(row) && !row.text(column).empty()) row.set(column, text);
    }
    return rows;
  }
};

/// Predicates with the verdicts that tables lead them to.
class ReachedVerdicts {
 public:
  ReachedVerdicts() { note(judge_claims(tables_)); }
  /// Doctors every column that a predicate without both verdicts reads, group by group.
  void doctor() {
    for (const auto& [name, rows] : rows_) {
      const std::set<std::string> read = columns_read_of(name + ".csv");
      const ColumnNames columns = tests::declared_columns(name);
      if (read.empty()) continue;
      for (const tests::Where& is_in_group : groups_of(rows, columns)) {
        for (const std::string& column : read) doctor(name, column, is_in_group);
      }
      tables_.add(name, tests::declared_table(name, rows));
    }
  }
  [[nodiscard]] std::vector<std::string> without_both() const {
    std::vector<std::string> names;
    for (const auto& [name, reached] : verdicts_) {
      const bool is_decided = !by_counting_.contains(name) && !reached.contains(ClaimVerdict::measured);
      if (is_decided && !(reached.contains(ClaimVerdict::reproduced) && reached.contains(ClaimVerdict::differs)))
        names.push_back(name);
    }
    return names;
  }
  [[nodiscard]] std::size_t count() const { return verdicts_.size(); }
  /// By claims' ids, a doctoring by which they differ.
  [[nodiscard]] const std::map<std::string, Doctoring>& refuted_by() const { return refuted_by_; }

 private:
  void note(const std::vector<JudgedClaim>& claims) {
    for (const JudgedClaim& claim : claims) {
      const std::string name = predicate_of(claim.id());
      verdicts_[name].insert(claim.verdict);
      if (claim.by_counting) by_counting_.insert(name);
      for (const ReadRows& read : claim.rows) read_[name][read.table].insert(read.columns.begin(), read.columns.end());
    }
  }
  [[nodiscard]] std::set<std::string> columns_read_of(const std::string& table) {
    std::set<std::string> columns;
    for (const std::string& name : without_both()) columns.insert(read_[name][table].begin(), read_[name][table].end());
    return columns;
  }
  void doctor(const std::string& name, const std::string& column, const tests::Where& is_in_group) {
    std::vector<std::string> open = without_both();
    std::erase_if(open, [&](const std::string& claim) { return !read_[claim][name + ".csv"].contains(column); });
    if (open.empty()) return;
    const Rows& rows = rows_.at(name);
    const auto one =
        std::ranges::find_if(rows, [&](const Row& row) { return is_in_group(row) && !row.text(column).empty(); });
    if (one == rows.end() || (!one->number(column) && alternatives_to(column, one->text(column)).size() > 2)) return;
    for (const std::string& text : alternatives_to(column, one->text(column))) {
      const Doctoring doctoring{name, column, text, is_in_group};
      tables_.add(name, tests::declared_table(name, doctoring.applied_to(rows)));
      const std::vector<JudgedClaim> judged =
          judge_claims(tables_, [&](const std::string& id) { return std::ranges::count(open, predicate_of(id)) > 0; });
      note(judged);
      for (const JudgedClaim& claim : judged) {
        if (claim.verdict == ClaimVerdict::differs) refuted_by_.try_emplace(claim.id(), doctoring);
      }
    }
  }

  tests::TableRows rows_ = tests::all_rows();
  ResultTables tables_ = tests::results_of(rows_);
  std::map<std::string, std::set<ClaimVerdict>> verdicts_;
  std::map<std::string, std::map<std::string, std::set<std::string>>> read_;  ///< columns, by predicate and table
  std::set<std::string> by_counting_;
  std::map<std::string, Doctoring> refuted_by_;
};

TEST(EveryPredicate, IsReproducedByOneTableAndDiffersByAnother) {
  ReachedVerdicts reached;
  reached.doctor();
  std::vector<std::string> open = reached.without_both();
  // Slopes of forces and transforms are those of the theorem, or a power less.
  std::erase(open, "order_theorem_with_one_power_less");
  EXPECT_TRUE(open.empty()) << fmt::format("cannot reach both verdicts: {}", fmt::join(open, ", "));
  EXPECT_GT(reached.count(), 60U);
}

/// The verdicts are exchanged with the rows that agree and those that do not: a mark by which a claim leaves rows out
/// leaves out either kind.
TEST(EveryPredicate, LeavesRowsOutWhateverTheirNumbersAre) {
  const tests::TableRows all = tests::all_rows();
  ResultTables tables = tests::results_of(all);
  std::map<std::string, std::vector<ReadRows>> read;
  for (const JudgedClaim& claim : judge_claims(tables)) read[claim.id()] = claim.rows;
  ReachedVerdicts reached;
  reached.doctor();
  std::size_t exchanged = 0;
  for (const auto& [id, doctoring] : reached.refuted_by()) {
    if (predicate_of(id) == "automatic_differentiation_more_robust") continue;  // it is about failures
    for (const auto& [column, mark] : {std::pair("fine_end", "orders"), std::pair("verdict", "unsteady"),
                                       std::pair("status", "step failed"), std::pair("branch", "other")}) {
      if (std::ranges::count(tests::declared_columns(doctoring.table), column) == 0 || column == doctoring.column)
        continue;
      // Of all tables that the claim reads, with rows of one that agree or that do not.
      const auto verdict_with = [&](const Rows& of_doctored) {
        for (const ReadRows& of_claim : read.at(id)) {
          const std::string name = of_claim.table.substr(0, of_claim.table.rfind(".csv"));
          Rows rows = name == doctoring.table ? of_doctored : all.at(name);
          if (std::ranges::count(tests::declared_columns(name), column) > 0) {
            for (Row& row : rows) row.set(column, mark);
          }
          tables.add(name, tests::declared_table(name, rows));
        }
        return judge_claims(tables, [&](const std::string& other) { return other == id; }).front().verdict;
      };
      const ClaimVerdict agreeing = verdict_with(all.at(doctoring.table));
      const ClaimVerdict refuting = verdict_with(doctoring.applied_to(all.at(doctoring.table)));
      EXPECT_EQ(name_of(refuting), name_of(agreeing == ClaimVerdict::reproduced ? ClaimVerdict::differs : agreeing))
          << id << ": " << doctoring.table << ", " << doctoring.column << " = " << doctoring.text << ", " << column;
      ++exchanged;
    }
    for (const ReadRows& of_claim : read.at(id)) {
      const std::string name = of_claim.table.substr(0, of_claim.table.rfind(".csv"));
      tables.add(name, tests::declared_table(name, all.at(name)));
    }
  }
  EXPECT_GT(exchanged, 40U);
}

/// Where solves fail, or end on another branch, a claim is judged by the others or not at all.
TEST(EveryPredicate, DiffersByNoFailureOfASolver) {
  const tests::TableRows all = tests::all_rows();
  ResultTables tables = tests::results_of(all);
  // A claim judges the tables that it reads; one that does not list them might read any.
  std::map<std::string, std::vector<ReadRows>> read;
  for (const JudgedClaim& claim : judge_claims(tables)) {
    // It is about failures.
    if (predicate_of(claim.id()) == "automatic_differentiation_more_robust") continue;
    if (claim.verdict != ClaimVerdict::differs) read[claim.id()] = claim.rows;
  }
  std::size_t failed = 0;
  for (const auto& [name, rows] : all) {
    for (const auto& [column, text] : {std::pair("status", "step failed"), std::pair("branch", "other")}) {
      if (std::ranges::count(tests::declared_columns(name), column) == 0) continue;
      for (const tests::Where& fails : groups_of(rows, {"method", "intervals", "derivatives", "tableau", "stages"})) {
        Rows doctored = rows;
        for (Row& row : doctored) {
          if (fails(row)) row.set(column, text);
        }
        tables.add(name, tests::declared_table(name, doctored));
        ++failed;
        const auto reads_it = [&](const std::string& id) {
          return read.contains(id) && (read[id].empty() || reads(read[id], name));
        };
        for (const JudgedClaim& claim : judge_claims(tables, reads_it)) {
          EXPECT_NE(claim.verdict, ClaimVerdict::differs)
              << name << ": " << text << ": " << claim.id() << ": " << claim.measured();
        }
      }
    }
    tables.add(name, tests::declared_table(name, rows));
  }
  EXPECT_GT(failed, 50U);
}

TEST(EveryPredicate, OfAClaimDrawsALineAndOfAFindingDoesNot) {
  for (const JudgedClaim& claim : judge_claims(tests::results_of(tests::all_rows()))) {
    if (claim.verdict == ClaimVerdict::not_judged) continue;
    EXPECT_EQ(claim.verdict == ClaimVerdict::measured, !claim.has_verdict) << claim.id();
    EXPECT_TRUE(claim.has_verdict || claim.whose != Whose::paper) << claim.id();
  }
}

}  // namespace
}  // namespace dmocbench
