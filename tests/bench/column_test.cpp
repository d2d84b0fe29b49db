#include "bench/run/column.hpp"

#include <memory>

#include <gtest/gtest.h>

#include "bench/run/solve_case.hpp"

namespace dmocbench {
namespace {

struct Wheel {
  double radius = 0.0;
  std::optional<int> spokes;
  [[nodiscard]] double diameter() const { return 2.0 * radius; }
};

struct Cart {
  std::string name;
  Wheel front;
  std::optional<Wheel> spare;
  std::shared_ptr<Wheel> drawn;
};

const Columns<Cart> columns{
    {"name", "", "what it is called", &Cart::name},
    {"radius", "m", "of the front wheel", from(&Cart::front, &Wheel::radius)},
    {"diameter", "m", "of the front wheel", from(&Cart::front, &Wheel::diameter)},
    {"spokes", "", "of the front wheel", from(&Cart::front, &Wheel::spokes)},
    {"spare", "m", "radius of the spare wheel", from(&Cart::spare, &Wheel::radius)},
    {"drawn", "m", "radius of the drawn wheel", from(&Cart::drawn, &Wheel::radius)},
};

TEST(Column, HeaderAndFieldsComeFromOneDeclaration) {
  const Cart cart{.name = "a, b", .front = {0.5, 12}, .spare = Wheel{.radius = 0.25, .spokes = {}}, .drawn = {}};
  EXPECT_EQ(table_of(columns, {cart}).csv(), "name,radius,diameter,spokes,spare,drawn\n\"a, b\",0.5,1,12,0.25,\n");
}

TEST(Column, OfNothingIsAnEmptyField) { EXPECT_EQ(row_of(columns, Cart{}).csv(names_of(columns)), ",0,0,,,\n"); }

TEST(Column, ReadsPartsOfARecord) {
  const Columns<Wheel> of_wheel{{"radius", "m", "of a wheel", &Wheel::radius}};
  const Columns<Cart> of_cart = columns_through<Cart>(&Cart::front, of_wheel);
  EXPECT_EQ(row_of(of_cart, Cart{.name = {}, .front = {2.0, {}}, .spare = {}, .drawn = {}}).text("radius"), "2");
  EXPECT_EQ(describe(of_cart), describe(of_wheel));
  EXPECT_EQ(of_cart.front().cell.type().kind, FieldKind::number);
}

TEST(Column, KnowsWhatItHoldsByTheTypeThatItsGetterReturns) {
  const Columns<Cart> further =
      columns + Columns<Cart>{{"is_named", "", "", [](const Cart& cart) { return !cart.name.empty(); }},
                              {"letters", "", "", [](const Cart& cart) { return cart.name.size(); }},
                              {"anything", "", "", [](const Cart&) { return Cell("12"); }}};
  const std::map<std::string, ColumnFacts> facts = table_of(further, std::vector<Cart>{}).facts();
  const auto is = [&](const std::string& column, FieldKind kind, bool may_be_empty) {
    const FieldType& type = facts.at(column).type;
    return type.kind == kind && type.may_be_empty == may_be_empty;
  };
  EXPECT_TRUE(is("name", FieldKind::text, true));
  EXPECT_TRUE(is("radius", FieldKind::number, true));
  EXPECT_TRUE(is("diameter", FieldKind::number, true));
  EXPECT_TRUE(is("spokes", FieldKind::integer, true));
  EXPECT_TRUE(is("spare", FieldKind::number, true));
  EXPECT_TRUE(is("drawn", FieldKind::number, true));
  EXPECT_TRUE(is("is_named", FieldKind::boolean, false));
  EXPECT_TRUE(is("letters", FieldKind::integer, false));
  EXPECT_FALSE(facts.contains("anything"));
}

TEST(Column, IsPartOfTheKeyOfItsTable) {
  const Columns<Cart> carts{{"name", "", "", &Cart::name, in_key},
                            {"diameter", "m", "", from(&Cart::front, &Wheel::diameter)},
                            {"spokes", "", "", from(&Cart::front, &Wheel::spokes), in_key}};
  EXPECT_EQ(table_of(carts, std::vector<Cart>{}).key(), (std::vector<std::string>{"name", "spokes"}));
}

TEST(Column, OfAGroupHasTheFieldOfItsPlace) {
  const auto letter = [](std::size_t i) { return [i](const Cart& cart) { return cart.name.substr(i, 1); }; };
  const auto letters = column_group<Cart>({"first", "second"}, "", "a letter of its name", letter);
  EXPECT_EQ(row_of(letters, Cart{"ox", {}, {}, {}}).csv(names_of(letters)), "o,x\n");
}

TEST(Column, IsDescribedWithItsUnit) {
  const std::string text = describe(columns);
  EXPECT_NE(text.find("  name: what it is called\n"), std::string::npos) << text;
  EXPECT_NE(text.find("  radius [m]: of the front wheel\n"), std::string::npos) << text;
}

TEST(CoreColumns, EachSaysWhatItMeans) {
  for (const auto& column : core_columns()) EXPECT_FALSE(column.meaning.empty()) << column.name;
}

}  // namespace
}  // namespace dmocbench
