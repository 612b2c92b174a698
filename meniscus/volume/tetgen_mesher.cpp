#include "meniscus/volume/tetgen_mesher.hpp"

#include <algorithm>
#include <cmath>
#include <csignal>
#include <ctime>
#include <memory>
#include <new>
#include <stdexcept>
#include <utility>

#include <Eigen/Geometry>
#include <fmt/format.h>
#include <tetgen.h>

#include "meniscus/core/child_process.hpp"
#include "meniscus/core/error.hpp"

namespace meniscus {
namespace {

using Point = const double*;

Vec3 position(Point p) { return {p[0], p[1], p[2]}; }

/// The size law at TetGen's vertices. TetGen tests each vertex with each new tetrahedron around it,
/// dozens of times. It may also free a vertex and give its number to another one, so an entry holds
/// only for the coordinates it was made for.
class SizeTest {
 public:
  /// The vertices of `mesh` begin with those of the surfaces at `on_surfaces`, then come those of
  /// the target.
  SizeTest(const CellTarget& target, const std::vector<Vec3>& on_surfaces, tetgenmesh& mesh)
      : target_(target), mesh_(mesh), known_(on_surfaces.size()) {
    for (std::size_t i = 0; i < target.surface_sizes.size(); ++i)
      known_[i] = {on_surfaces[i], target.surface_sizes[i]};
    for (const SizedVertex& vertex : target.vertices) known_.push_back({vertex.x, vertex.size});
  }

  bool is_too_large(Point a, Point b, Point c, Point d) {
    const double h = 0.25 * (size(a) + size(b) + size(c) + size(d));
    const Vec3 o = position(a);
    const double volume =
        std::abs((position(b) - o).cross(position(c) - o).dot(position(d) - o)) / 6.0;
    return volume > target_.volume_factor * h * h * h / (6.0 * std::sqrt(2.0));
  }

