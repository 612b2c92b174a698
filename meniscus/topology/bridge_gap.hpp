#pragma once

#include "meniscus/topology/cut_neck.hpp"
#include "meniscus/topology/gaps.hpp"

namespace meniscus {

struct BridgeOptions {
  double limit = 0.01;      ///< film thinner than this is opened [R0]
  double edge_floor = 0.0;  ///< [R0] no interface edge is asked to be shorter
};

/// Joins the two sides of a film by a tube at its closest place. Both surfaces are first refined
/// there to half the limit. The discs of faces within two limits of the closest place are taken
/// out. All of the film around it thinner than the limit goes with them. The two holes are joined
/// and smoothed. A thicker part of the film that this would enclose is taken out with it unless
/// it is large enough to be resolved. A sphere of its volume is then wider than twice the limit
/// and four times the edge floor. The disc of two limits alone is opened, where the film is
/// closest. An opening may add area, make the surface meet itself once its volume is restored, or
/// move more than a tenth of the liquid. Smaller discs are then tried, down to half a limit. A
/// drop within two limits of that place as a whole is left out, and its liquid is given to the
/// other.
///
/// The surface of the liquid that the bridge belongs to. For a film inside of a, between a drop in
/// a drop and the matrix around both, it is that of the film's liquid.
Surgery bridge_gap(const Scene& scene, const Gap& gap, const BridgeOptions& options);

}  // namespace meniscus
