#include "meniscus/case/value.hpp"

#include <cmath>

#include <fmt/format.h>

namespace meniscus::schema {
namespace {

std::string real_to_toml(double value) {
  if (std::isnan(value)) return "nan";
  if (std::isinf(value)) return value > 0.0 ? "inf" : "-inf";
  std::string text = fmt::format("{}", value);
  if (text.find_first_of(".e") == std::string::npos) text += ".0";
  return text;
}

std::string row_to_toml(const Vec3& row) {
  return fmt::format("[{}, {}, {}]", real_to_toml(row.x()), real_to_toml(row.y()),
                     real_to_toml(row.z()));
}

std::string text_to_toml(const std::string& text) {
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') quoted += '\\';
    const auto code = static_cast<unsigned char>(c);
    if (code < 0x20 || code == 0x7f)  // TOML allows no bare control characters
      quoted += fmt::format("\\u{:04x}", code);
    else
      quoted += c;
  }
  return quoted + '"';
}

struct ToToml {
  std::string operator()(bool value) const { return value ? "true" : "false"; }
  std::string operator()(std::int64_t value) const { return fmt::format("{}", value); }
  std::string operator()(double value) const { return real_to_toml(value); }
  std::string operator()(const std::string& value) const { return text_to_toml(value); }
  std::string operator()(const Vec3& value) const { return row_to_toml(value); }
  std::string operator()(const Mat3& value) const {
    return fmt::format("[{}, {}, {}]", row_to_toml(value.row(0)), row_to_toml(value.row(1)),
                       row_to_toml(value.row(2)));
  }
};

}  // namespace

std::string_view description(Type type) {
  switch (type) {
    case Type::number:
      return "a number";
    case Type::whole:
      return "a whole number";
    case Type::flag:
      return "true or false";
    case Type::word:
      return "a word in quotes";
    case Type::text:
      return "a text in quotes";
    case Type::path:
      return "a file name in quotes";
    case Type::vector:
      return "three numbers [x, y, z]";
    case Type::matrix:
      return "three rows of three numbers [[…], […], […]]";
    case Type::velocity:
      return "\"flow\" or three numbers [vx, vy, vz]";
  }
  return "";
}

std::string to_toml(const Value& value) { return std::visit(ToToml{}, value); }

std::vector<double> numbers_in(const Value& value) {
  if (const auto* whole = std::get_if<std::int64_t>(&value)) return {static_cast<double>(*whole)};
  if (const auto* real = std::get_if<double>(&value)) return {*real};
  if (const auto* v = std::get_if<Vec3>(&value)) return {v->data(), v->data() + v->size()};
  if (const auto* m = std::get_if<Mat3>(&value)) return {m->data(), m->data() + m->size()};
  return {};
}

Value scaled(const Value& value, double factor) {
  if (const auto* real = std::get_if<double>(&value)) return factor * *real;
  if (const auto* v = std::get_if<Vec3>(&value)) return Vec3(factor * *v);
  if (const auto* m = std::get_if<Mat3>(&value)) return Mat3(factor * *m);
  return value;
}

}  // namespace meniscus::schema
