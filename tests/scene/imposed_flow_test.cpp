#include "meniscus/scene/imposed_flow.hpp"

#include <gtest/gtest.h>

namespace meniscus {
namespace {

const Mat3 shear = ImposedFlow::simple_shear();
const Mat3 extension = ImposedFlow::uniaxial_extension();

TEST(ImposedFlowSchedule, AnEntryHoldsFromItsTimeOn) {
  ImposedFlow flow(FlowFamily::planar, shear);
  flow.add({0.0, 0.0, extension});
  flow.add({2.0, 0.0, -shear});
  EXPECT_EQ(flow.gradient(-1e-12), shear);
  EXPECT_EQ(flow.gradient(0.0), extension);
  EXPECT_EQ(flow.gradient(2.0 - 1e-12), extension);
  EXPECT_EQ(flow.gradient(2.0), Mat3(-shear));
  EXPECT_EQ(flow.gradient(1e9), Mat3(-shear));
  EXPECT_EQ(flow.initial_gradient(), shear);
  EXPECT_EQ(flow.family(), FlowFamily::planar);
}

TEST(ImposedFlowSchedule, ARampLeadsFromTheEntryBeforeNotFromTheStart) {
  ImposedFlow flow(FlowFamily::planar, shear);
  flow.add({1.0, 0.0, extension});
  flow.add({2.0, 4.0, -2.0 * shear});
  for (const double part : {0.0, 0.25, 0.5, 1.0}) {
    const Mat3 expected = (1.0 - part) * extension - 2.0 * part * shear;
    EXPECT_EQ(flow.gradient(2.0 + 4.0 * part), expected) << part;  // all numbers exact in binary
  }
  EXPECT_EQ(flow.gradient(7.0), Mat3(-2.0 * shear));
}

TEST(ImposedFlowSchedule, RampsAreContinuousAndTraceless) {
  ImposedFlow flow(FlowFamily::axial, extension);
  flow.add({0.5, 0.5, Mat3::Zero()});
  flow.add({1.0, 1.0, ImposedFlow::planar_extension()});  // as the ramp before ends
  const double step = 1.0 / 256.0;
  for (double t = 0.0; t < 2.5; t += step) {
    const Mat3 change = flow.gradient(t + step) - flow.gradient(t);
    EXPECT_LE(change.cwiseAbs().maxCoeff(), 2.0 * step) << t;  // 1 in 0.5 at most
    EXPECT_EQ(flow.gradient(t).trace(), 0.0) << t;
  }
  EXPECT_EQ(flow.gradient(1.0), Mat3(Mat3::Zero()));
  EXPECT_EQ(flow.gradient(2.0), ImposedFlow::planar_extension());
}

TEST(ImposedFlowSchedule, VelocityIsTheGradientOfTheInstantTimesX) {
  ImposedFlow flow(FlowFamily::planar, shear);
  flow.add({1.0, 2.0, Mat3::Zero()});
  EXPECT_EQ(flow.velocity(Vec3(5, 2, 7), 0.0), Vec3(2, 0, 0));
  EXPECT_EQ(flow.velocity(Vec3(5, 2, 7), 2.0), Vec3(1, 0, 0));
  EXPECT_EQ(ImposedFlow().velocity(Vec3(5, 2, 7), 0.0), Vec3(0, 0, 0));
}

}  // namespace
}  // namespace meniscus
