#include "meniscus/volume/field_transfer.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>

#include <Eigen/Geometry>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include "meniscus/core/error.hpp"
#include "meniscus/volume/tet_overlap.hpp"
#include "tests/volume/scenes.hpp"
#include "tests/volume/wave_fields.hpp"

namespace meniscus {
namespace {

using test::amounts, test::cell_error, test::meshed, test::sampled, test::turned_scene,
    test::vertex_error, test::wave;

template <class Values>
double least(const Values& values) {
  return *std::ranges::min_element(values);
}
template <class Values>
double most(const Values& values) {
  return *std::ranges::max_element(values);
}

void expect_same_amounts(const std::vector<double>& a, const std::vector<double>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t r = 0; r < a.size(); ++r)
    EXPECT_NEAR(a[r], b[r], 1e-12 * std::abs(a[r])) << "region " << r;
}

VolumeMoments overlap(const TetCorners& a, const TetCorners& b) {
  return tet_overlap(HalfSpaceTet(a), HalfSpaceTet(b));
}

TEST(TetOverlap, OfATetrahedronWithItselfAndWithAShiftedOne) {
  const TetCorners unit{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)};
  EXPECT_NEAR(overlap(unit, unit).volume, 1.0 / 6.0, 1e-15);
  TetCorners shifted = unit;
  for (Vec3& x : shifted) x += Vec3(0.25, 0.25, 0.0);
  // x ≥ 1/4, y ≥ 1/4, z ≥ 0, x + y + z ≤ 1: half the size.
  const VolumeMoments part = overlap(unit, shifted);
  EXPECT_NEAR(part.volume, 0.125 / 6.0, 1e-16);
  EXPECT_LT((part.moment / part.volume - Vec3(0.375, 0.375, 0.125)).norm(), 1e-14);
  for (Vec3& x : shifted) x += Vec3(1.0, 0.0, 0.0);
  EXPECT_EQ(overlap(unit, shifted).volume, 0.0);
  TetCorners small = unit;
  for (Vec3& x : small) x = Vec3(0.1, 0.1, 0.1) + 0.2 * x;
  for (const VolumeMoments& inside : {overlap(unit, small), overlap(small, unit)}) {
    EXPECT_NEAR(inside.volume, 0.008 / 6.0, 1e-17);
    EXPECT_LT((inside.moment / inside.volume - Vec3(0.15, 0.15, 0.15)).norm(), 1e-15);
  }
}

TEST(TetOverlap, IsSymmetricOnRandomTetrahedra) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> at(-1.0, 1.0);
  const auto tet = [&] {
    for (;;) {
      TetCorners x;
      for (Vec3& p : x) p = Vec3(at(random), at(random), at(random));
      if ((x[1] - x[0]).cross(x[2] - x[0]).dot(x[3] - x[0]) > 0.1) return x;
    }
  };
  for (int i = 0; i < 200; ++i) {
    const TetCorners a = tet(), b = tet();
    const VolumeMoments ab = overlap(a, b), ba = overlap(b, a);
    EXPECT_NEAR(ab.volume, ba.volume, 1e-14) << i;
    EXPECT_LT((ab.moment - ba.moment).norm(), 1e-14) << i;
  }
}

TEST(FieldTransfer, KeepsAmountsAndRangesBetweenOtherInterfaces) {
  const TetMesh before = meshed(turned_scene(200, 1)), after = meshed(turned_scene(200, 2), 1.4);
  const VolumeFields fields = sampled(before, wave);
  FieldExcess excess;
  const auto start = std::chrono::steady_clock::now();
  const VolumeFields carried = transfer_fields(fields, before, after, excess);
  const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - start;
  RecordProperty("microseconds_per_cell", std::to_string(1e6 * wall.count() / after.num_cells()));
  RecordProperty("cells", after.num_cells());
  check_fields(carried, after);
  expect_same_amounts(amounts(before, fields.on_cells[0].values),
                      amounts(after, carried.on_cells[0].values));
  // The drop and the matrix measure the same in both meshes to round-off.
  EXPECT_LT(std::max(excess.above, excess.below), 1e-12);
  EXPECT_GE(least(carried.on_cells[1].values), least(fields.on_cells[1].values));
  EXPECT_LE(most(carried.on_cells[1].values), most(fields.on_cells[1].values));
  EXPECT_GE(least(carried.on_vertices[0].values), least(fields.on_vertices[0].values));
  EXPECT_LE(most(carried.on_vertices[0].values), most(fields.on_vertices[0].values));
}

