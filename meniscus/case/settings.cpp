#include "meniscus/case/settings.hpp"

#include <algorithm>
#include <system_error>

#include "meniscus/core/error.hpp"

namespace meniscus {

using schema::Dimension;
using schema::Value;

double Scale::unit(Dimension dimension) const {
  switch (dimension) {
    case Dimension::none:
      return 1.0;
    case Dimension::length:
      return length;
    case Dimension::time:
      return 1.0 / rate;
    case Dimension::rate:
      return rate;
    case Dimension::velocity:
      return rate * length;
    case Dimension::stress:
      return viscosity * rate;
    case Dimension::force_density:
      return viscosity * rate / length;
    case Dimension::gravity:
      return surface_tension / (density * length * length);
  }
  return 1.0;
}

double Settings::unit_of(const std::string& path) const {
  const schema::Key* key = schema::find_key(schema::generic_path(path));
  MENISCUS_ASSERT(key != nullptr, "no key {} in the schema", path);
  return unit(key->dimension);
}

const Value& Settings::own_value(const std::string& path) {
  const auto known = used_.find(path);
  if (known != used_.end()) return known->second;
  const schema::Key* key = schema::find_key(schema::generic_path(path));
  MENISCUS_ASSERT(key != nullptr, "no key {} in the schema", path);
  const auto given = document_.values.find(path);
  if (given != document_.values.end()) return used_[path] = given->second.value;
  if (!key->value) reject_input("{}: {} is missing", source(path), name(path));
  // The default times the unit, although it is divided again later: run.json then reads back to the
  // same bits.
  return used_[path] = schema::scaled(*key->value, unit_of(path));
}

Value Settings::dimensionless_value(const std::string& path) {
  const Value& own = own_value(path);
  const schema::Key* key = schema::find_key(schema::generic_path(path));
  const double unit = unit_of(path);
  MENISCUS_ASSERT(unit > 0.0, "the unit of {} is {:g}", path, unit);
  Value value = own;
  if (const auto* real = std::get_if<double>(&own)) value = *real / unit;
  if (const auto* v = std::get_if<Vec3>(&own)) value = Vec3(*v / unit);
  if (const auto* m = std::get_if<Mat3>(&own)) value = Mat3(*m / unit);
  if (const std::string complaint = schema::range_complaint(*key, value); !complaint.empty())
    reject(
        path, "{}{}", complaint,
        scale_ && unit != 1.0 ? fmt::format(" in units of {}", schema::unit(key->dimension)) : "");
  return value;
}

double Settings::number(const std::string& path) {
  return std::get<double>(dimensionless_value(path));
}
int Settings::whole(const std::string& path) {
  return static_cast<int>(std::get<std::int64_t>(own_value(path)));
}
bool Settings::flag(const std::string& path) { return std::get<bool>(own_value(path)); }
std::string Settings::text(const std::string& path) {
  return std::get<std::string>(own_value(path));
}
Vec3 Settings::vector(const std::string& path) { return std::get<Vec3>(dimensionless_value(path)); }
Mat3 Settings::matrix(const std::string& path) { return std::get<Mat3>(dimensionless_value(path)); }

void Settings::require_metres(const std::string& path, double largest, double most) const {
  if (scale_ && largest > most)
    reject(path, "must be at most {} times scale.length = {}: with [scale] lengths are in metres",
           most, scale_->length);
}

std::optional<std::string> Settings::word_or_vector(const std::string& path) {
  const Value& own = own_value(path);
  if (const auto* word = std::get_if<std::string>(&own)) return *word;
  return std::nullopt;
}

std::filesystem::path Settings::file(const std::string& path) {
  const std::filesystem::path given = text(path);
  const bool from_here = document_.values.at(path).is_override;
  std::filesystem::path full = from_here ? given : document_.folder / given;
  // run.json has the absolute path, so that it can be read back from any folder.
  used_[path] = std::filesystem::absolute(full).lexically_normal().string();
  return full;
}

double Settings::number_or(const std::string& path, double fallback) {
  if (!is_given(path)) {
    used_[path] = fallback * unit_of(path);
  }
  return number(path);
}

std::string Settings::source(const std::string& path) const {
  const auto given = document_.values.find(path);
  if (given != document_.values.end()) return given->second.source;
  std::string_view around = path;
  while (!around.empty()) {
    const auto table = document_.tables.find(std::string(around));
    if (table != document_.tables.end()) return table->second;
    around = schema::parent_path(around);
  }
  return document_.name;
}

std::string Settings::name(const std::string& path) const {
  const auto given = document_.values.find(path);
  const bool is_override = given != document_.values.end() && given->second.is_override;
  return is_override ? path : schema::without_indices(path);
}

void Settings::reject_value(const std::string& path, const std::string& complaint) const {
  const auto given = document_.values.find(path);
  const auto known = used_.find(path);
  const Value* value = given != document_.values.end() ? &given->second.value
                       : known != used_.end()          ? &known->second
                                                       : nullptr;
  if (value == nullptr) reject_input("{}: {} {}", source(path), name(path), complaint);
  reject_input("{}: {} = {} {}", source(path), name(path), schema::to_toml(*value), complaint);
}

void Settings::require_all_used(const std::map<std::string, Value>& used_without_overrides) const {
  for (const auto& [path, given] : document_.values) {
    if (used_.contains(path)) continue;
    if (!given.is_override && used_without_overrides.contains(path)) continue;
    const schema::Key* key = schema::find_key(schema::generic_path(path));
    MENISCUS_ASSERT(key != nullptr, "no key {} in the schema", path);
    if (key->applies.empty())
      reject_input("{}: {} has no effect in this case", given.source, name(path));
    reject_input("{}: {} has no effect here: it applies {}", given.source, name(path),
                 key->applies);
  }
}

}  // namespace meniscus
