#pragma once

#include <vector>

#include "meniscus/core/vec.hpp"

namespace meniscus {

/// The family a case's flow belongs to; it decides which lengths L, B, W mean (docs/notation.md).
enum class FlowFamily { quiescent, axial, planar, general };

/// The imposed linear flow v = G(t)·x, [v] = G R0, with G traceless.
/// A schedule entry sets the gradient from its time on; between an entry's time and time + ramp the
/// gradient passes linearly from the one before.
class ImposedFlow {
 public:
  struct Entry {
    double time = 0.0;
    double ramp = 0.0;
    Mat3 gradient = Mat3::Zero();
  };
  ImposedFlow() = default;
  ImposedFlow(FlowFamily family, const Mat3& gradient) : family_(family), initial_(gradient) {}

  /// Entries in rising order of time, each starting after the ramp before it has ended.
  void add(const Entry& entry) { schedule_.push_back(entry); }
  [[nodiscard]] Mat3 gradient(double t) const;
  [[nodiscard]] Vec3 velocity(const Vec3& x, double t) const { return gradient(t) * x; }
  [[nodiscard]] FlowFamily family() const { return family_; }
  [[nodiscard]] const Mat3& initial_gradient() const { return initial_; }
  [[nodiscard]] const std::vector<Entry>& schedule() const { return schedule_; }

  static Mat3 simple_shear();        ///< v = (y, 0, 0)
  static Mat3 uniaxial_extension();  ///< diag(1, −1/2, −1/2)
  static Mat3 planar_extension();    ///< diag(1, −1, 0)

 private:
  FlowFamily family_ = FlowFamily::quiescent;
  Mat3 initial_ = Mat3::Zero();
  std::vector<Entry> schedule_;
};

}  // namespace meniscus
