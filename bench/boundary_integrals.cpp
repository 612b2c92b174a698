// Pair interactions per second of the direct sums, the core's peak rate of fused multiply-adds on
// registers, and the time of a solve by its parts.

#include <array>
#include <random>

#include <benchmark/benchmark.h>

#include "meniscus/flow/bem/boundary_integral_flow.hpp"
#include "meniscus/flow/bem/integral_equation.hpp"
#include "meniscus/mesh/shapes.hpp"

namespace meniscus::bem {
namespace {

// Operations per pair in the loops; a square root or a division counts as one.
constexpr double kSingleLayerFlops = 30.0, kDoubleLayerFlops = 31.0;

SourcePoints random_points(std::int32_t count) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  const auto vector = [&] { return Vec3(uniform(random), uniform(random), uniform(random)); };
  SourcePoints points;
  for (std::int32_t i = 0; i < count; ++i) points.add(vector(), vector());
  return points;
}

void report(benchmark::State& state, std::int32_t count, double flops) {
  const double pairs = static_cast<double>(state.iterations()) * static_cast<double>(count) * count;
  state.counters["pairs"] = benchmark::Counter(pairs, benchmark::Counter::kIsRate);
  state.counters["flops"] = benchmark::Counter(flops * pairs, benchmark::Counter::kIsRate);
}

void single_layer(benchmark::State& state) {
  const auto count = static_cast<std::int32_t>(state.range(0));
  const SourcePoints points = random_points(count);
  const std::vector<double> q(static_cast<std::size_t>(count), 1.0);
  for (auto _ : state)
    for (std::int32_t i = 0; i < count; ++i)
      benchmark::DoNotOptimize(single_layer_sum(points, q, points.point(i)));
  report(state, count, kSingleLayerFlops);
}
BENCHMARK(single_layer)->Arg(1000)->Arg(10000)->Unit(benchmark::kMillisecond);

void double_layer(benchmark::State& state) {
  const auto count = static_cast<std::int32_t>(state.range(0));
  const SourcePoints points = random_points(count);
  SourceVectors u(count);
  for (std::int32_t i = 0; i < count; ++i) u.set(i, points.point(i));
  for (auto _ : state)
    for (std::int32_t i = 0; i < count; ++i)
      benchmark::DoNotOptimize(double_layer_sum(points, u, points.point(i)));
  report(state, count, kDoubleLayerFlops);
}
BENCHMARK(double_layer)->Arg(1000)->Arg(10000)->Unit(benchmark::kMillisecond);

#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
#define MENISCUS_PEAK_CLONES \
  __attribute__((target_clones("arch=x86-64-v4", "arch=x86-64-v3", "default"), noinline))
#else
#define MENISCUS_PEAK_CLONES __attribute__((noinline))
#endif

constexpr std::size_t kChains = 96;  // twelve vectors of eight: enough to hide the latency
constexpr std::int64_t kTurns = 100000;

/// Independent chains x ← a x + b that stay in registers.
MENISCUS_PEAK_CLONES
void multiply_and_add(std::array<double, kChains>& x, double a, double b) {
  std::array<double, kChains> chains = x;
  for (std::int64_t turn = 0; turn < kTurns; ++turn)
    for (std::size_t k = 0; k < kChains; ++k) chains[k] = chains[k] * a + b;
  x = chains;
}

void peak(benchmark::State& state) {
  std::array<double, kChains> x{};
  for (auto _ : state) {
    multiply_and_add(x, 0.999, 0.001);
    benchmark::DoNotOptimize(x);
  }
  const double operations = 2.0 * static_cast<double>(state.iterations()) * kTurns * kChains;
  state.counters["flops"] = benchmark::Counter(operations, benchmark::Counter::kIsRate);
}
BENCHMARK(peak)->Unit(benchmark::kMillisecond);

Scene stretched_drop(int num_vertices) {
  Scene scene;
  scene.is_unbounded = true;
  scene.flow = ImposedFlow(FlowFamily::axial, ImposedFlow::uniaxial_extension());
  scene.liquids.add({});
  scene.liquids.add({.viscosity = 0.1});
  Interface drop;
  drop.mesh = stretched_sphere(num_vertices, Vec3(1.4, 0.85, 0.85));
  drop.inside = RegionId{1};
  drop.outside = RegionId{0};
  drop.tension = 1.0 / 0.17;
  scene.interfaces.push_back(std::move(drop));
  return scene;
}

/// Measures the set-up for a new geometry, before the first iteration.
void make_equation(benchmark::State& state) {
  const Scene scene = stretched_drop(static_cast<int>(state.range(0)));
  for (auto _ : state) benchmark::DoNotOptimize(IntegralEquation(scene, 0.0, {}));
}
BENCHMARK(make_equation)->Arg(500)->Arg(2000)->Unit(benchmark::kMillisecond);

void apply_equation(benchmark::State& state) {
  const IntegralEquation equation(stretched_drop(static_cast<int>(state.range(0))), 0.0, {});
  const std::vector<double>& w = equation.right_hand_side();
  std::vector<double> result(w.size());
  for (auto _ : state) equation.apply(w, result);
}
BENCHMARK(apply_equation)->Arg(500)->Arg(2000)->Unit(benchmark::kMillisecond);

void solve(benchmark::State& state) {
  const Scene scene = stretched_drop(static_cast<int>(state.range(0)));
  int iterations = 0;
  for (auto _ : state) {
    const auto flow = make_boundary_integral_flow({});
    const FlowSolution report = flow->solve({scene}, {});
    if (!report.ok()) state.SkipWithError("the flow was not solved");
    iterations = report.iterations;
  }
  state.counters["iterations"] = iterations;
}
BENCHMARK(solve)->Arg(500)->Arg(2000)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace meniscus::bem

BENCHMARK_MAIN();
