#include "methods/transcription/elements/families.hpp"

#include <set>

#include <gtest/gtest.h>

#include "tests/support/sentence_of_error.hpp"

namespace dmocbench {
namespace {

TEST(Families, HaveNamesLabelsAndStylesOfTheirOwn) {
  std::set<std::string_view> names;
  std::set<std::string_view> labels;
  std::set<int> styles;
  for (const Family& family : registered_families()) {
    EXPECT_TRUE(names.insert(family.name).second) << family.name;
    EXPECT_TRUE(labels.insert(family.label).second) << family.label;
    EXPECT_TRUE(styles.insert(family.style).second) << family.style;
    EXPECT_GE(family.style, 1) << family.name;
    EXPECT_LE(family.style, 7) << family.name << ": plots/style.gp defines no more";
  }
}

TEST(Families, OfThePaperAreThreeAndMethodsThemselves) {
  EXPECT_EQ(paper_families(), (std::vector<std::string>{"dmoc", "hamiltonian", "tangent"}));
  for (const std::string& name : paper_families()) EXPECT_EQ(make_element(name)->name(), name);
}

TEST(Families, MethodsHaveTheNamesOfTheirElementsAndBelongToAFamily) {
  std::set<std::string_view> seen;
  for (const std::string& method : all_methods()) {
    EXPECT_EQ(make_element(method)->name(), method);
    EXPECT_FALSE(make_element(method)->description().empty());
    seen.insert(family_of(method).name);
  }
  EXPECT_EQ(seen.size(), registered_families().size());
}

TEST(Families, UnknownMethodsListTheKnownOnes) {
  for (const char* unknown : {"", "simpson", "dmo", "dmoc_rk4_1", "multiple_shooting"}) {
    for (const std::string& method : all_methods()) {
      tests::expect_error_naming({unknown, method}, [&] { static_cast<void>(make_element(unknown)); });
    }
  }
}

TEST(Families, TellWhatAnIntegrationLacks) {
  const auto refuses = [](const char* method, const char* because) {
    tests::expect_error_naming({because}, [&] { static_cast<void>(make_element(method)); });
  };
  refuses("multiple_shooting_", "multiple_shooting__1");
  refuses("multiple_shooting_rk4", "multiple_shooting_rk4_1");
  refuses("single_shooting_rk5_1", "rk5");
  refuses("single_shooting_rk4_0", "substeps");
}

}  // namespace
}  // namespace dmocbench
