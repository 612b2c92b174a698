#include "meniscus/case/case_stop_rules.hpp"

#include <algorithm>

namespace meniscus {
namespace {

std::optional<double> number_if_given(Settings& settings, const std::string& path) {
  if (!settings.is_given(path)) return std::nullopt;
  return settings.number(path);
}

}  // namespace

StopRules read_stop_rules(Settings& settings, const DomainCase& domain) {
  const auto number = [&](const char* key) {
    return number_if_given(settings, std::string("time.stop-when.") + key);
  };
  StopRules rules;
  rules.steady_rate = number("steady-rate");
  rules.is_broken_by_event =
      settings.is_given("time.stop-when.broken") && settings.flag("time.stop-when.broken");
  rules.broken_length = number("broken-length");
  rules.length = number("length");
  const bool has_open_patch = std::ranges::any_of(domain.patches, [](const PatchCase& patch) {
    return patch.condition == PatchCase::Condition::open;
  });
  if (has_open_patch) rules.patch_gap = number("patch-gap").value_or(kDefaultPatchGap);
  return rules;
}

StopRules stop_rules_of(const Case& c) {
  Settings settings = c.settings;
  return read_stop_rules(settings, c.domain);
}

}  // namespace meniscus
