// Run under mpirun too, on two and three ranks (tests/CMakeLists.txt): every rank does every test.
#include <cstdlib>

#include <gtest/gtest.h>

#include "meniscus/linear/collective.hpp"
#include "meniscus/linear/ghost_values.hpp"
#include "meniscus/linear/graph_partition.hpp"
#include "meniscus/linear/saddle_solver.hpp"
#include "tests/linear/chain.hpp"

namespace meniscus::linear {
namespace {

Communicator world() { return Communicator::world(); }

TEST(RanksStart, LeavesNoSettingOfOneProcessInTheEnvironment) {
  (void)world();
  EXPECT_EQ(std::getenv("OMPI_MCA_ess_singleton_isolated"), nullptr);
}

/// The nodes of a chain that a rank has: as even as they can be.
struct Stretch {
  std::int32_t first, end;
  Stretch(std::int32_t n, int rank)
      : first(n * rank / world().size()), end(n * (rank + 1) / world().size()) {}
  [[nodiscard]] std::int32_t size() const { return end - first; }
};

/// Rows [first, end) of a matrix, own columns, which are [first_column, end_column), first.
CsrMatrix rows(const CsrView& matrix, const Stretch& stretch, int rows_per_node,
               int columns_per_node) {
  CsrMatrix part;
  part.num_columns = columns_per_node * stretch.size();
  part.row_start.push_back(0);
  const auto is_own = [&](std::int32_t j) {
    return j >= columns_per_node * stretch.first && j < columns_per_node * stretch.end;
  };
  for (std::int32_t i = rows_per_node * stretch.first; i < rows_per_node * stretch.end; ++i) {
    for (const bool own : {true, false})
      for (auto k = matrix.row_start[std::size_t(i)]; k < matrix.row_start[std::size_t(i) + 1]; ++k)
        if (is_own(matrix.columns[std::size_t(k)]) == own) {
          part.columns.push_back(matrix.columns[std::size_t(k)]);
          part.values.push_back(matrix.values[std::size_t(k)]);
        }
    part.row_start.push_back(static_cast<std::int32_t>(part.columns.size()));
  }
  return part;
}

/// A rank's part of a chain.
struct SharedChain {
  Chain whole;
  Stretch stretch;
  CsrMatrix A, B, C, laplacian;
  SaddleSystem system;

  SharedChain(std::int32_t n, bool is_closed)
      : whole(n, is_closed),
        stretch(n, world().rank()),
        A(rows(whole.A.view(), stretch, 3, 3)),
        B(rows(whole.B.view(), stretch, 1, 3)),
        C(rows(whole.C.view(), stretch, 1, 1)),
        laplacian(rows(whole.laplacian.view(), stretch, 1, 1)),
        system{A.view(),  B.view(),
               C.view(),  {laplacian.view()},
               {0, 0, 0}, std::span(whole.mass).first(std::size_t(stretch.size())),
               is_closed} {}

