#pragma once

#include <optional>
#include <string>

#include "meniscus/core/vec.hpp"

namespace meniscus {

/// Kinds of numerical failure. A caller that must tell failures apart tests the kind, not the text.
enum class FaultKind {
  not_finite,         ///< a coordinate is not finite, or a volume overflows
  connectivity,       ///< faces are not a closed, oriented manifold, or name a missing vertex
  several_pieces,     ///< a surface that must be connected is not
  degenerate_face,    ///< a face without area, or with too small an angle
  folded_face,        ///< a face looks into the liquid
  self_intersection,  ///< a surface meets itself
  intersection,       ///< two surfaces meet
  no_volume,          ///< a surface encloses no positive volume
  outside_domain,     ///< an interface lies beyond the outer boundary
  regions,            ///< regions of liquids contradict the nesting of the surfaces
  nonconforming,      ///< a volume mesh does not fit the surfaces of its scene
  inverted_cell,      ///< a tetrahedron has no positive volume
  poor_cell,          ///< a tetrahedron has too small an angle
  wrong_volume,       ///< the cells of a region do not fill it, or a step changed a drop's volume
  mesher,             ///< the mesher gave up
  too_large,          ///< a mesh would have more elements than can be made
  no_surgery,         ///< no cut or bridge is possible at a position
  added_area,         ///< a cut or a bridge would add area
  unlike_liquids,     ///< drops would merge that must not; no shorter step helps
  no_flow,            ///< the flow problem has no solution
  wrong_energy,       ///< a step changed the interfaces' energy as the flow does not
  inaccurate,         ///< a step's estimated error, or its motion, is too large
  concentration,      ///< one below zero, or of a surfactant beyond what has a tension
  no_step,            ///< no time step in its bounds can be taken
  not_converged,      ///< an iteration did not reach its tolerance
  unwanted            ///< refused by the caller's own test
};

/// What is wrong. Functions that look for a fault return std::optional<Fault>, none when all is
/// well.
struct Fault {
  FaultKind kind;
  std::string text;                   ///< one line for the user, with the position where known
  std::optional<Vec3> position = {};  ///< [R0]
};

/// The text of a fault; empty for none.
[[nodiscard]] std::string text_of(const std::optional<Fault>& fault);
/// A point as messages write it.
[[nodiscard]] std::string text_of(const Vec3& x);
/// The outcome of an operation that may fail. Reports that hold more derive from it.
struct [[nodiscard]] Report {
  std::optional<Fault> fault = {};  ///< why it failed

  [[nodiscard]] bool ok() const { return !fault; }
  [[nodiscard]] std::string text() const { return text_of(fault); }
};

/// A fault whose text is that of `fault` after "before: ".
[[nodiscard]] Fault with_context(const std::string& before, Fault fault);

}  // namespace meniscus