TEST(FieldTransfer, KeepsConstantsAndTheOwnMesh) {
  const TetMesh before = meshed(turned_scene(100, 1)), after = meshed(turned_scene(100, 2));
  FieldExcess excess;
  const VolumeFields constant = sampled(before, [](const Vec3&) { return 3.0; });
  const VolumeFields carried = transfer_fields(constant, before, after, excess);
  for (const double v : carried.on_cells[0].values) EXPECT_NEAR(v, 3.0, 1e-12);
  for (const double v : carried.on_cells[1].values) EXPECT_DOUBLE_EQ(v, 3.0);
  for (const double v : carried.on_vertices[0].values) EXPECT_DOUBLE_EQ(v, 3.0);
  const VolumeFields fields = sampled(before, wave);
  const VolumeFields same = transfer_fields(fields, before, before, excess);
  EXPECT_EQ(same.on_vertices[0].values, fields.on_vertices[0].values);
  for (const CellId c : before.cells.ids())
    EXPECT_NEAR(same.on_cells[0].values[c], fields.on_cells[0].values[c], 1e-10);
}

/// Errors of one transfer at three levels; coarser meshes have hardly a vertex between the
/// surfaces.
void expect_second_order(unsigned seed_of_the_other, const std::string& name) {
  std::vector<double> conserved, interpolated, nodal, h;
  for (const int vertices : {200, 500, 1250}) {
    const TetMesh before = meshed(turned_scene(vertices, 1));
    const TetMesh after = meshed(turned_scene(vertices, seed_of_the_other), 1.4);
    h.push_back(1.0 / std::cbrt(before.num_cells()));
    FieldExcess excess;
    const VolumeFields carried = transfer_fields(sampled(before, wave), before, after, excess);
    conserved.push_back(cell_error(after, carried.on_cells[0].values));
    interpolated.push_back(cell_error(after, carried.on_cells[1].values));
    nodal.push_back(vertex_error(after, carried.on_vertices[0].values));
  }
  for (const auto& [what, error] :
       {std::pair{"conserved", &conserved}, std::pair{"interpolated", &interpolated},
        std::pair{"nodal", &nodal}}) {
    const double order = std::log(error->front() / error->back()) / std::log(h.front() / h.back());
    ::testing::Test::RecordProperty(
        name + what, fmt::format("{:.3e} order {:.2f}", fmt::join(*error, " "), order));
    EXPECT_GT(order, 1.8) << what << fmt::format(" {:.3e}", fmt::join(*error, " "));
  }
}

TEST(FieldTransfer, IsOfSecondOrderBetweenTheSameInterfaces) { expect_second_order(1, "same_"); }
TEST(FieldTransfer, IsOfSecondOrderBetweenOtherInterfaces) { expect_second_order(2, "other_"); }

/// Errors of a field held still through transfers to and fro between two meshes, of one resolution:
/// of what is conserved in cells, interpolated in cells, and interpolated at vertices.
class HeldField {
 public:
  explicit HeldField(int vertices)
      : meshes_{meshed(turned_scene(vertices, 1)), meshed(turned_scene(vertices, 2), 1.6)},
        fields_(sampled(meshes_[0], wave)) {}

  std::array<double, 3> after_transfers(std::size_t count) {
    FieldExcess excess;
    for (; count_ < count; ++count_)
      fields_ = transfer_fields(fields_, meshes_[count_ % 2], meshes_[(count_ + 1) % 2], excess);
    const TetMesh& last = meshes_[count % 2];
    return {cell_error(last, fields_.on_cells[0].values),
            cell_error(last, fields_.on_cells[1].values),
            vertex_error(last, fields_.on_vertices[0].values)};
  }
  [[nodiscard]] double h() const { return 1.0 / std::cbrt(meshes_[0].num_cells()); }
  [[nodiscard]] std::vector<double> amounts_now() const {
    return amounts(meshes_[count_ % 2], fields_.on_cells[0].values);
  }

 private:
  std::array<TetMesh, 2> meshes_;
  VolumeFields fields_;
  std::size_t count_ = 0;
};

TEST(FieldTransfer, LosesLittleInTwoHundredTransfers) {
  HeldField held(60);
  const std::vector<double> start = held.amounts_now();
  const auto first = held.after_transfers(2), last = held.after_transfers(200);
  RecordProperty("errors",
                 fmt::format("{:.3e}; {:.3e}", fmt::join(first, " "), fmt::join(last, " ")));
  // Linear growth would be a hundredfold; each transfer flattens a share of what is left. Where
  // this was written it was ten times in cells, fifteen at vertices.
  for (std::size_t field = 0; field < 3; ++field) EXPECT_LT(last[field], 20.0 * first[field]);
  expect_same_amounts(start, held.amounts_now());
}

TEST(FieldTransfer, KeepsAHeldFieldInCellsToSecondOrder) {
  HeldField coarse(60), fine(150);
  const auto a = coarse.after_transfers(20), b = fine.after_transfers(20);
  for (std::size_t field = 0; field < 2; ++field) {
    const double order = std::log(a[field] / b[field]) / std::log(coarse.h() / fine.h());
    EXPECT_GT(order, 1.8) << a[field] << " " << b[field];
  }
  EXPECT_LT(b[2], a[2]);
}

