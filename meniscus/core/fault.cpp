#include "meniscus/core/fault.hpp"

#include <utility>

#include <fmt/format.h>

namespace meniscus {

std::string text_of(const std::optional<Fault>& fault) { return fault ? fault->text : ""; }

std::string text_of(const Vec3& x) {
  return fmt::format("({:.6g}, {:.6g}, {:.6g})", x.x(), x.y(), x.z());
}

Fault with_context(const std::string& before, Fault fault) {
  fault.text = before + ": " + std::move(fault.text);
  return fault;
}

}  // namespace meniscus
