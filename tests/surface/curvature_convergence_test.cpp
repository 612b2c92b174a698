// Orders of the estimates of curvature and of the smooth surface, on relaxed meshes of
// surfaces whose curvature is known.
#include <array>
#include <functional>

#include <gtest/gtest.h>

#include "meniscus/core/error.hpp"
#include "meniscus/surface/quartic_curvature.hpp"
#include "meniscus/surface/smooth_surface.hpp"
#include "tests/surface/implicit_shapes.hpp"
#include "tests/surface/jet_curvature.hpp"

namespace meniscus {
namespace {

using test::ImplicitShape;

using Estimate = std::function<VertexField<VertexCurvature>(const SurfaceMesh&)>;

VertexField<VertexCurvature> fitted(const SurfaceMesh& mesh) {
  return fitted_curvature(mesh, SurfaceTopology(mesh));
}
VertexField<VertexCurvature> osculating(const SurfaceMesh& mesh) {
  return osculating_curvature(mesh, SurfaceTopology(mesh));
}

/// The curvatures of the cubic patches of two rings that make the smooth surface.
VertexField<VertexCurvature> of_patches(const SurfaceMesh& mesh) {
  const SmoothSurface surface(mesh, SurfaceTopology(mesh));
  VertexField<VertexCurvature> result(mesh.num_vertices());
  for (const VertexId v : mesh.x.ids()) result[v] = surface.patch(v).curvature();
  return result;
}

VertexField<VertexCurvature> quartics_of(const SurfaceMesh& mesh) {
  const SurfaceTopology topology(mesh);
  return quartic_curvature(mesh, topology, osculating_curvature(mesh, topology));
}

VertexField<VertexCurvature> jets_of(const SurfaceMesh& mesh) {
  return test::jet_curvature(mesh, SurfaceTopology(mesh));
}

/// Root mean square errors over the vertices.
struct Errors {
  double sum, k1, k2, normal;
};

Errors errors_of(const ImplicitShape& shape, const SurfaceMesh& mesh, const Estimate& estimate) {
  const VertexField<VertexCurvature> found = estimate(mesh);
  Errors e{};
  for (const VertexId v : mesh.x.ids()) {
    const test::ExactShape exact = test::exact_shape(shape, mesh.x[v]);
    e.sum += std::pow(found[v].sum() - exact.k1 - exact.k2, 2);
    e.k1 += std::pow(found[v].k1 - exact.k1, 2);
    e.k2 += std::pow(found[v].k2 - exact.k2, 2);
    e.normal += (found[v].n - exact.n).squaredNorm();
  }
  for (double* value : {&e.sum, &e.k1, &e.k2, &e.normal})
    *value = std::sqrt(*value / mesh.num_vertices());
  return e;
}

struct Orders {
  Errors order, finest;
};

Orders orders_of(const ImplicitShape& shape, const std::vector<SurfaceMesh>& meshes,
                 const Estimate& estimate) {
  std::vector<double> vertices;
  std::array<std::vector<double>, 4> errors;
  Errors last{};
  for (const SurfaceMesh& mesh : meshes) {
    last = errors_of(shape, mesh, estimate);
    vertices.push_back(mesh.num_vertices());
    const std::array values{last.sum, last.k1, last.k2, last.normal};
    for (std::size_t i = 0; i < 4; ++i) errors[i].push_back(values[i]);
  }
  const auto order = [&](std::size_t i) { return test::observed_order(vertices, errors[i]); };
  return {{order(0), order(1), order(2), order(3)}, last};
}

std::vector<SurfaceMesh> relaxed_meshes(const ImplicitShape& shape, double coarsest) {
  std::vector<SurfaceMesh> meshes;
  for (const double factor : {1.0, 2.0, 4.0, 8.0})
    meshes.push_back(test::relaxed_mesh(shape, factor * coarsest));
  return meshes;
}

void print(const char* estimate, const ImplicitShape& shape, const Orders& o) {
  std::printf(
      "%-10s %-9s order: sum %.2f k1 %.2f k2 %.2f normal %.2f; finest %.2g %.2g %.2g %.2g\n",
      estimate, shape.name.c_str(), o.order.sum, o.order.k1, o.order.k2, o.order.normal,
      o.finest.sum, o.finest.k1, o.finest.k2, o.finest.normal);
}

TEST(CurvatureConvergence, OfPatchesQuarticsAndJets) {
  // The orders asserted are 0.2 below those of theory: cubic patches 2, normals 3; jets of degree 4
  // 3 and 4; quartics 3.
  for (const ImplicitShape& shape : test::implicit_shapes()) {
    const std::vector<SurfaceMesh> meshes = relaxed_meshes(shape, 40.0);
    const Orders patches = orders_of(shape, meshes, of_patches);
    print("patches", shape, patches);
    for (const double order : {patches.order.sum, patches.order.k1, patches.order.k2})
      EXPECT_GT(order, 1.8) << shape.name;
    EXPECT_GT(patches.order.normal, 2.8) << shape.name;
    const Orders quartics = orders_of(shape, meshes, quartics_of);
    print("quartics", shape, quartics);
    for (const double order : {quartics.order.sum, quartics.order.k1, quartics.order.k2})
      EXPECT_GT(order, 2.8) << shape.name;
    // Fourth order in theory; 3.1 on the torus, where the finest error is 5e-6.
    EXPECT_GT(quartics.order.normal, 2.8) << shape.name;
    const Orders jets = orders_of(shape, meshes, jets_of);
    print("jets", shape, jets);
    for (const double order : {jets.order.sum, jets.order.k1, jets.order.k2})
      EXPECT_GT(order, 2.8) << shape.name;
    EXPECT_GT(jets.order.normal, 3.8) << shape.name;
  }
}

TEST(CurvatureConvergence, OfOneRingFits) {
  // Second order where rings are even; at vertices of valence 5 and 7, a third of all, the ring's
  // odd parts leave an error of first order, small: between the two on the whole, and the nearer
  // to one the finer the meshes. The sum suffers less than the difference. (0.77 the lowest of
  // twelve, on meshes whose uneven vertices are where chance has put them.)
  for (const ImplicitShape& shape : test::implicit_shapes()) {
    const std::vector<SurfaceMesh> meshes = relaxed_meshes(shape, 20.0);
    const Orders paraboloid = orders_of(shape, meshes, fitted);
    print("paraboloid", shape, paraboloid);
    EXPECT_GT(paraboloid.order.sum, 1.8) << shape.name;
    EXPECT_GT(paraboloid.order.normal, 1.8) << shape.name;
    const Orders circles = orders_of(shape, meshes, osculating);
    print("osculating", shape, circles);
    EXPECT_GT(circles.order.sum, 1.3) << shape.name;
    EXPECT_GT(circles.order.normal, 1.8) << shape.name;
    for (const double order :
         {paraboloid.order.k1, paraboloid.order.k2, circles.order.k1, circles.order.k2})
      EXPECT_GT(order, 0.7) << shape.name;
    // These errors are of curvatures up to 3.
    EXPECT_LT(std::max(circles.finest.k1, circles.finest.k2), 0.015) << shape.name;
  }
}

TEST(CurvatureConvergence, OfTheSmoothSurfaceAtEdgeMidpointsIsFourthOrder) {
  for (const ImplicitShape& shape : test::implicit_shapes()) {
    std::vector<double> vertices, position, largest, normal;
    for (const SurfaceMesh& mesh : relaxed_meshes(shape, 20.0)) {
      const SurfaceTopology topology(mesh);
      const SmoothSurface surface(mesh, topology);
      double worst = 0.0, distance = 0.0, tilt = 0.0;
      for (const SurfaceEdge& e : topology.edges()) {
        const Vec3 x = surface.edge_point(e.a, e.b, 0.5);
        Vec3 weights = Vec3::Constant(0.5);  // of the left face: zero at the corner off the edge
        for (int k = 0; k < 3; ++k)
          if (mesh.faces[e.left][static_cast<std::size_t>(k)] == e.left_opposite) weights[k] = 0.0;
        const test::ExactShape exact = test::exact_shape(shape, x);
        const double d = test::signed_distance(shape, x);
        worst = std::max(worst, std::abs(d));
        distance += d * d;
        tilt += (surface.normal(e.left, weights) - exact.n).squaredNorm();
      }
      const auto count = static_cast<double>(topology.edges().size());
      vertices.push_back(mesh.num_vertices());
      largest.push_back(worst);
      position.push_back(std::sqrt(distance / count));
      normal.push_back(std::sqrt(tilt / count));
    }
    const auto order = [&](const std::vector<double>& e) {
      return test::observed_order(vertices, e);
    };
    std::printf(
        "surface    %-9s order: position %.2f largest %.2f normal %.2f; finest %.2g %.2g %.2g\n",
        shape.name.c_str(), order(position), order(largest), order(normal), position.back(),
        largest.back(), normal.back());
    EXPECT_GT(order(position), 3.5) << shape.name;  // 4 in theory; 3.80 to 3.96 measured
    EXPECT_GT(order(largest), 3.0) << shape.name;
    EXPECT_GT(order(normal), 2.8) << shape.name;
  }
}

TEST(JetCurvature, AgreesWithTheFitsToTheirError) {
  const SurfaceMesh mesh = test::torus(150, 60, 1.0, 0.4);
  const VertexField<VertexCurvature> fit = fitted(mesh), jet = jets_of(mesh);
  for (const VertexId v : mesh.x.ids()) {
    EXPECT_NEAR(fit[v].k1, jet[v].k1, 0.01 / 0.4);  // h²/8r² of the arc h = 2πr/60 is 0.0014
    EXPECT_NEAR(fit[v].k2, jet[v].k2, 0.03);
    EXPECT_NEAR(std::abs(fit[v].d1.dot(jet[v].d1)), 1.0, 1e-3);
    EXPECT_GT(fit[v].n.dot(jet[v].n), 1.0 - 1e-5);
    EXPECT_NEAR(jet[v].d1.cross(jet[v].d2).dot(jet[v].n), 1.0, 1e-12);
  }
  const SurfaceMesh tiny = sphere(12);
  EXPECT_THROW((void)jets_of(tiny), InvalidInput);
}

/// Vertices of valence 3 and 4 in a relaxed mesh: a vertex put into a face, and one on an edge.
TEST(LowValence, LeavesTheFitsRegularAndTheirErrorsNearTheNeighbours) {
  const ImplicitShape shape = test::implicit_ellipsoid(Vec3(1.5, 1.0, 0.8));
  SurfaceMesh mesh = test::relaxed_mesh(shape, 80.0);
  const std::int32_t first = mesh.num_vertices();
  for (std::int32_t i = 0; i < 300; i += 30) {  // valence 3
    const FaceVertices f = mesh.faces[FaceId{i}];
    const VertexId m =
        mesh.x.add(test::projected(shape, (mesh.x[f[0]] + mesh.x[f[1]] + mesh.x[f[2]]) / 3.0));
    mesh.faces[FaceId{i}] = {f[0], f[1], m};
    mesh.faces.add({f[1], f[2], m});
    mesh.faces.add({f[2], f[0], m});
  }
  const SurfaceTopology before(mesh);
  const SurfaceEdge edge = before.edges()[before.edges().size() / 2];  // valence 4
  const VertexId m = mesh.x.add(test::projected(shape, 0.5 * (mesh.x[edge.a] + mesh.x[edge.b])));
  for (const auto& [face, to] : {std::pair(edge.left, edge.b), {edge.right, edge.a}}) {
    const FaceVertices old = mesh.faces[face];
    FaceVertices replaced = old, added = old;
    const VertexId from = to == edge.b ? edge.a : edge.b;
    for (std::size_t k = 0; k < 3; ++k) {
      if (old[k] == to) replaced[k] = m;
      if (old[k] == from) added[k] = m;
    }
    mesh.faces[face] = replaced;
    mesh.faces.add(added);
  }
  const SurfaceTopology topology(mesh);
  EXPECT_EQ(topology.valence(VertexId{first}), 3);
  EXPECT_EQ(topology.valence(m), 4);
  for (const Estimate& estimate : {Estimate(fitted), Estimate(osculating)}) {
    const VertexField<VertexCurvature> found = estimate(mesh);
    const double typical = errors_of(shape, mesh, estimate).sum;
    for (VertexId v{first}; v.value < mesh.num_vertices(); ++v.value) {
      const test::ExactShape exact = test::exact_shape(shape, mesh.x[v]);
      EXPECT_TRUE(std::isfinite(found[v].k1) && std::isfinite(found[v].k2));
      EXPECT_LT(std::abs(found[v].sum() - exact.k1 - exact.k2), 10.0 * typical) << v.value;
      EXPECT_GT(found[v].n.dot(exact.n), 0.9999);
    }
  }
}

}  // namespace
}  // namespace meniscus
