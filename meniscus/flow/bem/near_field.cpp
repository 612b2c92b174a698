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

/// Builds one row after another; keeps an array over all nodes for the columns of the row at hand.
class RowBuilder {
 public:
  /// `q` is given at the nodes.
  RowBuilder(const BoundaryGeometry& geometry, const std::vector<double>& q,
             const std::vector<bool>& has_double_layer)
      : geometry_(geometry),
        q_(q),
        has_double_layer_(has_double_layer),
        dense_(q.size()),
        is_touched_(q.size(), false),
        area_(q.size(), Vec3::Zero()) {}

  NearRow row(std::int32_t i) {
    row_ = {};
    x_ = geometry_.nodes.point(i);
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
    remove_node_rule(m, i);
    if (own == m) {
      subtract(m, i, 1.0, kOnSurface);
      return;
    }
    const SurfaceTree::Hit nearest = surface.tree.closest(x_);
    const Vec3& b = nearest.weights;
    const NodeValues weights = quadratic_values({b[0], b[1], b[2]});
    const auto nodes = geometry_.nodes_of(m, nearest.face);
    const bool is_inside = geometry_.surfaces[own].is_inside_of[m];
    for (std::size_t a = 0; a < weights.size(); ++a)
      subtract(m, nodes[a], weights[a], is_inside ? kInside : 0.0);
  }

  [[nodiscard]] ConstantLayers constant_layers(std::size_t m) {
    const Surface& surface = geometry_.surfaces[m];
    ConstantLayers sums;
    for (const SourceRange& range : {surface.range, surface.middles}) {
      if (has_double_layer_[m]) {
        const ConstantLayers part = constant_layer_sums(geometry_.nodes, range, x_);
        sums.single += part.single;
        add(sums.double_layer, 1.0, part.double_layer);
      } else {
        ones_.resize(static_cast<std::size_t>(range.end - range.begin), 1.0);
        sums.single += single_layer_sum(geometry_.nodes, range, ones_, x_);
      }
    }
    return sums;
  }

  void add_face(std::size_t m, FaceId f, std::int32_t i) {
    const Face& face = geometry_.surfaces[m].elements.faces[f];
    const FaceMoments moments = face_moments(face, corner_at(geometry_, m, f, i), x_,
                                             geometry_.on_face(m, f, q_), has_double_layer_[m]);
    row_.single += moments.single;
    constant_.single += moments.constant;
    const auto nodes = geometry_.nodes_of(m, f);
    for (std::size_t a = 0; a < nodes.size(); ++a) {
      if (has_double_layer_[m]) add_double(nodes[a], moments.double_layer[a]);
      add_area(nodes[a], face.area[a]);
    }
  }

  void add_area(std::int32_t node, const Vec3& area) {
    Vec3& sum = area_[static_cast<std::size_t>(node)];
    if (sum == Vec3::Zero()) with_area_.push_back(node);
    sum += area;
  }

  /// Takes away what the areas of the near faces gave at their nodes.
  void remove_node_rule(std::size_t m, std::int32_t i) {
    for (const std::int32_t j : with_area_) {
      const Vec3 area = -std::exchange(area_[static_cast<std::size_t>(j)], Vec3::Zero());
      if (j == i || area == Vec3::Zero()) continue;
      const Vec3 r = geometry_.nodes.point(j) - x_;
      if (has_double_layer_[m]) {
        const LayerKernels kernels = layer_kernels(r, area);
        add_single(j, kernels.single);
        add_double(j, kernels.double_layer);
      } else {
        add_single(j, single_layer_kernel(r, area));
      }
    }
    with_area_.clear();
  }

  void add_single(std::int32_t node, const Vec3& kernel) {
    row_.single += q_[static_cast<std::size_t>(node)] * kernel;
    constant_.single += kernel;
  }

  void add_double(std::int32_t node, const Symmetric& kernel) {
    add(at(node), 1.0, kernel);
    add(constant_.double_layer, 1.0, kernel);
  }

  /// Replaces the rule's integral of the constant weight × (value at node j) by the exact one.
  void subtract(std::size_t m, std::int32_t j, double weight, double exact) {
    row_.single -= weight * q_[static_cast<std::size_t>(j)] * constant_.single;
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
  const std::vector<bool>& has_double_layer_;
  std::vector<Symmetric> dense_;
  std::vector<bool> is_touched_;
  std::vector<Vec3> area_;  // of the near faces at their nodes
  std::vector<std::int32_t> with_area_;
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
  MENISCUS_ASSERT(q.size() == geometry.nodes.x.size(), "{} densities of {} nodes", q.size(),
                  geometry.num_nodes());
  MENISCUS_ASSERT(has_double_layer.size() == geometry.surfaces.size(), "{} marks of {} surfaces",
                  has_double_layer.size(), geometry.surfaces.size());
  std::vector<NearRow> rows(static_cast<std::size_t>(geometry.size()));
  shared.for_own([&](std::int32_t begin, std::int32_t end) {
    RowBuilder builder(geometry, q, has_double_layer);
    for (std::int32_t i = begin; i < end; ++i) rows[static_cast<std::size_t>(i)] = builder.row(i);
  });
  return rows;
}

}  // namespace meniscus::bem
