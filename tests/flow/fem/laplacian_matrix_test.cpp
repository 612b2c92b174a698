#include "meniscus/flow/fem/laplacian_matrix.hpp"

#include <cmath>
#include <functional>
#include <limits>
#include <numeric>

#include <gtest/gtest.h>

#include "meniscus/flow/fem/elements.hpp"
#include "meniscus/flow/fem/stokes_residual.hpp"
#include "tests/flow/fem/stage_from_rest.hpp"

namespace meniscus::fem {
namespace {

// Single precision, and sums of some thousand terms.
constexpr double kRounding = 1e-5;

/// vᵀLv for v = (s, 0, 0), s given at the nodes.
double energy(const StokesProblem& problem, const std::function<double(const Vec3&)>& scalar) {
  LaplacianMatrix matrix(problem.space, problem.space.velocity.num_nodes);
  matrix.assemble(problem, StokesProduct(problem));
  std::vector<double> v, result(3 * static_cast<std::size_t>(problem.space.velocity.num_nodes));
  for (const Vec3& x : problem.positions.x) v.insert(v.end(), {scalar(x), 0.0, 0.0});
  v.push_back(1e300);  // which does not count
  matrix.multiply(v, result);
  return std::inner_product(result.begin(), result.end(), v.begin(), 0.0);
}

/// Volumes of the regions, curved cells as they are.
std::vector<double> volumes(const StokesProblem& problem) {
  std::vector<double> result(2, 0.0);
  QuadraticElement element(problem.space, problem.positions);
  for (const CellId c : problem.mesh.cells.ids())
    for (const auto& point : element.points(c))
      result[static_cast<std::size_t>(problem.mesh.region[c].value)] += point.weight;
  return result;
}

class LaplacianOfDrop : public testing::Test {
 protected:
  LaplacianOfDrop() : stage_(pushed_drop(60), DropShape::prolate, Elements::p2_p1) {}
  StageFromRest stage_;
};

// ∫μ|∇s|² is zero for a constant and the sum of μV for a coordinate, which the elements hold
// exactly.
TEST_F(LaplacianOfDrop, IsExactOnLinearFunctions) {
  const StokesProblem problem = stage_.problem({7.0}, std::numeric_limits<double>::infinity());
  const std::vector<double> V = volumes(problem);
  const double wanted = V[0] + 7.0 * V[1];
  EXPECT_NEAR(energy(problem, [](const Vec3&) { return 1.0; }), 0.0, kRounding * wanted);
  for (int k = 0; k < 3; ++k)
    EXPECT_NEAR(energy(problem, [k](const Vec3& x) { return 3.0 + x[k]; }), wanted,
                kRounding * wanted);
}

// Residuals are weighed by what is near the diagonals: that of the Laplacian, and ∫ψ/μ, which sums
// to V/μ.
TEST_F(LaplacianOfDrop, HasTheDiagonalThatResidualsAreWeighedBy) {
  StokesProblem problem = stage_.problem({7.0}, std::numeric_limits<double>::infinity());
  problem.inertia.reset();
  const std::int32_t num_nodes = problem.space.velocity.num_nodes;
  LaplacianMatrix matrix(problem.space, num_nodes);
  matrix.assemble(problem, StokesProduct(problem));
  const std::vector<double> diagonal = matrix.diagonal(), weights = residual_weights(problem);
  ASSERT_EQ(weights.size(), 3 * diagonal.size() + problem.space.pressure.vertex.size());
  double log_sum = 0.0;
  for (std::size_t i = 0; i < diagonal.size(); ++i) {
    EXPECT_EQ(weights[3 * i], weights[3 * i + 2]);
    const double ratio = weights[3 * i] * weights[3 * i] * diagonal[i];
    EXPECT_GT(ratio, 0.25);
    EXPECT_LT(ratio, 4.0);
    log_sum += std::log(ratio);
  }
  EXPECT_NEAR(log_sum / num_nodes, 0.0, 0.3);
  double mass = 0.0, wanted = 0.0;
  for (std::size_t i = 3 * diagonal.size(); i < weights.size(); ++i)
    mass += 1.0 / (weights[i] * weights[i]);
  for (const CellId c : problem.mesh.cells.ids())
    wanted += signed_volume(problem.mesh, c) / problem.viscosity[c];
  EXPECT_NEAR(mass, wanted, 1e-12 * wanted);
}

// A constant has the mass of the liquids over the stage's length, and no tension.
TEST_F(LaplacianOfDrop, HoldsTheMassWithInertia) {
  const double duration = 0.03;
  const StokesProblem problem = stage_.problem({7.0, 2.0, 5.0}, duration);
  const std::vector<double> V = volumes(problem);
  const double wanted = (2.0 * V[0] + 10.0 * V[1]) / duration;
  EXPECT_NEAR(energy(problem, [](const Vec3&) { return 1.0; }), wanted, kRounding * wanted);
}

// What tension adds to a function is τσ∮|∇_s s|², as the faces have it.
TEST_F(LaplacianOfDrop, HoldsTheTensionOfTheStage) {
  StokesProblem problem = stage_.problem({7.0, 2.0, 5.0}, 0.03);
  for (FaceStiffness& face : problem.inertia->tension) face.values *= 1e16;  // or it would be lost
  const auto square = [](const Vec3& x) { return x.x() * x.y() + x.z(); };
  const double with = energy(problem, square);
  double wanted = 0.0;
  for (const FaceStiffness& face : problem.inertia->tension)
    for (std::size_t i = 0; i < 6; ++i)
      for (std::size_t j = 0; j < 6; ++j)
        wanted += face.block(i, j)(0, 0) * square(problem.positions.x[face.nodes[i]]) *
                  square(problem.positions.x[face.nodes[j]]);
  problem.inertia->tension.clear();
  const double without = energy(problem, square);
  EXPECT_GT(wanted, 0.1 * without);
  EXPECT_NEAR(with - without, wanted, kRounding * with);
}

// Each component of a velocity gets what the others would get in its place.
TEST_F(LaplacianOfDrop, ServesEachComponent) {
  const StokesProblem problem = stage_.problem({7.0}, std::numeric_limits<double>::infinity());
  const auto count = static_cast<std::size_t>(problem.space.velocity.num_nodes);
  LaplacianMatrix matrix(problem.space, problem.space.velocity.num_nodes);
  matrix.assemble(problem, StokesProduct(problem));
  std::vector<double> v(3 * count + 1), result(3 * count);
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t k = 0; k < 3; ++k)
      v[3 * i + k] =
          double(k + 1) * problem.positions.x[NodeId{static_cast<std::int32_t>(i)}].norm();
  matrix.multiply(v, result);
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t k = 1; k < 3; ++k)
      EXPECT_NEAR(result[3 * i + k], double(k + 1) * result[3 * i], 1e-9);
}

}  // namespace
}  // namespace meniscus::fem
