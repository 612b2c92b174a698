#include <cmath>

#include <gtest/gtest.h>

#include "meniscus/flow/fem/stokes_solver.hpp"
#include "meniscus/linear/saddle_options.hpp"
#include "tests/flow/fem/straight_space.hpp"
#include "tests/flow/fem/stretched_drop.hpp"

namespace meniscus::fem {
namespace {

/// Meshes of a few thousand nodes that carry unknowns; larger ones are the benchmark's
/// (docs/benchmark-stokes.md), whose counts differ from these by a few.
struct Case {
  DropShape shape;
  Elements elements;
  int N0;
};
void PrintTo(const Case& each, std::ostream* out) {
  *out << (each.elements == Elements::p1_p1 ? "P1-P1" : "P2-P1") << " shape "
       << static_cast<int>(each.shape);
}

class LinearIterations : public testing::TestWithParam<Case> {
 protected:
  LinearIterations() : scene_(stretched_drop(GetParam().shape, GetParam().N0, 1.0)) {
    EXPECT_TRUE(tetrahedralize(scene_, suited_volume_mesh(GetParam().elements), mesh_).ok());
    space_ = flow_space(mesh_, GetParam().elements);
    problem_.emplace(instant(scene_, mesh_, space_));
  }
  /// From rest to the tolerance, with the viscosity ratio.
  StokesReport solved(double lambda, Options options) {
    for (const CellId c : mesh_.cells.ids())
      problem_->viscosity[c] = mesh_.region[c] == RegionId{0} ? 1.0 : lambda;
    StokesSolver solver(space_, with(GetParam().elements, std::move(options)));
    StokesState state = solver.state_at_rest();
    PhaseTimes times;
    return solver.solve(*problem_, state, linear::Preconditioner::fresh, times);
  }
  static bool is_quadratic() { return GetParam().elements == Elements::p2_p1; }

 private:
  Scene scene_;
  TetMesh mesh_;
  FlowSpace space_;
  std::optional<StokesProblem> problem_;
};

INSTANTIATE_TEST_SUITE_P(Shapes, LinearIterations,
                         testing::Values(Case{DropShape::sphere, Elements::p1_p1, 300},
                                         Case{DropShape::prolate, Elements::p1_p1, 200},
                                         Case{DropShape::dumbbell, Elements::p1_p1, 160},
                                         Case{DropShape::sphere, Elements::p2_p1, 60},
                                         Case{DropShape::prolate, Elements::p2_p1, 42},
                                         Case{DropShape::dumbbell, Elements::p2_p1, 42}));

// What the block solver promises: 30 iterations with linear and 40 with quadratic velocities while
// viscosities differ by ten, 50 while they differ by a hundred.
TEST_P(LinearIterations, AreFew) {
  for (const double lambda : {0.01, 0.1, 10.0, 100.0}) {
    const StokesReport report = solved(lambda, {});
    ASSERT_TRUE(report.ok()) << report.text();
    EXPECT_EQ(report.solver, LinearSolver::block);
    const int few = is_quadratic() ? 40 : 30;
    EXPECT_LE(report.iterations, lambda < 0.1 || lambda > 10.0 ? 50 : few) << "lambda " << lambda;
  }
}

class OnTheSphere : public LinearIterations {};
INSTANTIATE_TEST_SUITE_P(P1AndP2, OnTheSphere,
                         testing::Values(Case{DropShape::sphere, Elements::p1_p1, 300},
                                         Case{DropShape::sphere, Elements::p2_p1, 60},
                                         Case{DropShape::sphere, Elements::p2_p1, 65}));

// A pressure that is constant in a drop of next to no viscosity acts through the liquid around: its
// weight keeps the spectrum what it is between like liquids. So does a smoother that knows the
// spectrum of both liquids.
TEST_P(OnTheSphere, StayFewForAGas) {
  const int between_likes = solved(1.0, {}).iterations;
  for (const double lambda : {1e-3, 1e-4, 1e-6})
    EXPECT_LE(solved(lambda, {}).iterations, 1.25 * between_likes) << "lambda " << lambda;
}

// On any shape: a thousandth of the viscosity is next to none, and less changes no more than the
// scale of the equations inside. Measured: 49, 54, 56, 56 on the dumbbell, the worst of all.
TEST_P(LinearIterations, NoLongerGrowForAGas) {
  const int thousandth = solved(1e-3, {}).iterations;
  for (const double lambda : {1e-4, 1e-6}) {
    const StokesReport report = solved(lambda, {});
    ASSERT_TRUE(report.ok() && report.failed_solvers.empty()) << report.text();
    EXPECT_LE(report.iterations, 1.25 * thousandth) << "lambda " << lambda;
  }
}

// Where a drop's sections turn as rigid bodies it dissipates next to nothing, and the Laplacians
// that stand for the velocity block hold λ against it. Without the slow modes a sphere takes 42, a
// prolate drop 101, a dumbbell 141 iterations at λ = 1000.
TEST_P(LinearIterations, HardlyGrowForAStiffDrop) {
  const int between_likes = solved(1.0, {}).iterations;
  for (const double lambda : {1e3, 1e4}) {
    const StokesReport report = solved(lambda, {});
    ASSERT_TRUE(report.ok() && report.failed_solvers.empty()) << report.text();
    const double factor = GetParam().shape == DropShape::dumbbell ? 2.5 : 1.5;
    EXPECT_LE(report.iterations, factor * between_likes) << "lambda " << lambda;
  }
}

// PETSc's own multigrid, which a PETSc without hypre is left with, does the same.
TEST_P(OnTheSphere, AreFewWithoutHypre) {
  Options options;
  options.petsc_options =
      linear::default_options(linear::SaddleMethod::block, is_quadratic(), false);
  for (const double lambda : {0.1, 10.0}) {
    const StokesReport report = solved(lambda, options);
    ASSERT_TRUE(report.ok()) << report.text();
    EXPECT_EQ(report.solver, LinearSolver::block);
    EXPECT_LE(report.iterations, is_quadratic() ? 40 : 30) << "lambda " << lambda;
  }
}

// Quadratic velocities owe a fifth of their speed to the pressure's consistent mass matrix, which
// options undo; linear ones have the lumped one alone, to which the same options say nothing.
TEST_P(OnTheSphere, MassMatrixOfThePressureIsWorthItsSteps) {
  Options lumped;
  lumped.petsc_options = "-p_ksp_type preonly -p_pc_type jacobi -p_pc_jacobi_type rowsum";
  const int by_default = solved(1.0, {}).iterations, by_lumping = solved(1.0, lumped).iterations;
  if (is_quadratic())
    EXPECT_GT(by_lumping, 1.1 * by_default);
  else
    EXPECT_EQ(by_lumping, by_default);
}

}  // namespace
}  // namespace meniscus::fem
