#pragma once

#include <cstdint>
#include <string_view>

namespace meniscus::linear {

/// A count or an index as the 32 bits that sparse matrices, here and in PETSc, number entries with.
/// Throws RunFailure, "the flow problem has 2147483648 <things> on one process: …", where it does
/// not fit.
[[nodiscard]] std::int32_t checked_index(std::int64_t value, std::string_view things);

}  // namespace meniscus::linear
