#include "meniscus/mesh/field_archive.hpp"

#include <fmt/format.h>

namespace meniscus {
namespace {

template <class IdType>
void save_list(const std::vector<CarriedField<IdType>>& fields, Archive& archive,
               const std::string& path) {
  if (fields.empty()) return;
  std::vector<std::int64_t>& transfers = archive.integers[path + "/transfers"];
  for (std::size_t i = 0; i < fields.size(); ++i) {
    transfers.push_back(static_cast<std::int64_t>(fields[i].transfer));
    archive.texts[fmt::format("{}/{}/name", path, i)] = fields[i].name;
    archive.texts[fmt::format("{}/{}/unit", path, i)] = fields[i].unit;
    archive.reals[fmt::format("{}/{}/values", path, i)] = {fields[i].values.begin(),
                                                           fields[i].values.end()};
  }
}

FieldTransfer transfer_of(std::int64_t number, const std::string& path) {
  if (number != static_cast<std::int64_t>(FieldTransfer::interpolated) &&
      number != static_cast<std::int64_t>(FieldTransfer::conserved))
    reject_input("checkpoint entry \"{}/transfers\" holds {}, not 0 or 1", path, number);
  return static_cast<FieldTransfer>(number);
}

template <class IdType>
std::vector<CarriedField<IdType>> load_list(const Archive& archive, const std::string& path) {
  std::vector<CarriedField<IdType>> fields;
  const auto transfers = archive.integers.find(path + "/transfers");
  if (transfers == archive.integers.end()) return fields;
  for (std::size_t i = 0; i < transfers->second.size(); ++i) {
    CarriedField<IdType>& field = fields.emplace_back();
    field.name = entry(archive.texts, fmt::format("{}/{}/name", path, i));
    field.unit = entry(archive.texts, fmt::format("{}/{}/unit", path, i));
    field.transfer = transfer_of(transfers->second[i], path);
    for (const double value : entry(archive.reals, fmt::format("{}/{}/values", path, i)))
      field.values.add(value);
  }
  return fields;
}

}  // namespace

void save(const SurfaceFields& fields, Archive& archive, const std::string& path) {
  save_list(fields.on_vertices, archive, path + "/vertices");
  save_list(fields.on_faces, archive, path + "/faces");
}

void save(const VolumeFields& fields, Archive& archive, const std::string& path) {
  save_list(fields.on_vertices, archive, path + "/vertices");
  save_list(fields.on_cells, archive, path + "/cells");
}

SurfaceFields load_fields(const Archive& archive, const std::string& path,
                          const SurfaceMesh& mesh) {
  SurfaceFields fields{load_list<VertexId>(archive, path + "/vertices"),
                       load_list<FaceId>(archive, path + "/faces")};
  check_fields(fields, mesh);
  return fields;
}

VolumeFields load_fields(const Archive& archive, const std::string& path, const TetMesh& mesh) {
  VolumeFields fields{load_list<TetVertexId>(archive, path + "/vertices"),
                      load_list<CellId>(archive, path + "/cells")};
  check_fields(fields, mesh);
  return fields;
}

}  // namespace meniscus
