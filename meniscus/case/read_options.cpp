#include <algorithm>
#include <cctype>
#include <cmath>
#include <sstream>
#include <string>

#include "meniscus/case/case_parts.hpp"
#include "meniscus/case/words.hpp"

namespace meniscus {
namespace {

/// Throws InvalidInput for words that follow no option name: PETSc would ignore them in silence.
std::string read_petsc_options(Settings& settings) {
  constexpr const char* kPath = "solver.petsc-options";
  std::string options = settings.text(kPath);
  std::istringstream words(options);
  bool may_be_value = false;
  for (std::string word; words >> word;) {
    // A number may begin with a minus sign as well.
    const bool is_option =
        word.size() > 1 && word[0] == '-' && std::isalpha(static_cast<unsigned char>(word[1])) != 0;
    if (!is_option && !may_be_value)
      settings.reject(kPath, "has the word \"{}\", which belongs to no option (-name value …)",
                      word);
    may_be_value = is_option;
  }
  return options;
}

TopologyOptions read_topology(Settings& settings, double edge_floor) {
  TopologyOptions options;
  options.breakup_radius = settings.number("topology.breakup-radius");
  options.coalescence = settings.choice("topology.coalescence", words::on_off);
  options.coalescence_gap = settings.number("topology.coalescence-gap");
  options.edge_floor = edge_floor;
  return options;
}

/// The surface over which the flow solver integrates.
SurfaceShape surface_shape(FlowMethod method, fem::Elements elements) {
  if (method == FlowMethod::boundary_integral) return SurfaceShape::patched;
  return elements == fem::Elements::p2_p1 ? SurfaceShape::splined : SurfaceShape::faceted;
}

/// A case from before there was a choice has the paper's rule and its keys.
StepControl read_control(Settings& settings) {
  const bool is_paper = settings.is_given("time.step-factor") ||
                        settings.is_given("time.step-edges") ||
                        (settings.is_given("time.scheme") &&
                         settings.choice("time.scheme", words::time_schemes) == TimeScheme::euler);
  StepControl suited = kDefaultStepControl;
  if (is_paper)
    suited = StepControl::paper;
  else if (settings.is_given("time.tolerance"))
    suited = StepControl::error;
  settings.prefer("time.control", std::string(words::word_for(words::step_controls, suited)));
  return settings.choice("time.control", words::step_controls);
}

TimeScheme read_scheme(Settings& settings, StepControl control, bool has_inertia) {
  const TimeScheme of_stokes =
      control == StepControl::error ? TimeScheme::semi_implicit : TimeScheme::rk2;
  const TimeScheme suited = has_inertia ? TimeScheme::implicit : of_stokes;
  settings.prefer("time.scheme", std::string(words::word_for(words::time_schemes, suited)));
  const auto scheme = settings.choice("time.scheme", words::time_schemes);
  if (scheme == TimeScheme::euler && control == StepControl::error)
    settings.reject("time.control",
                    "needs another scheme than \"euler\", which estimates no error");
  return scheme;
}

/// How steps are made, and how long they are.
void read_steps(Settings& settings, double inertia, FlowFamily family, EvolutionOptions& options) {
  options.control = read_control(settings);
  options.scheme = read_scheme(settings, options.control, inertia > 0.0);
  if (options.control == StepControl::paper) {
    options.step_factor = settings.number("time.step-factor");
    options.step_edges = settings.choice("time.step-edges", words::step_edges);
    options.tolerance = kMostError;
    options.max_step = settings.number_or("time.max-step", 0.1);
  } else {
    options.tolerance = settings.number("time.tolerance");
    const bool has_waves = family == FlowFamily::quiescent && std::isfinite(inertia);
    const double wave = has_waves ? kDefaultLongestWave * std::sqrt(inertia) : 0.0;
    options.max_step = settings.number_or("time.max-step", std::max(kDefaultLongestStep, wave));
  }
  options.min_step = settings.number("time.min-step");
  if (options.min_step > options.max_step)
    settings.reject("time.min-step", "must be at most time.max-step = {} (unit: 1/G)",
                    options.max_step);
}

void read_motion_normal(Settings& settings, EvolutionOptions& options) {
  MotionNormal suited = MotionNormal::area_vector;
  if (options.surface == SurfaceShape::patched) suited = MotionNormal::smooth;
  if (options.surface == SurfaceShape::splined) suited = MotionNormal::faces;
  settings.prefer("interface.motion-normal",
                  std::string(words::word_for(words::motion_normals, suited)));
  options.motion_normal = settings.choice("interface.motion-normal", words::motion_normals);
  if (options.motion_normal == MotionNormal::faces && options.surface != SurfaceShape::splined)
    settings.reject("interface.motion-normal", "needs solver.elements = \"P2-P1\"");
}

/// Elements leave a small part of the error that a step may make. What is carried keeps what is
/// left from step to step: with 3e-6 slow modes of a drop with surfactant decay 1.1 % too slowly.
double read_elements_residual(Settings& settings, fem::Elements elements, bool carries_something) {
  double suited = fem::Options{}.rtol;
  if (!carries_something && read_control(settings) == StepControl::error) {
    const ResidualLaw& law =
        elements == fem::Elements::p2_p1 ? kResidualOfQuadratic : kResidualOfLinear;
    suited =
        std::clamp(law.over_tolerance * settings.number("time.tolerance"), law.least, law.most);
  }
  return settings.number_or("solver.rtol", suited);
}

}  // namespace

EvolutionOptions read_evolution(Settings& settings, FlowMethod method, fem::Elements elements,
                                double inertia, FlowFamily family) {
  EvolutionOptions options;
  options.surface = surface_shape(method, elements);
  read_motion_normal(settings, options);
  options.end = settings.number("time.end");
  read_steps(settings, inertia, family, options);
  options.follows_drops = settings.choice("domain.frame", words::domain_frames);
  settings.prefer("interface.remesh-every",
                  std::int64_t{options.control == StepControl::paper ? 1 : 0});
  options.remesh_every = settings.whole("interface.remesh-every");
  options.spring_tolerance = settings.number("interface.equilibrium");
  options.edge_floor =
      settings.number_or("interface.edge-floor", 0.5 * settings.number("topology.breakup-radius"));
  options.topology = read_topology(settings, options.edge_floor);
  settings.prefer("interface.neck-edges",
                  std::int64_t{options.surface == SurfaceShape::splined ? kDefaultNeckEdges : 0});
  options.neck_edges = settings.whole("interface.neck-edges");
  options.gap_layers = settings.whole("interface.gap-layers");
  return options;
}

FlowMethod read_method(Settings& settings, const DomainCase& domain) {
  const auto method = settings.choice("solver.method", words::methods);
  const bool is_unbounded = domain.shape == DomainCase::Shape::unbounded;
  if (is_unbounded && method == FlowMethod::finite_element)
    settings.reject("domain.shape", "needs solver.method = \"boundary-integral\"");
  if (!is_unbounded && method == FlowMethod::boundary_integral)
    settings.reject("solver.method", "needs domain.shape = \"unbounded\"");
  return method;
}

bem::Options read_boundary_integrals(Settings& settings) {
  return {.rtol = settings.number_or("solver.rtol", bem::Options{}.rtol),
          .max_iterations = settings.whole("solver.max-iterations"),
          .threads = settings.whole("solver.threads")};
}

fem::Options read_finite_elements(Settings& settings, bool carries_something) {
  fem::Options options;
  options.capillary = settings.choice("interface.surface-tension", words::capillary_forms);
  options.linear = settings.choice("solver.linear", words::linear_solvers);
  const bool needs_linear = options.capillary == fem::CapillaryForm::nodal ||
                            options.linear == fem::LinearSolver::paper_gmres;
  const auto suited = needs_linear ? fem::Elements::p1_p1 : fem::Elements::p2_p1;
  settings.prefer("solver.elements", std::string(words::word_for(words::elements, suited)));
  options.elements = settings.choice("solver.elements", words::elements);
  options.rtol = read_elements_residual(settings, options.elements, carries_something);
  options.max_iterations = settings.whole("solver.max-iterations");
  options.petsc_options = read_petsc_options(settings);
  return options;
}

MovingMeshOptions read_volume_mesh(Settings& settings, fem::Elements elements) {
  MovingMeshOptions options;
  VolumeMeshOptions& tetrahedra = options.tetrahedra;
  tetrahedra = fem::suited_volume_mesh(elements);
  settings.prefer("domain.grading",
                  std::string(words::word_for(words::gradings, tetrahedra.grading)));
  tetrahedra.grading = settings.choice("domain.grading", words::gradings);
  tetrahedra.cell_volume = settings.number_or("domain.cell-volume", tetrahedra.cell_volume);
  tetrahedra.interior_growth = settings.number("domain.interior-growth");
  tetrahedra.radius_edge = settings.number("domain.radius-edge");
  tetrahedra.gap_layers = settings.whole("interface.gap-layers");
  options.motion = settings.choice("interface.volume-motion", words::volume_motions);
  return options;
}

/// [R0] With [scale]: threads in experiments are up to some hundred radii long.
constexpr double kLongestDrop = 1000.0;

StopRules read_stop_rules(Settings& settings, const DomainCase& domain) {
  const auto number = [&](const char* key) -> std::optional<double> {
    const std::string path = std::string("time.stop-when.") + key;
    if (!settings.is_given(path)) return std::nullopt;
    return settings.number(path);
  };
  const auto length = [&](const char* key) {
    const std::optional<double> value = number(key);
    if (value) settings.require_metres(std::string("time.stop-when.") + key, *value, kLongestDrop);
    return value;
  };
  StopRules rules;
  rules.steady_rate = number("steady-rate");
  rules.is_broken_by_event =
      settings.is_given("time.stop-when.broken") && settings.flag("time.stop-when.broken");
  rules.broken_length = length("broken-length");
  rules.length = length("length");
  rules.is_ended_by_patch = std::ranges::any_of(domain.patches, [](const PatchCase& patch) {
    return patch.condition == PatchCase::Condition::open;
  });
  if (rules.is_ended_by_patch) rules.patch_gap = number("patch-gap");
  if (rules.patch_gap == 0.0) rules.is_ended_by_patch = false;
  return rules;
}

OutputOptions read_output(Settings& settings, FlowMethod method) {
  OutputOptions options;
  options.interval = settings.number("output.interval");
  options.volume = settings.flag("output.volume") && method == FlowMethod::finite_element;
  options.volume_interval = options.interval;
  if (options.volume)
    options.volume_interval = settings.number_or("output.volume-interval", options.interval);
  options.checkpoint_every = settings.whole("output.checkpoint-every");
  return options;
}

}  // namespace meniscus
