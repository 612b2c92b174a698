#include "meniscus/transport/carrier_surface.hpp"

#include "meniscus/core/error.hpp"
#include "meniscus/mesh/surface_measures.hpp"
#include "meniscus/surface/edge_interpolation.hpp"

namespace meniscus {
namespace {

using EdgeNumbers = FaceField<std::array<std::size_t, 3>>;

/// The middles of all edges, in the order of the topology.
std::vector<Vec3> middles_of(const SurfaceMesh& mesh, const SurfaceTopology& topology,
                             const EdgeNumbers& edges, const ReconstructedSurface& surface) {
  std::vector<Vec3> middles;
  for (const auto& edge : topology.edges())
    middles.push_back(0.5 * (mesh.x[edge.a] + mesh.x[edge.b]));
  if (surface.smooth())
    for (const FaceId f : mesh.faces.ids()) {
      const auto& x = surface.quadratic_faces()[f];
      const Vec3 origin = mesh.x[mesh.faces[f][0]] - x[0];
      for (std::size_t k = 0; k < 3; ++k) middles[edges[f][k]] = origin + x[3 + k];
    }
  return middles;
}

/// E: the values of vertices stay, those of middles are sums of them.
CarrierSurface::Interpolation interpolation_to(const SurfaceMesh& mesh,
                                               const std::vector<Stencil>& stencils) {
  std::vector<Eigen::Triplet<double>> entries;
  for (const VertexId v : mesh.x.ids()) entries.emplace_back(v.value, v.value, 1.0);
  int node = mesh.num_vertices();
  for (const Stencil& stencil : stencils) {
    for (const VertexWeight& each : stencil)
      entries.emplace_back(node, each.vertex.value, each.weight);
    ++node;
  }
  CarrierSurface::Interpolation matrix(node, mesh.num_vertices());
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

VertexField<Vec3> normals_of(const SurfaceMesh& mesh, const ReconstructedSurface& surface) {
  if (surface.smooth()) return surface.smooth()->vertex_normals();
  VertexField<Vec3> normals = vertex_area_vectors(mesh);
  for (Vec3& n : normals) n.normalize();
  return normals;
}

}  // namespace

CarrierSurface::CarrierSurface(const SurfaceMesh& mesh, SurfaceShape shape)
    : mesh_(mesh), surface_(mesh, shape), nodes_(mesh.num_faces()) {
  const SurfaceTopology topology(mesh);
  const EdgeNumbers edges = face_edges(mesh, topology);
  for (const FaceId f : mesh.faces.ids())
    for (std::size_t k = 0; k < 3; ++k) {
      nodes_[f][k] = mesh.faces[f][k].value;
      nodes_[f][3 + k] = mesh.num_vertices() + static_cast<int>(edges[f][k]);
    }
  at_nodes_ = interpolation_to(mesh, edge_stencils(mesh, topology, normals_of(mesh, surface_),
                                                   middles_of(mesh, topology, edges, surface_)));
}

TriangleTangents CarrierSurface::tangents_at(FaceId f,
                                             const TriangleShape<kQuadraticNodes>& shape) const {
  if (!surface_.quadratic_faces().empty()) return tangents(shape, surface_.quadratic_faces()[f]);
  const FaceVertices& v = mesh_.faces[f];
  return {mesh_.x[v[1]] - mesh_.x[v[0]], mesh_.x[v[2]] - mesh_.x[v[0]]};
}

double CarrierSurface::area_at(FaceId f, std::size_t q) const {
  const auto& [b, share] = kTriangleRule4[q];
  return share * tangents_at(f, quadratic_shape(b)).area().norm();
}

CarrierSurface::Points CarrierSurface::points(FaceId f) const {
  MENISCUS_ASSERT(f.value < mesh_.num_faces(), "{} of {}", f.value, mesh_.num_faces());
  Points points;
  for (std::size_t q = 0; q < points.size(); ++q) {
    const auto& [b, share] = kTriangleRule4[q];
    const TriangleShape<kQuadraticNodes> shape = quadratic_shape(b);
    const TriangleTangents at = tangents_at(f, shape);
    const TriangleGradients g = surface_gradients(at);
    points[q].value = shape.value;
    for (std::size_t i = 0; i < kQuadraticNodes; ++i)
      points[q].gradient[i] = shape.by_1[i] * g.g1 + shape.by_2[i] * g.g2;
    points[q].area = share * at.area().norm();
  }
  return points;
}

FaceField<CarrierSurface::NodeMatrix> CarrierSurface::masses() const {
  std::array<NodeMatrix, kTriangleRule4.size()> products;  // of the ψ at each point
  for (std::size_t q = 0; q < products.size(); ++q) {
    const auto shape = quadratic_shape(kTriangleRule4[q].barycentric);
    const Eigen::Map<const Eigen::Vector<double, kQuadraticNodes>> value(shape.value.data());
    products[q] = value * value.transpose();
  }
  FaceField<NodeMatrix> mass(mesh_.num_faces(), NodeMatrix::Zero());
  for (const FaceId f : mass.ids())
    for (std::size_t q = 0; q < products.size(); ++q) mass[f] += area_at(f, q) * products[q];
  return mass;
}

Eigen::SparseMatrix<double> CarrierSurface::assembled(const FaceField<NodeMatrix>& of_faces) const {
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(NodeMatrix::SizeAtCompileTime * static_cast<std::size_t>(of_faces.size()));
  for (const FaceId f : of_faces.ids())
    for (std::size_t a = 0; a < kQuadraticNodes; ++a)
      for (std::size_t b = 0; b < kQuadraticNodes; ++b)
        entries.emplace_back(
            nodes_[f][a], nodes_[f][b],
            of_faces[f](static_cast<Eigen::Index>(a), static_cast<Eigen::Index>(b)));
  Eigen::SparseMatrix<double> over_nodes(at_nodes_.rows(), at_nodes_.rows());
  over_nodes.setFromTriplets(entries.begin(), entries.end());
  const Eigen::SparseMatrix<double> E = at_nodes_;
  return at_nodes_.transpose() * Eigen::SparseMatrix<double>(over_nodes * E);
}

}  // namespace meniscus
