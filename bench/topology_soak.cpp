// Random scenes through many changes of topology (docs/topology.md): topology_soak FIRST COUNT
// [EVENTS].
#include <cstdlib>
#include <ctime>

#include <fmt/format.h>

#include "tests/topology/event_soak.hpp"

int main(int argc, char** argv) {
  using namespace meniscus::test;
  const unsigned first = argc > 1 ? static_cast<unsigned>(std::atoi(argv[1])) : 1U;
  const unsigned count = argc > 2 ? static_cast<unsigned>(std::atoi(argv[2])) : 300U;
  const int events = argc > 3 ? std::atoi(argv[3]) : 50;
  int breakups = 0, coalescences = 0, warnings = 0, faults = 0, short_of_events = 0;
  double area = 0.0, volume = 0.0, moved = 0.0;
  for (unsigned seed = first; seed < first + count; ++seed) {
    const std::clock_t began = std::clock();
    const EventSoak soak = event_soak(seed, events, 40 * events);
    const double seconds = static_cast<double>(std::clock() - began) / CLOCKS_PER_SEC;
    fmt::print(
        "seed {}: {} steps, {} refused, {} breakups, {} coalescences, {} tori, {} nested, {} "
        "warnings, volume error {:.1e}, {:.1f} s of processor time {}\n",
        seed, soak.steps, soak.refused_steps, soak.breakups, soak.coalescences, soak.tori,
        soak.nested, soak.warnings, soak.largest_volume_error, seconds, soak.fault);
    for (const std::string& line : soak.log) fmt::print("  {}\n", line);
    std::fflush(stdout);
    breakups += soak.breakups;
    coalescences += soak.coalescences;
    warnings += soak.warnings;
    faults += soak.fault.empty() ? 0 : 1;
    short_of_events += soak.breakups + soak.coalescences < events ? 1 : 0;
    area = std::max(area, soak.largest_area_rise);
    volume = std::max(volume, soak.largest_volume_error);
    moved = std::max(moved, soak.largest_volume_moved);
  }
  fmt::print(
      "{} scenes: {} breakups, {} coalescences, {} warnings, {} faults, {} scenes short of events\n"
      "largest rise of area by an event {:.2e} of 4 pi, error of volume {:.1e}, volume moved "
      "{:.1e}\n",
      count, breakups, coalescences, warnings, faults, short_of_events, area, volume, moved);
  return faults == 0 ? 0 : 1;
}
