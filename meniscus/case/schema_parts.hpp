#pragma once

#include <span>

#include "meniscus/case/schema.hpp"

namespace meniscus::schema {

// The parts of the table of keys, in its order, and what they share.

[[nodiscard]] std::span<const Key> flow_keys();    ///< the case as a whole, and its flow
[[nodiscard]] std::span<const Key> liquid_keys();  ///< the matrix and the drops
[[nodiscard]] std::span<const Key> domain_keys();  ///< the outer boundary
[[nodiscard]] std::span<const Key> scalar_keys();  ///< bulk scalars
[[nodiscard]] std::span<const Key> run_keys();     ///< how a case is run and its units

inline constexpr Range kPositive{.min = 0.0, .open_min = true};
inline constexpr Range kNotNegative{.min = 0.0};
inline constexpr Range kFinite{};
// A drop a million times smaller or larger than R0, or as far away, is a mistake, and beyond
// meshing in double precision.
inline constexpr Range kLength{.min = 1e-6, .max = 1e6};
inline constexpr Range kPlace{.min = -1e6, .max = 1e6};
inline constexpr std::string_view kWithElements = "with method = \"finite-element\"";

}  // namespace meniscus::schema
