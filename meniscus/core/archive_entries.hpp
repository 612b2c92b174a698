#pragma once

#include <string>
#include <vector>

#include "meniscus/core/archive.hpp"
#include "meniscus/core/error.hpp"
#include "meniscus/core/field.hpp"
#include "meniscus/core/vec.hpp"

namespace meniscus {

/// The array of that name in one of an archive's maps. Throws InvalidInput when there is none.
template <class Map>
[[nodiscard]] const typename Map::mapped_type& entry(const Map& arrays, const std::string& name) {
  const auto found = arrays.find(name);
  if (found == arrays.end()) reject_input("checkpoint lacks \"{}\"", name);
  return found->second;
}

/// The array of that name, which must have `size` values.
template <class Map>
[[nodiscard]] const typename Map::mapped_type& entry_of_size(const Map& arrays,
                                                             const std::string& name,
                                                             std::size_t size) {
  const auto& values = entry(arrays, name);
  if (values.size() != size)
    reject_input("checkpoint entry \"{}\" has {} values, not {}", name, values.size(), size);
  return values;
}

/// The array of that name, whose size must be a multiple of `width`.
template <class Map>
[[nodiscard]] const typename Map::mapped_type& entry_of_rows(const Map& arrays,
                                                             const std::string& name,
                                                             std::size_t width) {
  const auto& values = entry(arrays, name);
  if (values.size() % width != 0)
    reject_input("checkpoint entry \"{}\" has {} values, not a multiple of {}", name, values.size(),
                 width);
  return values;
}

/// The components x, y, z of every vector, one vector after the other.
template <class IdType>
[[nodiscard]] std::vector<double> flat(const Field<IdType, Vec3>& field) {
  std::vector<double> values;
  for (const Vec3& x : field) values.insert(values.end(), {x[0], x[1], x[2]});
  return values;
}

template <class IdType>
[[nodiscard]] Field<IdType, Vec3> vectors(const std::vector<double>& values) {
  MENISCUS_ASSERT(values.size() % 3 == 0, "{} numbers are no vectors", values.size());
  Field<IdType, Vec3> field;
  for (std::size_t i = 0; i + 2 < values.size(); i += 3)
    field.add(Vec3(values[i], values[i + 1], values[i + 2]));
  return field;
}

}  // namespace meniscus
