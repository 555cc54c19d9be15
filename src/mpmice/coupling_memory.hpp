// The memory of the coupling's arrays: over blocks of cells near solids.
#pragma once
#include "framework/grid/level.hpp"

namespace sluice::mpmice {

class MpmIce;

// Bytes at the start, with solids where the scene puts them, on the level that holds them. Bodies
// that part need more later. Outer faces, which grow with the surface alone, are not counted.
double coupling_bytes(const MpmIce& both, const Level& level);

}  // namespace sluice::mpmice
