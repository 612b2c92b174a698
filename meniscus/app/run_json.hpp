#pragma once
// Private header of this room.

#include <filesystem>
#include <string>

#include <nlohmann/json.hpp>

namespace meniscus {

/// The record of a run in its folder, run.json; an empty object where it is missing or damaged.
[[nodiscard]] nlohmann::ordered_json read_run_json(const std::filesystem::path& folder);

/// A member of an object. `otherwise` where it is missing or of another type: people edit records.
template <class T>
[[nodiscard]] T member(const nlohmann::ordered_json& object, const char* key, T otherwise) {
  const auto found = object.find(key);
  if (found == object.end()) return otherwise;
  try {
    return found->template get<T>();
  } catch (const nlohmann::json::exception&) {
    return otherwise;
  }
}

/// JSON as a file holds it. Bytes that are not UTF-8, which names of files may have, are replaced.
[[nodiscard]] std::string file_text(const nlohmann::ordered_json& json);

}  // namespace meniscus
