#include "meniscus/scene/imposed_flow.hpp"

#include <algorithm>

#include "meniscus/core/error.hpp"

namespace meniscus {

Mat3 ImposedFlow::gradient(double t) const {
  Mat3 current = initial_;
  for (const Entry& entry : schedule_) {
    if (t < entry.time) break;
    MENISCUS_ASSERT(entry.ramp >= 0.0, "ramp = {}", entry.ramp);
    const double progress = entry.ramp > 0.0 ? std::min(1.0, (t - entry.time) / entry.ramp) : 1.0;
    current = (1.0 - progress) * current + progress * entry.gradient;
  }
  return current;
}

Mat3 ImposedFlow::simple_shear() {
  Mat3 g = Mat3::Zero();
  g(0, 1) = 1.0;
  return g;
}
Mat3 ImposedFlow::uniaxial_extension() { return Vec3(1.0, -0.5, -0.5).asDiagonal(); }
Mat3 ImposedFlow::planar_extension() { return Vec3(1.0, -1.0, 0.0).asDiagonal(); }

}  // namespace meniscus
