// Both decay rates of drops at rest with surfactant, l = 2 and 3, E0 = 0.5.
#include <cstdio>

#include <gtest/gtest.h>

#include "tests/evolve/resting_mode.hpp"

namespace meniscus::test {
namespace {

constexpr const char* kNotDiffusing = "surfactant = {elasticity = 0.5}";
constexpr const char* kNotDiffusingLangmuir =
    "surfactant = {equation-of-state = \"langmuir\", elasticity = 0.371313, coverage = 0.5}";

/// In a rigid sphere of radius 10 at rest, by an independent axisymmetric program: exact.
constexpr Mode kWalled[] = {{2, 0.1, 0.6825401248, 1.1196026},  {2, 0.1, 1.2790317914, -7.1453927},
                            {2, 1, 0.4411208580, 0.48744365},   {2, 1, 0.9280905313, -16.412153},
                            {2, 10, 0.0926473266, 0.042178968}, {2, 10, 0.6554112175, -189.66799},
                            {3, 0.1, 1.2893464030, 1.2628945},  {3, 0.1, 2.0673633741, -15.836635},
                            {3, 1, 0.7536362960, 0.43085646},   {3, 1, 1.6462928980, -46.419172},
                            {3, 10, 0.1432914743, 0.041007578}, {3, 10, 1.2787728580, -487.71473}};
constexpr Mode kWalledNotDiffusing[] = {
    {2, 0.1, 0.4605936033, 4.1948961}, {2, 0.1, 0.9009783129, -1.9070794},
    {2, 1, 0.2768025789, 6.1898782},   {2, 1, 0.4924088104, -1.2924325},
    {2, 10, 0.0534938200, 13.240997},  {2, 10, 0.0945647241, -0.6041841},
    {3, 0.1, 0.7415011701, 13.303629}, {3, 0.1, 1.4152086070, -1.5033492},
    {3, 1, 0.4170269718, 18.0974},     {3, 1, 0.7829022222, -1.1051311},
    {3, 10, 0.0770436339, 28.498334},  {3, 10, 0.1450206983, -0.70179541}};

/// In half a time of decay, so that an eigenvector that is a little wrong has no time to show, and
/// in sixteen steps: the default ones are so long for so small a motion that they err by percents.
void expect_rate(const Mode& mode, const char* law, const RestingRun& resting) {
  RestingRun run = resting;
  run.surfactant = law;
  run.end = 0.5 / mode.rate;
  run.max_step = run.end / 16.0;
  const RelativeRate found = relative_rate(mode, run);
  std::printf("%s l %u lambda %g rate %.4f g/f %.3g N0 %d: %+.2f %% in %d steps, %s\n",
              run.is_meshed ? "P2-P1" : "boundary integrals", mode.l, mode.lambda, mode.rate,
              mode.g_over_f, run.nodes, 100.0 * (found.value - 1.0), found.num_steps, law);
  EXPECT_NEAR(found.value, 1.0, 0.01);
}

TEST(SurfactantLong, RatesByBoundaryIntegrals) {
  for (const unsigned l : {2U, 3U})
    for (const double lambda : {0.1, 1.0, 10.0}) {
      for (const Mode& mode : modes(l, lambda, 0.5, 10.0))
        for (const char* law : {kLinear, kLangmuir}) expect_rate(mode, law, {.nodes = 400});
      for (const Mode& mode : modes(l, lambda, 0.5, kInfinity))
        for (const char* law : {kNotDiffusing, kNotDiffusingLangmuir})
          expect_rate(mode, law, {.nodes = 400});
    }
}

TEST(SurfactantLong, RatesByQuadraticElements) {
  for (const Mode& mode : kWalled)
    for (const char* law : {kLinear, kLangmuir})
      expect_rate(mode, law, {.nodes = 400, .is_meshed = true});
  for (const Mode& mode : kWalledNotDiffusing)
    for (const char* law : {kNotDiffusing, kNotDiffusingLangmuir})
      expect_rate(mode, law, {.nodes = 400, .is_meshed = true});
}

// A film: β = 50, no diffusion. The slow rate is that of a surface that cannot be stretched,
// (l − 1)l(l + 1)(l + 2)/[(2l³ + 3l² − 5)λ + 2l³ + 3l² + 4]: 24/(32 + 23λ) for l = 2.
TEST(SurfactantLong, FilmsRelaxAsIfTheyCouldNotBeStretched) {
  for (const double lambda : {0.1, 1.0, 10.0}) {
    const Mode stiff = modes(2, lambda, 50.0, kInfinity)[0],
               soft = modes(2, lambda, 0.5, kInfinity)[0];
    const RestingRun run{.nodes = 400, .end = 0.5 / stiff.rate};
    RestingRun of_stiff = run, of_soft = run, resolved = run;
    resolved.max_step = run.end / 16.0;
    resolved.surfactant = "surfactant = {elasticity = 50}";
    of_stiff.surfactant = "surfactant = {elasticity = 50}";
    of_soft.surfactant = kNotDiffusing;
    const RelativeRate freely = relative_rate(stiff, of_stiff),
                       found = relative_rate(stiff, resolved),
                       beside = relative_rate(soft, of_soft);
    const double film = 24.0 / (32.0 + 23.0 * lambda);
    std::printf("film lambda %g: %+.2f %% in %d steps (%d at E0 = 0.5)\n", lambda,
                100.0 * (found.value * stiff.rate / film - 1.0), freely.num_steps,
                beside.num_steps);
    EXPECT_NEAR(found.value * stiff.rate / film, 1.0, 0.01);
    EXPECT_LE(freely.num_steps, 10 * beside.num_steps);
  }
}

}  // namespace
}  // namespace meniscus::test
