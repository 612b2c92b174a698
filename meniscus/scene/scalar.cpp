#include "meniscus/scene/scalar.hpp"

#include <cmath>

namespace meniscus {

double ScalarProfile::at(const Vec3& x) const {
  double result = value + gradient.dot(x);
  if (spot != 0.0) result += spot * std::exp(-0.5 * (x - center).squaredNorm() / (width * width));
  return result;
}

}  // namespace meniscus
