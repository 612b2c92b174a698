#include "meniscus/report/packing.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <random>
#include <set>
#include <utility>
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
  EXPECT_EQ(inflated(zlib_bytes(bytes)), bytes);
  EXPECT_LT(zlib_bytes(bytes).size(), bytes.size());
  EXPECT_EQ(inflated(zlib_bytes("")), "");
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
struct PackageReader {
  nlohmann::json header;
  std::string bytes;
  std::size_t at = 0;

  explicit PackageReader(const std::string& packed) : bytes(inflated(packed)) {
    const auto length = io::load<std::uint32_t>(bytes, std::endian::little);
    header = nlohmann::json::parse(bytes.substr(4, length));
    at = 4 + length;
  }
  template <class T>
  std::vector<T> take(std::size_t count) {
    std::vector<T> values(count);
    for (unsigned int plane = 0; plane < sizeof(T); ++plane) {
      for (T& value : values)
        value = static_cast<T>(value | T{static_cast<unsigned char>(bytes.at(at++))} << 8 * plane);
    }
    return values;
  }
  std::vector<std::uint16_t> take_sums(std::size_t count) {
    std::vector<std::uint16_t> values = take<std::uint16_t>(count);
    for (std::size_t i = 1; i < count; ++i)
      values[i] = static_cast<std::uint16_t>(values[i] + values[i - 1]);
    return values;
  }
  template <class T>
  std::vector<std::array<T, 3>> take_faces(std::size_t count) {
    const std::vector<T> a = take<T>(count), b = take<T>(count), c = take<T>(count);
    std::vector<std::array<T, 3>> faces;
    T first = 0;
    for (std::size_t f = 0; f < count; ++f) {
      first = static_cast<T>(first + a[f]);
      faces.push_back({first, static_cast<T>(first + b[f]), static_cast<T>(first + c[f])});
    }
    return faces;
  }
};

SurfaceFrame sphere_frame(int num_vertices) {
  SurfaceFrame frame{.t = 1.5, .mesh = sphere(num_vertices), .drop = {}};
  VertexField<double> height;
  for (const Vec3& x : frame.mesh.x) height.add(x.z());
  frame.fields.push_back({"curvature", height});
  frame.drop = FaceField<int>(frame.mesh.num_faces(), 0);
  return frame;
}

/// A face from its smallest corner on.
std::array<int, 3> turned(std::array<int, 3> corners) {
  std::ranges::rotate(corners, std::ranges::min_element(corners));
  return corners;
}

VertexId nearest_vertex(const SurfaceMesh& mesh, const Vec3& point) {
  VertexId nearest{0};
  for (const VertexId v : mesh.x.ids()) {
    if ((mesh.x[v] - point).norm() < (mesh.x[nearest] - point).norm()) nearest = v;
  }
  return nearest;
}

/// Vertices and faces come in another order: the triangles are the same ones, turned the same way.
TEST(PackedFrames, SurfaceIsReadBack) {
  const SurfaceFrame frame = sphere_frame(301);
  const PackedFrame packed_frame = packed_surface(frame);
  PackageReader package(packed_frame.bytes);
  EXPECT_EQ(package.header["t"], 1.5);
  EXPECT_EQ(package.header["vertices"], 301);
  EXPECT_EQ(package.header["wide"], false);
  const auto num_faces = static_cast<std::size_t>(frame.mesh.num_faces());
  const auto faces = package.take_faces<std::uint16_t>(num_faces);
  std::vector<Vec3> points(301);
  for (int axis = 0; axis < 3; ++axis) {
    const auto grid = package.take_sums(301);
    const double low = package.header["low"][axis], high = package.header["high"][axis];
    for (std::size_t v = 0; v < 301; ++v)
      points[v][axis] = low + (high - low) / Grid16::steps * grid[v];
  }
  const auto values = package.take_sums(301);
  EXPECT_EQ(package.at, package.bytes.size());

  // Half a step in each direction, of a grid over a sphere somewhat larger than 1.
  const double tolerance = 0.5 * std::sqrt(3.0) * 2.1 / Grid16::steps;
  std::vector<int> original;
  for (const Vec3& point : points) {
    const VertexId v = nearest_vertex(frame.mesh, point);
    EXPECT_LT((frame.mesh.x[v] - point).norm(), tolerance);
    original.push_back(v.value);
  }
  std::vector<std::array<int, 3>> expected, read;
  for (const FaceVertices& f : frame.mesh.faces)
    expected.push_back(turned({f[0].value, f[1].value, f[2].value}));
  for (const auto& [a, b, c] : faces)
    read.push_back(turned({original[a], original[b], original[c]}));
  std::ranges::sort(expected);
  std::ranges::sort(read);
  EXPECT_EQ(read, expected);

  EXPECT_EQ(package.header["fields"][0]["name"], "curvature");  // here: the height
  const double low = package.header["fields"][0]["low"], high = package.header["fields"][0]["high"];
  for (std::size_t v = 0; v < 301; ++v)
    EXPECT_NEAR(low + (high - low) / Grid16::steps * values[v], points[v].z(), tolerance);
  EXPECT_EQ(packed_frame.ranges.count("curvature"), 1U);
  EXPECT_EQ(packed_surface(frame).bytes, packed_frame.bytes);
}

