// The deformation test of leveque1996 and enright2002 (docs/surface-remeshing.md).
//
//     deformation PERIOD N0 [EDGE_FLOOR [STEP [EQUILIBRIUM]]]
#include "tests/surface/deformation.hpp"

#include <cstdio>
#include <cstdlib>
#include <ctime>

int main(int argc, char** argv) {
  if (argc < 3) {
    std::puts("deformation PERIOD N0 [EDGE_FLOOR [STEP [EQUILIBRIUM]]]");
    return 2;
  }
  meniscus::test::DeformationOptions options{.N0 = std::atof(argv[2]),
                                             .period = std::atof(argv[1])};
  if (argc > 3) options.edge_floor = std::atof(argv[3]);
  if (argc > 4) options.step = std::atof(argv[4]);
  if (argc > 5) options.spring_tolerance = std::atof(argv[5]);
  const auto r = meniscus::test::deform_and_return(options);
  std::printf(
      "T %g N0 %g floor %g: vertices %d, at most %d, %d in the end; shape error %.3g rms, "
      "%.3g largest; volume error %.3g %%, on the way %.3g %%, flat faces %.3g %%; smallest "
      "angle %.1f; %d failed steps %s; %.1f CPU s\n",
      options.period, options.N0, options.edge_floor, r.start_vertices, r.most_vertices,
      r.end_vertices, r.shape_error, r.worst_shape_error, 100.0 * r.volume_error,
      100.0 * r.worst_volume_error, 100.0 * r.flat_volume_error, r.smallest_angle_deg,
      r.failed_steps, r.failure.c_str(), static_cast<double>(std::clock()) / CLOCKS_PER_SEC);
  return r.failed_steps == 0 ? 0 : 1;
}
