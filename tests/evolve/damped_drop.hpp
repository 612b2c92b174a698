#pragma once

#include <array>
#include <optional>
#include <vector>

#include "meniscus/evolve/evolution.hpp"
#include "meniscus/flow/fem/finite_element_flow.hpp"

namespace meniscus::test {

/// A drop in a sphere of radius 4 whose wall moves with a linear flow, never remeshed.
struct DampedDrop {
  TimeScheme scheme = TimeScheme::semi_implicit;
  fem::Elements elements = fem::Elements::p1_p1;
  fem::CapillaryForm form = fem::CapillaryForm::weak;
  int num_vertices = 110;
  double viscosity_ratio = 1.0;
  double Ca = 1.0;
  double D = 0.1;      ///< of the ellipsoid of revolution about x
  double l4 = 0.0;     ///< radii are multiplied by 1 + l4 P_4(x/r), P_4 the Legendre polynomial
  double noise = 0.0;  ///< [R0] standard deviation of the vertices' radii
  Vec3 center = Vec3::Zero();
  Mat3 gradient = Mat3::Zero();  ///< of the wall's velocity
  Vec3 wind = Vec3::Zero();      ///< what is added to it
  double rtol = 1e-6;
  std::optional<Surfactant> surfactant = {};  ///< spread evenly
};

/// An evolution in steps of `dt` at the time 0, its mesh made.
[[nodiscard]] Evolution evolution_of(const DampedDrop& drop, double dt);
/// Ca · (shortest edge) of the drop.
[[nodiscard]] double capillary_time(const DampedDrop& drop);
/// Takes steps until `end`.
void run(Evolution& evolution, double end);
/// The area of the first interface as elements see it.
[[nodiscard]] double area_in(const Evolution& evolution, fem::Elements elements);
[[nodiscard]] Vec3 centroid_in(const Evolution& evolution);
/// The direction of the longest axis in the plane of x and y.
[[nodiscard]] double angle_in(const Evolution& evolution);

/// The gradient of the shear flow (y, 0, 0).
[[nodiscard]] Mat3 simple_shear();
/// The two orders in Δt at t = 0.5 by runs whose steps are halved three times: of the area where a
/// drop with the mode l = 4 relaxes and of one where an ellipsoid is sheared.
[[nodiscard]] std::array<double, 2> orders_in_relaxation(fem::Elements elements);
[[nodiscard]] std::array<double, 2> orders_in_shear(fem::Elements elements);
/// The orders in Δt of the difference from the midpoint rule, by the angle of the long axis of the
/// sheared ellipsoid. What quadratic faces do when the vertices that define them change, in steps
/// of 1e-5, cancels.
[[nodiscard]] std::array<double, 2> orders_beside_midpoint(fem::Elements elements);

/// Σσ·area after each of so many steps of 27.5 (1 + λ) Ca l_min, ten times what explicit steps
/// bear, less what it is after the last, over the first such difference.
[[nodiscard]] std::vector<double> excesses(const DampedDrop& drop, int num_steps);

}  // namespace meniscus::test
