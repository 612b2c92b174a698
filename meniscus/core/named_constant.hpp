#pragma once

namespace meniscus {

/// A constant that affects results but cannot be set in a case. run.json lists all of them by name
/// (docs/notation.md).
struct NamedConstant {
  const char* name;
  double value;
};

}  // namespace meniscus
