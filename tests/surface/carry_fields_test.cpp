#include "meniscus/surface/carry_fields.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include "meniscus/mesh/surface_measures.hpp"
#include "meniscus/surface/remesh.hpp"
#include "tests/surface/deformation.hpp"
#include "tests/surface/shapes.hpp"

namespace meniscus {
namespace {

using enum FieldTransfer;

Vec3 center(const SurfaceMesh& mesh, FaceId f) {
  const FaceVertices& v = mesh.faces[f];
  return (mesh.x[v[0]] + mesh.x[v[1]] + mesh.x[v[2]]) / 3.0;
}

template <class Function>
SurfaceFields sampled(const SurfaceMesh& mesh, Function function) {
  SurfaceFields fields;
  for (const FieldTransfer transfer : {interpolated, conserved}) {
    auto& on_vertices = fields.on_vertices.emplace_back();
    auto& on_faces = fields.on_faces.emplace_back();
    on_vertices.transfer = on_faces.transfer = transfer;
    for (const Vec3& x : mesh.x) on_vertices.values.add(function(x));
    for (const FaceId f : mesh.faces.ids()) on_faces.values.add(function(center(mesh, f)));
  }
  return fields;
}

/// ∮ f dS of what is conserved.
struct Amounts {
  double on_vertices = 0.0, on_faces = 0.0;
};
Amounts amounts_of(const SurfaceMesh& mesh, const SurfaceFields& fields) {
  Amounts amounts;
  const VertexField<double> areas = vertex_areas(mesh);
  for (const VertexId v : areas.ids())
    amounts.on_vertices += areas[v] * fields.on_vertices[1].values[v];
  for (const FaceId f : mesh.faces.ids())
    amounts.on_faces += face_area_vector(mesh, f).norm() * fields.on_faces[1].values[f];
  return amounts;
}

TEST(CarryFields, MotionKeepsEveryAmountWhereItIs) {
  const SurfaceMesh before = test::bumpy_sphere(300, 1, 0.4);
  SurfaceMesh after = before;
  for (Vec3& x : after.x) x = x.cwiseProduct(Vec3(0.8, 1.0, 1.0));
  const SurfaceFields start = sampled(before, [](const Vec3& x) { return std::cos(x.x()); });
  SurfaceFields fields = start;
  const FieldExcess excess = move_fields(fields, before, after);
  EXPECT_EQ(fields.on_vertices[0], start.on_vertices[0]);
  EXPECT_EQ(fields.on_faces[0], start.on_faces[0]);
  double highest = 0.0;
  for (const FaceId f : before.faces.ids()) {
    const double amount = face_area_vector(before, f).norm() * start.on_faces[1].values[f];
    EXPECT_NEAR(face_area_vector(after, f).norm() * fields.on_faces[1].values[f], amount,
                1e-14 * std::abs(amount));
  }
  for (const auto& value : fields.on_vertices[1].values)
    highest = std::max(highest, value - std::ranges::max(start.on_vertices[1].values));
  for (const auto& value : fields.on_faces[1].values)
    highest = std::max(highest, value - std::ranges::max(start.on_faces[1].values));
  EXPECT_GT(highest, 0.0);  // faces shrink where the cosine is largest
  EXPECT_EQ(excess.above, highest);
}

// Through the deformation of leveque1996 and back.
TEST(CarryFields, GoThroughTwoHundredRemeshedSteps) {
  constexpr int kSteps = 200;
  constexpr double kPeriod = 0.75, kStep = kPeriod / kSteps;
  SurfaceMesh mesh = sphere(150);
  for (Vec3& x : mesh.x) x = test::kDeformedCenter + test::kDeformedRadius * x.normalized();
  const auto wave = [](const Vec3& x) { return 2.0 + std::cos(20.0 * x.x()); };
  SurfaceFields fields = sampled(mesh, wave);
  const Amounts start = amounts_of(mesh, fields);
  const auto [low, high] = std::ranges::minmax(fields.on_vertices[0].values);
  const RemeshOptions options = sound_remeshing(150.0 / (4.0 * std::numbers::pi));
  int remeshed = 0;
  for (int step = 0; step < kSteps; ++step) {
    const SurfaceMesh before = mesh;
    test::advect(mesh, step * kStep, kStep, kPeriod);
    static_cast<void>(move_fields(fields, before, mesh));
    remeshed += remesh(mesh, options, fields).ok() ? 1 : 0;
  }
  EXPECT_EQ(remeshed, kSteps);
  const Amounts end = amounts_of(mesh, fields);
  EXPECT_NEAR(end.on_vertices, start.on_vertices, 1e-12 * start.on_vertices);
  EXPECT_NEAR(end.on_faces, start.on_faces, 1e-12 * start.on_faces);
  EXPECT_LE(std::ranges::max(fields.on_vertices[0].values), high);
  EXPECT_GE(std::ranges::min(fields.on_vertices[0].values), low);
}

TEST(CarryFields, ConservedOnesConvergeThroughARemesh) {
  const auto smooth = [](const Vec3& x) { return std::sin(2.0 * x.x()) + x.y() * x.z(); };
  std::vector<double> vertices, vertex_errors, face_errors;
  for (const int n : {400, 1600, 6400}) {
    SurfaceMesh mesh = stretched_sphere(n, Vec3(2, 1, 1));
    SurfaceFields fields = sampled(mesh, smooth);
    ASSERT_TRUE(remesh(mesh, {.C0 = n / (4.0 * std::numbers::pi)}, fields).ok());
    double on_vertices = 0.0, on_faces = 0.0;
    for (const VertexId v : mesh.x.ids())
      on_vertices += std::pow(fields.on_vertices[1].values[v] - smooth(mesh.x[v]), 2);
    for (const FaceId f : mesh.faces.ids())
      on_faces += std::pow(fields.on_faces[1].values[f] - smooth(center(mesh, f)), 2);
    vertices.push_back(mesh.num_vertices());
    vertex_errors.push_back(std::sqrt(on_vertices / mesh.num_vertices()));
    face_errors.push_back(std::sqrt(on_faces / mesh.num_faces()));
  }
  EXPECT_GT(test::observed_order(vertices, vertex_errors), 2.5);
  EXPECT_LT(vertex_errors.back(), 1e-4);
  EXPECT_GT(test::observed_order(vertices, face_errors), 1.8);
}

// Another triangulation of the same surface, as a repair leaves it.
TEST(CarryFields, ReplacedElementsTakeValuesOfSecondOrder) {
  const auto smooth = [](const Vec3& x) { return std::sin(2.0 * x.x()) + x.y() * x.z(); };
  std::vector<double> vertices, vertex_errors, face_errors, conserved_errors;
  for (const int n : {400, 1600, 6400}) {
    const SurfaceMesh before = sphere(n);
    SurfaceMesh after = before;
    for (Vec3& x : after.x) x = Vec3(0.6 * x.x() + 0.8 * x.z(), x.y(), 0.6 * x.z() - 0.8 * x.x());
    const ReplacedFields replaced = replaced_fields(sampled(before, smooth), before, after);
    double on_vertices = 0.0, on_faces = 0.0, conserved_faces = 0.0;
    for (const VertexId v : after.x.ids())
      on_vertices += std::pow(replaced.fields.on_vertices[0].values[v] - smooth(after.x[v]), 2);
    for (const FaceId f : after.faces.ids()) {
      on_faces += std::pow(replaced.fields.on_faces[0].values[f] - smooth(center(after, f)), 2);
      conserved_faces +=
          std::pow(replaced.fields.on_faces[1].values[f] - smooth(center(after, f)), 2);
    }
    vertices.push_back(n);
    vertex_errors.push_back(std::sqrt(on_vertices / after.num_vertices()));
    face_errors.push_back(std::sqrt(on_faces / after.num_faces()));
    conserved_errors.push_back(std::sqrt(conserved_faces / after.num_faces()));
  }
  EXPECT_GT(test::observed_order(vertices, vertex_errors), 1.8);
  EXPECT_GT(test::observed_order(vertices, face_errors), 1.8);
  RecordProperty("interpolated", fmt::format("{:.2e}", fmt::join(face_errors, " ")));
  RecordProperty("conserved", fmt::format("{:.2e}", fmt::join(conserved_errors, " ")));
}

}  // namespace
}  // namespace meniscus