TEST(FieldTransfer, KeepsAmountsOfMovingCells) {
  const TetMesh before = meshed(turned_scene(100, 1));
  TetMesh after = before;
  for (Vec3& x : after.x) x = 1.1 * x;
  VolumeFields fields = sampled(before, wave);
  const VolumeFields old = fields;
  FieldExcess excess;
  move_fields(fields, before, after, excess);
  expect_same_amounts(amounts(before, old.on_cells[0].values),
                      amounts(after, fields.on_cells[0].values));
  EXPECT_EQ(fields.on_cells[1], old.on_cells[1]);
  EXPECT_EQ(fields.on_vertices, old.on_vertices);
  EXPECT_EQ(excess.above, 0.0);
  EXPECT_GT(excess.below, 0.0);
  FieldExcess none;
  VolumeFields still = old;
  move_fields(still, before, before, none);
  EXPECT_EQ(still, old);
}

TEST(FieldTransfer, ReportsTheExcessOfAConstantOnARegionThatShrank) {
  const TetMesh before = meshed(test::drop_in_sphere(100, 2.0, 100));
  TetMesh after = before;
  for (Vec3& x : after.x) x *= 0.99;
  FieldExcess excess;
  const VolumeFields constant = sampled(before, [](const Vec3&) { return 2.0; });
  const VolumeFields carried = transfer_fields(constant, before, after, excess);
  expect_same_amounts(amounts(before, constant.on_cells[0].values),
                      amounts(after, carried.on_cells[0].values));
  const double expected = 2.0 / std::pow(0.99, 3) - 2.0;
  EXPECT_NEAR(excess.above, expected, 1e-12);
  EXPECT_EQ(excess.below, 0.0);
}

TEST(FieldTransfer, SharesAParentAmongItsChildrenAndSumsWhatMerges) {
  Scene one = test::scene_within(sphere(150, 4.0)), two = test::scene_within(sphere(150, 4.0));
  SurfaceMesh parent = sphere(150);
  for (Vec3& x : parent.x) x.x() *= 2.2;
  test::add_drop(one, parent);
  test::add_drop(two, sphere(100, 0.9, Vec3(-1.0, 0.0, 0.0)));
  test::add_drop(two, sphere(100, 0.9, Vec3(1.0, 0.0, 0.0)));
  const TetMesh whole = meshed(one), parts = meshed(two);
  const RegionId matrix{0}, a{1}, b{2};
  RegionSources cut, merge;
  for (const auto& sources : {std::vector{matrix}, std::vector{a}, std::vector{a}})
    cut.add(sources);
  for (const auto& sources : {std::vector{matrix}, std::vector{a, b}}) merge.add(sources);
  FieldExcess excess;
  const VolumeFields parent_fields = sampled(whole, wave);
  const VolumeFields children = transfer_fields(parent_fields, whole, parts, excess, cut);
  const auto old = amounts(whole, parent_fields.on_cells[0].values);
  const auto now = amounts(parts, children.on_cells[0].values);
  EXPECT_NEAR(now[0], old[0], 1e-12 * old[0]);
  EXPECT_NEAR(now[1] + now[2], old[1], 1e-12 * old[1]);
  const VolumeFields merged = transfer_fields(children, parts, whole, excess, merge);
  expect_same_amounts(old, amounts(whole, merged.on_cells[0].values));
  EXPECT_THROW((void)transfer_fields(children, parts, whole, excess), InvalidInput);
}

void expect_refusal(const VolumeFields& fields, const TetMesh& mesh, const std::string& text) {
  try {
    check_fields(fields, mesh);
    FAIL() << "accepted; expected " << text;
  } catch (const InvalidInput& error) {
    EXPECT_NE(std::string(error.what()).find(text), std::string::npos) << error.what();
  }
}

TEST(FieldTransfer, RefusesFieldsThatDoNotFit) {
  const TetMesh mesh = meshed(test::drop_in_sphere(60, 2.0, 60));
  const VolumeFields good = sampled(mesh, wave);
  check_fields(good, mesh);
  VolumeFields bad = good;
  bad.on_cells[0].values[CellId{7}] = std::nan("");
  expect_refusal(bad, mesh, "field \"amount\": value 7 of cells is nan");
  bad = good;
  bad.on_vertices[0].values.add(0.0);
  expect_refusal(bad, mesh, "field \"nodal\": ");
  bad = good;
  bad.on_vertices[0].name = "level";
  bad.on_cells[0].name = "level";
  expect_refusal(bad, mesh, "field \"level\": named twice");
  bad = good;
  bad.on_vertices[0].transfer = FieldTransfer::conserved;
  expect_refusal(bad, mesh, "field \"nodal\": conserved");
  bad = good;
  bad.on_cells[1].name.clear();
  expect_refusal(bad, mesh, "no name");
  FieldExcess excess;
  EXPECT_THROW((void)transfer_fields(bad, mesh, mesh, excess), InvalidInput);
  SurfaceFields surface;
  surface.on_faces.push_back({"film", "", FieldTransfer::conserved, FaceField<double>(3, 0.0)});
  EXPECT_THROW(check_fields(surface, sphere(60)), InvalidInput);
}

}  // namespace
}  // namespace meniscus
