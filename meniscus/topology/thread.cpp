#include "meniscus/topology/thread.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

namespace meniscus {
namespace {

constexpr double kStep = 0.25;  // radii between sections: a neck's minimum is parabolic over one
constexpr int kMaxSections = 2000;  // a thread of 500 radii; drops break long before
constexpr int kAlignments = 4;      // each halves the tilt of the first section, or better
constexpr double kCube = 3.0;       // half of the cube looked at, in the widest radius

/// The direction that the normals of the faces around a point avoid most: a thread's axis. Faces
/// count by the square of the cosine at which they face the point. Else the flat sides of a plate
/// would outdo the rim of its hole.
std::optional<Vec3> axis_guess(const SurfaceTree& tree, const Vec3& center, Side side,
                               double radius) {
  Mat3 sum = Mat3::Zero();
  const Vec3 half = Vec3::Constant(radius);
  tree.visit_box(center - half, center + half, [&](FaceId, const Triangle& x) {
    const Vec3 area = 0.5 * (x[1] - x[0]).cross(x[2] - x[0]);
    const double size = area.norm();
    const Vec3 from_center = (x[0] + x[1] + x[2]) / 3.0 - center;
    const double facing = -sign_of(side) * area.dot(from_center);
    if (size > 0.0 && facing > 0.0)
      sum += std::pow(facing / (size * from_center.norm()), 2) * area * area.transpose() / size;
    return true;
  });
  if (!(sum.trace() > 0.0)) return std::nullopt;
  const Eigen::SelfAdjointEigenSolver<Mat3> eigen(sum);
  return Vec3(eigen.eigenvectors().col(0));
}

/// The first section, its plane turned until it is normal to the thread.
SectionResult first_section(const SurfaceMesh& mesh, const SurfaceTree& tree, const Vec3& within,
                            Side side, double widest) {
  const double reach = kCube * widest;
  const std::optional<Vec3> axis = axis_guess(tree, within, side, widest);
  if (!axis) return {};
  SectionResult middle = section_around(mesh, tree, within, *axis, reach);
  for (int i = 0; i < kAlignments && middle.kind == SectionKind::closed; ++i) {
    const Section& s = middle.section;
    const Vec3 shift = kStep * s.radius * s.axis;
    const SectionResult before = section_around(mesh, tree, s.center - shift, s.axis, reach),
                        after = section_around(mesh, tree, s.center + shift, s.axis, reach);
    if (before.kind != SectionKind::closed || after.kind != SectionKind::closed) break;
    const Vec3 along = after.section.center - before.section.center;
    if (along.dot(s.axis) <= 0.0) break;
    middle = section_around(mesh, tree, s.center, along.normalized(), reach);
  }
  return middle;
}

/// What lies where no further section is found. A drop's thread ends there; the hole of a shell
/// that bends away on both sides opens there, unless it has become narrower before.
ThreadEnd end_without_section(Side side, double radius, double first_radius) {
  return side == Side::outside && radius > 0.9 * first_radius ? ThreadEnd::wide : ThreadEnd::tip;
}

/// Sections from the first one on in the direction of `axis`, the first left out; returns what
/// ended them.
ThreadEnd follow(const SurfaceMesh& mesh, const SurfaceTree& tree, Side side, const Section& first,
                 Vec3 axis, double widest, std::vector<Section>& sections) {
  const Vec3 start = first.center;
  Vec3 center = first.center;
  double radius = first.radius;
  for (int i = 0; i < kMaxSections; ++i) {
    const double step = kStep * radius;
    SectionResult next = section_around(mesh, tree, center + step * axis, axis, kCube * widest);
    if (next.kind == SectionKind::wide) return ThreadEnd::wide;
    if (next.kind == SectionKind::none) return end_without_section(side, radius, first.radius);
    Section& section = next.section;
    if (section.radius > widest) return ThreadEnd::wide;
    const Vec3 along = section.center - center;
    // A curve that is not the thread's next one: what was followed has ended.
    if (along.norm() > radius + step || along.dot(axis) <= 0.0)
      return end_without_section(side, radius, first.radius);
    if (section.radius < 0.05 * first.radius) return ThreadEnd::tip;
    axis = along.normalized();
    center = section.center;
    radius = section.radius;
    sections.push_back(std::move(section));
    if (i > 6 && (center - start).norm() < step) return ThreadEnd::ring;
  }
  return ThreadEnd::wide;
}

}  // namespace

Thread thread_through(const SurfaceMesh& mesh, const SurfaceTree& tree, const Vec3& within,
                      Side side, double widest) {
  Thread thread;
  SectionResult first = first_section(mesh, tree, within, side, widest);
  if (first.kind != SectionKind::closed || first.section.radius > widest) return thread;
  std::vector<Section> backward;
  const Vec3 axis = first.section.axis;
  thread.front = follow(mesh, tree, side, first.section, -axis, widest, backward);
  std::ranges::reverse(backward);
  thread.sections = std::move(backward);
  thread.sections.push_back(first.section);
  if (thread.front == ThreadEnd::ring) {
    thread.back = ThreadEnd::ring;
    return thread;
  }
  thread.back = follow(mesh, tree, side, first.section, axis, widest, thread.sections);
  return thread;
}

}  // namespace meniscus
