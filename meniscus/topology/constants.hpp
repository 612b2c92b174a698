#pragma once

#include <array>
#include <numbers>

#include "meniscus/core/named_constant.hpp"

namespace meniscus {

/// How much wider than a neck its thread must become on both sides. A ring of ten edges has a
/// perimeter within 2 % of the circle's, whatever its phase; a tenth is beyond all such noise.
inline constexpr double kProminence = 1.1;
/// Volume that must lie on either side of a neck, in its radius cubed. It is a ball as wide as the
/// neck and a stretch of it as long as the radius.
inline constexpr double kLeastEnd = (4.0 / 3.0 + 1.0) * std::numbers::pi;
/// Radius of the hole that a film is opened with, in limits (`coalescence_gap`). A tube of length h
/// and radius a has less area than the two discs it stands for from a = h on. Twice that leaves
/// room for a patch that is no circle.
inline constexpr double kHole = 2.0;
/// Area that an event may add, of that of the sphere as large as the largest parent. Cuts and
/// bridges take area off but where the liquid of a wide neck or film swells small or crumpled
/// drops. A thinner one swells them less.
inline constexpr double kMostAddedByEvent = 1e-3;
/// Area that an opening may add, in limits²; at the default limit of 0.01 it is 1.5e-4. Taking much
/// film out adds more, where its liquid swells the rest.
inline constexpr double kMostAddedByOpening = 1.5;
/// Largest part of the liquid that an opening may move. Most openings move of the order of the
/// limit cubed. From a drop no larger than the hole, or a flat one, an opening would take most.
inline constexpr double kMostMoved = 0.1;

inline constexpr std::array kTopologyConstants{
    NamedConstant{"prominence", kProminence},
    NamedConstant{"least-end", kLeastEnd},
    NamedConstant{"hole", kHole},
    NamedConstant{"most-added-by-event", kMostAddedByEvent},
    NamedConstant{"most-added-by-opening", kMostAddedByOpening},
    NamedConstant{"most-moved", kMostMoved}};

}  // namespace meniscus
