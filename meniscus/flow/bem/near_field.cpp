#include "meniscus/flow/bem/near_field.hpp"

#include <algorithm>
#include <numbers>
#include <utility>

#include <Eigen/Geometry>

#include "meniscus/core/error.hpp"
#include "meniscus/flow/bem/face_moments.hpp"
#include "meniscus/flow/bem/near_faces.hpp"

namespace meniscus::bem {
namespace {

using Face = InterfaceElements::Face;
using Surface = BoundaryGeometry::Surface;

/// ∮ rr (r·n)/r⁵ dS seen from the surface itself and from within: 4π/6 and 8π/6 times the identity;
/// from outside, nothing. It is −1/6 of the integral of the stress kernel.
constexpr double kOnSurface = 2.0 * std::numbers::pi / 3.0;
constexpr double kInside = 2.0 * kOnSurface;

void add_identity(Symmetric& m, double factor) {
  for (std::size_t k = 0; k < 3; ++k) m[k] += factor;
}

/// The density of the single layer at the nodes of all faces, by surface.
using NodeDensity = std::vector<FaceField<NodeValues>>;

NodeDensity node_density(const BoundaryGeometry& geometry, const std::vector<double>& q) {
  NodeDensity density;
  for (const Surface& surface : geometry.surfaces) {
    VertexField<double> at_vertices;
    for (std::int32_t j = surface.range.begin; j < surface.range.end; ++j)
      at_vertices.add(q[static_cast<std::size_t>(j)]);
    FaceField<NodeValues>& at_nodes = density.emplace_back();
    for (const Face& face : surface.elements.faces) at_nodes.add(node_values(face, at_vertices));
  }
  return density;
}

/// Builds one row after another; keeps an array over all nodes for the columns of the row at hand.
class RowBuilder {
 public:
  RowBuilder(const BoundaryGeometry& geometry, const std::vector<double>& q,
             const NodeDensity& node_density, const std::vector<bool>& has_double_layer)
      : geometry_(geometry),
        q_(q),
        node_density_(node_density),
        has_double_layer_(has_double_layer),
        dense_(static_cast<std::size_t>(geometry.num_nodes())),
        share_(static_cast<std::size_t>(geometry.size()), 0.0),
        is_touched_(dense_.size(), false) {}

  NearRow row(std::int32_t i) {
    row_ = {};
    x_ = geometry_.points.point(i);
    for (std::size_t m = 0; m < geometry_.surfaces.size(); ++m) add_surface(m, i);
    std::ranges::sort(row_.columns);
    for (const std::int32_t c : row_.columns) {
      const auto at = static_cast<std::size_t>(c);
      row_.double_layer.push_back(dense_[at]);
      dense_[at] = {};
      is_touched_[at] = false;
    }
    return std::move(row_);
  }

 private:
  void add_surface(std::size_t m, std::int32_t i) {
    const Surface& surface = geometry_.surfaces[m];
    const auto own = static_cast<std::size_t>(geometry_.surface_of[static_cast<std::size_t>(i)]);
    find_near_faces(geometry_, m, i, near_);
    if (near_.empty()) return;
    // The rule's integrals of constants. They differ from the exact ones by the error that the
    // subtraction removes.
    constant_ = constant_layers(m);
    for (const FaceId f : near_) add_face(m, f, i);
    remove_vertex_rule(m, i);
    if (own == m) {
      subtract(m, i, q_[static_cast<std::size_t>(i)], 1.0, kOnSurface);
      return;
    }
    const SurfaceTree::Hit nearest = surface.tree.closest(x_);
    const Vec3& b = nearest.weights;
    const NodeValues weights = quadratic_values({b[0], b[1], b[2]});
    const auto nodes = geometry_.nodes(m, nearest.face);
    const bool is_inside = geometry_.surfaces[own].is_inside_of[m];
    for (std::size_t a = 0; a < weights.size(); ++a)
      subtract(m, nodes[a], node_density_[m][nearest.face][a], weights[a],
               is_inside ? kInside : 0.0);
  }

  [[nodiscard]] ConstantLayers constant_layers(std::size_t m) {
    const SourceRange range = geometry_.surfaces[m].range;
    if (has_double_layer_[m]) return constant_layer_sums(geometry_.points, range, x_);
    ones_.resize(static_cast<std::size_t>(range.end - range.begin), 1.0);
    return {.single = single_layer_sum(geometry_.points, range, ones_, x_), .double_layer = {}};
  }

