#include "meniscus/app/scalar_arrays.hpp"

#include "meniscus/core/error.hpp"

namespace meniscus {
namespace {

/// What turns T into the value shown: 1 of heat, γ of a species.
double factor(const Scene& scene, std::size_t scalar, RegionId region) {
  if (!scene.scalars[scalar].is_species) return 1.0;
  const std::vector<ScalarLiquid>& liquids = scene.liquids[region].scalars;
  MENISCUS_ASSERT(scalar < liquids.size(), "{} scalars in liquid {}", liquids.size(), region.value);
  return liquids[scalar].capacity;
}

void check_sizes([[maybe_unused]] const Scene& scene, [[maybe_unused]] const TetMesh& mesh,
                 [[maybe_unused]] const BulkScalars& scalars) {
  MENISCUS_ASSERT(scalars.empty() || scalars.size() == scene.scalars.size(), "{} of {} scalars",
                  scalars.size(), scene.scalars.size());
  for ([[maybe_unused]] const BulkScalar& scalar : scalars)
    MENISCUS_ASSERT(scalar.values.size() >= static_cast<std::size_t>(mesh.num_vertices()),
                    "{} values at {} vertices", scalar.values.size(), mesh.num_vertices());
}

double value_at(const BulkScalar& scalar, TetVertexId v) {
  return scalar.values[static_cast<std::size_t>(v.value)];
}

std::vector<double> at_vertices(const TetMesh& mesh, const BulkScalar& scalar) {
  return {scalar.values.begin(), scalar.values.begin() + mesh.num_vertices()};
}

std::vector<double> at_corners(const Scene& scene, const TetMesh& mesh, const BulkScalars& scalars,
                               std::size_t k) {
  std::vector<double> values;
  values.reserve(4 * static_cast<std::size_t>(mesh.num_cells()));
  for (const CellId c : mesh.cells.ids()) {
    const double gamma = factor(scene, k, mesh.region[c]);
    for (const TetVertexId v : mesh.cells[c]) values.push_back(gamma * value_at(scalars[k], v));
  }
  return values;
}

}  // namespace

ScalarArrays scalars_in_volume(const Scene& scene, const TetMesh& mesh,
                               const BulkScalars& scalars) {
  check_sizes(scene, mesh, scalars);
  ScalarArrays arrays;
  for (std::size_t k = 0; k < scalars.size(); ++k) {
    const std::string& name = scene.scalars[k].name;
    if (scene.scalars[k].is_species)
      arrays.on_corners.push_back({name, 1, at_corners(scene, mesh, scalars, k)});
    else
      arrays.on_vertices.push_back({name, 1, at_vertices(mesh, scalars[k])});
  }
  return arrays;
}

std::vector<io::NamedArray> scalars_on_interfaces(const Scene& scene, const TetMesh& mesh,
                                                  const BulkScalars& scalars) {
  check_sizes(scene, mesh, scalars);
  MENISCUS_ASSERT(scalars.empty() || mesh.interfaces.size() == scene.interfaces.size(),
                  "{} interfaces in a mesh of {}", scene.interfaces.size(), mesh.interfaces.size());
  std::vector<io::NamedArray> arrays;
  for (std::size_t k = 0; k < scalars.size(); ++k) {
    io::NamedArray& array = arrays.emplace_back(io::NamedArray{scene.scalars[k].name, 1, {}});
    for (std::size_t i = 0; i < scene.interfaces.size(); ++i) {
      const double gamma = factor(scene, k, scene.interfaces[i].outside);
      for (const VertexId v : scene.interfaces[i].mesh.x.ids())
        array.values.push_back(gamma * value_at(scalars[k], mesh.interfaces[i].vertex(v)));
    }
  }
  return arrays;
}

}  // namespace meniscus