  /// This rank's unknowns of those of the whole.
  [[nodiscard]] std::vector<double> own(std::span<const double> all) const {
    const auto part = [&](std::size_t start, std::int32_t first, std::int32_t count) {
      return all.subspan(start + std::size_t(first), std::size_t(count));
    };
    const auto v = part(0, 3 * stretch.first, 3 * stretch.size());
    const auto p = part(whole.A.row_start.size() - 1, stretch.first, stretch.size());
    std::vector<double> result(v.begin(), v.end());
    result.insert(result.end(), p.begin(), p.end());
    return result;
  }
};

class RanksByMethod : public testing::TestWithParam<SaddleMethod> {};
INSTANTIATE_TEST_SUITE_P(EveryOne, RanksByMethod,
                         testing::Values(SaddleMethod::block, SaddleMethod::paper_gmres,
                                         SaddleMethod::minres, SaddleMethod::mumps));

TEST_P(RanksByMethod, FindTheSolution) {
  for (const bool is_closed : {false, true}) {
    const SharedChain chain(20, is_closed);
    for (unsigned seed = 0; seed < 3; ++seed) {
      const std::vector<double> exact = random_solution(chain.whole.system, seed);
      const std::vector<double> side =
          product(merged_system(chain.whole.system, 1.0, 0.0).view(), exact);
      SaddleSolver solver(world(), {.method = GetParam(), .petsc_options = {}});
      std::vector<double> u(std::size_t(chain.system.size()), 0.0);
      LinearReport report = solver.solve(chain.system, chain.own(side), u, 1e-12);
      ASSERT_TRUE(report.converged) << report.reason;
      // As on one process (saddle_solver_test.cpp).
      EXPECT_LT(distance(u, chain.own(exact)), 1e-7) << name(GetParam()) << " seed " << seed;
      std::ranges::fill(u, 0.0);
      report = solver.solve(chain.system, chain.own(side), u, 1e-12, Preconditioner::kept);
      ASSERT_TRUE(report.converged) << report.reason;
      EXPECT_LT(distance(u, chain.own(exact)), 1e-7);
    }
  }
}

TEST(Ranks, ReportASingularSystemTogether) {
  SharedChain chain(20, false);
  for (double& value : chain.A.values) value = 0.0;
  for (double& value : chain.B.values) value = 0.0;
  const std::vector<double> side(std::size_t(chain.system.size()), 1.0);
  SaddleSolver solver(world(), {.method = SaddleMethod::mumps, .petsc_options = {}});
  std::vector<double> u(side.size(), 0.0);
  const LinearReport report = solver.solve(chain.system, side, u, 1e-8);
  EXPECT_FALSE(report.converged);
  EXPECT_FALSE(report.reason.empty());
}

TEST(Ranks, ReportNotANumberTogether) {
  const SharedChain chain(20, false);
  std::vector<double> side(std::size_t(chain.system.size()), 1.0);
  if (world().rank() == 0) side[5] = std::nan("");
  for (const SaddleMethod method : {SaddleMethod::block, SaddleMethod::paper_gmres,
                                    SaddleMethod::minres, SaddleMethod::mumps}) {
    SaddleSolver solver(world(), {.method = method, .petsc_options = {}});
    std::vector<double> u(side.size(), 0.0);
    const LinearReport report = solver.solve(chain.system, side, u, 1e-8);
    EXPECT_FALSE(report.converged) << name(method);
    EXPECT_FALSE(report.reason.empty());
  }
}

TEST(Ranks, ActTogether) {
  const int rank = world().rank(), size = world().size();
  EXPECT_EQ(sum(world(), 1.0 + rank), 0.5 * size * (size + 1));
  EXPECT_EQ(sum(world(), std::int64_t{1} << 40), std::int64_t{size} << 40);
  EXPECT_DOUBLE_EQ(norm(world(), 3.0), 3.0 * std::sqrt(size));
  EXPECT_TRUE(any(world(), rank == size - 1));
  EXPECT_FALSE(any(world(), false));
  EXPECT_TRUE(agree(world(), 77));
  EXPECT_EQ(agree(world(), std::uint64_t(rank)), size == 1);
  std::string text = rank == 0 ? "what rank 0 says" : "";
  broadcast(world(), text);
  EXPECT_EQ(text, "what rank 0 says");
  std::vector<std::int32_t> numbers = {rank, rank + 1};
  broadcast(world(), numbers);
  EXPECT_EQ(numbers, (std::vector<std::int32_t>{0, 1}));
  EXPECT_TRUE(all_arrive(world(), std::chrono::seconds(60)));
  EXPECT_TRUE(all_arrive(world(), std::chrono::seconds(60)));
}

TEST(Ranks, GatherPartsOfUnequalLength) {
  const int rank = world().rank(), size = world().size();
  std::vector<std::int32_t> counts;
  std::vector<double> expected;
  for (int r = 0; r < size; ++r) {
    counts.push_back(r + 1);
    expected.insert(expected.end(), std::size_t(r) + 1, 10.0 * r);
  }
  const std::vector<double> own(std::size_t(rank) + 1, 10.0 * rank);
  std::vector<double> all(expected.size());
  gather(world(), own, counts, all);
  EXPECT_EQ(all, expected);
}

/// A square grid, each vertex with its neighbours.
WeightedGraph grid(int n) {
  WeightedGraph graph;
  graph.row_start.push_back(0);
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      for (const auto& [di, dj] : {std::pair(-1, 0), {0, -1}, {0, 1}, {1, 0}})
        if (i + di >= 0 && i + di < n && j + dj >= 0 && j + dj < n) {
          graph.neighbours.push_back(n * (i + di) + j + dj);
          graph.edge_weights.push_back(1);
        }
      graph.row_start.push_back(static_cast<std::int32_t>(graph.neighbours.size()));
      graph.vertex_weights.push_back(1);
    }
  return graph;
}

TEST(GraphPartition, PartsAreEvenAndFewEdgesAreCut) {
  const WeightedGraph graph = grid(30);
  for (const Partitioner partitioner : {best_partitioner(), Partitioner::even})
    for (const int num_parts : {2, 3, 7}) {
      const std::vector<std::int32_t> part = partition(graph, num_parts, partitioner);
      ASSERT_EQ(part.size(), 900u);
      for (int p = 0; p < num_parts; ++p)
        EXPECT_NEAR(double(std::ranges::count(part, p)), 900.0 / num_parts, 900.0 * 0.03);
      int cut = 0;
      for (std::size_t i = 0; i < part.size(); ++i)
        for (auto k = graph.row_start[i]; k < graph.row_start[i + 1]; ++k)
          cut += part[i] != part[std::size_t(graph.neighbours[std::size_t(k)])];
      // A straight cut takes 30 edges, counted from both sides; seven parts, six cuts at most.
      if (partitioner == Partitioner::ptscotch) {
        EXPECT_LT(cut, 2 * 45 * (num_parts - 1));
      }
    }
}

TEST(GraphPartition, IsTheSameAgain) {
  const WeightedGraph graph = grid(40);
  const std::vector<std::int32_t> first = partition(graph, 3);
  (void)partition(grid(17), 2);  // random numbers have been drawn
  EXPECT_EQ(partition(graph, 3), first);
}

TEST(GraphPartition, HeavyVerticesHaveFewerCompanions) {
  WeightedGraph graph = grid(20);
  graph.vertex_weights[0] = 100;  // of 499
  const std::vector<std::int32_t> part = partition(graph, 2);
  if (best_partitioner() == Partitioner::ptscotch) {
    EXPECT_NEAR(double(std::ranges::count(part, part[0])), 150.0, 25.0);
  }
}

/// Each rank owns two items more than the one before it, and wants the last of every other one.
struct WantedOfOthers {
  static std::int32_t number_owned(int rank) { return 1 + 2 * rank; }
  WantedOfOthers() {
    std::int32_t end = 0;
    for (int rank = 0; rank < world().size(); ++rank) {
      if (rank == world().rank()) first = end;
      end += number_owned(rank);
      if (rank != world().rank()) wanted.insert(wanted.begin(), end - 1);
    }
  }
  std::vector<std::int32_t> wanted;
  std::int32_t first = 0;  // of this rank
};

TEST(Ranks, FetchWhatOthersOwn) {
  const WantedOfOthers of_others;
  const auto& [wanted, first] = of_others;
  const auto number_owned = WantedOfOthers::number_owned;
  const GhostValues ghosts(world(), number_owned(world().rank()), wanted, 2);
  for (const double sign : {1.0, -1.0}) {
    std::vector<double> owned, found(2 * wanted.size());
    for (std::int32_t i = 0; i < number_owned(world().rank()); ++i)
      for (const double part : {0.25, 0.5}) owned.push_back(sign * (first + i + part));
    ghosts.fetch(owned, found);
    for (std::size_t k = 0; k < wanted.size(); ++k) {
      EXPECT_EQ(found[2 * k], sign * (wanted[k] + 0.25));
      EXPECT_EQ(found[2 * k + 1], sign * (wanted[k] + 0.5));
    }
  }
}

// The last item gets a number from every other rank, the others keep what they have.
TEST(Ranks, GiveToThoseThatOwn) {
  const WantedOfOthers of_others;
  const std::int32_t num_owned = WantedOfOthers::number_owned(world().rank());
  const GhostValues ghosts(world(), num_owned, of_others.wanted, 2);
  std::vector<double> given, owned(2 * static_cast<std::size_t>(num_owned), 0.125);
  for (const std::int32_t number : of_others.wanted) {
    given.push_back(1.0 + number);
    given.push_back(-2.0 - number);
  }
  ghosts.give(given, owned);
  const double others = world().size() - 1.0, last = of_others.first + num_owned - 1.0;
  EXPECT_EQ(owned[owned.size() - 2], 0.125 + others * (1.0 + last));
  EXPECT_EQ(owned.back(), 0.125 - others * (2.0 + last));
  for (std::size_t i = 0; i + 2 < owned.size(); ++i) EXPECT_EQ(owned[i], 0.125) << i;
}

}  // namespace
}  // namespace meniscus::linear
