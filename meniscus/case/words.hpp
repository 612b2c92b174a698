#pragma once

#include <array>
#include <string_view>
#include <vector>

#include "meniscus/case/case.hpp"

namespace meniscus::words {

/// A word of a case file and its meaning.
template <class Meaning>
struct Word {
  std::string_view word;
  Meaning meaning;
};

// The words of every key that takes a word. The schema lists them; `Settings::choice` reads them.

struct NamedFlow {
  FlowFamily family;
  Mat3 (*gradient)();
};
inline Mat3 no_gradient() { return Mat3::Zero(); }
inline constexpr std::array flow_kinds{
    Word<NamedFlow>{"simple-shear", {FlowFamily::planar, ImposedFlow::simple_shear}},
    Word<NamedFlow>{"uniaxial-extension", {FlowFamily::axial, ImposedFlow::uniaxial_extension}},
    Word<NamedFlow>{"planar-extension", {FlowFamily::planar, ImposedFlow::planar_extension}},
    Word<NamedFlow>{"quiescent", {FlowFamily::quiescent, no_gradient}}};

enum class LawKind { newtonian, carreau_yasuda, power_law };
inline constexpr std::array viscosity_laws{Word<LawKind>{"newtonian", LawKind::newtonian},
                                           Word<LawKind>{"carreau-yasuda", LawKind::carreau_yasuda},
                                           Word<LawKind>{"power-law", LawKind::power_law}};

enum class StateKind { linear, langmuir };
inline constexpr std::array equations_of_state{Word<StateKind>{"linear", StateKind::linear},
                                               Word<StateKind>{"langmuir", StateKind::langmuir}};

/// The shapes of the domain but for a surface file, which has its own key.
inline constexpr std::array domain_shapes{
    Word<DomainCase::Shape>{"box", DomainCase::Shape::box},
    Word<DomainCase::Shape>{"sphere", DomainCase::Shape::sphere},
    Word<DomainCase::Shape>{"cylinder", DomainCase::Shape::cylinder},
    Word<DomainCase::Shape>{"unbounded", DomainCase::Shape::unbounded}};
inline constexpr std::array gradings{Word<Grading>{"linear", Grading::linear},
                                     Word<Grading>{"exponential", Grading::exponential},
                                     Word<Grading>{"gaussian", Grading::gaussian}};
/// Whether the domain follows the drops.
inline constexpr std::array domain_frames{Word<bool>{"fixed", false}, Word<bool>{"drops", true}};

inline constexpr std::array conditions{
    Word<PatchCase::Condition>{"velocity", PatchCase::Condition::velocity},
    Word<PatchCase::Condition>{"symmetry", PatchCase::Condition::symmetry},
    Word<PatchCase::Condition>{"open", PatchCase::Condition::open}};
/// Whether a profile is parabolic.
inline constexpr std::array profiles{Word<bool>{"uniform", false}, Word<bool>{"parabolic", true}};

inline constexpr std::array capillary_forms{
    Word<fem::CapillaryForm>{"weak", fem::CapillaryForm::weak},
    Word<fem::CapillaryForm>{"nodal", fem::CapillaryForm::nodal},
    Word<fem::CapillaryForm>{"balanced", fem::CapillaryForm::balanced}};
inline constexpr std::array motion_normals{
    Word<MotionNormal>{"area-vector", MotionNormal::area_vector},
    Word<MotionNormal>{"fit", MotionNormal::fit},
    Word<MotionNormal>{"smooth", MotionNormal::smooth},
    Word<MotionNormal>{"faces", MotionNormal::faces}};
inline constexpr std::array volume_motions{
    Word<VolumeMotion>{"spines", VolumeMotion::spines},
    Word<VolumeMotion>{"lagrangian", VolumeMotion::lagrangian},
    Word<VolumeMotion>{"harmonic", VolumeMotion::harmonic}};

inline constexpr std::array on_off{Word<bool>{"on", true}, Word<bool>{"off", false}};

inline constexpr std::array methods{
    Word<FlowMethod>{"finite-element", FlowMethod::finite_element},
    Word<FlowMethod>{"boundary-integral", FlowMethod::boundary_integral}};
inline constexpr std::array elements{Word<fem::Elements>{"P1-P1", fem::Elements::p1_p1},
                                     Word<fem::Elements>{"P2-P1", fem::Elements::p2_p1}};
inline constexpr std::array linear_solvers{
    Word<fem::LinearSolver>{"block", fem::LinearSolver::block},
    Word<fem::LinearSolver>{"paper-gmres", fem::LinearSolver::paper_gmres},
    Word<fem::LinearSolver>{"minres", fem::LinearSolver::minres},
    Word<fem::LinearSolver>{"mumps", fem::LinearSolver::mumps}};

inline constexpr std::array time_schemes{
    Word<TimeScheme>{"rk2", TimeScheme::rk2}, Word<TimeScheme>{"euler", TimeScheme::euler},
    Word<TimeScheme>{"semi-implicit", TimeScheme::semi_implicit},
    Word<TimeScheme>{"rkc", TimeScheme::rkc}, Word<TimeScheme>{"implicit", TimeScheme::implicit}};
inline constexpr std::array step_controls{Word<StepControl>{"paper", StepControl::paper},
                                          Word<StepControl>{"error", StepControl::error}};
inline constexpr std::array step_edges{Word<StepEdges>{"interface", StepEdges::interface},
                                       Word<StepEdges>{"mesh", StepEdges::mesh}};

/// Whether a bulk scalar is a species.
inline constexpr std::array scalar_kinds{Word<bool>{"heat", false}, Word<bool>{"species", true}};
inline constexpr std::array scalar_conditions{
    Word<ScalarCondition::Kind>{"none", ScalarCondition::Kind::none},
    Word<ScalarCondition::Kind>{"value", ScalarCondition::Kind::value},
    Word<ScalarCondition::Kind>{"flux", ScalarCondition::Kind::flux}};

/// The words without meanings, for the schema.
template <class Meaning, std::size_t N>
std::vector<std::string_view> list(const std::array<Word<Meaning>, N>& words) {
  std::vector<std::string_view> result;
  result.reserve(N);
  for (const Word<Meaning>& entry : words) result.push_back(entry.word);
  return result;
}

/// The word for a meaning.
template <class Meaning, std::size_t N>
std::string_view word_for(const std::array<Word<Meaning>, N>& words, Meaning meaning) {
  for (const Word<Meaning>& entry : words)
    if (entry.meaning == meaning) return entry.word;
  MENISCUS_ASSERT(false, "a meaning without a word");
  return words[0].word;
}

}  // namespace meniscus::words
