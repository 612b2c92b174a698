// Prints what the tables of docs/validation-stokes.md are made of: a few minutes on one core. With
// the argument P2-P1 and values of N0 (110 200 400), that of the quadratic elements alone.

#include <array>
#include <cstdlib>
#include <span>
#include <string_view>

#include <fmt/format.h>

#include "tests/flow/fem/lamb_mode.hpp"
#include "tests/flow/fem/sphere_experiments.hpp"

namespace meniscus::fem {
namespace {

constexpr std::array<int, 4> sizes = {110, 200, 400, 800};
constexpr std::array<double, 3> viscosity_ratios = {0.1, 1.0, 10.0};
constexpr std::array<CapillaryForm, 3> forms = {CapillaryForm::weak, CapillaryForm::nodal,
                                                CapillaryForm::balanced};

void print_static_spheres() {
  fmt::print("\n| N0 | weak | nodal | balanced |\n|---|---|---|---|\n");
  for (const int size : sizes) {
    fmt::print("| {} |", size);
    for (const CapillaryForm form : forms) {
      const StaticSphere sphere = static_sphere(size, form);
      fmt::print(" {:.1e} / {:+.1e} / {:.1e} |", sphere.largest_velocity, sphere.jump_error,
                 sphere.jump_deviation);
    }
    fmt::print("\n");
    std::fflush(stdout);
  }
}

void print_relaxation_rates(int l) {
  for (const double lambda : viscosity_ratios) {
    const double exact = relaxation_rate(l, lambda);
    fmt::print(
        "\nl = {}, lambda = {}: exact {:.6f}\n\n| N0 | weak | nodal | balanced |\n"
        "|---|---|---|---|\n",
        l, lambda, exact);
    for (const int size : sizes) {
      fmt::print("| {} |", size);
      for (const CapillaryForm form : forms)
        fmt::print(" {:+.2e} |", measured_relaxation_rate(size, form, l, lambda) / exact - 1.0);
      fmt::print("\n");
      std::fflush(stdout);
    }
  }
}

/// Prints one row per size, one column per wall radius and viscosity ratio.
template <std::size_t Walls, class Error>
void print_in_walls(const char* title, const std::array<double, Walls>& walls, Error error) {
  fmt::print("\n{}\n\n| N0 |", title);
  for (const double b : walls)
    for (const double lambda : viscosity_ratios) fmt::print(" b = {}, lambda = {} |", b, lambda);
  fmt::print("\n|---|---|---|---|---|---|---|\n");
  for (const int size : sizes) {
    fmt::print("| {} |", size);
    for (const double b : walls)
      for (const double lambda : viscosity_ratios) fmt::print(" {:+.2e} |", error(size, lambda, b));
    fmt::print("\n");
    std::fflush(stdout);
  }
}

/// Prints the same errors for quadratic elements, in one table.
void print_quadratic_drops(std::span<char*> given_sizes) {
  const Method fitted(CapillaryForm::weak, Elements::p2_p1);
  Method analytic = fitted;
  analytic.has_analytic_middles = true;
  analytic.shows_corners = false;
  fmt::print(
      "\n| N0 | at rest: v, jump, deviation | cE, λ = 0.1 | cE, λ = 10 | fitted, λ = 0.1 | 1 | 10 "
      "| analytic, λ = 0.1 | 1 | 10 |\n|---|---|---|---|---|---|---|---|---|---|\n");
  for (const char* given : given_sizes) {
    const int size = std::atoi(given);
    const StaticSphere rest = static_sphere(size, fitted);
    fmt::print("| {} | {:.1e} / {:+.1e} / {:.1e} |", size, rest.largest_velocity, rest.jump_error,
               rest.jump_deviation);
    for (const double lambda : {0.1, 10.0})
      fmt::print(
          " {:+.2e} |",
          measured_stretching(size, lambda, 10.0, fitted) / exact_stretching(lambda, 10.0) - 1.0);
    std::fflush(stdout);
    for (const Method& method : {fitted, analytic})
      for (const double lambda : viscosity_ratios) {
        fmt::print(
            " {:+.2e} |",
            measured_relaxation_rate(size, method, 2, lambda) / relaxation_rate(2, lambda) - 1.0);
        std::fflush(stdout);
      }
    fmt::print("\n");
  }
}

}  // namespace
}  // namespace meniscus::fem

int main(int count, char** arguments) {
  using namespace meniscus::fem;
  if (count > 1 && std::string_view(arguments[1]) == "P2-P1") {
    print_quadratic_drops({arguments + 2, arguments + count});
    return EXIT_SUCCESS;
  }
  print_static_spheres();
  for (const int l : {2, 3}) print_relaxation_rates(l);
  print_in_walls("cE", std::array{2.0, 5.0}, [](int size, double lambda, double b) {
    return measured_stretching(size, lambda, b) / exact_stretching(lambda, b) - 1.0;
  });
  for (const CapillaryForm form : forms)
    print_in_walls(form == CapillaryForm::weak    ? "cf, weak"
                   : form == CapillaryForm::nodal ? "cf, nodal"
                                                  : "cf, balanced",
                   std::array{2.0, 5.0}, [form](int size, double lambda, double b) {
                     return measured_relaxation_in_wall(size, lambda, b, form) /
                                relaxation_rate(2, lambda, b) -
                            1.0;
                   });
  print_in_walls("U", std::array{3.0, 5.0}, [](int size, double lambda, double b) {
    return measured_translation(size, lambda, b) - 1.0;
  });
  return EXIT_SUCCESS;
}
