#include "meniscus/flow/fem/finite_element_flow.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "meniscus/core/error.hpp"
#include "meniscus/mesh/surface_measures.hpp"
#include "meniscus/surface/remesh.hpp"
#include "tests/flow/fem/sphere_scene.hpp"
#include "tests/flow/meshed_flow.hpp"

namespace meniscus::fem {
namespace {

using test::flow_in;
using test::MeshedFlow;

Scene shear_scene(double outer_radius = 4.0) {
  Mat3 gradient = ImposedFlow::simple_shear();
  Scene scene = sphere_in_sphere(
      {.num_vertices = 110,
       .outer_radius = outer_radius,
       .viscosity_ratio = 2.0,
       .Ca = 0.4,
       .outer_velocity = [gradient](const Vec3& x, double) { return Vec3(gradient * x); },
       .is_linear_flow = true});
  scene.flow = ImposedFlow(FlowFamily::planar, gradient);
  return scene;
}

/// Moves scene and mesh with a flow for a time.
void move(Scene& scene, MeshedFlow& flow, const FlowSolution& solution, double dt) {
  const Scene start = scene;
  flow.mesh.begin_step(start);
  for (std::size_t i = 0; i < scene.interfaces.size(); ++i)
    for (const VertexId v : solution.velocity[i].ids())
      scene.interfaces[i].mesh.x[v] += dt * solution.velocity[i][v];
  const Report moved = flow.mesh.move(start, solution.velocity, solution.bulk->v, dt);
  ASSERT_TRUE(moved.ok()) << moved.text();
}

TEST(FiniteElementFlow, WarmSecondStageTakesFewerIterations) {
  Scene scene = shear_scene();
  MeshedFlow flow;
  flow.follow(scene);
  const FlowSolution first = flow.solve(scene);
  ASSERT_TRUE(first.ok()) << first.text();
  move(scene, flow, first, 0.02);
  const FlowSolution second = flow.solve(scene, 0.02);
  ASSERT_TRUE(second.ok()) << second.text();
  EXPECT_GT(second.iterations, 0);
  EXPECT_LT(second.iterations, first.iterations);
  for (const char* phase : {"assemble", "solve"})
    EXPECT_GT(flow.solver->times()[phase], 0.0) << phase;
  for (const char* phase : {"tetrahedralize", "move mesh"})
    EXPECT_GT(flow.mesh.times()[phase], 0.0) << phase;
}

/// The drop's velocity in an outer sphere, solved to a tolerance.
VertexField<Vec3> drop_velocity(const Scene& scene, double rtol) {
  Options options;
  options.rtol = rtol;
  return flow_in(scene, options).velocity[0];
}

// The forces on a boundary far away, which grow with its distance squared, must not loosen it.
TEST(FiniteElementFlow, ToleranceDoesNotDependOnHowFarTheBoundaryIs) {
  for (const double outer_radius : {10.0, 100.0}) {
    const Scene scene = shear_scene(outer_radius);
    const VertexField<Vec3> loose = drop_velocity(scene, 1e-6), tight = drop_velocity(scene, 1e-11);
    double largest = 0.0;
    for (const VertexId v : tight.ids()) largest = std::max(largest, (loose[v] - tight[v]).norm());
    // Velocities near one. Relative to the residual at rest it would be 0.006 at 100 R0.
    EXPECT_LT(largest, 3e-4) << outer_radius;
  }
}

TEST(FiniteElementFlow, EnergyInIsDissipatedOrStoredInTheSurface) {
  const Scene scene = shear_scene();
  Options options;
  options.rtol = 1e-10;
  const FlowSolution flow = flow_in(scene, options);
  const VertexField<Vec3> gradient = area_gradient(scene.interfaces[0].mesh);
  double growth = 0.0;
  for (const VertexId v : gradient.ids()) growth += gradient[v].dot(flow.velocity[0][v]) / 0.4;
  const Power power = flow.power.value();
  EXPECT_NEAR(power.in - power.dissipation, growth, 1e-7 * power.in);
}

// A run that goes on and one that is restored from a checkpoint do the same arithmetic, whether the
// checkpoint falls between steps that make a preconditioner or keep one.
TEST(FiniteElementFlow, ARestoredSolverDoesTheSameArithmetic) {
  // Stiff drops and long thin ones have slow modes, which follow the places of the nodes.
  struct Run {
    Elements elements;
    LinearSolver solver;
    double viscosity, length;
  };
  for (const auto& [elements, which, viscosity, length] :
       {Run{Elements::p1_p1, LinearSolver::block, 2.0, 1.0},
        Run{Elements::p1_p1, LinearSolver::mumps, 2.0, 1.0},
        Run{Elements::p2_p1, LinearSolver::block, 2.0, 1.0},
        Run{Elements::p1_p1, LinearSolver::block, 100.0, 1.0},
        Run{Elements::p2_p1, LinearSolver::block, 100.0, 1.0},
        Run{Elements::p2_p1, LinearSolver::block, 0.01, 2.5}}) {
    SCOPED_TRACE(viscosity);
    Options options;
    options.elements = elements;
    options.linear = which;
    Scene scene = shear_scene();
    scene.liquids[RegionId{1}].viscosity = viscosity;
    for (Vec3& x : scene.interfaces[0].mesh.x)
      x = x.cwiseProduct(Vec3(length, 1.0 / std::sqrt(length), 1.0 / std::sqrt(length)));
    MeshedFlow flow(options);
    flow.follow(scene);
    FlowSolution straight = flow.solve(scene);
    ASSERT_TRUE(straight.ok());
    for (int step = 1; step <= 3; ++step) {
      move(scene, flow, straight, 0.01);
      MeshedFlow restored(options);
      restored.load(flow.saved(scene), scene);
      straight = flow.solve(scene, 0.01 * step);
      const FlowSolution resumed = restored.solve(scene, 0.01 * step);
      ASSERT_TRUE(straight.ok() && resumed.ok());
      EXPECT_GT(straight.iterations, 0);
      EXPECT_EQ(straight.iterations, resumed.iterations);
      EXPECT_EQ(straight.velocity[0], resumed.velocity[0]) << step;
      const Archive a = flow.saved(scene), b = restored.saved(scene);
      EXPECT_EQ(a.reals, b.reals) << step;
      EXPECT_EQ(a.integers, b.integers) << step;
    }
  }
}

/// The largest distance between two velocities.
double largest_difference(const VertexField<Vec3>& a, const VertexField<Vec3>& b) {
  double largest = 0.0;
  for (const VertexId v : a.ids()) largest = std::max(largest, (a[v] - b[v]).norm());
  return largest;
}

// On a mesh made anew the last solution saves iterations, and leaves the answer as near to the
// exact one as the tolerance asks for. A solver restored from a checkpoint begins from the same
// guess.
TEST(FiniteElementFlow, TheLastSolutionFollowsToAnotherMesh) {
  for (const Elements elements : {Elements::p1_p1, Elements::p2_p1}) {
    Options options;
    options.elements = elements;
    Scene scene = shear_scene();
    MeshedFlow flow(options), fresh(options), restored(options);
    options.rtol = 1e-11;
    MeshedFlow exact(options);
    flow.follow(scene);
    const FlowSolution first = flow.solve(scene);
    ASSERT_TRUE(first.ok()) << first.text();
    move(scene, flow, first, 0.02);
    const SurfaceMesh before = scene.interfaces[0].mesh;
    ASSERT_TRUE(remesh(scene.interfaces[0].mesh, {.C0 = 120.0 / (4.0 * M_PI)}).ok());
    ASSERT_NE(scene.interfaces[0].mesh.num_vertices(), before.num_vertices());
    flow.follow(scene);
    const Archive saved = flow.saved(scene);
    restored.load(saved, scene);
    fresh.mesh.load(saved, scene);
    exact.mesh.load(saved, scene);
    const FlowSolution carried = flow.solve(scene), resumed = restored.solve(scene),
                       cold = fresh.solve(scene), wanted = exact.solve(scene);
    ASSERT_TRUE(carried.ok() && resumed.ok() && cold.ok() && wanted.ok());
    EXPECT_LT(carried.iterations, cold.iterations);
    EXPECT_GT(carried.iterations, 0);
    EXPECT_EQ(resumed.iterations, carried.iterations);
    EXPECT_EQ(resumed.velocity[0], carried.velocity[0]);
    // The bound is that of ToleranceDoesNotDependOnHowFarTheBoundaryIs.
    EXPECT_LT(largest_difference(carried.velocity[0], wanted.velocity[0]), 3e-4);
  }
}

// One hierarchy and the guess serve all solves while the topology stands and nothing has moved far;
// both go into the checkpoint. Where the mesh is made anew the hierarchy goes, the guess stays.
TEST(FiniteElementFlow, KeepsItsPreconditionerAndItsGuessWhileTheTopologyStands) {
  const Scene scene = shear_scene();
  MeshedFlow flow;
  for (int topology = 0; topology < 2; ++topology) {
    flow.follow(scene);
    EXPECT_FALSE(flow.saved(scene).reals.contains("flow/preconditioner/x"));
    EXPECT_EQ(flow.saved(scene).reals.contains("flow/guess/velocity"), topology > 0);
    Scene moved = scene;
    ASSERT_TRUE(flow.solve(moved).ok());
    const Archive first = flow.saved(moved);
    for (int stage = 0; stage < 4; ++stage) {
      for (Vec3& x : moved.interfaces[0].mesh.x) x[0] *= 1.001;
      ASSERT_TRUE(flow.solve(moved).ok());
      const Archive next = flow.saved(moved);
      EXPECT_EQ(next.reals.at("flow/preconditioner/x"), first.reals.at("flow/preconditioner/x"));
      EXPECT_NE(next.reals.at("flow/guess/velocity"), first.reals.at("flow/guess/velocity"));
    }
  }
}

/// A mesh with a cell of the matrix squeezed between a face of an interface, which bulges into it,
/// and its fourth vertex: that is lowered to a twentieth of its height.
TetMesh with_flat_cell(TetMesh mesh) {
  const auto is_on_surface = [&](TetVertexId v) {
    const auto& surface = mesh.interfaces[0];
    return std::ranges::any_of(ids<VertexId>(surface.num_vertices),
                               [&](VertexId w) { return surface.vertex(w) == v; });
  };
  for (const CellId c : mesh.cells.ids()) {
    const CellVertices& corners = mesh.cells[c];
    if (mesh.region[c] != RegionId{0} || std::ranges::count_if(corners, is_on_surface) != 3)
      continue;
    const auto apex = std::ranges::find_if_not(corners, is_on_surface);
    Vec3 base = Vec3::Zero();
    for (const TetVertexId v : corners)
      if (v != *apex) base += mesh.x[v] / 3.0;
    const Vec3 before = mesh.x[*apex];
    mesh.x[*apex] = base + 0.05 * (before - base);
    if (std::ranges::all_of(mesh.cells.ids(),
                            [&](CellId each) { return signed_volume(mesh, each) > 0.0; }))
      return mesh;
    mesh.x[*apex] = before;
  }
  ADD_FAILURE() << "no cell can be squeezed";
  return mesh;
}

// Where edges of an interface would be flattened a moved mesh is not to be kept; one that was like
// that when it was new is. A solver restored from a checkpoint knows which.
TEST(FiniteElementFlow, AMeshThatFlattensEdgesOfInterfacesIsNotFit) {
  const Scene scene = shear_scene();
  Options options;
  options.elements = Elements::p2_p1;
  for (const bool is_flat_from_the_start : {false, true}) {
    MeshedFlow flow(options), restored(options);
    flow.follow(scene);
    const TetMesh flat = with_flat_cell(flow.mesh.tetrahedra());
    FlowDomain domain = flow.domain(scene);
    if (is_flat_from_the_start) domain.mesh = &flat;
    ASSERT_TRUE(flow.solver->solve(domain, {}).ok());
    restored.load(flow.saved(scene), scene);
    for (MeshedFlow* each : {&flow, &restored}) {
      FlowDomain moved = each->domain(scene);
      EXPECT_TRUE(each->solver->is_fit(moved));
      moved.mesh = &flat;
      EXPECT_EQ(each->solver->is_fit(moved), is_flat_from_the_start);
    }
  }
}

// A factorisation of what is no longer there soon costs more iterations than it is worth.
TEST(FiniteElementFlow, APreconditionerThatNoLongerFitsIsGivenUp) {
  Scene scene = shear_scene();
  Options options;
  options.linear = LinearSolver::mumps;
  MeshedFlow flow(options);
  flow.follow(scene);
  ASSERT_TRUE(flow.solve(scene).ok());
  scene.liquids[RegionId{1}].viscosity *= 10.0;
  const FlowSolution kept = flow.solve(scene);
  ASSERT_TRUE(kept.ok());
  EXPECT_GT(kept.iterations, 4);
  EXPECT_FALSE(flow.saved(scene).reals.contains("flow/preconditioner/x"));
  for (Vec3& x : scene.interfaces[0].mesh.x) x[0] *= 1.001;
  const FlowSolution fresh = flow.solve(scene);
  ASSERT_TRUE(fresh.ok());
  EXPECT_LE(fresh.iterations, 2);
}

TEST(FiniteElementFlow, ADamagedCheckpointIsRefused) {
  const Scene scene = shear_scene();
  MeshedFlow flow, restored;
  flow.follow(scene);
  const Archive archive = flow.saved(scene);
  Archive missing = archive;
  missing.reals.erase("mesh/x");
  EXPECT_THROW(restored.load(missing, scene), InvalidInput);
  Archive wild = archive;
  wild.integers["mesh/cells"][7] = 1000000;
  EXPECT_THROW(restored.load(wild, scene), InvalidInput);
  Archive short_preconditioner = archive;
  short_preconditioner.reals["flow/preconditioner/x"] = {0.0, 0.0, 0.0};
  EXPECT_THROW(restored.load(short_preconditioner, scene), InvalidInput);
  Archive short_guess = archive;
  short_guess.reals["flow/guess/velocity"] = {0.0, 0.0, 0.0};
  short_guess.reals["flow/guess/pressure"] = {0.0};
  EXPECT_THROW(restored.load(short_guess, scene), InvalidInput);
}

// The flow in the volume is tested: the interfaces' velocities have had their net flux taken out. A
// pressure constant in one drop alone tests its continuity equation, ∫∇·v dV = 0, which needs a
// pressure that jumps at both interfaces. The mean over the nodes, of which most are near the drop,
// is another.
TEST(FiniteElementFlow, PressureIsRelativeToItsMeanOverTheMatrix) {
  for (const Elements elements : {Elements::p1_p1, Elements::p2_p1}) {
    Options options;
    options.elements = elements;
    const Scene scene = shear_scene();
    MeshedFlow flow(options);
    flow.follow(scene);
    const FlowSolution solution = flow.solve(scene);
    ASSERT_TRUE(solution.ok()) << solution.text();
    const TetMesh& mesh = flow.mesh.tetrahedra();
    const std::vector<double>& p = solution.bulk->corner_pressure;
    double integral = 0.0, size = 0.0;
    for (const CellId c : mesh.cells.ids()) {
      if (mesh.region[c] != RegionId{0}) continue;
      for (std::size_t k = 0; k < 4; ++k) {
        const double of_corner = p[4 * static_cast<std::size_t>(c.value) + k];
        integral += 0.25 * signed_volume(mesh, c) * of_corner;
        size += 0.25 * signed_volume(mesh, c) * std::abs(of_corner);
      }
    }
    EXPECT_GT(size, 0.0);
    EXPECT_NEAR(integral, 0.0, 1e-12 * size);
  }
}

TEST(FiniteElementFlow, TwoDropsEachKeepTheirVolume) {
  Scene scene = shear_scene();
  scene.liquids.add({.viscosity = 0.5});
  scene.boundary.mesh = sphere(300, 6.0);
  scene.boundary.patch = FaceField<PatchId>(scene.boundary.mesh.num_faces(), PatchId{0});
  Interface other = scene.interfaces[0];
  other.drop = 1;
  other.inside = RegionId{2};
  scene.interfaces.push_back(other);
  for (Vec3& x : scene.interfaces[0].mesh.x) x += Vec3(-1.5, 0.4, 0.0);
  for (Vec3& x : scene.interfaces[1].mesh.x) x += Vec3(1.5, -0.4, 0.0);
  Options options;
  options.rtol = 1e-9;
  MeshedFlow flow(options);
  flow.follow(scene);
  const FlowSolution solution = flow.solve(scene);
  ASSERT_TRUE(solution.ok()) << solution.text();
  const TetMesh& mesh = flow.mesh.tetrahedra();
  ASSERT_EQ(mesh.interfaces.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    const VertexField<Vec3> area = vertex_area_vectors(scene.interfaces[i].mesh);
    double flux = 0.0, gross = 0.0;
    for (const VertexId v : area.ids()) {
      const double through = area[v].dot(solution.bulk->v[mesh.interfaces[i].vertex(v)]);
      flux += through;
      gross += std::abs(through);
    }
    EXPECT_GT(gross, 1.0);  // what the drop's deformation pumps: its area times some 0.1
    EXPECT_NEAR(flux, 0.0, 1e-7);
  }
}

}  // namespace
}  // namespace meniscus::fem