 private:
  double size(Point p) {
    const int mark = mesh_.pointmark(const_cast<double*>(p));
    MENISCUS_ASSERT(mark >= 0, "TetGen's vertex {}", mark);
    const auto number = static_cast<std::size_t>(mark);
    if (number >= known_.size()) known_.resize(std::max(number + 1, 2 * known_.size()));
    Known& known = known_[number];
    if (!(known.size > 0.0) || known.x != position(p))
      known = {position(p), target_.size(position(p))};
    return known.size;
  }
  struct Known {
    Vec3 x = Vec3::Zero();
    double size = 0.0;
  };
  const CellTarget& target_;
  tetgenmesh& mesh_;
  std::vector<Known> known_;  // by TetGen's number of the vertex
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

/// TetGen's view of a complex and of vertices between its surfaces. It points into vectors kept
/// here, and lets go of them before TetGen's destructor would free them.
class TetgenInput {
 public:
  TetgenInput(const SurfaceComplex& complex, const std::vector<SizedVertex>& between)
      : corners_(3 * complex.triangles.size()),
        polygons_(complex.triangles.size()),
        facets_(complex.triangles.size()) {
    coordinates_.reserve(3 * (complex.x.size() + between.size()));
    for (const Vec3& x : complex.x) coordinates_.insert(coordinates_.end(), x.begin(), x.end());
    for (const auto& [x, size] : between)
      coordinates_.insert(coordinates_.end(), x.begin(), x.end());
    for (std::size_t f = 0; f < facets_.size(); ++f) {
      std::copy(complex.triangles[f].begin(), complex.triangles[f].end(), &corners_[3 * f]);
      polygons_[f] = {&corners_[3 * f], 3};
      facets_[f] = {&polygons_[f], 1, nullptr, 0};
    }
    io_.firstnumber = 0;
    io_.pointlist = coordinates_.data();
    io_.numberofpoints = static_cast<int>(coordinates_.size() / 3);
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
constexpr int kOutOfMemory = 1;
std::string meaning(int code) {
  switch (code) {
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

/// Mistakes of TetGen's that are met in one order of the points and not in another.
constexpr int kMostOrders = 4;
/// Processor time after which a meshing counts as endless: a hundred times what it takes.
constexpr unsigned kLeastSeconds = 60;
constexpr double kSecondsPerCell = 1e-3;

/// Lets TetGen treat vertices that it was given between the surfaces as its own. It moves those to
/// improve cells.
void free_given_vertices(tetgenmesh& mesh) {
  mesh.points->traversalinit();
  while (tetgenmesh::point p = mesh.pointtraverse())
    if (mesh.pointtype(p) == tetgenmesh::VOLVERTEX) {
      mesh.setpointtype(p, tetgenmesh::FREEVOLVERTEX);
      ++mesh.st_volref_count;
    }
}

/// The phases of TetGen for given facets that are to be kept whole (-pY).
void run_phases(tetgenmesh& mesh, tetgenio& out) {
  const tetgenbehavior& behavior = *mesh.b;
  clock_t ignored = 0;
  mesh.initializepools();
  mesh.transfernodes();
  exactinit(behavior.verbose, behavior.noexact, behavior.nostaticfilter, mesh.xmax - mesh.xmin,
            mesh.ymax - mesh.ymin, mesh.zmax - mesh.zmin);
  mesh.incrementaldelaunay(ignored);
  mesh.meshsurface();
  mesh.recoverboundary(ignored);
  mesh.carveholes();
  mesh.suppresssteinerpoints();
  mesh.recoverdelaunay();
  free_given_vertices(mesh);
  if (behavior.quality != 0) mesh.delaunayrefinement();
  if (behavior.optlevel > 0) mesh.optimizemesh();
  mesh.outnodes(&out);
  mesh.outelements(&out);
}

void read_output(const tetgenio& out, MesherResult& result) {
  result.x.reserve(out.numberofpoints);
  for (int i = 0; i < out.numberofpoints; ++i)
    result.x.add(position(out.pointlist + std::ptrdiff_t{3} * i));
  result.cells.reserve(out.numberoftetrahedra);
  for (int c = 0; c < out.numberoftetrahedra; ++c) {
    const int* v = out.tetrahedronlist + std::ptrdiff_t{c} * out.numberofcorners;
    result.cells.add({TetVertexId{v[0]}, TetVertexId{v[1]}, TetVertexId{v[2]}, TetVertexId{v[3]}});
  }
}

/// Throws what TetGen finds as a runtime_error.
void mesh_complex(const SurfaceComplex& complex, tetgenbehavior behavior, const CellTarget& target,
                  MesherResult& result) {
  TetgenInput input(complex, target.vertices);
  tetgenio output;
  auto mesh = std::make_unique<tetgenmesh>();
  SizeTest test(target, complex.x, *mesh);
  const ActiveSizeTest active(test);
  mesh->b = &behavior;
  mesh->in = &input.io();
  try {
    run_phases(*mesh, output);
  } catch (int code) {
    // TetGen has freed the mesh's memory before it threw, and the destructor would do so again. So
    // does TetGen's own driver, which therefore cannot be used.
    static_cast<void>(mesh.release());
    if (code == kOutOfMemory) throw std::bad_alloc();
    throw std::runtime_error(meaning(code));
  }
  read_output(output, result);
}

}  // namespace

std::vector<std::string> tetgen_switches(double radius_edge) {
  return {fmt::format("pYMq{}/10o/140Q", radius_edge),
          fmt::format("pYMq{}/0T1e-12Q", radius_edge + 0.6),
          "pYMq20/0T1e-13Q",  // sizes only, whatever the shapes
          "pYMT1e-14Q"};      // no vertices beyond those that the facets' recovery needs
}

MesherResult run_tetgen(const SurfaceComplex& complex, const std::string& switches,
                        const CellTarget& target) {
  tetgenbehavior behavior;
  std::string mutable_switches = switches;
  [[maybe_unused]] const bool is_understood = behavior.parse_commandline(mutable_switches.data());
  MENISCUS_ASSERT(is_understood, "TetGen does not know the switches {}", switches);

  MesherResult result;
  const ChildLimits limits{.seconds = kLeastSeconds +
                                      static_cast<unsigned>(kSecondsPerCell * target.num_cells)};
  // Points are inserted in rounds, each a multiple of the last, drawn by chance. Another multiple
  // is another order, in which points that fail an assertion of TetGen's in one come out well.
  const double first = behavior.brio_ratio;
  for (int order = 1; order <= kMostOrders; ++order) {
    behavior.brio_ratio = order * first;
    result = {};
    const ChildResult child =
        run_in_child([&] { mesh_complex(complex, behavior, target, result); }, limits);
    current_test = nullptr;  // of an attempt that was cut short
    if (child.failure.empty()) return result;
    result = {fmt::format("TetGen -{}: {}", switches, child.failure), {}, {}};
    if (child.signal != SIGABRT) break;
  }
  return result;
}

}  // namespace meniscus
