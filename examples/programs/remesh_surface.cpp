// Lesson 1: a surface from a file, with better triangles.
//
//   remesh_surface                       # the lesson: makes a torus, remeshes it, checks it
//   remesh_surface PART.stl ERROR OUT    # the same for a closed surface of yours
//
// ERROR is the largest distance allowed between a face and the smooth surface, in the unit of the
// file. Formats go by extension: stl, ply, obj, off, vtp; vtu is read alone.
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <numbers>

#include "meniscus/core/error.hpp"
#include "meniscus/io/surface_file.hpp"
#include "meniscus/mesh/surface_distance.hpp"
#include "meniscus/mesh/surface_quality.hpp"
#include "meniscus/solids/remesh_target.hpp"
#include "meniscus/solids/solid_check.hpp"

namespace {

using namespace meniscus;

// A torus has its volume and area in closed form, and a hole that a remesher might close.
constexpr double kMajor = 1.0, kMinor = 0.4, kPi = std::numbers::pi;
constexpr double kVolume = 2.0 * kPi * kPi * kMajor * kMinor * kMinor;
constexpr double kArea = 4.0 * kPi * kPi * kMajor * kMinor;

// A SurfaceMesh is two lists: points, and triples of points. `add` returns the id of what it added.
// Ids are strong types: a VertexId never stands where a FaceId is meant. Faces are
// counter-clockwise seen from outside. These are long and thin, as from a lathe.
SurfaceMesh lathed_torus(int columns, int rows) {
  SurfaceMesh mesh;
  for (int i = 0; i < columns; ++i)
    for (int j = 0; j < rows; ++j) {
      const double u = 2.0 * kPi * i / columns, v = 2.0 * kPi * j / rows;
      const double r = kMajor + kMinor * std::cos(v);
      mesh.x.add(Vec3(r * std::cos(u), r * std::sin(u), kMinor * std::sin(v)));
    }
  const auto vertex = [&](int i, int j) { return VertexId{i % columns * rows + j % rows}; };
  for (int i = 0; i < columns; ++i)
    for (int j = 0; j < rows; ++j) {
      mesh.faces.add({vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1)});
      mesh.faces.add({vertex(i, j), vertex(i + 1, j + 1), vertex(i, j + 1)});
    }
  return mesh;
}

// What comes from outside is checked before it is used. A fault is a value with a line of text:
// open edges, faces inside out, faces that cross, and where.
SurfaceMesh read_closed(const std::filesystem::path& file) {
  SurfaceMesh mesh = io::read_surface(file).mesh;
  if (const auto fault = find_solid_defect(mesh))
    reject_input("{}: {}", file.string(), fault->text);
  return mesh;
}

void print(const char* name, const SurfaceQuality& q) {
  std::printf(
      "%-7s %5d vertices, genus %d, volume %.6f, area %.6f, smallest angles %.0f in the mean, %.1f "
      "at least\n",
      name, q.num_vertices, q.genus, q.volume, q.area, q.mean_min_angle_deg, q.min_angle_deg);
}

// The remesher works on a copy of what was read, so that both can be held beside each other.
// An expected failure is no exception: the report says why, and the mesh is as it was.
SurfaceMesh remeshed(const SurfaceMesh& given, double error) {
  SurfaceMesh mesh = given;
  const TargetReport report =
      remesh_to(mesh, {.by = RemeshTarget::By::chordal_error, .value = error});
  if (!report.ok()) throw RunFailure(report.text());
  print("before:", surface_quality(given, SurfaceTopology(given)));
  print("after:", surface_quality(mesh, SurfaceTopology(mesh)));
  std::printf("error of chords: asked %g, reached %.6f%s\n", error, report.reached,
              report.is_met ? "" : " (the shape allows no better)");
  // The Hausdorff distance looks at whole faces, not at vertices alone. Here it is mostly the
  // distance of the given faces from the smooth surface.
  std::printf("distance of the two surfaces: %.6f\n", hausdorff_distance(given, mesh).distance);
  return mesh;
}

// How far corners and centres of faces are from the torus itself: what no mesh was told.
double distance_from_torus(const SurfaceMesh& mesh) {
  const auto distance = [](const Vec3& x) {
    return std::abs(std::hypot(std::hypot(x.x(), x.y()) - kMajor, x.z()) - kMinor);
  };
  double largest = 0.0;
  for (const FaceVertices& f : mesh.faces) {
    const Vec3 &a = mesh.x[f[0]], &b = mesh.x[f[1]], &c = mesh.x[f[2]];
    for (const Vec3& x : {a, Vec3((a + b) / 2.0), Vec3((a + b + c) / 3.0)})
      largest = std::max(largest, distance(x));
  }
  return largest;
}

// The lesson is a test as well: it fails where the result is not the torus.
bool lesson() {
  constexpr double kError = 0.006;
  io::write_surface("torus.stl", lathed_torus(40, 32));
  const SurfaceMesh mesh = remeshed(read_closed("torus.stl"), kError);
  io::write_surface("torus-remeshed.stl", mesh);
  const SurfaceQuality q = surface_quality(mesh, SurfaceTopology(mesh));
  const double off = distance_from_torus(mesh);
  std::printf("against the torus: volume %+.1e, area %+.1e, distance %.6f\n",
              q.volume / kVolume - 1.0, q.area / kArea - 1.0, off);
  // The mesh keeps the volume of the smooth surface through the given points, which is nearer to
  // the torus than faces are: a tenth of what a layer as thick as the error holds. Area feels the
  // corners of faces more.
  return q.genus == 1 && q.mean_min_angle_deg > 45.0 && off < 1.2 * kError &&
         std::abs(q.volume / kVolume - 1.0) < 0.1 * kError / kMinor &&
         std::abs(q.area / kArea - 1.0) < 0.3 * kError / kMinor;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    if (argc == 4) {
      io::write_surface(argv[3], remeshed(read_closed(argv[1]), std::atof(argv[2])));
      return 0;
    }
    return lesson() ? 0 : 1;
  } catch (const std::exception& error) {  // one line says what was wrong with which file
    std::fprintf(stderr, "remesh_surface: %s\n", error.what());
    return 2;
  }
}
