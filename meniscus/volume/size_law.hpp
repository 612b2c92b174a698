#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "meniscus/mesh/box_tree.hpp"
#include "meniscus/mesh/surface_tree.hpp"
#include "meniscus/surface/gap.hpp"
#include "meniscus/volume/tetrahedralize.hpp"

namespace meniscus {

/// A size of start + growth × distance.
struct LeastSize {
  double start = 0.0;   ///< [R0]
  double growth = 0.0;  ///< `least_growth`
};

/// Wanted edge length [R0] at a point between a surface of edge length `h_s`, at distance `d_s`,
/// and one of `h_b`, at distance `d_b`. With s = d_s/(d_s + d_b),
///   linear       h = h_s + (h_b − h_s) s
///   exponential  h = h_s (h_b/h_s)^s
///   gaussian     h = h_b + (h_s − h_b) (e^(−9s²/2) − e^(−9/2))/(1 − e^(−9/2)), but at least
///                `least` and at most h_b,
/// the last a bell whose standard deviation is a third of the way to the other surface. Beside a
/// thin neck it would stay as fine as the neck far beyond what the neck does to the flow: hence the
/// least size.
[[nodiscard]] double graded_size(Grading grading, double h_s, double d_s, double h_b, double d_b,
                                 const LeastSize& least = {});

/// The least growth beside an interface of resolution C0. It is 1/3 or less, and above 200 vertices
/// inversely as the root of their number. So all sizes go with those of the edges. The bell has
/// that much by itself around a sphere in a boundary of ten radii.
[[nodiscard]] double least_growth(double C0);

/// By how much a place of an interface is finer than the sphere of the drop's volume, whose edges
/// are `even_edge` long. It is 0 where the edges are longer than a third of those, 1 below a sixth.
/// At such a neck or tip the mesh is scaled to a radius that is small beside the drop's. Cells have
/// twice the volume there and grow from the surface on, at `least_growth`. The errors of the flow
/// that they bring decay within some radii of the neck, and reach the drop as its small part. For
/// the bell (`Grading::gaussian`) alone.
[[nodiscard]] double fineness(double edge, double even_edge);

/// Bound on the edge length in a gap of width `width` between surfaces whose edges are `h` long
/// [R0]. Then the gap holds `layers` layers: kGapEdge width/layers, but no less than h. Infinite
/// where the gap is wider than 7/4 layers of h: the surfaces hold it by themselves.
[[nodiscard]] double gap_size(double width, double layers, double h);

/// The edge wanted at a point, and how far the nearest surface is from it, up to a fifth [R0].
struct SizeAt {
  double size, distance;
};

/// The wanted edge length of the tetrahedra of a scene as a function of the point.
///
/// Each region is bounded from outside by one surface, the interface that encloses it or the outer
/// boundary. From inside it is bounded by any number of interfaces. The size is the smallest of the
/// laws between each inner interface and the enclosing surface. Where there is no inner interface
/// it is h_s + interior_growth d of the enclosing one. A law between two neighbouring drops would
/// keep all of the space between them as fine as they are, however far apart. The smallest of the
/// laws towards the enclosing surface is fine near each of them and grows in between.
///
/// With `gap_layers` > 0 the size is, besides, at most `gap_size` of each gap the point lies in.
/// Between any two of the surfaces around its region, the width is the sum of its distances from
/// them. Between two sheets of one of them, it is the one at the nearest point.
class SizeLaw {
 public:
  SizeLaw(const Scene& scene, const VolumeMeshOptions& options);

  /// [R0]; a few µs per surface that may set the size there. The scene must outlive the law.
  [[nodiscard]] double operator()(const Vec3& x) const;
  [[nodiscard]] SizeAt at(const Vec3& x) const;
  /// The wanted edge at each vertex of the surfaces: the interfaces', then the outer boundary's.
  /// That a vertex lies on its own interface is known, and the exact test is spared. Collective.
  [[nodiscard]] std::vector<double> at_surface_vertices() const;
  /// Of the processes that share the law's work.
  [[nodiscard]] linear::Communicator communicator() const {
    return linear::Communicator::of(options_.processes);
  }
  /// How often the nearest point of a surface has been looked for: what the law costs.
  [[nodiscard]] std::int64_t num_searches() const { return num_searches_; }

 private:
  /// A surface with the mean length of the edges at each vertex.
  struct Sized {
    /// `even_edge`: of the sphere of the drop's volume; 0 where no place counts as fine.
    Sized(const SurfaceMesh& mesh, double gap_layers, double least_growth = 0.0,
          double even_edge = 0.0);
    struct Nearest {
      double distance = 0.0, size = 0.0;
      double start = 0.0;                  // of the least size
      double inside = 0.0, outside = 0.0;  // widths of the surface's own gaps there
    };
    [[nodiscard]] Nearest nearest(const Vec3& x) const;
    [[nodiscard]] Box box() const { return {tree.low(), tree.high()}; }
    [[nodiscard]] bool has_outside_gap() const;

    const SurfaceMesh* mesh;
    SurfaceTree tree;
    VertexField<double> size, start;  // of cells at the vertices: size, and start of the least size
    OwnGaps gaps;                     // empty without gap layers
    double least_growth;
  };
  /// The interfaces that one surface encloses with nothing in between.
  struct Inner {
    Inner(std::span<const Sized> surfaces, std::vector<std::size_t> members);
    std::vector<std::size_t> members;  // indices into surfaces_
    BoxTree boxes;                     // of the members
    double least_size = std::numeric_limits<double>::infinity(), largest_size = 0.0;  // of edges
    double least_growth = std::numeric_limits<double>::infinity();                    // of all
    std::vector<std::size_t> folded;  // positions in `members`: those with outside gaps
  };
  /// What a member of an Inner has at a point.
  struct Asked {
    std::size_t position;
    Sized::Nearest nearest;
  };
  /// What is known of the surroundings of a point.
  struct Around {
    Vec3 x;
    std::size_t enclosing;  // index into surfaces_
    const Inner* inner;
    Sized::Nearest outer;      // of the enclosing surface
    std::vector<Asked> asked;  // of the members so far
  };
  [[nodiscard]] Sized::Nearest ask(std::size_t surface, const Vec3& x) const;
  const Sized::Nearest& ask_member(std::size_t position, Around& around) const;
  static constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();
  /// `on`: the interface that x lies on.
  [[nodiscard]] Around surroundings(const Vec3& x, std::size_t on = kNone) const;
  [[nodiscard]] double size(Around& around) const;
  [[nodiscard]] double least_law(Around& around) const;
  /// Asks the members beside which a gap may lie that is no wider than `widest`.
  void ask_sides_of_gaps(double widest, Around& around) const;
  [[nodiscard]] double size_in_gap(double size, const Sized::Nearest& a,
                                   const Sized::Nearest& b) const;
  [[nodiscard]] double size_in_gaps(double size, Around& around) const;
  [[nodiscard]] double distance_from_surfaces(Around& around) const;
  static BoxTree boxes_of(std::span<const Sized> surfaces, std::span<const std::size_t> members);
  [[nodiscard]] std::size_t enclosing_surface(const Vec3& x, std::size_t on) const;

  VolumeMeshOptions options_;
  std::vector<Sized> surfaces_;            // interfaces, then the outer boundary
  std::vector<std::size_t> container_;     // of each interface, an index into surfaces_
  std::vector<std::size_t> inside_first_;  // interfaces, the most deeply nested first
  BoxTree boxes_{{}};                      // of the interfaces in that order
  std::vector<Inner> inner_;               // of each of surfaces_
  mutable std::int64_t num_searches_ = 0;
};

}  // namespace meniscus
