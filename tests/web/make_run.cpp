// Writes the files of a synthetic run, for the tests of the page: make_run DIR FRAMES VERTICES
// DROPS [scalars]     with scalars its faces are curved
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "tests/report/synthetic_run.hpp"

int main(int argc, char** argv) {
  if (argc < 5 || argc > 6) return 2;
  const std::filesystem::path folder = argv[1];
  std::filesystem::remove_all(folder);
  meniscus::test::SyntheticRun run;
  run.num_frames = std::atoi(argv[2]);
  run.num_vertices = std::atoi(argv[3]);
  run.num_drops = std::atoi(argv[4]);
  run.has_scalars = run.is_curved = argc == 6;
  run.num_steps = 600;
  run.num_volume_frames = 3;
  meniscus::test::write_synthetic_run(folder, run);
  std::ofstream(folder / "events.csv")
      << "step,t,kind,x,y,z,parents,children,volume_before,volume_after,area_before,area_after,"
         "energy_before,energy_after,neck_radius,gap\n"
         "150,1.51,breakup,0.5,0.25,0,0,1;2,4.18,4.18,12.6,12.5,33,32,0.01,\n"
         "420,4.2,coalescence,-0.5,-0.25,0,1;2,3,4.18,4.18,12.5,12.4,32,31,,0.01\n";
  std::ofstream(folder / "reference.csv")
      << "# Made up for a test.\nt,D\n0,0\n1,0.21\n3,0.33\n6,0.37\n";
  return 0;
}
