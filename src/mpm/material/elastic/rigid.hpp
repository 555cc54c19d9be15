// A law for solids that move as they are told, whatever law a deck names.
#pragma once
#include <memory>

#include "mpm/material/base/material.hpp"

namespace sluice::mpm {

std::shared_ptr<const Material> make_rigid(double bulk_modulus);

}  // namespace sluice::mpm
