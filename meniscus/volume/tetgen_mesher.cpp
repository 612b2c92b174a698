#include "meniscus/volume/tetgen_mesher.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <ctime>
#include <exception>
#include <memory>
#include <unordered_map>
#include <utility>

#include <Eigen/Geometry>
#include <fmt/format.h>
#include <tetgen.h>

#include "meniscus/core/error.hpp"
#include "meniscus/volume/tetgen_assertions.hpp"

namespace meniscus {
namespace {

using Point = const double*;

Vec3 position(Point p) { return {p[0], p[1], p[2]}; }

/// The size law at TetGen's vertices. TetGen tests each vertex with each new tetrahedron around it,
/// dozens of times; it may also free a vertex and use its memory again, so an entry holds only for
/// the coordinates it was made for.
class SizeTest {
 public:
  SizeTest(const std::function<double(const Vec3&)>& size, double volume_factor)
      : size_(size), volume_factor_(volume_factor) {}

  bool is_too_large(Point a, Point b, Point c, Point d) {
    const double h = 0.25 * (size(a) + size(b) + size(c) + size(d));
    const Vec3 o = position(a);
    const double volume =
        std::abs((position(b) - o).cross(position(c) - o).dot(position(d) - o)) / 6.0;
    return volume > volume_factor_ * h * h * h / (6.0 * std::sqrt(2.0));
  }

 private:
  double size(Point p) {
    const auto [entry, is_new] = known_.try_emplace(p);
    if (is_new || entry->second.x != position(p)) entry->second = {position(p), size_(position(p))};
    return entry->second.size;
  }
  struct Known {
    Vec3 x = Vec3::Zero();
    double size = 0.0;
  };
  const std::function<double(const Vec3&)>& size_;
  double volume_factor_;
  std::unordered_map<Point, Known> known_;
};

/// TetGen's hook is a bare function pointer, so the test it should use travels beside it.
thread_local SizeTest* current_test = nullptr;

bool is_unsuitable(REAL* a, REAL* b, REAL* c, REAL* d, REAL*, REAL) {
  return current_test != nullptr && current_test->is_too_large(a, b, c, d);
}

class ActiveSizeTest {
 public:
  explicit ActiveSizeTest(SizeTest& test) { current_test = &test; }
  ActiveSizeTest(const ActiveSizeTest&) = delete;
  ActiveSizeTest& operator=(const ActiveSizeTest&) = delete;
  ~ActiveSizeTest() { current_test = nullptr; }
};

/// TetGen's view of a complex. It points into vectors kept here, and lets go of them before
/// TetGen's destructor would free them.
class TetgenInput {
 public:
  explicit TetgenInput(const SurfaceComplex& complex)
      : corners_(3 * complex.triangles.size()),
        polygons_(complex.triangles.size()),
        facets_(complex.triangles.size()) {
    coordinates_.reserve(3 * complex.x.size());
    for (const Vec3& x : complex.x) coordinates_.insert(coordinates_.end(), x.begin(), x.end());
    for (std::size_t f = 0; f < facets_.size(); ++f) {
      std::copy(complex.triangles[f].begin(), complex.triangles[f].end(), &corners_[3 * f]);
      polygons_[f] = {&corners_[3 * f], 3};
      facets_[f] = {&polygons_[f], 1, nullptr, 0};
    }
    io_.firstnumber = 0;
    io_.pointlist = coordinates_.data();
    io_.numberofpoints = static_cast<int>(complex.x.size());
    io_.facetlist = facets_.data();
    io_.numberoffacets = static_cast<int>(facets_.size());
    io_.tetunsuitable = is_unsuitable;
  }
  TetgenInput(const TetgenInput&) = delete;
  TetgenInput& operator=(const TetgenInput&) = delete;
  ~TetgenInput() {
    io_.pointlist = nullptr;
    io_.facetlist = nullptr;
    io_.numberoffacets = 0;
  }
  tetgenio& io() { return io_; }

