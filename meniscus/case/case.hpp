#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "meniscus/case/settings.hpp"
#include "meniscus/evolve/options.hpp"
#include "meniscus/evolve/stop_rules.hpp"
#include "meniscus/flow/bem/options.hpp"
#include "meniscus/flow/fem/options.hpp"
#include "meniscus/flow/flow_solver.hpp"
#include "meniscus/flow/scalar_solver.hpp"
#include "meniscus/scene/scene.hpp"

namespace meniscus {

struct BallShape {
  double radius = 1.0;
};
struct EllipsoidShape {
  Vec3 axes = Vec3::Ones();
};
struct FileShape {
  std::filesystem::path file;
  bool is_repaired = false;
};
struct RunShape {
  std::filesystem::path folder;
  std::optional<int> drop;  ///< id in that run; none: its only one
};
using DropShapeCase = std::variant<BallShape, EllipsoidShape, FileShape, RunShape>;

struct DropCase {
  DropShapeCase shape;
  Vec3 center = Vec3::Zero();
  double viscosity_ratio = 1.0;
  double density_ratio = 1.0;  ///< over the matrix's
  ViscosityLaw law = {};
  double tension_ratio = 1.0;
  int nodes = 110;  ///< N0
  Vec3 body_force = Vec3::Zero();
  std::optional<Surfactant> surfactant;
};

/// The part of the outer boundary that a table is about.
struct PatchPlace {
  std::string path;       ///< "domain.patch[2]" or "scalar[0].patch[1]", to name its line
  std::string name;       ///< of the shape's patch, or the label of a tag
  std::vector<int> tags;  ///< of the shape's faces, or the tag in the surface file
};

/// One [[domain.patch]]: the condition on a part of the outer boundary.
struct PatchCase : PatchPlace {
  enum class Condition { velocity, symmetry, open } condition = Condition::velocity;
  bool follows_flow = true;  ///< v = G·x; if false, `velocity` with its profile
  Vec3 velocity = Vec3::Zero();
  bool is_parabolic = false;
  std::optional<Vec3> profile_center = {};
  std::optional<double> profile_radius = {};
  Vec3 traction = Vec3::Zero();
};

struct DomainCase {
  enum class Shape { box, sphere, cylinder, file, unbounded } shape = Shape::box;
  Vec3 half_widths = Vec3::Constant(10.0);
  double radius = 10.0, half_length = 10.0;
  std::filesystem::path file;
  bool is_repaired = false;  ///< the file's surface
  int nodes = 507;
  bool is_symmetric_in_z = false;  ///< the z-faces of the box default to no penetration
  std::vector<PatchCase> patches;
};

/// One [[scalar.patch]]: the condition on a scalar at a part of the outer boundary.
struct ScalarPatchCase : PatchPlace {
  ScalarCondition condition = {};
};

/// One [[scalar]].
struct ScalarCase {
  std::string path;  ///< "scalar[0]", to name its line
  Scalar scalar;
  std::vector<ScalarLiquid> liquids;     ///< of the matrix, then of every drop
  std::vector<ScalarPatchCase> patches;  ///< faces of no patch have no condition
};

/// What a run writes, and when (the case's [output]).
struct OutputOptions {
  double interval = 0.2;         ///< between surfaces written for viewing [1/G]
  bool volume = true;            ///< volume meshes too; else the first and the last alone
  double volume_interval = 0.2;  ///< between them [1/G]
  int checkpoint_every = 10;     ///< steps
};

enum class FlowMethod { finite_element, boundary_integral };

/// A case after reading and checking; all values are dimensionless.
struct Case {
  Settings settings;  ///< every key with its value and source
  std::string title;
  double Ca = 1.0;
  double reynolds = 0.0;        ///< Re = ρ_out G R0²/μ_out; 0: Stokes flow
  Vec3 gravity = Vec3::Zero();  ///< Bond number ρ_out g R0²/σ
  ImposedFlow flow;
  Vec3 matrix_body_force = Vec3::Zero();
  ViscosityLaw matrix_law = {};
  std::vector<DropCase> drops;
  DomainCase domain;
  std::vector<ScalarCase> scalars;
  EvolutionOptions evolution;
  StopRules stop;  ///< when the run ends before its end time
  FlowMethod method = FlowMethod::finite_element;
  fem::Options flow_solver;       ///< options of the finite-element solver
  MovingMeshOptions volume_mesh;  ///< of finite elements
  bem::Options boundary_integral;
  OutputOptions output;
};

/// Reads a case file. Each override is "key=value" and replaces the file's value. A key of the file
/// that loses its effect by an override is ignored. Throws InvalidInput with one line: file:line
/// (or the override), key, value, and what is allowed.
[[nodiscard]] Case read_case(const std::filesystem::path& file,
                             std::span<const std::string> overrides = {});
/// Reads a case from text. Messages call it `name`; relative file names start from `folder`.
[[nodiscard]] Case parse_case(std::string_view text, const std::string& name,
                              const std::filesystem::path& folder = {},
                              std::span<const std::string> overrides = {});

/// The case with all defaults that apply, in its own units, as a case file and as JSON. JSON is
/// nested like the file; inf is the string "inf". `parse_case` of the case file gives the same case
/// bit for bit.
[[nodiscard]] std::string case_toml(const Case& c);
[[nodiscard]] std::string case_json(const Case& c);

/// Takes what the user should know of a case's surfaces: faces that were cut, turned or mended, a
/// surface that could not be remeshed.
using WarningListener = std::function<void(const std::string& text)>;
/// Writes a warning to the log.
void log_warning(const std::string& text);

/// The initial scene of a case. Throws InvalidInput, naming line, drop and position, when a surface
/// is unfit, or when drops touch each other or the boundary or lie outside it. So it does when
/// imposed velocities have a net flux and no patch is open, or a scalar no value where they enter.
[[nodiscard]] Scene build_scene(const Case& c, const WarningListener& warn = log_warning);
/// The initial scene without interfaces. A resumed run needs no more, so that the drops' surface
/// files may be gone.
[[nodiscard]] Scene build_surroundings(const Case& c, const WarningListener& warn = log_warning);
/// Where the case gives the surface nearest to a position: "file:line" of its drop or domain, or
/// of the first drop without a position. Messages about a scene's initial mesh begin with it.
[[nodiscard]] std::string source_of_surface(const Case& c, const Scene& scene,
                                            const std::optional<Vec3>& position);
/// The flow solver of a case.
[[nodiscard]] std::unique_ptr<FlowSolver> make_flow_solver(const Case& c);
/// The flow solver of a case, and what convects and diffuses its bulk scalars.
struct CaseSolvers {
  std::unique_ptr<FlowSolver> flow;
  std::unique_ptr<ScalarSolver> scalars;  ///< null where the case has none
};
[[nodiscard]] CaseSolvers make_solvers(const Case& c);
/// The moving mesh of the case's solver, without tetrahedra as yet; none for boundary integrals.
[[nodiscard]] std::optional<MovingMesh> make_moving_mesh(const Case& c);

}  // namespace meniscus
