#include "meniscus/report/packing.hpp"

#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <zlib.h>

#include "meniscus/io/binary.hpp"
#include "meniscus/mesh/shapes.hpp"
#include "meniscus/report/packed_frames.hpp"

namespace meniscus::report {
namespace {

std::string inflated(const std::string& bytes) {
  std::string result(1 << 22, '\0');
  uLongf size = result.size();
  EXPECT_EQ(uncompress(reinterpret_cast<Bytef*>(result.data()), &size,
                       reinterpret_cast<const Bytef*>(bytes.data()), bytes.size()),
            Z_OK);
  result.resize(size);
  return result;
}

TEST(Packing, Base64HasTheValuesOfItsStandard) {  // RFC 4648, section 10
  EXPECT_EQ(base64(""), "");
  EXPECT_EQ(base64("f"), "Zg==");
  EXPECT_EQ(base64("fo"), "Zm8=");
  EXPECT_EQ(base64("foo"), "Zm9v");
  EXPECT_EQ(base64("foob"), "Zm9vYg==");
  EXPECT_EQ(base64("fooba"), "Zm9vYmE=");
  EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
  EXPECT_EQ(base64(std::string("\xff\xfe\x00", 3)), "//4A");
}

TEST(Packing, DeflateIsUndoneByZlib) {
  std::mt19937 random(7);
  std::string bytes;
  for (int i = 0; i < 100000; ++i) bytes += static_cast<char>(random() % 16);
  EXPECT_EQ(inflated(deflated(bytes)), bytes);
  EXPECT_LT(deflated(bytes).size(), bytes.size());
  EXPECT_EQ(inflated(deflated("")), "");
}

TEST(Packing, GridIsExactToHalfAStep) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(-2.0, 5.0);
  std::vector<double> values;
  for (int i = 0; i < 1000; ++i) values.push_back(uniform(random));
  const Grid16 grid = Grid16::around(values);
  const double step = (grid.high - grid.low) / Grid16::steps;
  for (const double value : values) {
    // Half a step, and the roundoff of the product.
    EXPECT_NEAR(grid.low + step * grid.index(value), value, 0.5 * step + 1e-14);
  }
  EXPECT_EQ(grid.index(grid.low), 0);
  EXPECT_EQ(grid.index(grid.high), Grid16::steps);
}

TEST(Packing, GridBearsWhatIsNoNumber) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN(), infinity = HUGE_VAL;
  const Grid16 grid = Grid16::around(std::vector{1.0, nan, 3.0, infinity});
  EXPECT_EQ(grid.low, 1.0);
  EXPECT_EQ(grid.high, 3.0);
  EXPECT_EQ(grid.index(nan), Grid16::none);
  EXPECT_EQ(grid.index(infinity), Grid16::none);
  EXPECT_EQ(Grid16::around(std::vector{2.0, 2.0}).index(2.0), 0);
  EXPECT_EQ(Grid16::around({}).high, 0.0);
  const Grid16 wide = Grid16::around(std::vector{-1.7e308, 1.7e308});
  EXPECT_EQ(wide.index(0.0), Grid16::steps / 2);
}

/// Reads a package as the page's script does.
struct Package32 {
  nlohmann::json header;
  std::string bytes;
  std::size_t at = 0;

  explicit Package32(const std::string& packed) : bytes(inflated(packed)) {
    const auto length = io::load<std::uint32_t>(bytes, std::endian::little);
    header = nlohmann::json::parse(bytes.substr(4, length));
    at = 4 + length;
  }
  template <class T>
  std::vector<T> take(std::size_t count) {
    at = (at + 3) / 4 * 4;
    std::vector<T> values;
    for (std::size_t i = 0; i < count; ++i, at += sizeof(T))
      values.push_back(io::load<T>(std::string_view(bytes).substr(at), std::endian::little));
    return values;
  }
};

SurfaceFrame sphere_frame(int num_vertices) {
  SurfaceFrame frame{.t = 1.5, .mesh = sphere(num_vertices), .curvature = {}, .drop = {}};
  VertexField<double> height;
  for (const Vec3& x : frame.mesh.x) height.add(x.z());
  frame.fields.push_back({"curvature", height});
  frame.drop = FaceField<int>(frame.mesh.num_faces(), 0);
  return frame;
}

TEST(PackedFrames, SurfaceIsReadBack) {
  const SurfaceFrame frame = sphere_frame(301);  // odd: arrays of 16 bits must be aligned
  const PackedFrame packed_frame = packed(frame);
  Package32 package(packed_frame.bytes);
  EXPECT_EQ(package.header["t"], 1.5);
  EXPECT_EQ(package.header["vertices"], 301);
  EXPECT_EQ(package.header["wide"], false);
  const auto corners =
      package.take<std::uint16_t>(3 * static_cast<std::size_t>(frame.mesh.num_faces()));
  std::size_t k = 0;
  for (const FaceVertices& face : frame.mesh.faces) {
    for (const VertexId v : face) EXPECT_EQ(corners[k++], v.value);
  }
  const double half_step = 0.5 * 2.0 / Grid16::steps + 1e-12;
  for (int axis = 0; axis < 3; ++axis) {
    const auto grid = package.take<std::uint16_t>(301);
    const double low = package.header["low"][axis], high = package.header["high"][axis];
    for (const VertexId v : frame.mesh.x.ids()) {
      const double x = low + (high - low) / Grid16::steps * grid[static_cast<std::size_t>(v.value)];
      EXPECT_NEAR(x, frame.mesh.x[v][axis], 1.1 * half_step);  // the sphere's radius is above 1
    }
  }
  const auto values = package.take<std::uint16_t>(301);
  EXPECT_EQ(package.at, package.bytes.size());
  EXPECT_EQ(package.header["fields"][0]["name"], "curvature");
  EXPECT_EQ(packed_frame.ranges.count("curvature"), 1U);
  EXPECT_EQ(packed(frame).bytes, packed_frame.bytes);
}

TEST(PackedFrames, ManyVerticesHaveWideCorners) {
  SurfaceFrame frame = sphere_frame(100);
  for (int i = 0; i < 65500; ++i) frame.mesh.x.add(Vec3::UnitX());
  frame.mesh.faces[FaceId{0}][2] = VertexId{65599};
  frame.fields.clear();
  Package32 package(packed(frame).bytes);
  EXPECT_EQ(package.header["wide"], true);
  EXPECT_EQ(package.take<std::uint32_t>(3)[2], 65599U);
}

TEST(SurfaceFrames, CoarseOnesKeepTheirFields) {
  const SurfaceFrame frame = sphere_frame(4000);
  const SurfaceFrame coarse = coarsened(frame, 1000);
  EXPECT_LT(coarse.mesh.num_faces(), 1500);
  ASSERT_EQ(coarse.fields.size(), 1U);
  // A mean of the values of a linear function is its value at the mean.
  for (const VertexId v : coarse.mesh.x.ids())
    EXPECT_NEAR(coarse.fields[0].values[v], coarse.mesh.x[v].z(), 1e-12);
}

}  // namespace
}  // namespace meniscus::report
