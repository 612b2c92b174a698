#include "meniscus/app/wording.hpp"

#include <gtest/gtest.h>

namespace meniscus {
namespace {

TEST(Wording, SaysWhatHappenedWhenAndWhere) {
  EXPECT_EQ(text_of(Notice{0.5, RefusedStep{12, 0.025, "a cell is inverted"}}),
            "step 12 of length 0.025 failed: a cell is inverted");
  InterfaceRemesh remesh{{}, 3};
  remesh.is_mended = true;
  remesh.closed_holes = 1;
  EXPECT_EQ(text_of(Notice{0.5, remesh}),
            "t = 0.5: creases of drop 3 were rounded, 1 holes through it closed, to remesh it");
  remesh.smoothed_over = 0.125;
  EXPECT_EQ(text_of(Notice{0.5, remesh}),
            "t = 0.5: drop 3 was smoothed over 0.125, 1 holes through it closed, to remesh it");
  remesh.fault = Fault{FaultKind::folded_face, "a face is folded over"};
  EXPECT_EQ(text_of(Notice{0.5, remesh}),
            "drop 3 was not remeshed at t = 0.5: a face is folded over");
  EXPECT_EQ(text_of(Notice{0.25, FailedSurgery{"why"}}), "t = 0.25: why");
  EXPECT_EQ(text_of(Notice{0.25, FailedSolver{"why"}}), "t = 0.25: why");
  EXPECT_EQ(text_of(Notice{0.0, FlowJump{2.5}}),
            "the flow jumps at t = 2.5, and the liquids have inertia: a ramp would be smoother");
  EXPECT_EQ(text_of(Notice{0.25, LargeVolumeShift{0.0234}}),
            "t = 0.25: restoring the volume shifts a vertex by 0.023 of its edges, and by as much "
            "after a shorter step");
  EXPECT_EQ(text_of(Notice{4.5, LeftCenter{1.0625}}),
            "t = 4.5: the drops are 1.06 R0 from where they began, an unstable place in this flow; "
            "domain.frame = \"drops\" moves the domain along");
  EXPECT_EQ(text_of(Notice{4.5, LeftCenter{1.0625, false}}),
            "t = 4.5: the drops are 1.06 R0 from where they began, an unstable place in this flow");
}

TEST(Wording, AnnouncesEventsByTheirKind) {
  TopologyEvent event;
  event.parents = {0};
  event.children = {1, 2};
  event.neck_radius = 0.01;
  event.position = Vec3(1.0, 0.0, -0.5);
  EXPECT_EQ(text_of(event, 2.0),
            "breakup at t = 2: drop 0 -> 1, 2, at a neck of radius 0.01 near (1, 0, -0.5)");
  event.kind = EventKind::coalescence;
  event.gap = 0.02;
  EXPECT_EQ(text_of(event, 2.0),
            "coalescence at t = 2: drop 0 -> 1, 2, at a gap of 0.02 near (1, 0, -0.5)");
}

}  // namespace
}  // namespace meniscus
