// Fields on interfaces and in the bulk, carried through whole steps.
#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

#include <gtest/gtest.h>

#include "meniscus/core/error.hpp"
#include "meniscus/core/log.hpp"
#include "meniscus/evolve/evolution.hpp"
#include "meniscus/mesh/shapes.hpp"
#include "meniscus/mesh/surface_measures.hpp"
#include "tests/evolve/prescribed_flow.hpp"

namespace meniscus {
namespace {

double cosine(const Vec3& x) { return 2.0 + std::cos(2.0 * x.x() + x.y() - 0.5 * x.z()); }

Vec3 center(const SurfaceMesh& mesh, FaceId f) {
  const FaceVertices& v = mesh.faces[f];
  return (mesh.x[v[0]] + mesh.x[v[1]] + mesh.x[v[2]]) / 3.0;
}

/// Conserved and interpolated cosines on vertices and faces.
SurfaceFields cosines(const SurfaceMesh& mesh) {
  VertexField<double> at_vertices;
  for (const Vec3& x : mesh.x) at_vertices.add(cosine(x));
  FaceField<double> on_faces;
  for (const FaceId f : mesh.faces.ids()) on_faces.add(cosine(center(mesh, f)));
  return {{{"gamma", "", FieldTransfer::conserved, at_vertices},
           {"label", "", FieldTransfer::interpolated, at_vertices}},
          {{"load", "", FieldTransfer::conserved, on_faces}}};
}

VolumeFields cosines(const TetMesh& mesh) {
  Field<TetVertexId, double> at_vertices;
  for (const Vec3& x : mesh.x) at_vertices.add(cosine(x));
  Field<CellId, double> on_cells;
  for (const CellVertices& c : mesh.cells)
    on_cells.add(cosine(0.25 * (mesh.x[c[0]] + mesh.x[c[1]] + mesh.x[c[2]] + mesh.x[c[3]])));
  return {{{"temperature", "", FieldTransfer::interpolated, at_vertices}},
          {{"species", "", FieldTransfer::conserved, on_cells}}};
}

/// Σ value · measure of what is conserved: on vertices and faces of all interfaces, and in all
/// cells.
struct Amounts {
  double on_vertices = 0.0, on_faces = 0.0, in_cells = 0.0;
};
Amounts amounts(const State& state) {
  Amounts sum;
  for (const Interface& interface : state.scene.interfaces) {
    const VertexField<double> areas = vertex_areas(interface.mesh);
    const VertexField<double>& gamma = interface.fields.on_vertices[0].values;
    for (const VertexId v : areas.ids()) sum.on_vertices += areas[v] * gamma[v];
    const FaceField<double>& load = interface.fields.on_faces[0].values;
    for (const FaceId f : load.ids())
      sum.on_faces += face_area_vector(interface.mesh, f).norm() * load[f];
  }
  if (!state.mesh) return sum;
  const TetMesh& mesh = state.mesh->tetrahedra();
  const Field<CellId, double>& species = state.mesh->fields().on_cells[0].values;
  for (const CellId c : mesh.cells.ids()) sum.in_cells += signed_volume(mesh, c) * species[c];
  return sum;
}

void expect_kept(const Amounts& now, const Amounts& before, double tolerance) {
  EXPECT_NEAR(now.on_vertices, before.on_vertices, tolerance * before.on_vertices);
  EXPECT_NEAR(now.on_faces, before.on_faces, tolerance * before.on_faces);
  EXPECT_NEAR(now.in_cells, before.in_cells, tolerance * before.in_cells);
}

void add_drop(Scene& scene, int nodes, double radius, const Vec3& at) {
  Interface drop;
  drop.drop = static_cast<int>(scene.interfaces.size());
  drop.mesh = sphere(nodes, radius);
  for (Vec3& x : drop.mesh.x) x += at;
  drop.C0 = nodes / (4.0 * std::numbers::pi);
  drop.volume = drop.initial_volume = enclosed_volume(drop.mesh);
  scene.interfaces.push_back(std::move(drop));
  scene.liquids.add({});
}

Scene in_sphere(double radius) {
  Scene scene;
  scene.liquids.add({});
  scene.boundary.mesh = sphere(60, radius);
  scene.boundary.patch = FaceField<PatchId>(scene.boundary.mesh.num_faces(), PatchId{0});
  scene.boundary.patches.add({"wall", NoPenetration{}});
  return scene;
}

/// A drop turned and stretched to and fro by a shear.
struct Sheared {
  PrescribedFlow* flow;
  Evolution evolution;
};
Sheared sheared_drop(double end) {
  Scene scene = in_sphere(4.0);
  add_drop(scene, 60, 1.0, Vec3::Zero());
  assign_regions(scene);
  EvolutionOptions options;
  options.end = end;
  options.max_step = 0.02;
  options.min_step = 1e-4;
  auto flow = std::make_unique<PrescribedFlow>([](const Vec3& x, double t) {
    return Vec3(std::cos(2.0 * t) * x.y(), 0.3 * std::sin(3.0 * t) * x.x(), 0.0);
  });
  PrescribedFlow* seen = flow.get();
  return {seen, Evolution(scene, options, std::move(flow),
                          MovingMesh({.tetrahedra = {}, .motion = VolumeMotion::harmonic}))};
}

void put_cosines(Evolution& evolution) {
  std::vector<SurfaceFields> fields;
  for (const Interface& interface : evolution.scene().interfaces)
    fields.push_back(cosines(interface.mesh));
  evolution.set_interface_fields(std::move(fields));
  if (evolution.state().mesh)
    evolution.set_bulk_fields(cosines(evolution.state().mesh->tetrahedra()));
}

void step(Evolution& evolution) {
  ASSERT_TRUE(evolution.solve().ok());
  const Report report = evolution.advance();
  ASSERT_TRUE(report.ok()) << report.text();
}

TEST(CarriedFields, KeepTheirAmountsThroughRemeshedSteps) {
  Evolution evolution = sheared_drop(10.0).evolution;
  ASSERT_TRUE(evolution.prepare().ok());
  put_cosines(evolution);
  const Amounts before = amounts(evolution.state());
  for (int i = 0; i < 200; ++i) step(evolution);
  expect_kept(amounts(evolution.state()), before, 1e-12);
  const auto [low, high] =
      std::ranges::minmax(evolution.scene().interfaces[0].fields.on_vertices[1].values);
  EXPECT_GE(low, 1.0);
  EXPECT_LE(high, 3.0);
  EXPECT_LT(low, 2.0);  // it is still no constant
  EXPECT_GT(high, 2.0);
  const auto& temperature = evolution.state().mesh->fields().on_vertices[0].values;
  EXPECT_GE(std::ranges::min(temperature), 1.0);
  EXPECT_LE(std::ranges::max(temperature), 3.0);
  std::printf("excess %.3e above, %.3e below; kept to %.1e %.1e %.1e\n",
              evolution.state().field_excess.above, evolution.state().field_excess.below,
              amounts(evolution.state()).on_vertices / before.on_vertices - 1.0,
              amounts(evolution.state()).on_faces / before.on_faces - 1.0,
              amounts(evolution.state()).in_cells / before.in_cells - 1.0);
}

TEST(CarriedFields, AreAsTheyWereAfterARefusedStep) {
  log::set_level(log::Level::off);
  Sheared run = sheared_drop(10.0);
  ASSERT_TRUE(run.evolution.prepare().ok());
  put_cosines(run.evolution);
  step(run.evolution);
  ASSERT_TRUE(run.evolution.solve().ok());
  const SurfaceFields on_interface = run.evolution.scene().interfaces[0].fields;
  const VolumeFields in_bulk = run.evolution.state().mesh->fields();
  run.flow->longest_step = 0.0;
  EXPECT_FALSE(run.evolution.advance().ok());
  EXPECT_EQ(run.evolution.scene().interfaces[0].fields, on_interface);
  EXPECT_EQ(run.evolution.state().mesh->fields(), in_bulk);
  log::set_level(log::Level::warning);
}

TEST(CarriedFields, GoOnFromACheckpointToTheSameBits) {
  Evolution whole = sheared_drop(10.0).evolution;
  ASSERT_TRUE(whole.prepare().ok());
  put_cosines(whole);
  for (int i = 0; i < 3; ++i) step(whole);
  Archive archive;
  whole.save(archive);
  Evolution resumed = sheared_drop(10.0).evolution;
  resumed.load(archive);
  for (int i = 0; i < 3; ++i) {
    step(whole);
    step(resumed);
  }
  EXPECT_EQ(whole.scene().interfaces[0].fields, resumed.scene().interfaces[0].fields);
  EXPECT_EQ(whole.state().mesh->fields(), resumed.state().mesh->fields());
  Archive a, b;
  whole.save(a);
  resumed.save(b);
  EXPECT_EQ(a.reals, b.reals);
  archive.reals["interfaces/0/fields/faces/0/values"].pop_back();
  EXPECT_THROW(sheared_drop(10.0).evolution.load(archive), InvalidInput);
}

// Two drops meet: what both carried is on and in the one they become.
TEST(CarriedFields, AddUpWhereDropsMerge) {
  Scene scene = in_sphere(3.0);
  add_drop(scene, 100, 0.5, Vec3(-0.56, 0, 0));
  add_drop(scene, 100, 0.5, Vec3(0.56, 0, 0));
  assign_regions(scene);
  EvolutionOptions options;
  options.end = 10.0;
  options.max_step = 0.02;
  options.min_step = 1e-4;
  options.edge_floor = 0.02;
  options.topology = {
      .breakup_radius = 0.04, .coalescence = true, .coalescence_gap = 0.05, .edge_floor = 0.02};
  Evolution evolution(scene, options, std::make_unique<PrescribedFlow>([](const Vec3& x, double) {
                        return Vec3(x.x() < 0.0 ? 1.0 : -1.0, 0.0, 0.0);
                      }),
                      MovingMesh({.tetrahedra = {}, .motion = VolumeMotion::harmonic}));
  ASSERT_TRUE(evolution.prepare().ok());
  put_cosines(evolution);
  const Amounts before = amounts(evolution.state());
  for (int i = 0; i < 100 && evolution.events().empty(); ++i) step(evolution);
  ASSERT_EQ(evolution.events().size(), 1U);
  ASSERT_EQ(evolution.scene().interfaces.size(), 1U);
  expect_kept(amounts(evolution.state()), before, 1e-12);
}

std::string refusal(auto&& action) {
  try {
    action();
  } catch (const InvalidInput& error) {
    return error.what();
  }
  return {};
}

TEST(CarriedFields, ThatDoNotFitAreRefusedByName) {
  Evolution evolution = sheared_drop(1.0).evolution;
  ASSERT_TRUE(evolution.prepare().ok());
  const SurfaceFields good = cosines(evolution.scene().interfaces[0].mesh);
  SurfaceFields wrong = good;
  wrong.on_vertices[0].values.add(1.0);
  EXPECT_NE(refusal([&] { evolution.set_interface_fields({wrong}); }).find("gamma"),
            std::string::npos);
  wrong = good;
  wrong.on_faces[0].values[FaceId{3}] = std::nan("");
  EXPECT_NE(refusal([&] { evolution.set_interface_fields({wrong}); }).find("load"),
            std::string::npos);
  wrong = good;
  wrong.on_vertices[1].name = "gamma";
  EXPECT_NE(refusal([&] { evolution.set_interface_fields({wrong}); }).find("gamma"),
            std::string::npos);
  EXPECT_NE(refusal([&] { evolution.set_interface_fields({good, good}); }), "");
  EXPECT_TRUE(evolution.scene().interfaces[0].fields.empty());
}

}  // namespace
}  // namespace meniscus