 private:
  std::vector<double> coordinates_;
  std::vector<int> corners_;
  std::vector<tetgenio::polygon> polygons_;
  std::vector<tetgenio::facet> facets_;
  tetgenio io_;
};

/// What the integers mean that TetGen throws.
std::string meaning(int code) {
  switch (code) {
    case 1:
      return "out of memory";
    case 2:
      return "an internal error";
    case 3:
      return "surfaces that intersect";
    case 4:
      return "features smaller than its tolerance";
    case 5:
      return "facets nearer than its tolerance";
    case 10:
      return "an input it cannot read";
    default:
      return fmt::format("error {}", code);
  }
}

void read_output(const tetgenio& out, MesherResult& result) {
  result.x.reserve(out.numberofpoints);
  for (int i = 0; i < out.numberofpoints; ++i) result.x.add(position(out.pointlist + 3 * i));
  result.cells.reserve(out.numberoftetrahedra);
  for (int c = 0; c < out.numberoftetrahedra; ++c) {
    const int* v = out.tetrahedronlist + c * out.numberofcorners;
    result.cells.add({TetVertexId{v[0]}, TetVertexId{v[1]}, TetVertexId{v[2]}, TetVertexId{v[3]}});
  }
}

/// TetGen's working mesh. Before TetGen throws its `int` it frees the mesh's memory, and its
/// destructor would free it again (as it does in TetGen's own driver, which therefore cannot be
/// used): after such an exception the destructor must not run.
class TetgenMesh {
 public:
  TetgenMesh() : mesh_(std::construct_at(reinterpret_cast<tetgenmesh*>(storage_))) {}
  TetgenMesh(const TetgenMesh&) = delete;
  TetgenMesh& operator=(const TetgenMesh&) = delete;
  ~TetgenMesh() {
    if (!is_freed_) std::destroy_at(mesh_);
  }
  /// Runs one phase.
  template <class Result, class... Parameters, class... Args>
  void run(Result (tetgenmesh::*phase)(Parameters...), Args&&... args) {
    try {
      (mesh_->*phase)(std::forward<Args>(args)...);
    } catch (int) {
      is_freed_ = true;
      throw;
    }
  }
  tetgenmesh* operator->() { return mesh_; }

 private:
  alignas(tetgenmesh) std::byte storage_[sizeof(tetgenmesh)];
  tetgenmesh* mesh_;
  bool is_freed_ = false;
};

/// The phases of TetGen for given facets that are to be kept whole (-pY).
void mesh_facets(tetgenbehavior& behavior, tetgenio& in, tetgenio& out) {
  TetgenMesh mesh;
  mesh->b = &behavior;
  mesh->in = &in;
  clock_t ignored = 0;
  mesh.run(&tetgenmesh::initializepools);
  mesh.run(&tetgenmesh::transfernodes);
  exactinit(behavior.verbose, behavior.noexact, behavior.nostaticfilter, mesh->xmax - mesh->xmin,
            mesh->ymax - mesh->ymin, mesh->zmax - mesh->zmin);
  mesh.run(&tetgenmesh::incrementaldelaunay, ignored);
  mesh.run(&tetgenmesh::meshsurface);
  mesh.run(&tetgenmesh::recoverboundary, ignored);
  mesh.run(&tetgenmesh::carveholes);
  mesh.run(&tetgenmesh::suppresssteinerpoints);
  mesh.run(&tetgenmesh::recoverdelaunay);
  if (behavior.quality != 0) mesh.run(&tetgenmesh::delaunayrefinement);
  if (behavior.optlevel > 0) mesh.run(&tetgenmesh::optimizemesh);
  mesh.run(&tetgenmesh::outnodes, &out);
  mesh.run(&tetgenmesh::outelements, &out);
}

/// Points are inserted in rounds, each a multiple of the last, drawn by chance. Another multiple is
/// another order, in which points that fail an assertion of TetGen's in one come out well.
void mesh_in_some_order(tetgenbehavior& behavior, tetgenio& in, tetgenio& out) {
  const TetgenAssertionsThrow guard;
  const double first = behavior.brio_ratio;
  for (const double ratio : {first, 2.0 * first, 3.0 * first, 4.0 * first}) {
    behavior.brio_ratio = ratio;
    try {
      return mesh_facets(behavior, in, out);
    } catch (const TetgenAssertion&) {
      if (ratio == 4.0 * first) throw;
    }
  }
}

}  // namespace

std::vector<std::string> tetgen_switches(double radius_edge) {
  return {fmt::format("pYMq{}/10o/140Q", radius_edge),
          fmt::format("pYMq{}/0T1e-12Q", radius_edge + 0.6),
          "pYMq20/0T1e-13Q",  // sizes only, whatever the shapes
          "pYMT1e-14Q"};      // no vertices beyond those that the facets' recovery needs
}

MesherResult run_tetgen(const SurfaceComplex& complex, const std::string& switches,
                        const std::function<double(const Vec3&)>& size, double volume_factor) {
  MesherResult result;
  tetgenbehavior behavior;
  std::string mutable_switches = switches;
  [[maybe_unused]] const bool is_understood = behavior.parse_commandline(mutable_switches.data());
  MENISCUS_ASSERT(is_understood, "TetGen does not know the switches {}", switches);

  SizeTest test(size, volume_factor);
  const ActiveSizeTest active(test);
  TetgenInput input(complex);
  try {
    tetgenio output;
    mesh_in_some_order(behavior, input.io(), output);
    read_output(output, result);
  } catch (int code) {
    result.failure = fmt::format("TetGen -{} found {}", switches, meaning(code));
  } catch (const std::exception& fault) {
    result.failure = fmt::format("TetGen -{} failed: {}", switches, fault.what());
  }
  return result;
}

}  // namespace meniscus
