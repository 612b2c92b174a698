#include <cmath>
#include <string>

#include "meniscus/case/case_parts.hpp"
#include "meniscus/case/words.hpp"

namespace meniscus {
namespace {

Mat3 traceless_gradient(Settings& settings, const std::string& path) {
  Mat3 gradient = settings.matrix(path);
  // 1e-12: roundoff of decimal fractions. A larger trace is a mistake that would create liquid.
  if (std::abs(gradient.trace()) > 1e-12 * gradient.cwiseAbs().maxCoeff())
    settings.reject(path, "has the trace {:.6g}; the trace of a gradient must be 0 (no net inflow)",
                    gradient.trace());
  return gradient;
}

void require_at_most_one(const Settings& settings, const std::string& table) {
  const std::string kind = table + ".kind", gradient = table + ".gradient";
  if (settings.is_given(kind) && settings.is_given(gradient))
    settings.reject(gradient, "conflicts with kind: give one of the two");
}

ImposedFlow read_initial_flow(Settings& settings) {
  require_at_most_one(settings, "flow");
  if (settings.is_given("flow.gradient"))
    return {FlowFamily::general, traceless_gradient(settings, "flow.gradient")};
  if (!settings.is_given("flow.kind"))
    reject_input("{}: flow.kind is missing: it must be one of {}, unless flow.gradient is given",
                 settings.source("flow.kind"),
                 schema::quoted_list(schema::find_key("flow.kind")->words));
  const words::NamedFlow flow = settings.choice("flow.kind", words::flow_kinds);
  return {flow.family, flow.gradient()};
}

ImposedFlow::Entry read_entry(Settings& settings, const std::string& table,
                              const Mat3& initial_gradient) {
  const std::string kind = table + ".kind", gradient = table + ".gradient";
  require_at_most_one(settings, table);
  if (!settings.is_given(kind) && !settings.is_given(gradient) &&
      !settings.is_given(table + ".factor"))
    reject_input("{}: {} needs one of kind, gradient, factor", settings.source(table),
                 schema::without_indices(table));
  const Mat3 base = settings.is_given(kind) ? settings.choice(kind, words::flow_kinds).gradient()
                    : settings.is_given(gradient) ? traceless_gradient(settings, gradient)
                                                  : initial_gradient;
  ImposedFlow::Entry entry;
  entry.time = settings.number(table + ".time");
  entry.ramp = settings.number(table + ".ramp");
  entry.gradient = settings.number(table + ".factor") * base;
  return entry;
}

}  // namespace

ImposedFlow read_flow(Settings& settings) {
  ImposedFlow flow = read_initial_flow(settings);
  double free_from = 0.0;  // end of the previous ramp
  for (int i = 0; i < settings.count("flow.schedule"); ++i) {
    const std::string table = fmt::format("flow.schedule[{}]", i);
    const ImposedFlow::Entry entry = read_entry(settings, table, flow.initial_gradient());
    if (entry.time < free_from || (i > 0 && entry.time == flow.schedule().back().time))
      settings.reject(table + ".time",
                      "must come after the entry before it has begun and its ramp has ended ({} "
                      "1/G)",
                      free_from);
    flow.add(entry);
    free_from = entry.time + entry.ramp;
  }
  return flow;
}

}  // namespace meniscus
