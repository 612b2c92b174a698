#include "meniscus/case/case.hpp"

#include <cmath>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/case/case_files.hpp"

namespace meniscus {
namespace {

using test::shear_case;

TEST(Case, HasTheDocumentedDefaults) {
  const Case c = shear_case();
  EXPECT_EQ(c.title, "");
  EXPECT_EQ(c.Ca, 0.3);
  EXPECT_EQ(c.reynolds, 0.0);
  EXPECT_EQ(c.gravity, Vec3(0, 0, 0));
  EXPECT_EQ(c.flow.family(), FlowFamily::planar);
  EXPECT_EQ(c.flow.gradient(3.0), ImposedFlow::simple_shear());
  ASSERT_EQ(c.drops.size(), 1u);
  EXPECT_EQ(std::get<BallShape>(c.drops[0].shape).radius, 1.0);
  EXPECT_EQ(c.drops[0].center, Vec3(0, 0, 0));
  EXPECT_EQ(c.drops[0].viscosity_ratio, 1.0);
  EXPECT_EQ(c.drops[0].density_ratio, 1.0);
  EXPECT_EQ(c.drops[0].tension_ratio, 1.0);
  EXPECT_EQ(c.drops[0].nodes, 110);
  EXPECT_EQ(c.domain.shape, DomainCase::Shape::box);
  EXPECT_EQ(c.domain.half_widths, Vec3::Constant(10.0));
  EXPECT_EQ(c.domain.nodes, 507);
  EXPECT_TRUE(c.domain.is_symmetric_in_z);
  EXPECT_EQ(c.output.interval, 0.2);
  EXPECT_EQ(c.output.volume_interval, 0.2);
  EXPECT_TRUE(c.output.volume);
}

TEST(Case, SolvesWithQuadraticElementsInStepsThatFollowTheError) {
  const Case c = shear_case();
  EXPECT_EQ(c.flow_solver.elements, fem::Elements::p2_p1);
  EXPECT_EQ(c.flow_solver.capillary, fem::CapillaryForm::weak);
  EXPECT_EQ(c.evolution.control, StepControl::error);
  EXPECT_EQ(c.evolution.scheme, TimeScheme::semi_implicit);
  EXPECT_EQ(c.evolution.tolerance, kDefaultTolerance);
  EXPECT_EQ(c.evolution.max_step, kDefaultLongestStep);
  EXPECT_EQ(c.evolution.motion_normal, MotionNormal::faces);
}

Case inertial_drop(double laplace) {
  return parse_case(fmt::format("[flow]\nkind = \"quiescent\"\nreynolds-number = {}\n[[drop]]\n"
                                "radius = 1\n[domain]\nhalf-width = 4\n[time]\nend = 1\n",
                                laplace),
                    "drop.toml");
}

TEST(Case, WithInertiaThePeriodOfADropMayAllowLongerSteps) {
  EXPECT_EQ(inertial_drop(100.0).evolution.max_step, kDefaultLongestStep);
  EXPECT_NEAR(inertial_drop(1e4).evolution.max_step, 7.0, 1e-12);
}

// Its time is the drop's own, whatever rate the case counts times in.
TEST(Case, LongestStepOfAnInertialDropDoesNotDependOnTheRate) {
  const auto longest = [](const std::string& rate) {
    const Case c = parse_case(
        "[scale]\nlength = 1e-3\nviscosity = 1e-5\nsurface-tension = 0.07\ndensity = 1000\n" +
            rate +
            "[flow]\nkind = \"quiescent\"\n[[drop]]\nradius = 1e-3\n"
            "[domain]\nhalf-width = 4e-3\n[time]\nend = 0.1\n",
        "case.toml");
    return c.evolution.max_step / c.settings.scale()->rate;
  };
  // 0.07 (ρ_out R0³/σ)^½
  EXPECT_NEAR(longest(""), 0.07 * std::sqrt(1000.0 * 1e-9 / 0.07), 1e-12);
  EXPECT_NEAR(longest("rate = 70000.0\n") / longest(""), 1.0, 1e-12);
}

TEST(Case, WhatLinearElementsAloneCanDoChoosesThem) {
  const auto elements = [](const std::string& tables) {
    return shear_case(tables).flow_solver.elements;
  };
  EXPECT_EQ(elements("[interface]\nsurface-tension = \"nodal\"\n"), fem::Elements::p1_p1);
  EXPECT_EQ(elements("[solver]\nlinear = \"paper-gmres\"\n"), fem::Elements::p1_p1);
  EXPECT_EQ(elements("[interface]\nsurface-tension = \"balanced\"\n"), fem::Elements::p2_p1);
}

TEST(Case, AStepFactorWithoutControlMeansThePapersRule) {
  const EvolutionOptions evolution = shear_case("[time]\nstep-factor = 0.7\n").evolution;
  EXPECT_EQ(evolution.control, StepControl::paper);
  EXPECT_EQ(evolution.scheme, TimeScheme::rk2);
  EXPECT_EQ(evolution.step_factor, 0.7);
  EXPECT_EQ(evolution.max_step, 0.1);
}

TEST(Case, LiquidsWithInertiaHaveAnImplicitScheme) {
  const auto evolution = [](const std::string& tables) {
    return shear_case(tables, {"flow.reynolds-number=10"}).evolution;
  };
  for (const char* tables :
       {"", "[time]\nscheme = \"implicit\"\n", "[interface]\nsurface-tension = \"balanced\"\n"}) {
    EXPECT_EQ(evolution(tables).scheme, TimeScheme::implicit) << tables;
    EXPECT_EQ(evolution(tables).control, StepControl::error) << tables;
  }
  for (const char* tables : {"[time]\ncontrol = \"paper\"\n", "[time]\nstep-factor = 0.7\n"}) {
    EXPECT_EQ(evolution(tables).scheme, TimeScheme::implicit) << tables;
    EXPECT_EQ(evolution(tables).control, StepControl::paper) << tables;
  }
}

TEST(Case, AnOverrideMayTakeInertiaAndWithItTheEffectOfDensities) {
  const Case c = parse_case(
      "[flow]\nkind = \"quiescent\"\nreynolds-number = 10\n[[drop]]\nradius = 1\n"
      "density-ratio = 2\n",
      "case.toml", {}, std::vector<std::string>{"flow.reynolds-number=0"});
  EXPECT_EQ(c.reynolds, 0.0);
  EXPECT_EQ(c.evolution.scheme, TimeScheme::semi_implicit);
}

TEST(Case, OptionsOfThePapersMethodAreTheDefaultsOfTheRooms) {
  const Case c =
      shear_case("[solver]\nelements = \"P1-P1\"\n[time]\ncontrol = \"paper\"\nend = 1.0\n");
  const EvolutionOptions evolution;
  EXPECT_EQ(c.evolution.scheme, evolution.scheme);
  EXPECT_EQ(c.evolution.motion_normal, evolution.motion_normal);
  EXPECT_EQ(c.evolution.end, evolution.end);
  EXPECT_EQ(c.evolution.step_factor, evolution.step_factor);
  EXPECT_EQ(c.evolution.step_edges, evolution.step_edges);
  EXPECT_EQ(c.evolution.max_step, evolution.max_step);
  EXPECT_EQ(c.evolution.min_step, evolution.min_step);
  EXPECT_EQ(c.evolution.remesh_every, evolution.remesh_every);
  EXPECT_EQ(c.evolution.edge_floor, 0.5 * c.evolution.topology.breakup_radius);
  const fem::Options solver;
  const MovingMeshOptions mesh;
  EXPECT_EQ(c.flow_solver.capillary, solver.capillary);
  EXPECT_EQ(c.flow_solver.linear, solver.linear);
  EXPECT_EQ(c.flow_solver.rtol, solver.rtol);
  EXPECT_EQ(c.flow_solver.max_iterations, solver.max_iterations);
  EXPECT_EQ(c.volume_mesh.tetrahedra.grading, mesh.tetrahedra.grading);
  EXPECT_EQ(c.volume_mesh.tetrahedra.cell_volume, mesh.tetrahedra.cell_volume);
  EXPECT_EQ(c.volume_mesh.motion, mesh.motion);
  EXPECT_EQ(c.flow_solver.petsc_options, solver.petsc_options);
}

TEST(Case, ElementsLeaveAPartOfTheErrorOfAStep) {
  const auto rtol = [](const std::string& tables) { return shear_case(tables).flow_solver.rtol; };
  EXPECT_DOUBLE_EQ(rtol(""), 2e-6);
  EXPECT_DOUBLE_EQ(rtol("[time]\ntolerance = 0.02\n"), 0.02 / 15000.0);
  EXPECT_DOUBLE_EQ(rtol("[time]\ntolerance = 0.001\n"), 2e-7);
  EXPECT_DOUBLE_EQ(rtol("[time]\ntolerance = 0.3\n"), 2e-6);
  EXPECT_DOUBLE_EQ(rtol("[solver]\nelements = \"P1-P1\"\n"), 3e-6);
  EXPECT_DOUBLE_EQ(rtol("[time]\ntolerance = 0.003\n[solver]\nelements = \"P1-P1\"\n"), 1e-6);
  EXPECT_DOUBLE_EQ(rtol("[time]\ncontrol = \"paper\"\n"), 1e-6);
  EXPECT_DOUBLE_EQ(rtol("[drop.surfactant]\nelasticity = 0.2\n"), 1e-6);
  EXPECT_DOUBLE_EQ(inertial_drop(100.0).flow_solver.rtol, 1e-6);
  EXPECT_DOUBLE_EQ(rtol("[time]\ntolerance = 0.003\n[solver]\nrtol = 1e-4\n"), 1e-4);
}

TEST(Case, BoundaryIntegralsTakeTheirOptionsAndAnUnboundedScene) {
  const std::string solver =
      "[domain]\nshape = \"unbounded\"\n[solver]\nmethod = \"boundary-integral\"\n";
  const Case plain = shear_case(solver);
  const bem::Options options;
  EXPECT_EQ(plain.method, FlowMethod::boundary_integral);
  EXPECT_EQ(plain.boundary_integral.rtol, options.rtol);
  EXPECT_EQ(plain.boundary_integral.max_iterations, options.max_iterations);
  EXPECT_EQ(plain.boundary_integral.threads, options.threads);
  EXPECT_FALSE(plain.output.volume);
  EXPECT_EQ(plain.evolution.surface, SurfaceShape::patched);
  EXPECT_EQ(plain.evolution.motion_normal, MotionNormal::smooth);
  const Case c = shear_case(solver + "rtol = 1e-9\nmax-iterations = 50\nthreads = 3\n");
  EXPECT_EQ(c.boundary_integral.rtol, 1e-9);
  EXPECT_EQ(c.boundary_integral.max_iterations, 50);
  EXPECT_EQ(c.boundary_integral.threads, 3);
  const Scene scene = build_scene(c);
  EXPECT_TRUE(scene.is_unbounded);
  EXPECT_EQ(scene.boundary.mesh.num_faces(), 0);
  const std::unique_ptr<FlowSolver> flow = make_flow_solver(c);
  EXPECT_TRUE(flow->solve({scene}, {}).ok());
  EXPECT_FALSE(make_moving_mesh(c));
}

TEST(Case, WordsBecomeOptions) {
  const Case c = shear_case(
      "[interface]\nsurface-tension = \"balanced\"\nmotion-normal = \"fit\"\n"
      "volume-motion = \"harmonic\"\n[solver]\nlinear = \"mumps\"\n[time]\nscheme = \"euler\"\n"
      "step-edges = \"mesh\"\n[domain]\ngrading = \"gaussian\"\n");
  EXPECT_EQ(c.flow_solver.capillary, fem::CapillaryForm::balanced);
  EXPECT_EQ(c.evolution.motion_normal, MotionNormal::fit);
  EXPECT_EQ(c.volume_mesh.motion, VolumeMotion::harmonic);
  EXPECT_EQ(c.flow_solver.linear, fem::LinearSolver::mumps);
  EXPECT_EQ(c.evolution.scheme, TimeScheme::euler);
  EXPECT_EQ(c.evolution.step_edges, StepEdges::mesh);
  EXPECT_EQ(c.volume_mesh.tetrahedra.grading, Grading::gaussian);
}

TEST(Case, InterfacesAreTheSurfacesThatTheSolverIntegratesOver) {
  const auto shape = [](const std::string& solver) { return shear_case(solver).evolution.surface; };
  EXPECT_EQ(shape(""), SurfaceShape::splined);
  EXPECT_EQ(shape("[solver]\nelements = \"P1-P1\"\n"), SurfaceShape::faceted);
}

TEST(Case, QuadraticElementsGetSmallCellsAroundTheDrops) {
  const std::string elements = "[solver]\nelements = \"P2-P1\"\n";
  const VolumeMeshOptions plain = shear_case(elements).volume_mesh.tetrahedra;
  EXPECT_EQ(plain.grading, Grading::gaussian);
  EXPECT_EQ(plain.cell_volume, 1.5);
  const VolumeMeshOptions told =
      shear_case(elements + "[domain]\ngrading = \"linear\"\ncell-volume = 3.0\n")
          .volume_mesh.tetrahedra;
  EXPECT_EQ(told.grading, Grading::linear);
  EXPECT_EQ(told.cell_volume, 3.0);
}

TEST(Case, OverridesWinAndAddDrops) {
  const Case c = shear_case(
      "", {"drop[0].nodes=200", "flow.capillary-number=inf", "interface.surface-tension=nodal",
           "drop[1].radius=0.5", "drop[1].center=[0, 0, 3]", "time.scheme=\"euler\""});
  EXPECT_EQ(c.drops[0].nodes, 200);
  EXPECT_TRUE(std::isinf(c.Ca));
  EXPECT_EQ(c.flow_solver.capillary, fem::CapillaryForm::nodal);
  ASSERT_EQ(c.drops.size(), 2u);
  EXPECT_EQ(c.drops[1].center, Vec3(0, 0, 3));
  EXPECT_EQ(c.evolution.scheme, TimeScheme::euler);
}

TEST(Case, OverridesMayTakeTheEffectOfWhatTheFileSays) {
  constexpr const char* kElements =
      "[domain]\nhalf-width = 20\n[interface]\nsurface-tension = \"nodal\"\n";
  const std::vector<std::string> integrals = {"solver.method=boundary-integral",
                                              "domain.shape=unbounded"};
  EXPECT_EQ(shear_case(kElements, integrals).method, FlowMethod::boundary_integral);
  // Not so what has no effect in the file either, and what is itself an override.
  EXPECT_EQ(test::message_of(std::string(test::kShear) + "[domain]\nradius = 20\n", integrals),
            "case.toml:7: domain.radius has no effect here: it applies with shape = \"sphere\" or "
            "\"cylinder\"");
  EXPECT_EQ(test::message_of(test::kShear, {"solver.method=boundary-integral",
                                            "domain.shape=unbounded", "domain.half-width=5"}),
            "--set domain.half-width=5: domain.half-width has no effect here: it applies with "
            "shape = \"box\", without half-widths");
}

TEST(Case, OverridesNeedNoIndexWhereThereIsOneTable) {
  const Case c = shear_case("[[flow.schedule]]\ntime = 1\nfactor = 0\n",
                            {"drop.nodes=80", "flow.schedule.time=2"});
  EXPECT_EQ(c.drops[0].nodes, 80);
  EXPECT_EQ(c.flow.schedule()[0].time, 2.0);
}

TEST(Case, OverridesMayAddADropInAnyOrder) {
  const Case c =
      shear_case("", {"drop[1].nodes=60", "drop[1].center=[0, 0, 3]", "drop[1].radius=0.5"});
  ASSERT_EQ(c.drops.size(), 2u);
  EXPECT_EQ(c.drops[1].nodes, 60);
}

TEST(Case, OverridesTakeTitlesWithBlanksAndQuotedNumbers) {
  EXPECT_EQ(shear_case("", {"title=Two drops"}).title, "Two drops");
  EXPECT_EQ(shear_case("", {"title=\"Two drops\""}).title, "Two drops");
  EXPECT_EQ(shear_case("", {"title=\"7\""}).title, "7");
}

TEST(Case, InlineTablesAreTables) {
  const Case c = parse_case(
      "flow = {kind = \"quiescent\"}\ndrop = [{radius = 0.5}, {radius = 1, center = [3, 0, 0]}]\n",
      "case.toml");
  EXPECT_EQ(c.flow.family(), FlowFamily::quiescent);
  EXPECT_EQ(c.drops.size(), 2u);
}

TEST(Case, CapillaryNumberOfAFlowAtRestIsOneOrInfinite) {
  const auto read = [](const std::string& flow, const std::string& more = "") {
    return parse_case("[flow]\n" + flow + "\n[[drop]]\nradius = 1\n" + more, "case.toml").Ca;
  };
  const std::string at_rest = "kind = \"quiescent\"\ncapillary-number = ";
  EXPECT_EQ(read("kind = \"quiescent\""), 1.0);
  EXPECT_EQ(read(at_rest + "1"), 1.0);
  EXPECT_TRUE(std::isinf(read(at_rest + "inf")));
  EXPECT_THROW(read(at_rest + "2"), InvalidInput);
  EXPECT_THROW(read("gradient = [[0, 0, 0], [0, 0, 0], [0, 0, 0]]\ncapillary-number = 2"),
               InvalidInput);
  // A schedule or a patch that sets a rate makes any number meaningful.
  const std::string start = "[[flow.schedule]]\ntime = 1\nkind = \"simple-shear\"\n";
  EXPECT_EQ(read(at_rest + "0.3", start), 0.3);
  EXPECT_THROW(read(at_rest + "0.3", start + "factor = 0\n"), InvalidInput);
  EXPECT_EQ(read(at_rest + "0.3", "[[domain.patch]]\nname = \"x-\"\nvelocity = [1, 0, 0]\n"), 0.3);
  EXPECT_THROW(read(at_rest + "0.3", "[[domain.patch]]\nname = \"x-\"\nvelocity = [0, 0, 0]\n"),
               InvalidInput);
}

TEST(Case, ScheduleStopsRampsAndReverses) {
  const Case c = shear_case(
      "[[flow.schedule]]\ntime = 1\nfactor = 0\nramp = 2\n"
      "[[flow.schedule]]\ntime = 4\nfactor = -1\n"
      "[[flow.schedule]]\ntime = 5\nkind = \"planar-extension\"\nfactor = 0.5\n"
      "[[flow.schedule]]\ntime = 6\ngradient = [[0, 0, 0], [0, 0, 2], [0, 0, 0]]\n");
  const auto shear_rate = [&](double t) { return c.flow.gradient(t)(0, 1); };
  EXPECT_EQ(shear_rate(0.9), 1.0);
  EXPECT_DOUBLE_EQ(shear_rate(2.0), 0.5);
  EXPECT_EQ(shear_rate(3.5), 0.0);
  EXPECT_EQ(shear_rate(4.5), -1.0);
  EXPECT_EQ(c.flow.gradient(5.5), Mat3(0.5 * ImposedFlow::planar_extension()));
  EXPECT_EQ(c.flow.gradient(7.0)(1, 2), 2.0);
  EXPECT_FALSE(c.domain.is_symmetric_in_z);  // the last entry has vorticity along x
}

TEST(Case, EveryFlowHasItsFamilyAndGradient) {
  const auto flow = [](const std::string& line) {
    return parse_case("[flow]\n" + line + "\n[[drop]]\nradius = 1\n", "case.toml").flow;
  };
  EXPECT_EQ(flow("kind = \"uniaxial-extension\"").family(), FlowFamily::axial);
  EXPECT_EQ(flow("kind = \"uniaxial-extension\"").gradient(0), ImposedFlow::uniaxial_extension());
  EXPECT_EQ(flow("kind = \"planar-extension\"").family(), FlowFamily::planar);
  EXPECT_EQ(flow("kind = \"quiescent\"").family(), FlowFamily::quiescent);
  EXPECT_EQ(flow("kind = \"quiescent\"").gradient(0), Mat3::Zero());
  const ImposedFlow general = flow("gradient = [[0.1, 1, 0], [0, 0.2, 0], [0, 0, -0.3]]");
  EXPECT_EQ(general.family(), FlowFamily::general);
  EXPECT_EQ(general.gradient(0)(1, 1), 0.2);
}

constexpr const char* kScaled =
    "[flow]\nkind = \"simple-shear\"\n"
    "[[drop]]\nradius = 2e-3\nbody-force = [100.0, 0, 0]\n"
    "[domain]\nhalf-width = 0.01\n"
    "[time]\nend = 3.0\n"
    "[scale]\nlength = 1e-3\nviscosity = 5.0\nsurface-tension = 0.02\nrate = 2.0\n";

TEST(Case, ScaleConvertsOnce) {
  const Case c = parse_case(kScaled, "case.toml");
  EXPECT_DOUBLE_EQ(c.Ca, 5.0 * 2.0 * 1e-3 / 0.02);
  EXPECT_DOUBLE_EQ(std::get<BallShape>(c.drops[0].shape).radius, 2.0);
  EXPECT_DOUBLE_EQ(c.domain.half_widths.x(), 10.0);
  EXPECT_DOUBLE_EQ(c.evolution.end, 6.0);             // 3 s at 2 per second
  EXPECT_DOUBLE_EQ(c.drops[0].body_force.x(), 0.01);  // over viscosity · rate/length = 1e4 N/m³
  EXPECT_DOUBLE_EQ(c.evolution.max_step, 1.0);        // a default stays dimensionless
}

/// kScaled with densities and gravity.
constexpr const char* kScaledWeight =
    "[flow]\nkind = \"simple-shear\"\ngravity = [0, 0, -9.81]\n"
    "[[drop]]\nradius = 1e-3\ndensity-ratio = 0.8\n"
    "[scale]\nlength = 1e-3\nviscosity = 5.0\nsurface-tension = 0.02\nrate = 2.0\n"
    "density = 1000.0\n";

TEST(Case, ScaleGivesReynoldsAndBondNumbers) {
  const Case c = parse_case(kScaledWeight, "case.toml");
  EXPECT_DOUBLE_EQ(c.reynolds, 1000.0 * 2.0 * 1e-6 / 5.0);
  EXPECT_EQ(c.gravity.head<2>().norm(), 0.0);
  EXPECT_DOUBLE_EQ(c.gravity.z(), -1000.0 * 9.81 * 1e-6 / 0.02);
  EXPECT_EQ(c.drops[0].density_ratio, 0.8);
  const Case light = parse_case(kScaled, "case.toml");
  EXPECT_EQ(light.reynolds, 0.0);
  EXPECT_EQ(light.evolution.scheme, TimeScheme::semi_implicit);
}

TEST(Case, ReynoldsNumberOfAQuiescentFlowIsTheLaplaceNumber) {
  const Case c = parse_case(
      "[flow]\nkind = \"quiescent\"\n[[drop]]\nradius = 1e-3\n"
      "[scale]\nlength = 1e-3\nviscosity = 2.0\nsurface-tension = 0.03\ndensity = 1000.0\n",
      "case.toml");
  const double laplace = 1000.0 * 0.03 * 1e-3 / (2.0 * 2.0);
  EXPECT_NEAR(c.reynolds, laplace, 1e-14 * laplace);  // roundoff
}

TEST(Case, ScaleOfAQuiescentFlowIsTheCapillaryTime) {
  const Case c = parse_case(
      "[flow]\nkind = \"quiescent\"\n[[drop]]\nradius = 1e-3\n"
      "[scale]\nlength = 1e-3\nviscosity = 2.0\nsurface-tension = 0.03\n",
      "case.toml");
  EXPECT_DOUBLE_EQ(c.Ca, 1.0);
  EXPECT_DOUBLE_EQ(c.settings.scale()->rate, 15.0);
}

TEST(Case, TomlWithDefaultsReadsBackToTheSameCase) {
  const std::string text = std::string(test::kShear) +
                           "viscosity-ratio = 0.1\n[[drop]]\naxes = [1, 2, 0.3]\n"
                           "center = [5, 0, 0]\n[[flow.schedule]]\ntime = 3\nfactor = -1\n"
                           "[[domain.patch]]\nname = \"x+\"\nvelocity = [0.1, 0, 0]\n";
  const std::string inertia =
      "[flow]\nkind = \"quiescent\"\nreynolds-number = 0.1\ngravity = [0, 0.1, -0.3]\n"
      "[[drop]]\nradius = 0.7\ndensity-ratio = 0.1\n";
  for (const std::string& source :
       {text, std::string(kScaled), inertia, std::string(kScaledWeight)}) {
    const Case first = parse_case(source, "case.toml");
    const Case second = parse_case(case_toml(first), "again.toml");
    EXPECT_EQ(case_toml(first), case_toml(second));
    EXPECT_EQ(first.Ca, second.Ca);
    EXPECT_EQ(first.reynolds, second.reynolds);
    EXPECT_EQ(first.gravity, second.gravity);
    EXPECT_EQ(first.drops[0].density_ratio, second.drops[0].density_ratio);
    EXPECT_EQ(first.evolution.scheme, second.evolution.scheme);
    EXPECT_EQ(first.evolution.max_step, second.evolution.max_step);
    EXPECT_EQ(first.drops.size(), second.drops.size());
    EXPECT_EQ(first.flow.gradient(4.0), second.flow.gradient(4.0));
    EXPECT_EQ(first.domain.is_symmetric_in_z, second.domain.is_symmetric_in_z);
  }
}

TEST(Case, JsonHasInertiaAndGravity) {
  const Case c =
      shear_case("density-ratio = 2\n", {"flow.reynolds-number=10", "flow.gravity=[0, 0, -0.5]"});
  const nlohmann::json json = nlohmann::json::parse(case_json(c));
  EXPECT_EQ(json["flow"]["reynolds-number"], 10.0);
  EXPECT_EQ(json["flow"]["gravity"], nlohmann::json({0.0, 0.0, -0.5}));
  EXPECT_EQ(json["drop"][0]["density-ratio"], 2.0);
  EXPECT_EQ(json["time"]["scheme"], "implicit");
}

TEST(Case, JsonHasEveryValueInItsPlace) {
  const Case c = shear_case("[[drop]]\nradius = 0.5\ncenter = [0, 0, 3]\n",
                            {"flow.capillary-number=inf", "title=A \"quoted\" title"});
  const nlohmann::json json = nlohmann::json::parse(case_json(c));
  EXPECT_EQ(json["title"], "A \"quoted\" title");
  EXPECT_EQ(json["flow"]["capillary-number"], "inf");
  ASSERT_EQ(json["drop"].size(), 2u);
  EXPECT_EQ(json["drop"][1]["center"], nlohmann::json({0.0, 0.0, 3.0}));
  EXPECT_EQ(json["drop"][1]["nodes"], 110);
  EXPECT_EQ(json["time"]["scheme"], "semi-implicit");
  EXPECT_EQ(json["topology"]["coalescence"], "on");
  EXPECT_EQ(json["output"]["volume"], true);
  EXPECT_FALSE(json["domain"].contains("radius"));  // of another shape
}

}  // namespace
}  // namespace meniscus
