#include "meniscus/evolve/event_archive.hpp"

#include "meniscus/core/error.hpp"

namespace meniscus {
namespace {

// Integers of an event: its kind, the numbers of parents and children, and their ids. Reals of an
// event: position, volumes, areas, energies, width of the neck or gap, volume moved.
constexpr const char* kWhole = "evolution/events/ids";
constexpr const char* kReal = "evolution/events/measures";
constexpr std::size_t kMeasures = 11;

/// Reads an array entry by entry. Throws InvalidInput past its end.
template <class T>
class Reader {
 public:
  explicit Reader(const std::vector<T>& values) : values_(values) {}
  [[nodiscard]] bool is_done() const { return at_ == values_.size(); }
  T next() {
    if (is_done()) reject_input("checkpoint entries \"evolution/events\" are cut short");
    return values_[at_++];
  }

 private:
  const std::vector<T>& values_;
  std::size_t at_ = 0;
};

std::vector<int> read_ids(Reader<std::int64_t>& whole, std::int64_t count) {
  std::vector<int> ids;
  for (std::int64_t k = 0; k < count; ++k) ids.push_back(static_cast<int>(whole.next()));
  return ids;
}

TopologyEvent read_event(Reader<std::int64_t>& whole, Reader<double>& real) {
  TopologyEvent event;
  event.kind = whole.next() == 0 ? EventKind::breakup : EventKind::coalescence;
  const std::int64_t parents = whole.next(), children = whole.next();
  event.parents = read_ids(whole, parents);
  event.children = read_ids(whole, children);
  for (int k = 0; k < 3; ++k) event.position[k] = real.next();
  for (double* value : {&event.volume_before, &event.volume_after, &event.area_before,
                        &event.area_after, &event.energy_before, &event.energy_after})
    *value = real.next();
  (event.kind == EventKind::breakup ? event.neck_radius : event.gap) = real.next();
  event.volume_moved = real.next();
  return event;
}

}  // namespace

void save_events(const std::vector<TopologyEvent>& events, Archive& archive) {
  std::vector<std::int64_t>& whole = archive.integers[kWhole];
  std::vector<double>& real = archive.reals[kReal];
  real.reserve(kMeasures * events.size());
  for (const TopologyEvent& event : events) {
    whole.insert(whole.end(), {event.kind == EventKind::breakup ? 0 : 1,
                               static_cast<std::int64_t>(event.parents.size()),
                               static_cast<std::int64_t>(event.children.size())});
    whole.insert(whole.end(), event.parents.begin(), event.parents.end());
    whole.insert(whole.end(), event.children.begin(), event.children.end());
    real.insert(real.end(),
                {event.position.x(), event.position.y(), event.position.z(), event.volume_before,
                 event.volume_after, event.area_before, event.area_after, event.energy_before,
                 event.energy_after, event.neck_radius.value_or(event.gap.value_or(0.0)),
                 event.volume_moved});
  }
}

std::vector<TopologyEvent> load_events(const Archive& archive) {
  const auto whole = archive.integers.find(kWhole);
  const auto real = archive.reals.find(kReal);
  if (whole == archive.integers.end() || real == archive.reals.end())
    reject_input("checkpoint lacks \"evolution/events\"");
  Reader<std::int64_t> ids(whole->second);
  Reader<double> measures(real->second);
  std::vector<TopologyEvent> events;
  while (!ids.is_done()) events.push_back(read_event(ids, measures));
  return events;
}

}  // namespace meniscus
