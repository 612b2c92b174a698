// Run under mpirun too, on two and three ranks (tests/CMakeLists.txt): every rank does every test.
#include "meniscus/linear/shared_work.hpp"

#include <bit>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "meniscus/core/error.hpp"
#include "meniscus/linear/collective.hpp"

namespace meniscus::linear {
namespace {

Communicator world() { return Communicator::world(); }

TEST(SharedWork, GoesToTheRankWithLeastToDo) {
  EXPECT_EQ(ranks_for(std::vector<double>{3, 10, 4, 4, 2}, 2), (std::vector<int>{1, 0, 1, 1, 0}));
  EXPECT_EQ(ranks_for(std::vector<double>{1, 1, 1}, 3), (std::vector<int>{0, 1, 2}));
  EXPECT_EQ(ranks_for(std::vector<double>{1, 1}, 1), (std::vector<int>{0, 0}));
  EXPECT_TRUE(ranks_for({}, 2).empty());
}

Archive piece(std::size_t k) {
  Archive archive;
  archive.reals["a/x"] = {0.1 * double(k),
                          -0.0,
                          1.0 / 3.0,
                          1e-310,
                          std::numeric_limits<double>::quiet_NaN(),
                          -std::numeric_limits<double>::infinity()};
  archive.reals["a/none"] = {};
  archive.integers["b"] = {std::numeric_limits<std::int64_t>::min(), std::int64_t(k), 1LL << 53};
  archive.texts["c"] = "σ = " + std::to_string(k);
  return archive;
}

std::vector<std::uint64_t> bits(const std::vector<double>& numbers) {
  std::vector<std::uint64_t> all;
  for (const double x : numbers) all.push_back(std::bit_cast<std::uint64_t>(x));
  return all;
}

void expect_equal(const Archive& a, const Archive& b) {
  EXPECT_EQ(a.integers, b.integers);
  EXPECT_EQ(a.texts, b.texts);
  ASSERT_EQ(a.reals.size(), b.reals.size());
  for (const auto& [name, values] : a.reals) EXPECT_EQ(bits(values), bits(b.reals.at(name)));
}

TEST(RanksShareWork, NumbersAreFoundOnceAndReachAllInOrder) {
  for (const std::size_t count : {0, 1, 2, 7, 100}) {
    std::vector<double> calls(count, 0.0);
    const std::vector<double> found =
        shared_numbers(world(), count, 2, [&](std::size_t first, std::size_t end) {
          std::vector<double> values;
          for (std::size_t k = first; k < end; ++k) {
            calls[k] += 1.0;
            values.push_back(std::sqrt(double(k)));
            values.push_back(-1.0 / double(k + 1));
          }
          return values;
        });
    ASSERT_EQ(found.size(), 2 * count);
    for (std::size_t k = 0; k < count; ++k) {
      EXPECT_EQ(found[2 * k], std::sqrt(double(k)));
      EXPECT_EQ(found[2 * k + 1], -1.0 / double(k + 1));
    }
    sum(world(), calls);
    EXPECT_EQ(calls, std::vector<double>(count, 1.0));
  }
}

TEST(RanksShareWork, EveryPieceIsMadeOnceAndReachesAllBitForBit) {
  const std::vector<double> work = {1, 7, 3, 3, 2, 9, 1};
  std::vector<int> made(work.size(), 0), taken(work.size(), 0);
  share_work(
      world(), work,
      [&](std::size_t k, Archive& archive) {
        archive = piece(k);
        ++made[k];
      },
      [&](std::size_t k, const Archive& archive) {
        expect_equal(archive, piece(k));
        ++taken[k];
      });
  const std::vector<int> owner = ranks_for(work, world().size());
  for (std::size_t k = 0; k < work.size(); ++k) {
    EXPECT_EQ(made[k], owner[k] == world().rank() ? 1 : 0) << k;
    EXPECT_EQ(made[k] + taken[k], 1) << k;
  }
}

TEST(RanksShareWork, WrongInputStaysWrongInput) {
  const std::vector<double> work = {2, 1};
  const auto make = [](std::size_t k, Archive&) {
    if (k == 1) throw InvalidInput("piece 1 is wrong");
  };
  EXPECT_THROW(share_work(world(), work, make, [](std::size_t, const Archive&) {}), InvalidInput);
}

TEST(RanksShareWork, WhatOneThrowsAllThrow) {
  const std::vector<double> work = {2, 1};
  const auto make = [](std::size_t k, Archive&) {
    if (k == 1) throw std::length_error("piece 1 is too long");
  };
  try {
    share_work(world(), work, make, [](std::size_t, const Archive&) {});
    ADD_FAILURE() << "nothing was thrown";
  } catch (const std::exception& error) {
    EXPECT_STREQ(error.what(), "piece 1 is too long");
  }
}

}  // namespace
}  // namespace meniscus::linear
