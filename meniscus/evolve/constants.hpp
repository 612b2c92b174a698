#pragma once

#include <array>

#include "meniscus/core/named_constant.hpp"

namespace meniscus {

/// [mean edge at the vertex] A step whose restoration of volumes shifts a vertex farther is tried
/// again at half its length. Remeshing by itself shifts vertices by less than a tenth of this
/// (tests/surface/remesh_test.cpp).
inline constexpr double kMostShiftOverEdge = 0.01;
/// Shortening is given up when it leaves more of the shift than this: what a step's length has to
/// do with goes down by a factor of 2 or more.
inline constexpr double kShiftLeft = 0.9;
/// A step that takes the volume of a drop out of these bounds, relative to what it was, is refused:
/// a flow that was solved keeps volumes to a thousandth or so.
inline constexpr double kLeastVolumeKept = 0.5, kMostVolumeKept = 2.0;

inline constexpr std::array kEvolveConstants{
    NamedConstant{"most-shift-over-edge", kMostShiftOverEdge},
    NamedConstant{"shift-left", kShiftLeft}, NamedConstant{"least-volume-kept", kLeastVolumeKept},
    NamedConstant{"most-volume-kept", kMostVolumeKept}};

}  // namespace meniscus
