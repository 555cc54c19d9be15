// Material points as the solids of a coupled step (solids/coupled_solids.hpp).
#pragma once
#include <memory>

#include "solids/coupled_solids.hpp"

namespace sluice::mpm {

class Mpm;

// What a fluid sees of each material.
std::vector<solids::SolidKind> kinds_beside_fluid(const Mpm& solids);

// With a step of its own.
std::shared_ptr<solids::CoupledSolids> make_solids_beside_fluid(const Mpm& solids);

}  // namespace sluice::mpm
