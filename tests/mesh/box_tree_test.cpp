#include "meniscus/mesh/box_tree.hpp"

#include <algorithm>
#include <limits>
#include <random>

#include <gtest/gtest.h>

namespace meniscus {
namespace {

Vec3 random_vector(std::mt19937& random, double low, double high) {
  std::uniform_real_distribution<double> coordinate(low, high);
  const double x = coordinate(random), y = coordinate(random);
  return {x, y, coordinate(random)};
}

std::vector<Box> random_boxes(int count, std::mt19937& random) {
  std::vector<Box> boxes;
  for (int i = 0; i < count; ++i) {
    const Vec3 low = random_vector(random, -5.0, 5.0);
    boxes.emplace_back(low, low + random_vector(random, 0.0, 2.0));
  }
  return boxes;
}

TEST(BoxTree, FindsWhatASearchOfAllBoxesFinds) {
  for (const unsigned seed : {1U, 2U, 3U})
    for (const int count : {0, 1, 2, 3, 5, 60}) {
      std::mt19937 random(seed);
      const std::vector<Box> boxes = random_boxes(count, random);
      const BoxTree tree(boxes);
      const Vec3 x = random_vector(random, -6.0, 6.0);
      for (const double reach : {0.0, 1.0, 4.0}) {
        std::vector<std::size_t> found, wanted;
        tree.visit_within(Box(x), reach, [&](std::size_t i) { found.push_back(i); });
        for (std::size_t i = 0; i < boxes.size(); ++i)
          if (boxes[i].exteriorDistance(x) <= reach) wanted.push_back(i);
        std::ranges::sort(found);
        EXPECT_EQ(found, wanted) << count << " boxes, reach " << reach << ", seed " << seed;
      }
      const auto value = [&](std::size_t i) { return (boxes[i].center() - x).norm(); };
      double least = std::numeric_limits<double>::max();
      for (std::size_t i = 0; i < boxes.size(); ++i) least = std::min(least, value(i));
      EXPECT_EQ(tree.least(
                    x, [](double distance) { return distance; }, value),
                least)
          << count << " boxes, seed " << seed;
    }
}

TEST(BoxTree, NamesTheBoxesBeforeOneThatAreNear) {
  std::vector<Box> boxes;
  for (const double x : {3.0, 0.0, 10.0, 1.5}) boxes.emplace_back(Vec3(x, 0, 0), Vec3(x + 1, 1, 1));
  const BoxTree tree(boxes);
  EXPECT_EQ(tree.earlier_within(3, 0.5), (std::vector<std::size_t>{0, 1}));
  EXPECT_EQ(tree.earlier_within(3, 0.49), std::vector<std::size_t>{});
  EXPECT_EQ(tree.earlier_within(1, 2.0), std::vector<std::size_t>{0});
}

// Few of a thousand boxes that lie apart can hold the least distance.
TEST(BoxTree, AsksFewBoxes) {
  std::vector<Box> boxes;
  for (int i = 0; i < 1000; ++i) {
    const Vec3 low(2.0 * (i % 10), 2.0 * (i / 10 % 10), 2.0 * (i / 100));
    boxes.emplace_back(low, low + Vec3::Ones());
  }
  const BoxTree tree(boxes);
  int asked = 0;
  const Vec3 x(9.4, 9.4, 9.4);
  static_cast<void>(tree.least(
      x, [](double distance) { return distance; },
      [&](std::size_t i) {
        ++asked;
        return boxes[i].exteriorDistance(x);
      }));
  EXPECT_LE(asked, 8);
}

}  // namespace
}  // namespace meniscus
