#include "meniscus/linear/saddle_solver.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "meniscus/core/error.hpp"
#include "meniscus/linear/saddle_options.hpp"
#include "tests/linear/chain.hpp"

namespace meniscus::linear {
namespace {

struct Case {
  SaddleMethod method;
  bool is_closed;
};
void PrintTo(const Case& each, std::ostream* out) {
  *out << name(each.method) << (each.is_closed ? ", closed" : ", open");
}

class EveryMethod : public testing::TestWithParam<Case> {};

TEST_P(EveryMethod, FindsTheSolution) {
  const auto [method, is_closed] = GetParam();
  for (unsigned seed = 0; seed < 5; ++seed) {
    const Chain chain(20, is_closed);  // 80 unknowns: fewer than GMRES keeps before it restarts
    const std::vector<double> exact = random_solution(chain.system, seed);
    const std::vector<double> side = product(merged_system(chain.system, 1.0, 0.0).view(), exact);
    SaddleSolver solver(Communicator::self(), {.method = method, .petsc_options = {}});
    std::vector<double> u(exact.size(), 0.0);
    const LinearReport report = solver.solve(chain.system, side, u, 1e-12);
    ASSERT_TRUE(report.converged) << report.reason;
    // Tolerance times the condition of the chain, (2n/π)² · 6 ~ 1e3, with room for the pressures.
    EXPECT_LT(distance(u, exact), 1e-7) << name(method) << " seed " << seed;
    ASSERT_FALSE(report.residuals.empty());
    EXPECT_LE(report.residuals.back(), 1e-12 * report.residuals.front());
    // A second system of the same size with what was kept of the first.
    std::ranges::fill(u, 0.0);
    const Chain again(20, is_closed);
    const LinearReport kept = solver.solve(again.system, side, u, 1e-12, Preconditioner::kept);
    ASSERT_TRUE(kept.converged) << kept.reason;
    EXPECT_LT(distance(u, exact), 1e-7);
  }
}

INSTANTIATE_TEST_SUITE_P(
    OpenAndClosed, EveryMethod,
    testing::Values(Case{SaddleMethod::block, false}, Case{SaddleMethod::block, true},
                    Case{SaddleMethod::paper_gmres, false}, Case{SaddleMethod::paper_gmres, true},
                    Case{SaddleMethod::minres, false}, Case{SaddleMethod::minres, true},
                    Case{SaddleMethod::mumps, false}, Case{SaddleMethod::mumps, true}));

TEST(SaddleSolver, NoConvergenceIsReported) {
  const Chain chain(60, true);
  const std::vector<double> exact = random_solution(chain.system, 3);
  const std::vector<double> side = product(merged_system(chain.system, 1.0, 0.0).view(), exact);
  for (const SaddleMethod method :
       {SaddleMethod::block, SaddleMethod::paper_gmres, SaddleMethod::minres}) {
    SaddleSolver solver(Communicator::self(),
                        {.method = method, .max_iterations = 2, .petsc_options = {}});
    std::vector<double> u(exact.size(), 0.0);
    const LinearReport report = solver.solve(chain.system, side, u, 1e-14);
    EXPECT_FALSE(report.converged);
    EXPECT_EQ(report.reason, "DIVERGED_ITS");
    EXPECT_EQ(report.iterations, 2);
    EXPECT_EQ(report.residuals.size(), 3u);
  }
}

TEST(SaddleSolver, NotANumberIsReported) {
  const Chain chain(20, false);
  std::vector<double> side(std::size_t(chain.system.size()), 1.0);
  side[5] = std::nan("");
  for (const SaddleMethod method : {SaddleMethod::block, SaddleMethod::paper_gmres,
                                    SaddleMethod::minres, SaddleMethod::mumps}) {
    SaddleSolver solver(Communicator::self(), {.method = method, .petsc_options = {}});
    std::vector<double> u(side.size(), 0.0);
    const LinearReport report = solver.solve(chain.system, side, u, 1e-8);
    EXPECT_FALSE(report.converged) << name(method);
    EXPECT_FALSE(report.reason.empty());
  }
}

TEST(SaddleSolver, SingularSystemIsReportedByTheDirectMethod) {
  Chain chain(20, false);
  for (double& value : chain.A.values) value = 0.0;
  for (double& value : chain.B.values) value = 0.0;
  const std::vector<double> side(std::size_t(chain.system.size()), 1.0);
  SaddleSolver solver(Communicator::self(), {.method = SaddleMethod::mumps, .petsc_options = {}});
  std::vector<double> u(side.size(), 0.0);
  const LinearReport report = solver.solve(chain.system, side, u, 1e-8);
  EXPECT_FALSE(report.converged);
  EXPECT_FALSE(report.reason.empty());
}

// An operator without any entry: whatever a method makes of it, it says that it found nothing.
TEST(SaddleSolver, SingularBlockIsReported) {
  Chain chain(20, false);
  for (CsrMatrix* matrix : {&chain.A, &chain.B, &chain.C, &chain.laplacian})
    std::ranges::fill(matrix->values, 0.0);
  const std::vector<double> side(std::size_t(chain.system.size()), 1.0);
  for (const SaddleMethod method : {SaddleMethod::block, SaddleMethod::paper_gmres,
                                    SaddleMethod::minres, SaddleMethod::mumps}) {
    SaddleSolver solver(Communicator::self(), {.method = method, .petsc_options = {}});
    std::vector<double> u(side.size(), 0.0);
    const LinearReport report = solver.solve(chain.system, side, u, 1e-8);
    EXPECT_FALSE(report.converged) << name(method);
    EXPECT_FALSE(report.reason.empty()) << name(method);
  }
}

TEST(SaddleSolver, OptionsOverrideTheMethod) {
  const Chain chain(60, true);
  const std::vector<double> exact = random_solution(chain.system, 1);
  const std::vector<double> side = product(merged_system(chain.system, 1.0, 0.0).view(), exact);
  std::vector<double> u(exact.size(), 0.0);
  SaddleSolver limited(Communicator::self(), {.petsc_options = "-ksp_max_it 3"});
  EXPECT_EQ(limited.solve(chain.system, side, u, 1e-14).iterations, 3);
  std::ranges::fill(u, 0.0);
  SaddleSolver other(Communicator::self(), {.petsc_options = "-v_pc_type gamg"});
  EXPECT_TRUE(other.solve(chain.system, side, u, 1e-10).converged);
  EXPECT_LT(distance(u, exact), 1e-5);
}

TEST(SaddleSolver, OptionsThatPetscCannotReadAreRefused) {
  EXPECT_THROW(SaddleSolver(Communicator::self(), {.petsc_options = "ksp_type minres"}),
               InvalidInput);
}

TEST(SaddleSolver, PreparedIsKept) {
  const Chain chain(20, true);
  const std::vector<double> exact = random_solution(chain.system, 2);
  const std::vector<double> side = product(merged_system(chain.system, 1.0, 0.0).view(), exact);
  for (const SaddleMethod method : {SaddleMethod::block, SaddleMethod::mumps}) {
    const SaddleOptions options = {.method = method, .petsc_options = {}};
    SaddleSolver fresh(Communicator::self(), options), prepared(Communicator::self(), options);
    std::vector<double> a(exact.size(), 0.0), b(exact.size(), 0.0);
    const LinearReport first = fresh.solve(chain.system, side, a, 1e-8);
    prepared.prepare(chain.system);
    const LinearReport second = prepared.solve(chain.system, side, b, 1e-8, Preconditioner::kept);
    EXPECT_TRUE(first.converged && second.converged);
    EXPECT_EQ(a, b);  // bit for bit
  }
}

// What is kept belongs to the first system: the second, whose Laplacian is another, takes other
// iterations than with its own.
TEST(SaddleSolver, KeptIsNotMadeAnew) {
  const Chain first(60, true);
  Chain second(60, true);
  for (std::size_t i = 0; i < 60; ++i) second.A.values[i] *= 3.0;
  for (std::size_t k = 0; k < second.laplacian.values.size(); ++k)
    second.laplacian.values[k] *= k < 90 ? 3.0 : 1.0;
  const std::vector<double> exact = random_solution(first.system, 4);
  const std::vector<double> side = product(merged_system(second.system, 1.0, 0.0).view(), exact);
  SaddleSolver solver(Communicator::self(), {.petsc_options = {}});
  std::vector<double> kept(exact.size(), 0.0), fresh(exact.size(), 0.0);
  solver.prepare(first.system);
  EXPECT_TRUE(solver.solve(second.system, side, kept, 1e-10, Preconditioner::kept).converged);
  EXPECT_TRUE(solver.solve(second.system, side, fresh, 1e-10, Preconditioner::fresh).converged);
  EXPECT_NE(kept, fresh);
  EXPECT_LT(distance(kept, fresh), 1e-5);
}

// Where PETSc has no hypre nothing asks for it.
TEST(SaddleOptions, DoWithoutHypre) {
  for (const bool is_by_degree : {false, true}) {
    const std::string options = default_options(SaddleMethod::block, is_by_degree, false);
    EXPECT_EQ(options.find("hypre"), std::string::npos) << options;
    EXPECT_NE(options.find("pc_type gamg"), std::string::npos) << options;
  }
}

TEST(SaddleSystem, MergedMatrixHasSignAndPin) {
  const Chain chain(3, true);
  const CsrMatrix plus = merged_system(chain.system, 1.0, 0.0),
                  minus = merged_system(chain.system, -1.0, 7.0);
  std::vector<double> u(12, 0.0);
  u[9] = 1.0;  // the first pressure
  const auto column = product(plus.view(), u), flipped = product(minus.view(), u);
  EXPECT_DOUBLE_EQ(column[0], 0.5);  // Bᵀ
  EXPECT_DOUBLE_EQ(column[9], -0.1);
  EXPECT_DOUBLE_EQ(flipped[0], 0.5);
  EXPECT_DOUBLE_EQ(flipped[9], 0.1 + 7.0);
  EXPECT_DOUBLE_EQ(flipped[10], -0.1);
}

TEST(Communicator, OneProcessAlone) {
  EXPECT_EQ(Communicator::self().size(), 1);
  EXPECT_EQ(Communicator::world().rank(), 0);
}

}  // namespace
}  // namespace meniscus::linear
