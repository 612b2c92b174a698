#pragma once

#include <array>
#include <numbers>

#include "meniscus/core/named_constant.hpp"

namespace meniscus {

/// [mean edge at the vertex] A step whose restoration of volumes shifts a vertex farther is tried
/// again at half its length. Remeshing by itself shifts vertices by less than a tenth of this
/// (tests/surface/remesh_test.cpp).
inline constexpr double kMostShiftOverEdge = 0.01;
/// Shortening a step is given up when more than this fraction of the shift remains: a shift caused
/// by the step's length falls by a factor of 2 or more.
inline constexpr double kShiftLeft = 0.9;
/// A step is refused if it changes a drop's volume by a factor outside these bounds. A converged
/// flow keeps volumes to about a thousandth.
inline constexpr double kLeastVolumeKept = 0.5, kMostVolumeKept = 2.0;

/// The semi-implicit scheme damps what this share of a step would change, 1 − 1/√2: short waves
/// then vanish in a long step (docs/time-stepping.md).
inline constexpr double kDampedShare = 1.0 - 0.5 * std::numbers::sqrt2;
/// A shape whose turning moves it along its normals by less than the root of this, relative to the
/// turning itself, is too round to have a spin: ellipsoids of D below 0.02.
inline constexpr double kRoundness = 1e-3;

inline constexpr std::array kEvolveConstants{
    NamedConstant{"most-shift-over-edge", kMostShiftOverEdge},
    NamedConstant{"shift-left", kShiftLeft},
    NamedConstant{"least-volume-kept", kLeastVolumeKept},
    NamedConstant{"most-volume-kept", kMostVolumeKept},
    NamedConstant{"damped-share", kDampedShare},
    NamedConstant{"roundness", kRoundness}};

}  // namespace meniscus
