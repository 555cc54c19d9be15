// Ghost layers that copy or mirror cells of the domain.
#pragma once
#include <span>

#include "framework/field/array_view.hpp"

namespace sluice::ice {

// The interior cell that a ghost cell looks at: its mirror image or the nearest one.
IntVec3 source_cell(IntVec3 ghost, int d, bool plus, bool mirrored, const IndexBox& domain);

// data = sign * data of the layer source[n] of direction d, for the n-th ghost layer; sign: 1 or
// -1.
void copy_layers(const RealView& v, const IndexBox& ghosts, int d, std::span<const int> source,
                 double sign);

}  // namespace sluice::ice
