#include "meniscus/case/examples.hpp"

#include <algorithm>
#include <vector>

#include "meniscus/case/nearest_word.hpp"
#include "meniscus/core/error.hpp"

namespace meniscus {
namespace {

// cmake/Examples.cmake writes these entries: {"name", R"text(…)text", R"text(…)text"}, …
constexpr ExampleCase kExamples[] = {
#include "meniscus/case/examples_generated.inc"
};

}  // namespace

std::span<const ExampleCase> examples() { return kExamples; }

const ExampleCase& example(std::string_view name) {
  const auto found = std::ranges::find(examples(), name, &ExampleCase::name);
  if (found != examples().end()) return *found;
  std::vector<std::string_view> names;
  for (const ExampleCase& each : examples()) names.push_back(each.name);
  const std::string_view near = nearest_word(name, names);
  reject_input("examples: \"{}\" is not one of {}{}", name, fmt::join(names, ", "),
               near.empty() ? "" : fmt::format("; did you mean \"{}\"?", near));
}

}  // namespace meniscus
