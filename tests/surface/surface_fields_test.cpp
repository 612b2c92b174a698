#include "meniscus/surface/surface_fields.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "meniscus/mesh/surface_measures.hpp"
#include "meniscus/surface/remesh.hpp"
#include "tests/surface/shapes.hpp"

namespace meniscus {
namespace {

using enum FieldTransfer;

RemeshOptions with_nodes(int num_vertices) {
  return {.C0 = num_vertices / (4.0 * std::numbers::pi)};
}

double integral(const SurfaceMesh& mesh, const VertexField<double>& values) {
  const auto areas = vertex_areas(mesh);
  double sum = 0.0;
  for (const VertexId v : values.ids()) sum += areas[v] * values[v];
  return sum;
}
double integral(const SurfaceMesh& mesh, const FaceField<double>& values) {
  double sum = 0.0;
  for (const FaceId f : values.ids()) sum += face_area_vector(mesh, f).norm() * values[f];
  return sum;
}
Vec3 center(const SurfaceMesh& mesh, FaceId f) {
  const FaceVertices& v = mesh.faces[f];
  return (mesh.x[v[0]] + mesh.x[v[1]] + mesh.x[v[2]]) / 3.0;
}

SurfaceFields sampled(const SurfaceMesh& mesh, double (*function)(const Vec3&),
                      FieldTransfer transfer) {
  SurfaceFields fields;
  fields.on_vertices.push_back({"f", "", transfer, VertexField<double>(mesh.num_vertices())});
  fields.on_faces.push_back({"f", "", transfer, FaceField<double>(mesh.num_faces())});
  for (const VertexId v : mesh.x.ids()) fields.on_vertices[0].values[v] = function(mesh.x[v]);
  for (const FaceId f : mesh.faces.ids()) fields.on_faces[0].values[f] = function(center(mesh, f));
  return fields;
}

double smooth(const Vec3& x) { return std::sin(2.0 * x.x()) + x.y() * x.z(); }
double spot(const Vec3& x) { return std::exp(-20.0 * (x - Vec3(1, 0, 0)).squaredNorm()); }

// A surface that is stretched, so that splits, collapses and flips happen all over it.
TEST(SurfaceFields, ConservedOnesKeepTheirIntegral) {
  for (const unsigned seed : {1u, 2u, 3u}) {
    SurfaceMesh mesh = test::bumpy_sphere(500, seed, 0.5);
    SurfaceFields fields = sampled(mesh, spot, conserved);
    for (int step = 0; step < 10; ++step) {
      for (Vec3& x : mesh.x) x = x.cwiseProduct(Vec3(1.05, 0.99, 0.97));
      const double on_vertices = integral(mesh, fields.on_vertices[0].values);
      const double on_faces = integral(mesh, fields.on_faces[0].values);
      const RemeshReport report = remesh(mesh, with_nodes(400), fields);
      ASSERT_TRUE(report.ok()) << report.text();
      ASSERT_EQ(fields.on_vertices[0].values.size(), mesh.num_vertices());
      ASSERT_EQ(fields.on_faces[0].values.size(), mesh.num_faces());
      // Sums of a thousand terms of round-off 1e-16.
      EXPECT_NEAR(integral(mesh, fields.on_vertices[0].values), on_vertices, 1e-13 * on_vertices);
      EXPECT_NEAR(integral(mesh, fields.on_faces[0].values), on_faces, 1e-13 * on_faces);
      for (const double value : fields.on_vertices[0].values) EXPECT_GE(value, 0.0);
      for (const double value : fields.on_faces[0].values) EXPECT_GE(value, 0.0);
    }
  }
}

TEST(SurfaceFields, PiecesKeepTheirOwnIntegral) {
  SurfaceMesh mesh = stretched_sphere(200, Vec3(1.5, 1, 1));
  const SurfaceMesh other = stretched_sphere(200, Vec3(1, 1, 2), Vec3(5, 0, 0));
  for (const FaceVertices& f : other.faces) {
    FaceVertices shifted = f;
    for (VertexId& v : shifted) v.value += 200;
    mesh.faces.add(shifted);
  }
  for (const Vec3& x : other.x) mesh.x.add(x);
  const auto integral_beyond = [](const SurfaceMesh& m, const VertexField<double>& values) {
    const auto areas = vertex_areas(m);
    double sum = 0.0;
    for (const VertexId v : values.ids()) sum += m.x[v].x() > 3.0 ? areas[v] * values[v] : 0.0;
    return sum;
  };
  SurfaceFields fields = sampled(mesh, spot, conserved);
  for (double& value : fields.on_vertices[0].values) value += 1.0;
  const double all = integral(mesh, fields.on_vertices[0].values),
               beyond = integral_beyond(mesh, fields.on_vertices[0].values);
  ASSERT_TRUE(remesh(mesh, with_nodes(200), fields).ok());
  EXPECT_NEAR(integral(mesh, fields.on_vertices[0].values), all, 1e-13 * all);
  EXPECT_NEAR(integral_beyond(mesh, fields.on_vertices[0].values), beyond, 1e-13 * all);
}

TEST(SurfaceFields, ConstantsStayConstant) {
  SurfaceMesh mesh = test::bumpy_sphere(500, 4, 0.5);
  const double area = surface_area(mesh);
  SurfaceFields fields = sampled(
      mesh, [](const Vec3&) { return 0.7; }, interpolated);
  SurfaceFields more = sampled(
      mesh, [](const Vec3&) { return 0.7; }, conserved);
  fields.on_vertices.push_back(more.on_vertices[0]);
  fields.on_faces.push_back(more.on_faces[0]);
  ASSERT_TRUE(remesh(mesh, with_nodes(700), fields).ok());
  for (const double value : fields.on_vertices[0].values) EXPECT_EQ(value, 0.7);
  for (const double value : fields.on_faces[0].values) EXPECT_EQ(value, 0.7);
  // What is conserved is spread over the area of the new faces.
  const double spread = 0.7 * area / surface_area(mesh);
  for (const double value : fields.on_vertices[1].values) EXPECT_NEAR(value, spread, 1e-13);
  for (const double value : fields.on_faces[1].values) EXPECT_NEAR(value, spread, 1e-13);
}

TEST(SurfaceFields, AreLeftAloneWhereNothingMoves) {
  SurfaceMesh mesh = test::equilibrated_ellipsoid(400, Vec3(1.5, 1, 1));
  SurfaceFields fields, before;
  SurfaceMesh last;
  for (int i = 0; i < 50 && mesh != last; ++i) {
    last = mesh;
    before = fields = sampled(mesh, smooth, interpolated);
    ASSERT_TRUE(remesh(mesh, with_nodes(400), fields).ok());
  }
  ASSERT_EQ(mesh.faces, last.faces);
  for (const VertexId v : mesh.x.ids()) ASSERT_LT((mesh.x[v] - last.x[v]).norm(), 1e-14);
  for (const VertexId v : mesh.x.ids())
    EXPECT_NEAR(fields.on_vertices[0].values[v], before.on_vertices[0].values[v], 1e-13);
  for (const FaceId f : mesh.faces.ids())
    EXPECT_NEAR(fields.on_faces[0].values[f], before.on_faces[0].values[f], 1e-13);
}

TEST(SurfaceFields, SmoothOnesConverge) {
  std::vector<double> vertices, vertex_errors, face_errors;
  for (const int n : {400, 1600, 6400}) {
    // From an even mesh to one that follows the curvature: every vertex moves or is new.
    const Vec3 axes(2, 1, 1);
    SurfaceMesh mesh = stretched_sphere(n, axes);
    SurfaceFields fields = sampled(mesh, smooth, interpolated);
    ASSERT_TRUE(remesh(mesh, with_nodes(n), fields).ok());
    double on_vertices = 0.0, on_faces = 0.0;
    for (const VertexId v : mesh.x.ids())
      on_vertices += std::pow(fields.on_vertices[0].values[v] - smooth(mesh.x[v]), 2);
    for (const FaceId f : mesh.faces.ids())
      on_faces += std::pow(fields.on_faces[0].values[f] - smooth(center(mesh, f)), 2);
    vertices.push_back(mesh.num_vertices());
    vertex_errors.push_back(std::sqrt(on_vertices / mesh.num_vertices()));
    face_errors.push_back(std::sqrt(on_faces / mesh.num_faces()));
  }
  EXPECT_GT(test::observed_order(vertices, vertex_errors), 2.6);
  EXPECT_GT(test::observed_order(vertices, face_errors), 1.8);
}

TEST(SurfaceFields, AreUnchangedWhenTheRemeshFails) {
  SurfaceMesh mesh = test::bumpy_sphere(300, 1, 0.5);
  SurfaceFields fields = sampled(mesh, smooth, conserved);
  const SurfaceFields before = fields;
  RemeshOptions options = with_nodes(500);
  options.find_fault = [](const SurfaceMesh&) { return Fault{FaultKind::unwanted, "not wanted"}; };
  EXPECT_FALSE(remesh(mesh, options, fields).ok());
  EXPECT_EQ(fields.on_vertices[0].values, before.on_vertices[0].values);
  EXPECT_EQ(fields.on_faces[0].values, before.on_faces[0].values);
}

}  // namespace
}  // namespace meniscus
