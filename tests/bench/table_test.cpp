#include "methods/tables/table.hpp"

#include <cmath>
#include <limits>
#include <numbers>

#include <gtest/gtest.h>

#include "tests/support/sentence_of_error.hpp"

namespace dmocbench {
namespace {

using tests::expect_error_naming;

Table one_row(const std::vector<std::string>& columns, const std::vector<std::string>& fields) {
  Table table(columns);
  Row row;
  for (std::size_t i = 0; i < columns.size(); ++i) row.set(columns[i], Cell(fields[i]));
  table.append(row);
  return table;
}

TEST(Table, TextsComeBackWhateverTheyContain) {
  const std::vector<std::string> columns{"plain", "comma", "quote", "line", "carriage return", "all", "space"};
  const std::vector<std::string> fields{"plain", "a,b", "say \"h\"", "two\nlines", "a\r\nb", "\",\n\"", "  "};
  const Table table = Table::from_csv(one_row(columns, fields).csv());
  ASSERT_EQ(table.columns(), columns);
  ASSERT_EQ(table.rows().size(), 1U);
  for (std::size_t i = 0; i < columns.size(); ++i) EXPECT_EQ(table.rows()[0].text(columns[i]), fields[i]);
}

TEST(Table, ColumnNamesComeBackWhateverTheyContain) {
  const std::vector<std::string> columns{"t_[h]", "a,b", "\"q\""};
  EXPECT_EQ(Table::from_csv(Table(columns).csv()).columns(), columns);
}

TEST(Table, NumbersComeBackToTheLastBit) {
  using Limits = std::numeric_limits<double>;
  for (const double value : {0.1, 1.0 / 3.0, std::numbers::pi, -0.0, Limits::max(), Limits::min(), Limits::denorm_min(),
                             1.0 + Limits::epsilon(), 3.9449100000000003e-05}) {
    Table table({"x"});
    Row row;
    row.set("x", value);
    table.append(row);
    const Table back = Table::from_csv(table.csv());
    const auto number = back.rows()[0].number("x");
    ASSERT_TRUE(number) << value;
    EXPECT_EQ(*number, value);
    EXPECT_EQ(std::signbit(*number), std::signbit(value));
  }
}

TEST(Table, LargeWholeNumbersKeepAllDigits) {
  Row row;
  row.set("n", std::numeric_limits<long long>::max());
  EXPECT_EQ(row.text("n"), "9223372036854775807");
}

TEST(Table, WhatDoesNotExistIsAnEmptyField) {
  Table table({"a", "b", "c"});
  Row row;
  row.set("b", 1LL);
  row.set("c", std::optional<int>());
  table.append(row);
  EXPECT_EQ(table.csv(), "a,b,c\n,1,\n");
  const Table back = Table::from_csv(table.csv());
  EXPECT_EQ(back.rows()[0].text("a"), "");
  EXPECT_FALSE(back.rows()[0].number("a"));
  EXPECT_FALSE(back.rows()[0].number("no such column"));
  EXPECT_EQ(back.rows()[0].number("b"), 1.0);
}

TEST(Table, ATextThatBeginsLikeANumberIsNone) {
  Row row;
  for (const char* text : {"1 km", "12x", "", " 1", "1,5", "one"}) {
    row.set("x", text);
    EXPECT_FALSE(row.number("x")) << text;
  }
}

TEST(Table, WhatIsNotFiniteIsNoNumberAndIsNamedWhereOneIsNeeded) {
  for (const char* text : {"nan", "-nan", "inf", "-inf", "infinity", "1e999", "much"}) {
    Table table = one_row({"x"}, {text});
    table.name_places("t.csv");
    EXPECT_FALSE(table.rows()[0].number("x")) << text;
    expect_error_naming({"t.csv, record 2", "column x", text}, [&] { static_cast<void>(table.rows()[0].needed("x")); });
  }
  expect_error_naming({"column y", "no number"}, [] { static_cast<void>(Row().needed("y")); });
}

TEST(Table, ReadsLinesThatEndAsOnWindowsAndALastLineWithoutEnd) {
  const Table table = Table::from_csv("a,b\r\n1,2\r\n3,4");
  ASSERT_EQ(table.rows().size(), 2U);
  EXPECT_EQ(table.columns()[1], "b");
  EXPECT_EQ(table.rows()[0].number("b"), 2.0);
  EXPECT_EQ(table.rows()[1].number("b"), 4.0);
}

TEST(Table, RefusesARecordOfAnotherLengthAndNamesIt) {
  expect_error_naming({"record 3", "1", "2"}, [] { static_cast<void>(Table::from_csv("a,b\n1,2\n3\n")); });
  expect_error_naming({"record 2", "3", "2"}, [] { static_cast<void>(Table::from_csv("a,b\n1,2,3\n")); });
}

}  // namespace
}  // namespace dmocbench
