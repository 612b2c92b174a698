#pragma once

#include <array>

#include "meniscus/core/named_constant.hpp"

namespace meniscus {

/// Largest |∇l0| of the rest length that a surface is remeshed with.
inline constexpr double kGradation = 0.5;
/// Largest |∇l0| where edges around necks are asked for. The cone from a thread to its bulb bends
/// less than the neck, yet the flow varies there over its radius.
inline constexpr double kNeckGradation = 0.3;
/// Fewest vertices of a drop, however small or round: those of an icosahedron whose faces are
/// divided in four. Fewer cannot hold a drop's shape through a remeshing.
inline constexpr int kFewestVertices = 42;
/// Σ|weights| of the vertices that a fitted middle of an edge rests on: 1.6 to 3 where they are
/// spread evenly. Above this the noise of vertices is amplified more than the lower degree's
/// truncation is worth. The spline fades out until twice that, so that middles, and the volume
/// under them, follow the vertices without jumps.
inline constexpr double kMostAmplification = 4.0;
/// Over the middle of an edge a fitted surface is trusted to this many of the edge's lengths. That
/// is a little more than the height of a circle over the sides of its regular triangle. Where
/// vertices lie as on a crease, fits swing out by a hundred.
inline constexpr double kHighestMiddle = 0.3;
/// Largest part of a drop's volume that a mending may move: one that moves more has pulled the
/// surface off its shape.
inline constexpr double kMostMendedVolume = 0.05;

inline constexpr std::array kSurfaceConstants{
    NamedConstant{"gradation", kGradation},
    NamedConstant{"neck-gradation", kNeckGradation},
    NamedConstant{"fewest-vertices", kFewestVertices},
    NamedConstant{"most-amplification", kMostAmplification},
    NamedConstant{"highest-middle", kHighestMiddle},
    NamedConstant{"most-mended-volume", kMostMendedVolume}};

}  // namespace meniscus
