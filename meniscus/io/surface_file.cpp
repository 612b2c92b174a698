#include "meniscus/io/surface_file.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <span>
#include <string_view>

#include "meniscus/core/error.hpp"
#include "meniscus/io/atomic_file.hpp"
#include "meniscus/io/surface_formats.hpp"
#include "meniscus/io/vtk_file.hpp"

namespace meniscus::io {
namespace {

namespace fs = std::filesystem;

constexpr double kLargestCoordinate = 1e100;  // products of three are taken, of volumes

std::string lower_extension(const fs::path& path) {
  std::string extension = path.extension().string();
  std::ranges::transform(extension, extension.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

// A .vtu is read, for the frames of runs with curved faces, but not written.
constexpr const char *kRead = ".stl, .ply, .obj, .off, .vtp and .vtu",
                     *kWritten = ".stl, .ply, .obj, .off and .vtp";

[[noreturn]] void reject_extension(const fs::path& path, const char* known) {
  reject_input("{}: unknown kind of surface file; known are {}", path.string(), known);
}

/// Tags of the cell array `patch`, if the file has one.
std::vector<int> patch_tags(const fs::path& path, const PolygonFrame& frame) {
  const std::vector<NamedArray>& arrays = frame.on_faces;
  const auto patch = std::ranges::find(arrays, "patch", &NamedArray::name);
  std::vector<int> tags;
  if (patch == arrays.end()) return tags;
  if (patch->components != 1)
    reject_input("{}: the cell array `patch` is no scalar", path.string());
  MENISCUS_ASSERT(patch->values.size() == frame.soup.num_faces(), "{} tags of {} faces",
                  patch->values.size(), frame.soup.num_faces());
  for (const double value : patch->values) {
    // 2³¹: what an int holds
    if (value != std::floor(value) || value < 0.0 || value >= 0x1p31) {
      reject_input("{}: patch = {} is not a whole number from 0 on", path.string(), value);
    }
    tags.push_back(static_cast<int>(value));
  }
  return tags;
}

PolygonSoup tagged_soup(const fs::path& path, PolygonFrame frame) {
  frame.soup.tags = patch_tags(path, frame);
  return std::move(frame.soup);
}

PolygonSoup parse(const fs::path& path) {
  const std::string extension = lower_extension(path);
  if (extension == ".vtp") return tagged_soup(path, read_vtp_polygons(path));
  if (extension == ".vtu") return tagged_soup(path, read_vtu_polygons(path));
  if (extension == ".stl") return parse_stl(path, read_file(path));
  if (extension == ".ply") return parse_ply(path, read_file(path));
  if (extension == ".obj") return parse_obj(path, read_file(path));
  if (extension == ".off") return parse_off(path, read_file(path));
  reject_extension(path, kRead);
}

void check(const fs::path& path, const PolygonSoup& soup) {
  if (soup.num_faces() == 0) reject_input("{}: holds no faces", path.string());
  const auto num_points = static_cast<std::int64_t>(soup.points.size());
  for (std::size_t f = 0; f < soup.num_faces(); ++f) {
    for (const std::int64_t corner : soup.face(f)) {
      if (corner < 0 || corner >= num_points) {
        reject_input("{}: face {} has the point {}; the file has {} points", path.string(), f,
                     corner, num_points);
      }
    }
  }
  for (std::size_t i = 0; i < soup.points.size(); ++i) {
    if (!soup.points[i].allFinite()) {
      reject_input("{}: point {} has a coordinate that is not finite", path.string(), i);
    }
    const double largest = soup.points[i].cwiseAbs().maxCoeff();
    if (largest > kLargestCoordinate) {
      reject_input(
          "{}: point {} has a coordinate of size {:g}, which is too large; at most {:g} is "
          "allowed",
          path.string(), i, largest, kLargestCoordinate);
    }
  }
}

}  // namespace

void require_surface_extension(const fs::path& path) {
  constexpr std::array<std::string_view, 5> known{".stl", ".ply", ".obj", ".off", ".vtp"};
  if (std::ranges::find(known, lower_extension(path)) == known.end())
    reject_extension(path, kWritten);
}

PolygonSoup read_polygons(const fs::path& path) {
  PolygonSoup soup = parse(path);
  check(path, soup);
  return soup;
}

RepairedSurface read_surface(const fs::path& path, bool mends) {
  return surface_of(read_polygons(path), mends);
}

void write_surface(const fs::path& path, const SurfaceMesh& mesh) {
  const std::string extension = lower_extension(path);
  if (extension == ".vtp") {
    const SurfaceMesh* const surfaces[] = {&mesh};
    return write_vtp(path, surfaces, {}, 0.0);
  }
  if (extension == ".stl") return write_file(path, format_stl(path, mesh));
  if (extension == ".ply") return write_file(path, format_ply(mesh));
  if (extension == ".obj") return write_file(path, format_obj(mesh));
  if (extension == ".off") return write_file(path, format_off(mesh));
  reject_extension(path, kWritten);
}

}  // namespace meniscus::io
