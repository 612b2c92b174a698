#include "tests/flow/fem/box_mesh.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <random>

#include <Eigen/Geometry>

#include "meniscus/flow/fem/face_elements.hpp"

namespace meniscus::fem {
namespace {

using Lattice = std::array<int, 3>;

/// Lattice points in the order boundary, interior.
std::map<Lattice, TetVertexId> numbered_lattice(int n, std::int32_t& num_boundary) {
  std::map<Lattice, TetVertexId> vertex;
  std::int32_t next = 0;
  for (const bool wants_boundary : {true, false}) {
    for (int i = 0; i <= n; ++i)
      for (int j = 0; j <= n; ++j)
        for (int k = 0; k <= n; ++k) {
          const bool is_boundary = i % n == 0 || j % n == 0 || k % n == 0;
          if (is_boundary == wants_boundary) vertex[{i, j, k}] = TetVertexId{next++};
        }
    if (wants_boundary) num_boundary = next;
  }
  return vertex;
}

void add_cube(const std::map<Lattice, TetVertexId>& vertex, const Lattice& corner, TetMesh& mesh) {
  std::array<std::size_t, 3> axes = {0, 1, 2};
  do {  // one tetrahedron for every path along three edges to the opposite corner
    Lattice at = corner;
    CellVertices cell;
    cell[0] = vertex.at(at);
    for (std::size_t s = 0; s < 3; ++s) {
      ++at[axes[s]];
      cell[s + 1] = vertex.at(at);
    }
    mesh.cells.add(cell);
    mesh.region.add(RegionId{0});
    const CellId c{mesh.num_cells() - 1};
    if (signed_volume(mesh, c) < 0.0) std::swap(mesh.cells[c][2], mesh.cells[c][3]);
  } while (std::ranges::next_permutation(axes).found);
}

int side(const Vec3& a, const Vec3& b, const Vec3& c) {
  for (int k = 0; k < 3; ++k)
    for (const double at : {-1.0, 1.0})
      if (a[k] == at && b[k] == at && c[k] == at) return 2 * k + (at > 0.0 ? 1 : 0);
  return -1;
}

/// The facet opposite to each local vertex, outward.
constexpr std::array<std::array<std::size_t, 3>, 4> facets = {
    {{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};

void add_boundary(BoxMesh& box, std::int32_t num_boundary) {
  TetMesh& mesh = box.mesh;
  mesh.boundary.first_vertex = TetVertexId{0};
  mesh.boundary.num_vertices = num_boundary;
  for (std::int32_t v = 0; v < num_boundary; ++v) box.boundary.mesh.x.add(mesh.x[TetVertexId{v}]);
  for (const CellId c : mesh.cells.ids())
    for (const auto& facet : facets) {
      const CellVertices& v = mesh.cells[c];
      const int at = side(mesh.x[v[facet[0]]], mesh.x[v[facet[1]]], mesh.x[v[facet[2]]]);
      if (at < 0) continue;
      box.boundary.mesh.faces.add(
          {VertexId{v[facet[0]].value}, VertexId{v[facet[1]].value}, VertexId{v[facet[2]].value}});
      box.boundary.patch.add(PatchId{at});
      mesh.boundary.sides.add({c, CellId{}});
    }
  for (const char* name : {"-x", "+x", "-y", "+y", "-z", "+z"})
    box.boundary.patches.add({name, NoPenetration{}});
}

}  // namespace

BoxMesh box_mesh(const BoxOptions& options) {
  BoxMesh box;
  TetMesh& mesh = box.mesh;
  std::int32_t num_boundary = 0;
  const auto vertex = numbered_lattice(options.n, num_boundary);
  const double edge = 2.0 / options.n;
  mesh.x = Field<TetVertexId, Vec3>(static_cast<std::int32_t>(vertex.size()), Vec3::Zero());
  for (const auto& [p, v] : vertex) mesh.x[v] = Vec3(p[0], p[1], p[2]) * edge - Vec3::Ones();
  for (int i = 0; i < options.n; ++i)
    for (int j = 0; j < options.n; ++j)
      for (int k = 0; k < options.n; ++k) add_cube(vertex, {i, j, k}, mesh);
  for (const CellId c : mesh.cells.ids()) {
    Vec3 centroid = Vec3::Zero();
    for (const TetVertexId v : mesh.cells[c]) centroid += 0.25 * mesh.x[v];
    mesh.region[c] = RegionId{options.region(centroid)};
  }
  add_boundary(box, num_boundary);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(-options.jitter * edge, options.jitter * edge);
  for (std::int32_t v = num_boundary; v < mesh.num_vertices(); ++v) {
    Vec3& x = mesh.x[TetVertexId{v}];
    const bool is_in_plane = std::abs(x.z()) < 1e-12;
    x += Vec3(uniform(random), uniform(random), is_in_plane ? 0.0 : uniform(random));
  }
  for (Vec3& x : mesh.x) x = options.rotation * x;
  for (Vec3& x : box.boundary.mesh.x) x = options.rotation * x;
  return box;
}

std::vector<std::array<TetVertexId, 3>> interface_faces(const TetMesh& mesh) {
  using Face = std::array<TetVertexId, 3>;
  std::map<Face, Face> inner;  // sorted → oriented out of region 1
  std::vector<Face> result;
  const auto visit = [&](RegionId region, auto action) {
    for (const CellId c : mesh.cells.ids())
      for (const auto& facet : facets) {
        if (mesh.region[c] != region) continue;
        const CellVertices& v = mesh.cells[c];
        const Face oriented = {v[facet[0]], v[facet[1]], v[facet[2]]};
        Face sorted = oriented;
        std::ranges::sort(sorted);
        action(sorted, oriented);
      }
  };
  visit(RegionId{1},
        [&](const Face& sorted, const Face& oriented) { inner.emplace(sorted, oriented); });
  visit(RegionId{0}, [&](const Face& sorted, const Face&) {
    const auto found = inner.find(sorted);
    if (found != inner.end()) result.push_back(found->second);
  });
  return result;
}

void add_traction_jump(const std::function<Vec3(const Vec3& x, const Vec3& n)>& jump,
                       StokesProblem& problem) {
  std::map<std::array<TetVertexId, 2>, NodeId> middle;
  for (std::size_t e = 0; e < problem.space.edges.size(); ++e)
    middle[problem.space.edges[e]] =
        NodeId{problem.space.num_vertices() + static_cast<std::int32_t>(e)};
  for (const auto& face : interface_faces(problem.mesh)) {
    std::vector<NodeId> nodes = {node_at(face[0]), node_at(face[1]), node_at(face[2])};
    for (std::size_t k = 0; !middle.empty() && k < 3; ++k)
      nodes.push_back(
          middle.at({std::min(face[k], face[(k + 1) % 3]), std::max(face[k], face[(k + 1) % 3])}));
    for (const FacePoint& point : face_points(problem.positions.x, nodes)) {
      const Vec3 part = point.area.norm() * jump(point.x, point.area.normalized());
      for (std::size_t i = 0; i < nodes.size(); ++i)
        problem.force[nodes[i]] -= point.value[i] * part;
    }
  }
}

void impose_everywhere(OuterBoundary& boundary, std::function<Vec3(const Vec3&)> velocity,
                       bool is_linear_flow) {
  for (const PatchId patch : boundary.patches.ids())
    boundary.patches[patch].condition =
        ImposedVelocity{[velocity](const Vec3& x, double) { return velocity(x); }, is_linear_flow};
}

}  // namespace meniscus::fem
