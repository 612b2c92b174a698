#pragma once

#include <functional>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "meniscus/case/case.hpp"
#include "meniscus/evolve/evolution.hpp"

namespace meniscus::test {

/// A drop in an unbounded liquid by boundary integrals, in steps of the paper's rule.
struct UnboundedDrop {
  std::string flow = "quiescent";
  double Ca = 1.0;
  std::string shape = "axes = [1.2, 0.913, 0.913]";
  double lambda = 1.0;
  int nodes = 110;
  std::string more = {};  ///< further tables
};

inline Case unbounded_case(const UnboundedDrop& drop) {
  const std::string control =
      drop.more.find("[time]") == std::string::npos ? "[time]\ncontrol = \"paper\"\n" : "";
  return parse_case(
      fmt::format("[flow]\nkind = \"{}\"\ncapillary-number = {}\n[[drop]]\n{}\nviscosity-ratio = "
                  "{}\nnodes = {}\n[domain]\nshape = \"unbounded\"\n[solver]\nmethod = "
                  "\"boundary-integral\"\nrtol = 1e-8\n[topology]\nbreakup-radius = 0\n{}{}",
                  drop.flow, drop.Ca, drop.shape, drop.lambda, drop.nodes, control, drop.more),
      "drop.toml");
}

/// The run of a case's scene with options that `change` sets, to its end or to the first fault.
/// `look` sees every state whose flow was solved.
inline Report run(const Case& c, const Scene& scene,
                  const std::function<void(EvolutionOptions&)>& change,
                  const std::function<void(const Evolution&)>& look) {
  EvolutionOptions options = c.evolution;
  change(options);
  Evolution evolution(scene, options, make_flow_solver(c), make_moving_mesh(c));
  Report report = evolution.prepare();
  while (report.ok()) {
    report = evolution.solve();
    if (!report.ok()) break;
    look(evolution);
    if (evolution.is_finished()) break;
    report = evolution.advance();
  }
  return report;
}

}  // namespace meniscus::test