/// As the page does: an edge's middle is found from its ends when a face first names it.
TEST(PackedFrames, MiddlesOfCurvedFacesAreReadBack) {
  SurfaceFrame frame = sphere_frame(150);
  for (const FaceVertices& v : frame.mesh.faces) {
    const auto middle = [&](std::size_t k) {
      return Vec3((frame.mesh.x[v[k]] + frame.mesh.x[v[(k + 1) % 3]]).normalized());
    };
    frame.middles.add({middle(0), middle(1), middle(2)});
  }
  PackageReader package(packed_surface(frame).bytes);
  const auto num_faces = static_cast<std::size_t>(frame.mesh.num_faces());
  const std::size_t num_edges = 3 * num_faces / 2;
  ASSERT_EQ(package.header["middles"], num_edges);
  const auto faces = package.take_faces<std::uint16_t>(num_faces);
  std::array<std::vector<std::uint16_t>, 3> points, offsets;
  for (auto& axis : points) axis = package.take_sums(150);
  for (auto& axis : offsets) axis = package.take<std::uint16_t>(num_edges);
  std::set<std::pair<std::uint16_t, std::uint16_t>> named;
  for (const auto& face : faces)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::pair<std::uint16_t, std::uint16_t> ends =
          std::minmax({face[k], face[(k + 1) % 3]});
      const std::size_t edge = named.size();
      if (!named.insert(ends).second) continue;
      Vec3 middle, sum;
      double step = 0.0;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const double low = package.header["low"][axis], high = package.header["high"][axis];
        step = (high - low) / Grid16::steps;
        const double both = points[axis][ends.first] + points[axis][ends.second];
        const auto offset = static_cast<std::int16_t>(offsets[axis][edge]);
        sum[static_cast<int>(axis)] = 2.0 * low + step * both;
        middle[static_cast<int>(axis)] = low + step * (0.5 * both + offset);
      }
      // Half a step in each direction, of the middle and of the sum of two ends, of length 1.9.
      EXPECT_LT((middle - sum.normalized()).norm(), 1.1 * std::sqrt(3.0) * step);
    }
  EXPECT_EQ(named.size(), num_edges);
}

TEST(PackedFrames, ManyVerticesHaveWideCorners) {
  SurfaceFrame frame = sphere_frame(100);
  for (int i = 0; i < 65500; ++i) frame.mesh.x.add(Vec3(1.0 + 1e-6 * i, 0.0, 0.0));
  frame.mesh.faces[FaceId{0}][2] = VertexId{65599};
  frame.fields.clear();
  PackageReader package(packed_surface(frame).bytes);
  EXPECT_EQ(package.header["wide"], true);
  std::uint32_t largest = 0;
  for (const auto& face :
       package.take_faces<std::uint32_t>(static_cast<std::size_t>(frame.mesh.num_faces())))
    largest = std::max(largest, std::ranges::max(face));
  EXPECT_EQ(largest,
            65599U);  // the last along the curve is one of the sphere, above all the others
}

TEST(PackedFrames, CutsAreReadBackWithTheirFields) {
  MeshCut cut;
  cut.points = {{0.0, 0.0}, {1.0, 0.0}, {0.0, 1.0}, {1.0, 0.0}, {1.0, 1.0}, {0.0, 1.0}};
  cut.polygons = {{0, 3, 0, 36.0}, {3, 3, 1, 72.0}};
  cut.fields = {{"dye", {4.0, 2.0}}};
  cut.drops = {5, 2};
  const PackedFrame packed_frame = packed_cuts(0.5, {cut});
  PackageReader package(packed_frame.bytes);
  const nlohmann::json& header = package.header["cuts"][0];
  EXPECT_EQ(package.take<std::uint8_t>(2), (std::vector<std::uint8_t>{3, 3}));
  EXPECT_EQ(package.take<std::uint8_t>(2), (std::vector<std::uint8_t>{0, 1}));
  (void)package.take<std::uint8_t>(2);
  for (int k = 0; k < 2; ++k) (void)package.take_sums(6);
  EXPECT_EQ(header["drops"], nlohmann::json({5, 2}));
  EXPECT_EQ(header["fields"][0]["name"], "dye");
  EXPECT_EQ(header["fields"][0]["low"], 2.0);
  EXPECT_EQ(header["fields"][0]["high"], 4.0);
  EXPECT_EQ(package.take_sums(2), (std::vector<std::uint16_t>{Grid16::steps, 0}));
  EXPECT_EQ(package.at, package.bytes.size());
  EXPECT_LT(packed_frame.ranges.at("dye").low, packed_frame.ranges.at("dye").high);
}

TEST(SurfaceFrames, CoarseOnesKeepTheirFields) {
  const SurfaceFrame frame = sphere_frame(4000);
  const SurfaceFrame coarse = coarse_frame(frame, 1000);
  EXPECT_LT(coarse.mesh.num_faces(), 1500);
  ASSERT_EQ(coarse.fields.size(), 1U);
  // A mean of the values of a linear function is its value at the mean.
  for (const VertexId v : coarse.mesh.x.ids())
    EXPECT_NEAR(coarse.fields[0].values[v], coarse.mesh.x[v].z(), 1e-12);
}

}  // namespace
}  // namespace meniscus::report
