#pragma once

#include <string>
#include <vector>

namespace meniscus::test {

/// What became of a random scene that was moved by random smooth flows through changes of topology.
struct EventSoak {
  int steps = 0;
  int breakups = 0, coalescences = 0;
  int tori = 0;           ///< children of events that have a hole, however many
  int nested = 0;         ///< children of events that lie in another drop
  int warnings = 0;       ///< events that were due and could not be carried out
  int refused_steps = 0;  ///< steps that made drops touch and were taken again at half the length
  std::string fault;      ///< the first thing that must not be; empty: none
  double largest_area_rise = 0.0;     ///< of one event, over 4π
  double largest_volume_error = 0.0;  ///< relative, of one event
  double largest_volume_moved = 0.0;  ///< over the parents' volume
  std::vector<std::string> log;
};

/// 5 to 30 drops of random sizes at random places, some of them in others, carried by random smooth
/// velocities without divergence, local strains that draw drops apart, flatten them or bring them
/// together, until `events` events have happened or `max_steps` steps are done. The seed alone
/// decides everything.
[[nodiscard]] EventSoak event_soak(unsigned seed, int events, int max_steps);

}  // namespace meniscus::test
