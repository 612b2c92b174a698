#include "tests/report/synthetic_run.hpp"

#include <cmath>
#include <fstream>
#include <numbers>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/LU>
#include <fmt/format.h>

#include "meniscus/io/table.hpp"
#include "meniscus/io/vtk_file.hpp"
#include "meniscus/mesh/shapes.hpp"
#include "meniscus/mesh/surface_measures.hpp"
#include "meniscus/mesh/tet_mesh.hpp"

namespace meniscus::test {
namespace {

namespace fs = std::filesystem;
using io::Cell;

constexpr double end_time = 6.0;

/// An ellipsoid in the flow plane: half axes L > W > B with L B W = 1, L at an angle to x.
struct Shape {
  double L = 1.0, B = 1.0, W = 1.0, angle = std::numbers::pi / 4.0;
  Vec3 center = Vec3::Zero();
};

Shape shape_at(double t, int drop) {
  const double growth = 1.0 - std::exp(-t / 1.5);
  Shape shape;
  shape.L = 1.0 + (0.55 + 0.1 * drop) * growth;
  shape.W = 1.0 - 0.08 * growth;
  shape.B = 1.0 / (shape.L * shape.W);
  shape.angle = std::numbers::pi / 180.0 * (45.0 - 19.0 * growth);
  if (drop > 0) shape.center = Vec3(1.2 + 0.3 * t, 1.9, 0.2);
  return shape;
}

/// Maps the unit sphere on the ellipsoid.
Mat3 stretch(const Shape& s) {
  const double c = std::cos(s.angle), d = std::sin(s.angle);
  Mat3 axes;
  axes << c, -d, 0, d, c, 0, 0, 0, 1;
  return axes * Vec3(s.L, s.B, s.W).asDiagonal();
}

/// k1 + k2 of the ellipsoid at the image of a point u of the unit sphere:
/// h³/(abc)² (a² + b² + c² − r²), h the distance of the tangent plane, r that of the point.
double curvature_at(const Shape& s, const Vec3& u) {
  const Vec3 axes(s.L, s.B, s.W), x = axes.cwiseProduct(u);
  const double h = 1.0 / x.cwiseQuotient(axes.cwiseProduct(axes)).norm();
  const double abc = s.L * s.B * s.W;
  return h * h * h / (abc * abc) * (axes.squaredNorm() - x.squaredNorm());
}

double temperature_at(const Vec3& x) { return 1.0 + 0.1 * x.x(); }

/// The edges of all drops through points of the ellipsoids.
io::CurvedEdges curved_edges(const SyntheticRun& run, const SurfaceMesh& ball, double t) {
  io::CurvedEdges curved;
  const SurfaceTopology topology(ball);
  for (int k = 0; k < run.num_drops; ++k) {
    const Shape shape = shape_at(t, k);
    const std::int32_t first = k * ball.num_vertices();
    for (const SurfaceEdge& edge : topology.edges()) {
      curved.ends.push_back({first + edge.a.value, first + edge.b.value});
      curved.middles.emplace_back(stretch(shape) * (ball.x[edge.a] + ball.x[edge.b]).normalized() +
                                  shape.center);
    }
  }
  return curved;
}

void write_frame(const fs::path& path, const SyntheticRun& run, const SurfaceMesh& ball, double t) {
  std::vector<SurfaceMesh> meshes;
  io::NamedArray curvature{"curvature", 1, {}}, speed{"normal_velocity", 1, {}},
      velocity{"velocity", 3, {}}, density{"node_density", 1, {}}, jump{"pressure_jump", 1, {}},
      drop{"drop", 1, {}}, temperature{"temperature", 1, {}}, dye{"dye", 1, {}};
  for (int k = 0; k < run.num_drops; ++k) {
    const Shape shape = shape_at(t, k);
    SurfaceMesh mesh = ball;
    for (Vec3& x : mesh.x) {
      curvature.values.push_back(curvature_at(shape, x));
      speed.values.push_back(std::exp(-t) * x.x() * x.y());
      jump.values.push_back(-curvature.values.back() / 0.3);
      velocity.values.insert(velocity.values.end(), {x.y(), 0.0, 0.0});
      x = stretch(shape) * x + shape.center;
      temperature.values.push_back(temperature_at(x));
      dye.values.push_back(x.z());
    }
    for (const double area : vertex_areas(mesh)) density.values.push_back(1.0 / area);
    drop.values.insert(drop.values.end(), static_cast<std::size_t>(mesh.num_faces()), k);
    meshes.push_back(mesh);
  }
  std::vector<const SurfaceMesh*> surfaces;
  for (const SurfaceMesh& mesh : meshes) surfaces.push_back(&mesh);
  io::MeshData data{{curvature, speed, velocity, density, jump}, {drop}};
  if (run.has_scalars) data.on_vertices.insert(data.on_vertices.end(), {temperature, dye});
  if (run.is_curved)
    io::write_surface_vtu(path, surfaces, data, t, curved_edges(run, ball, t));
  else
    io::write_vtp(path, surfaces, data, t);
}

void write_frames(const fs::path& folder, const SyntheticRun& run) {
  fs::create_directories(folder / "surface");
  std::vector<io::PvdEntry> entries;
  const SurfaceMesh ball = sphere(run.num_vertices);
  for (int i = 0; i < run.num_frames; ++i) {
    const double t = run.num_frames > 1 ? end_time * i / (run.num_frames - 1) : 0.0;
    entries.push_back(
        {t, fmt::format("surface/surface-{:04}.{}", i, run.is_curved ? "vtu" : "vtp")});
    write_frame(folder / entries.back().file, run, ball, t);
  }
  io::write_pvd(folder / "surface.pvd", entries);
}

/// Cubes of six tetrahedra each; those whose middle lies in the first drop are of region 1.
TetMesh box_mesh(int cubes_per_side, const Shape& drop) {
  constexpr double half_width = 4.0;
  static constexpr int paths[6][2] = {{1, 2}, {2, 1}, {0, 2}, {2, 0}, {0, 1}, {1, 0}};
  const int n = cubes_per_side;
  TetMesh mesh;
  for (int i = 0; i < (n + 1) * (n + 1) * (n + 1); ++i) {
    const Vec3 corner(i % (n + 1), i / (n + 1) % (n + 1), i / ((n + 1) * (n + 1)));
    mesh.x.add(half_width * (2.0 / n * corner - Vec3::Ones()));
  }
  const int strides[3] = {1, n + 1, (n + 1) * (n + 1)};
  const Mat3 to_ball = stretch(drop).inverse();
  for (int cube = 0; cube < n * n * n; ++cube) {
    const int base = cube % n + cube / n % n * strides[1] + cube / (n * n) * strides[2];
    for (const auto& [second, third] :
         paths) {  // from corner to corner along the three axes in turn
      const int first = 3 - second - third, a = base + strides[first], b = a + strides[second];
      const int corners[4] = {base, a, b, b + strides[third]};
      CellVertices cell;
      Vec3 middle = Vec3::Zero();
      for (std::size_t k = 0; k < 4; ++k) {
        cell[k] = TetVertexId{corners[k]};
        middle += 0.25 * mesh.x[cell[k]];
      }
      const CellId c = mesh.cells.add(cell);
      if (signed_volume(mesh, c) < 0.0) std::swap(mesh.cells[c][2], mesh.cells[c][3]);
      mesh.region.add(RegionId{(to_ball * (middle - drop.center)).norm() < 1.0 ? 1 : 0});
    }
  }
  return mesh;
}

void write_volume_frames(const fs::path& folder, const SyntheticRun& run) {
  fs::create_directories(folder / "volume");
  std::vector<io::PvdEntry> entries;
  for (int i = 0; i < run.num_volume_frames; ++i) {
    const double t = run.num_volume_frames > 1 ? end_time * i / (run.num_volume_frames - 1) : 0.0;
    const TetMesh mesh = box_mesh(12, shape_at(t, 0));
    io::NamedArray region{"region", 1, {}}, drop{"drop", 1, {}},
        dihedral{"min_dihedral_deg", 1, {}}, temperature{"temperature", 1, {}}, dye{"dye", 1, {}};
    for (const CellId c : mesh.cells.ids()) {
      region.values.push_back(mesh.region[c].value);
      drop.values.push_back(mesh.region[c].value - 1);
      dihedral.values.push_back(30.0 + 25.0 * std::sin(c.value));
      dye.values.insert(dye.values.end(), 4, 1.0 + mesh.region[c].value);
    }
    for (const Vec3& x : mesh.x) temperature.values.push_back(temperature_at(x));
    io::MeshData data{{}, {region, drop, dihedral}};
    if (run.has_scalars) data.on_vertices.push_back(temperature);
    entries.push_back({t, fmt::format("volume/volume-{:04}.vtu", i)});
    io::write_vtu(folder / entries.back().file, mesh, data, t,
                  std::span(&dye, run.has_scalars ? 1 : 0));
  }
  io::write_pvd(folder / "volume.pvd", entries);
}

std::vector<Cell> with_scalars(std::vector<Cell> row, const SyntheticRun& run,
                               const std::vector<Cell>& of_scalars) {
  if (run.has_scalars) row.insert(row.end(), of_scalars.begin(), of_scalars.end());
  return row;
}

std::vector<std::string> columns_with_scalars(std::vector<std::string> columns,
                                              const SyntheticRun& run,
                                              const std::vector<std::string>& of_scalars) {
  if (run.has_scalars) columns.insert(columns.end(), of_scalars.begin(), of_scalars.end());
  return columns;
}

void write_drops(io::TableWriter& drops, const SyntheticRun& run, int step, double t) {
  for (int k = 0; k < run.num_drops; ++k) {
    const Shape s = shape_at(t, k);
    const double volume = 4.0 / 3.0 * std::numbers::pi;
    std::vector<Cell> of_scalars{volume, 2.0 + std::exp(-t), 2.0 * volume};
    of_scalars.emplace_back();
    if (step > 0) of_scalars.back() = 3.0;
    drops.add(with_scalars(
        {std::int64_t{step}, t, std::int64_t{k}, Cell(), volume, 1e-13 * std::sin(5.0 * step + k),
         1e-5 * (1.0 + std::sin(0.3 * step)), 12.6 * s.L, s.center.x(), s.center.y(), s.center.z(),
         s.L, s.B, s.W, (s.L - s.B) / (s.L + s.B), s.angle * 180.0 / std::numbers::pi, s.L,
         s.L * s.L, 0.9},
        run, of_scalars));
  }
}

void write_tables(const fs::path& folder, const SyntheticRun& run) {
  io::TableWriter history(folder / "history.csv",
                          columns_with_scalars({"step",
                                                "t",
                                                "dt",
                                                "drops",
                                                "surface_nodes",
                                                "nodes",
                                                "tetrahedra",
                                                "min_gap",
                                                "min_dihedral_deg",
                                                "linear_iterations",
                                                "power_in",
                                                "dissipation",
                                                "surface_rate",
                                                "power_residual",
                                                "stress_xx",
                                                "stress_yy",
                                                "stress_zz",
                                                "stress_xy",
                                                "stress_xz",
                                                "stress_yz",
                                                "N1",
                                                "N2"},
                                               run,
                                               {"temperature_total", "temperature_boundary_rate",
                                                "temperature_source_rate", "temperature_min",
                                                "temperature_max", "dye_total", "dye_boundary_rate",
                                                "dye_source_rate", "dye_min", "dye_max"}));
  io::TableWriter drops(
      folder / "drops.csv",
      columns_with_scalars(
          {"step", "t", "drop", "parent", "volume", "volume_drift", "volume_correction", "area",
           "x", "y", "z", "L", "B", "W", "D", "angle_deg", "extent_x", "H_max", "D_inertia"},
          run, {"temperature_amount", "temperature_nusselt", "dye_amount", "dye_sherwood"}));
  io::TableWriter timing(folder / "timing.csv", {"step", "t", "solve", "output"});
  for (int step = 0; step <= run.num_steps; ++step) {
    const double t = run.num_steps > 0 ? end_time * step / run.num_steps : 0.0;
    const double rate = 0.8 * std::exp(-t / 1.5);
    const Cell gap = run.num_drops > 1 ? Cell(0.3 + 0.1 * t) : Cell();
    history.add(with_scalars({std::int64_t{step},
                              t,
                              step > 0 ? 0.1 : 0.0,
                              std::int64_t{run.num_drops},
                              std::int64_t{200 + step},
                              std::int64_t{5400 + 20 * step},
                              std::int64_t{30000 + 150 * step},
                              gap,
                              7.0 + std::sin(step),
                              std::int64_t{44},
                              9.0 - 0.1 * rate,
                              9.0 - rate,
                              0.88 * rate,
                              0.02 * rate,
                              0.1,
                              -0.1,
                              0.0,
                              4.0 + rate,
                              0.0,
                              0.0,
                              2.0 - 2.0 * rate,
                              -0.6 + 0.6 * rate},
                             run, {500.0 + t, 1.0, 0.5, 0.6, 1.4, 8.0, 0.0, 0.0, 1.0, 2.0}));
    write_drops(drops, run, step, t);
    timing.add({std::int64_t{step}, t, 0.3 + 0.05 * std::sin(step), 0.02});
  }
}

constexpr const char* record = R"({
  "program": "meniscus", "version": "0.1.0", "commit": "0123456789ab",
  "title": "Drop in simple shear, <subcritical> & steady", "status": "done",
  "case_file": "cases/shear/case.toml",
  "case_text": "title = \"Drop in simple shear\"\n[flow]\nkind = \"simple-shear\"   # v_x = G y\ncapillary-number = 0.3\n\n[[drop]]\nradius = 1.0\n",
  "case": {"title": "Drop in simple shear", "flow": {"kind": "simple-shear", "capillary-number": 0.3},
    "drop": [{"radius": 1.0, "viscosity-ratio": 1.0, "nodes": 200, "center": [0, 0, 0]}],
    "domain": {"shape": "box", "half-width": 10.0}, "interface": {"surface-tension": "nodal"},
    "solver": {"method": "finite-element", "elements": "P1-P1", "linear": "block"},
    "time": {"scheme": "rk2", "end": 6.0}},
  "host": "example", "ranks": 1, "started": "2001-02-03T04:05:06Z",
  "finished": "2001-02-03T04:07:01Z", "wall_seconds": 115.2,
  "seconds": {"remesh surface": 3.1, "tetrahedralize": 14.8, "assemble": 31.2, "solve": 52.4,
    "move mesh": 4.4, "diagnostics": 6.2, "output": 2.1},
  "steps": 60, "t": 6.0, "warnings": []
}
)";

}  // namespace

void write_synthetic_run(const fs::path& folder, const SyntheticRun& run) {
  fs::create_directories(folder);
  write_tables(folder, run);
  write_frames(folder, run);
  if (run.num_volume_frames > 0) write_volume_frames(folder, run);
  std::ofstream(folder / "run.json") << record;
}

}  // namespace meniscus::test