  void add_face(std::size_t m, FaceId f, std::int32_t i) {
    const Face& face = geometry_.surfaces[m].elements.faces[f];
    const FaceMoments moments = face_moments(face, corner_at(geometry_, m, f, i), x_,
                                             node_density_[m][f], has_double_layer_[m]);
    row_.single += moments.single;
    constant_.single += moments.constant;
    if (has_double_layer_[m]) {
      const auto nodes = geometry_.nodes(m, f);
      for (std::size_t a = 0; a < nodes.size(); ++a) add_double(nodes[a], moments.double_layer[a]);
    }
    for (std::size_t c = 0; c < face.columns.size(); ++c)
      add_share(geometry_.index(m, face.columns[c]), face.share[c]);
  }

  void add_share(std::int32_t j, double share) {
    double& sum = share_[static_cast<std::size_t>(j)];
    if (sum == 0.0) with_share_.push_back(j);
    sum += share;
  }

  /// Takes away what the weights of the vertices gave for the near faces.
  void remove_vertex_rule(std::size_t m, std::int32_t i) {
    const Surface& surface = geometry_.surfaces[m];
    for (const std::int32_t j : with_share_) {
      const double share = std::exchange(share_[static_cast<std::size_t>(j)], 0.0);
      if (j == i) continue;
      const VertexId v{j - surface.range.begin};
      const Vec3 r = surface.elements.x[v] - x_, area = -share * surface.elements.n[v];
      if (has_double_layer_[m]) {
        const LayerKernels kernels = layer_kernels(r, area);
        add_single(j, kernels.single);
        add_double(j, kernels.double_layer);
      } else {
        add_single(j, single_layer_kernel(r, area));
      }
    }
    with_share_.clear();
  }

  void add_single(std::int32_t j, const Vec3& kernel) {
    row_.single += q_[static_cast<std::size_t>(j)] * kernel;
    constant_.single += kernel;
  }

  void add_double(std::int32_t node, const Symmetric& kernel) {
    add(at(node), 1.0, kernel);
    add(constant_.double_layer, 1.0, kernel);
  }

  /// Replaces the rule's integral of the constant weight × (value at node j) by the exact one; q is
  /// the single layer's density there.
  void subtract(std::size_t m, std::int32_t j, double q, double weight, double exact) {
    row_.single -= weight * q * constant_.single;
    if (!has_double_layer_[m]) return;
    add(at(j), -weight, constant_.double_layer);
    add_identity(at(j), weight * exact);
  }

  Symmetric& at(std::int32_t j) {
    const auto k = static_cast<std::size_t>(j);
    if (!is_touched_[k]) row_.columns.push_back(j);
    is_touched_[k] = true;
    return dense_[k];
  }

  const BoundaryGeometry& geometry_;
  const std::vector<double>& q_;
  const NodeDensity& node_density_;
  const std::vector<bool>& has_double_layer_;
  std::vector<Symmetric> dense_;
  std::vector<double> share_;  // weights of the vertices in the rule on the near faces
  std::vector<std::int32_t> with_share_;
  std::vector<bool> is_touched_;
  Vec3 x_ = Vec3::Zero();
  NearRow row_;
  ConstantLayers constant_;
  std::vector<FaceId> near_;
  std::vector<double> ones_;
};

}  // namespace

std::vector<NearRow> near_rows(const BoundaryGeometry& geometry, const std::vector<double>& q,
                               const std::vector<bool>& has_double_layer,
                               const SharedPoints& shared) {
  MENISCUS_ASSERT(q.size() == static_cast<std::size_t>(geometry.size()),
                  "{} densities of {} points", q.size(), geometry.size());
  MENISCUS_ASSERT(has_double_layer.size() == geometry.surfaces.size(), "{} marks of {} surfaces",
                  has_double_layer.size(), geometry.surfaces.size());
  std::vector<NearRow> rows(static_cast<std::size_t>(geometry.size()));
  const NodeDensity at_nodes = node_density(geometry, q);
  shared.for_own([&](std::int32_t begin, std::int32_t end) {
    RowBuilder builder(geometry, q, at_nodes, has_double_layer);
    for (std::int32_t i = begin; i < end; ++i) rows[static_cast<std::size_t>(i)] = builder.row(i);
  });
  return rows;
}

}  // namespace meniscus::bem
