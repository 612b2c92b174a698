#include "meniscus/evolve/remeshed_interface.hpp"

#include "meniscus/core/archive_entries.hpp"
#include "meniscus/mesh/field_archive.hpp"
#include "meniscus/mesh/surface_archive.hpp"

namespace meniscus {
namespace {

constexpr const char *kSurface = "surface", *kFields = "fields", *kShift = "shift",
                     *kOutcome = "outcome", *kSmoothedOver = "smoothed-over",
                     *kFaultKind = "fault/kind", *kFaultText = "fault/text",
                     *kFaultPosition = "fault/position";

void save_fault(const Fault& fault, Archive& archive) {
  archive.integers[kFaultKind] = {static_cast<std::int64_t>(fault.kind)};
  archive.texts[kFaultText] = fault.text;
  if (fault.position)
    archive.reals[kFaultPosition] = {fault.position->begin(), fault.position->end()};
}

std::optional<Fault> load_fault(const Archive& archive) {
  if (!archive.integers.contains(kFaultKind)) return {};
  Fault fault{static_cast<FaultKind>(entry_of_size(archive.integers, kFaultKind, 1)[0]),
              entry(archive.texts, kFaultText)};
  if (archive.reals.contains(kFaultPosition))
    fault.position = Vec3(entry_of_size(archive.reals, kFaultPosition, 3).data());
  return fault;
}

}  // namespace

void save(const RemeshedInterface& remeshed, Archive& archive) {
  save(remeshed.mesh, archive, kSurface);
  save(remeshed.fields, archive, kFields);
  const VolumeShift& shift = remeshed.shift;
  archive.reals[kShift] = {shift.length, shift.over_edge, shift.field_excess.above,
                           shift.field_excess.below};
  const InterfaceRemesh& outcome = remeshed.outcome;
  archive.integers[kOutcome] = {outcome.drop, outcome.is_mended ? 1 : 0, outcome.closed_holes};
  archive.reals[kSmoothedOver] = {outcome.smoothed_over};
  if (outcome.fault) save_fault(*outcome.fault, archive);
}

RemeshedInterface load_remeshed(const Archive& archive) {
  RemeshedInterface remeshed;
  remeshed.mesh = load_surface(archive, kSurface);
  remeshed.fields = load_fields(archive, kFields, remeshed.mesh);
  const auto& shift = entry_of_size(archive.reals, kShift, 4);
  remeshed.shift = {shift[0], shift[1], {shift[2], shift[3]}};
  const auto& outcome = entry_of_size(archive.integers, kOutcome, 3);
  remeshed.outcome = {{load_fault(archive)},
                      static_cast<int>(outcome[0]),
                      outcome[1] != 0,
                      entry_of_size(archive.reals, kSmoothedOver, 1)[0],
                      static_cast<int>(outcome[2])};
  return remeshed;
}

}  // namespace meniscus
