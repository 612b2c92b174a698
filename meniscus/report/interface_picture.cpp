#include "meniscus/report/interface_picture.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "meniscus/mesh/surface_measures.hpp"
#include "meniscus/report/text.hpp"
#include "meniscus/report/ticks.hpp"

namespace meniscus::report {
namespace {

constexpr double margin = 10.0;  // [px] around the widest frame
// [px] Triangles are written as whole multiples of this length: short text, finer than any screen.
constexpr double subpixel = 0.1;
// How much whiter edges are than their face, so that the mesh shows but does not dominate.
constexpr double edge_whiteness = 0.2;

/// The box of a frame along the axes of the view [R0].
struct Box {
  Vec3 low, high;
};

Box box_of(const SurfaceFrame& frame, const View& view) {
  Box box{Vec3::Constant(1e300), Vec3::Constant(-1e300)};
  for (const Vec3& x : frame.mesh.x) {
    const Vec3 p(view.right.dot(x), view.up.dot(x), view.toward.dot(x));
    box.low = box.low.cwiseMin(p);
    box.high = box.high.cwiseMax(p);
  }
  return box;
}

View flow_plane_view() {
  View view;
  view.toward = Vec3(0.30, 0.38, 1.0).normalized();  // 20° above the flow plane, 17° beside it
  view.right = Vec3::UnitY().cross(view.toward).normalized();
  view.up = view.toward.cross(view.right);
  return view;
}

/// The shaded colour of a face with unit normal n. Neither the darkest nor the brightest side loses
/// its hue.
Color lit_color(const Color& color, const View& view, const Vec3& n) {
  const Vec3 light = (-0.45 * view.right + 0.6 * view.up + 0.75 * view.toward).normalized();
  const double share = std::max(0.0, n.dot(light));
  return tint(shade(color, 0.72 + 0.36 * share), 0.16 * share * share);
}

Color face_color(const SurfaceFrame& frame, FaceId f, const ValueRange& range) {
  constexpr Color plain = {0.45, 0.62, 0.75};  // colour of a frame without curvature
  if (frame.curvature.empty()) return plain;
  double mean = 0.0;
  for (const VertexId v : frame.mesh.faces[f]) mean += frame.curvature[v] / 3.0;
  return range.color(mean);
}

/// The faces turned to the viewer, the farthest first.
std::vector<FaceId> visible_faces(const SurfaceFrame& frame, const View& view) {
  std::vector<FaceId> faces;
  FaceField<double> nearness(frame.mesh.num_faces());
  for (const FaceId f : frame.mesh.faces.ids()) {
    if (face_area_vector(frame.mesh, f).dot(view.toward) <= 0.0) continue;
    for (const VertexId v : frame.mesh.faces[f]) nearness[f] += view.toward.dot(frame.mesh.x[v]);
    faces.push_back(f);
  }
  std::ranges::stable_sort(faces, {}, [&](FaceId f) { return nearness[f]; });
  return faces;
}

/// The longest of 1, 2 and 5 times a power of ten that is not above `room`.
double longest_round_length(double room) {
  const double power = std::pow(10.0, std::floor(std::log10(room)));
  for (const double digit : {5.0, 2.0})
    if (digit * power <= room) return digit * power;
  return power;
}

}  // namespace

View common_view(std::span<const SurfaceFrame> frames, double width) {
  View view = flow_plane_view();
  Vec3 extent = Vec3::Constant(1e-12);
  for (const SurfaceFrame& frame : frames) {
    const Box box = box_of(frame, view);
    extent = extent.cwiseMax(box.high - box.low);
  }
  // The picture must not be taller than wide.
  view.scale = (width - 2.0 * margin) / std::max(extent.x(), extent.y());
  view.width = width;
  view.height = std::ceil(view.scale * extent.y() + 2.0 * margin);
  return view;
}

ValueRange curvature_range(std::span<const SurfaceFrame> frames) {
  std::vector<double> all;
  for (const SurfaceFrame& frame : frames) {
    all.insert(all.end(), frame.curvature.begin(), frame.curvature.end());
  }
  return color_range(all);
}

bool have_curvature(std::span<const SurfaceFrame> frames) {
  return std::ranges::all_of(frames, [](const SurfaceFrame& f) { return !f.curvature.empty(); });
}

std::string draw_surface(const SurfaceFrame& frame, const View& view, const ValueRange& range) {
  const Box box = box_of(frame, view);
  const Vec3 center = 0.5 * (box.low + box.high);
  struct Point {
    long x = 0, y = 0;
  };
  VertexField<Point> points;
  for (const Vec3& x : frame.mesh.x) {
    const double right = view.right.dot(x) - center.x(), up = view.up.dot(x) - center.y();
    points.add({std::lround((0.5 * view.width + view.scale * right) / subpixel),
                std::lround((0.5 * view.height - view.scale * up) / subpixel)});
  }
  std::string text = fmt::format(R"x(<g class="mesh" transform="scale({})" stroke-width="{}">)x",
                                 subpixel, 0.6 / subpixel);
  for (const FaceId f : visible_faces(frame, view)) {
    const FaceVertices& face = frame.mesh.faces[f];
    const Point a = points[face[0]], b = points[face[1]], c = points[face[2]];
    const Vec3 n = face_area_vector(frame.mesh, f).stableNormalized();
    const Color color = lit_color(face_color(frame, f, range), view, n);
    text += fmt::format(R"(<path fill="{}" stroke="{}" d="M{} {}l{} {} {} {}z"/>)", hex(color),
                        hex(tint(color, edge_whiteness)), a.x, a.y, b.x - a.x, b.y - a.y, c.x - b.x,
                        c.y - b.y);
  }
  return text + "</g>";
}

std::string draw_color_bar(const ValueRange& range, std::string_view label, double x, double y,
                           double width) {
  constexpr int num_strips = 64;                     // finer than the eye resolves on this length
  constexpr double thickness = 10.0, overlap = 1.2;  // strips overlap so that no seam shows
  std::string text;
  for (int i = 0; i < num_strips; ++i) {
    text += fmt::format(
        R"(<rect x="{:.1f}" y="{:.1f}" width="{:.1f}" height="{}" fill="{}"/>)",
        x + width * i / num_strips, y, width / num_strips + (i + 1 < num_strips ? overlap : 0.0),
        thickness, hex(range.color(range.low + (i + 0.5) / num_strips * (range.high - range.low))));
  }
  const Ticks ticks = linear_ticks(range.low, range.high, 5, false);
  for (std::size_t i = 0; i < ticks.values.size(); ++i) {
    const double at = x + width * range.fraction(ticks.values[i]);
    text += fmt::format(
        R"(<path class="ax" d="M{0:.1f} {1:.1f}v4"/>)"
        R"(<text class="small" x="{0:.1f}" y="{2:.1f}" text-anchor="middle">{3}</text>)",
        at, y + thickness, y + thickness + 16.0, ticks.labels[i]);
  }
  const std::string factor = ticks.factor.empty() ? "" : " (" + ticks.factor + ")";
  return text + fmt::format(R"(<text x="{:.1f}" y="{:.1f}">{}</text>)", x, y - 7.0,
                            markup_text(label) + factor);
}

std::string draw_key(const View& view, const ValueRange& range, bool has_colors) {
  std::string text;
  if (has_colors) {
    text += draw_color_bar(range, "Curvature κ = k₁ + k₂ [1/R₀]", 10.0, 24.0, 260.0);
  }
  const double shown = longest_round_length(120.0 / view.scale), length = shown * view.scale;
  const std::string name = shown == 1.0 ? "R₀" : number_text(shown, 1) + " R₀";
  text += fmt::format(R"(<path class="ax" d="M310 29h{0:.1f}m0 -4v8m-{0:.1f} 0v-8"/>)"
                      R"(<text x="{1:.1f}" y="17" text-anchor="middle">{2}</text>)",
                      length, 310.0 + 0.5 * length, name);
  const double x = 490.0, y = 44.0, arrow = 26.0;  // the axes
  const char* names[] = {"x", "y", "z"};
  for (int k = 0; k < 3; ++k) {
    const Vec3 axis = Vec3::Unit(k);
    const double dx = arrow * view.right.dot(axis), dy = -arrow * view.up.dot(axis);
    text += fmt::format(R"(<path class="ax" d="M{0:.1f} {1:.1f}l{2:.1f} {3:.1f}"/>)"
                        R"(<text class="small" font-style="italic" x="{4:.1f}" y="{5:.1f}" )"
                        R"(text-anchor="middle">{6}</text>)",
                        x, y, dx, dy, x + 1.4 * dx, y + 1.4 * dy + 4.0, names[k]);
  }
  return text;
}

}  // namespace meniscus::report
