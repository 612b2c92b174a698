#pragma once

namespace meniscus {

/// A number that decides what a run gives and that no case sets: run.json lists them all, by these
/// names (docs/notation.md).
struct NamedConstant {
  const char* name;
  double value;
};

}  // namespace meniscus
