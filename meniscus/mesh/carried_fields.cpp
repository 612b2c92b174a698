#include "meniscus/mesh/carried_fields.hpp"

#include <cmath>
#include <cstdint>
#include <set>
#include <string_view>

#include "meniscus/core/error.hpp"

namespace meniscus {
namespace {

using Names = std::set<std::string_view>;

template <class IdType>
void check_field(const CarriedField<IdType>& field, std::int32_t size, std::string_view elements,
                 Names& names) {
  if (field.name.empty()) reject_input("a field on {} has no name", elements);
  if (!names.insert(field.name).second) reject_input("field \"{}\": named twice", field.name);
  if (field.values.size() != size)
    reject_input("field \"{}\": {} values for {} {}", field.name, field.values.size(), size,
                 elements);
  for (const IdType id : field.values.ids())
    if (!std::isfinite(field.values[id]))
      reject_input("field \"{}\": value {} of {} is {}, not a finite number", field.name, id.value,
                   elements, field.values[id]);
}

}  // namespace

void check_fields(const SurfaceFields& fields, const SurfaceMesh& mesh) {
  Names names;
  for (const auto& field : fields.on_vertices)
    check_field(field, mesh.num_vertices(), "vertices", names);
  for (const auto& field : fields.on_faces) check_field(field, mesh.num_faces(), "faces", names);
}

void check_fields(const VolumeFields& fields, const TetMesh& mesh) {
  Names names;
  for (const auto& field : fields.on_vertices) {
    check_field(field, mesh.num_vertices(), "vertices", names);
    if (field.transfer == FieldTransfer::conserved)
      reject_input("field \"{}\": conserved fields of a volume mesh live on its cells", field.name);
  }
  for (const auto& field : fields.on_cells) check_field(field, mesh.num_cells(), "cells", names);
}

}  // namespace meniscus
