#pragma once

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "tests/transport/bulk/scalar_scene.hpp"
#include "tests/transport/bulk/sphere_conduction.hpp"

namespace meniscus::bulk {

/// A row of the table of conduction from a sphere, wall at radius 10.
struct ConductionRow {
  double t, centre, surface, mean;
};
struct Medium {
  double k, a;
  std::vector<ConductionRow> rows;
};
inline const Medium kSame{1,
                          1,
                          {{0.1, 0.8282028557, 0.3215918162, 0.5004439832},
                           {0.5, 0.1987480431, 0.1322985542, 0.1566151753},
                           {2.0, 0.0308595958, 0.0274016343, 0.0287497058}}};
inline const Medium kBetter{10,
                            5,
                            {{0.1, 0.6133255408, 0.5477209241, 0.5729636963},
                             {0.5, 0.2639191423, 0.2509938839, 0.2561072927},
                             {2.0, 0.0641860250, 0.0628262684, 0.0633678147}}};
inline const Medium kWorse{0.1,
                           0.5,
                           {{0.1, 0.9694629859, 0.0700432595, 0.4409235518},
                            {0.5, 0.2122101525, 0.0277829966, 0.0859288944},
                            {2.0, 0.0065373254, 0.0048585824, 0.0054794113}}};

/// Relative errors at a row.
struct ConductionErrors {
  double centre = 0.0, surface = 0.0, mean = 0.0;
};

struct ConductionRun {
  bool is_species = false;
  int num_vertices = 200;
  double cell_volume = 0.0;  ///< 0: what suits the elements
  double step = 0.1;         ///< over t
  fem::Elements elements = fem::Elements::p2_p1;
};

/// Conducts from the exact field at t = 0.05 and compares at the rows of a medium.
inline std::vector<ConductionErrors> conduction_errors(const Medium& medium,
                                                       const ConductionRun& run) {
  ScalarScene::Options options;
  options.elements = run.elements;
  options.spheres.num_vertices = run.num_vertices;
  options.cell_volume = run.cell_volume;
  options.scalar.is_species = run.is_species;
  options.drop = {.capacity = medium.k / medium.a, .conductivity = medium.k};
  options.wall.kind = ScalarCondition::Kind::value;
  ScalarScene drop(options);
  const SphereConduction exact(medium.k, medium.a, 10.0);
  const NodePositions at = drop.positions(run.elements);
  BulkScalars scalars;
  EXPECT_TRUE(drop.solver->initial(drop.domain(), scalars).ok());
  NodeId centre{0};
  for (const NodeId i : at.x.ids()) {
    const double r = at.x[i].norm();
    scalars[0].values[static_cast<std::size_t>(i.value)] = r < 9.99 ? exact.at(r, 0.05) : 0.0;
    if (r < at.x[centre].norm()) centre = i;
  }
  scalars[0].largest = 1.0;
  const FlowSolution rest;
  std::vector<ConductionErrors> errors;
  double t = 0.05;
  for (const ConductionRow& row : medium.rows) {
    const int steps = static_cast<int>(std::ceil(std::log(row.t / t) / std::log1p(run.step)));
    const double factor = std::pow(row.t / t, 1.0 / steps);
    for (int n = 0; n < steps; ++n, t *= factor) {
      const Report moved =
          drop.solver->advance({drop.domain(), drop.domain(), t * (factor - 1.0), rest}, scalars);
      EXPECT_TRUE(moved.ok()) << moved.text();
    }
    const ScalarMeasures measures = drop.solver->measures(drop.domain(), scalars)[0];
    const EmbeddedSurface& interface = drop.mesh.interfaces[0];
    double surface = 0.0;
    for (std::int32_t v = 0; v < interface.num_vertices; ++v)
      surface += scalars[0].values[static_cast<std::size_t>(interface.first_vertex.value + v)] /
                 interface.num_vertices;
    errors.push_back({scalars[0].values[static_cast<std::size_t>(centre.value)] /
                              exact.at(at.x[centre].norm(), row.t) -
                          1.0,
                      surface / row.surface - 1.0,
                      measures.regions[1].amount / options.drop.capacity /
                              measures.regions[1].volume / row.mean -
                          1.0});
  }
  return errors;
}

}  // namespace meniscus::bulk
