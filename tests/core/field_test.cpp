#include "meniscus/core/field.hpp"

#include <memory>
#include <string>
#include <type_traits>
#include <unordered_set>

#include <gtest/gtest.h>

namespace meniscus {
namespace {

using AppleId = Id<struct AppleTag>;
using PearId = Id<struct PearTag>;

// What must not compile: one kind of id where another, or a number, is asked for.
static_assert(!std::is_convertible_v<AppleId, PearId>);
static_assert(!std::is_constructible_v<PearId, AppleId>);
static_assert(!std::is_convertible_v<int, AppleId>);
static_assert(!std::is_convertible_v<AppleId, int>);
template <class Fruit, class Key>
concept IndexedBy = requires(Fruit fruit, Key key) {
  fruit[key];
};
static_assert(IndexedBy<Field<AppleId, double>, AppleId>);
static_assert(!IndexedBy<Field<AppleId, double>, PearId>);
static_assert(!IndexedBy<Field<AppleId, double>, int>);
static_assert(sizeof(AppleId) == 4);

TEST(Id, IsInvalidUntilItNamesSomething) {
  EXPECT_FALSE(AppleId{}.is_valid());
  EXPECT_TRUE(AppleId{0}.is_valid());
  EXPECT_EQ(AppleId{}, AppleId{-1});
}

TEST(Id, IsOrderedAndHashedByItsValue) {
  EXPECT_LT(AppleId{2}, AppleId{3});
  EXPECT_LT(AppleId{}, AppleId{0});
  const std::unordered_set<AppleId> set = {AppleId{7}, AppleId{7}, AppleId{8}};
  EXPECT_EQ(set.size(), 2u);
  EXPECT_TRUE(set.contains(AppleId{8}));
  EXPECT_FALSE(set.contains(AppleId{9}));
}

TEST(Ids, CountFromZero) {
  std::int32_t expected = 0;
  for (const AppleId id : ids<AppleId>(4)) EXPECT_EQ(id, AppleId{expected++});
  EXPECT_EQ(expected, 4);
  for ([[maybe_unused]] const AppleId id : ids<AppleId>(0)) FAIL();
}

TEST(Field, StoresValuesInTheOrderOfTheIds) {
  Field<AppleId, double> weight(3, 0.5);
  weight[AppleId{1}] = 2.0;
  EXPECT_EQ(weight.size(), 3);
  EXPECT_EQ(std::vector<double>(weight.begin(), weight.end()),
            (std::vector<double>{0.5, 2.0, 0.5}));
  for (const AppleId a : weight.ids()) EXPECT_EQ(&weight[a], &weight.span()[std::size_t(a.value)]);
}

TEST(Field, OfASizeAloneHoldsDefaultValues) {
  const Field<AppleId, double> zero(3);
  EXPECT_EQ(zero, (Field<AppleId, double>(3, 0.0)));
  EXPECT_TRUE((Field<AppleId, double>().empty()));
  EXPECT_FALSE(zero.empty());
}

TEST(Field, NamesTheElementItAdds) {
  Field<AppleId, std::string> name;
  name.reserve(2);
  EXPECT_TRUE(name.empty());
  const AppleId first = name.add("first"), second = name.add("second");
  EXPECT_EQ(first, AppleId{0});
  EXPECT_EQ(second, AppleId{1});
  EXPECT_EQ(name[first], "first");
  EXPECT_EQ(name[second], "second");
}

TEST(Field, TakesValuesThatOnlyMove) {
  Field<AppleId, std::unique_ptr<int>> owner;
  const AppleId id = owner.add(std::make_unique<int>(5));
  EXPECT_EQ(*owner[id], 5);
}

TEST(Field, KeepsItsValuesWhenItGrows) {
  Field<AppleId, int> count(std::vector<int>{4, 5});
  count.resize(4);
  EXPECT_EQ(count, (Field<AppleId, int>(std::vector<int>{4, 5, 0, 0})));
  count.resize(1);
  EXPECT_EQ(count, (Field<AppleId, int>(std::vector<int>{4})));
}

TEST(Field, IsAValue) {
  Field<AppleId, int> a(2, 1);
  Field<AppleId, int> b = a;
  EXPECT_EQ(a, b);
  b.span()[1] = 3;
  EXPECT_EQ(a[AppleId{1}], 1);
  EXPECT_NE(a, b);
  b.resize(1);
  EXPECT_NE(a, b);
}

}  // namespace
}  // namespace meniscus
