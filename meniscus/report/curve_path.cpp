#include "meniscus/report/curve_path.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace meniscus::report {
namespace {

// A plot is about 500 px wide, so two points per pixel show everything.
constexpr std::size_t most_points = 1000;

bool is_gap(const PicturePoint& p) { return !std::isfinite(p.x) || !std::isfinite(p.y); }

/// The lowest and the highest point of each bucket of neighbours, in order, and both ends of the
/// curve.
std::vector<PicturePoint> min_max_envelope(std::span<const PicturePoint> points) {
  if (points.size() <= most_points) return {points.begin(), points.end()};
  std::vector<PicturePoint> kept = {points.front()};
  const std::size_t num_buckets = most_points / 2;
  for (std::size_t b = 0; b < num_buckets; ++b) {
    const std::size_t begin = b * points.size() / num_buckets;
    const std::size_t end = (b + 1) * points.size() / num_buckets;
    const auto bucket = points.subspan(begin, end - begin);
    auto [low, high] = std::ranges::minmax_element(bucket, {}, &PicturePoint::y);
    if (high < low) std::swap(low, high);
    kept.push_back(*low);
    if (high != low) kept.push_back(*high);
  }
  kept.push_back(points.back());
  return kept;
}

void add_piece(CurvePath& path, std::span<const PicturePoint> piece) {
  if (piece.empty()) return;
  if (piece.size() == 1) return path.dots.push_back(piece.front());
  char command = 'M';
  for (const PicturePoint& p : min_max_envelope(piece)) {
    path.line += fmt::format("{}{:.1f} {:.1f}", command, p.x, p.y);
    command = 'L';
  }
}

}  // namespace

CurvePath curve_path(std::span<const PicturePoint> points) {
  CurvePath path;
  while (!points.empty()) {
    const auto end = std::ranges::find_if(points, is_gap);
    const auto length = static_cast<std::size_t>(end - points.begin());
    add_piece(path, points.first(length));
    points = points.subspan(std::min(length + 1, points.size()));
  }
  return path;
}

}  // namespace meniscus::report
