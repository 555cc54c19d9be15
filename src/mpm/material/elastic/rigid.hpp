// A law for solids whose motion is prescribed, whatever law a deck names; bulk_modulus: Pa.
#pragma once
#include <memory>

#include "mpm/material/base/material.hpp"

namespace sluice::mpm {

std::shared_ptr<const Material> make_rigid(double bulk_modulus);

}  // namespace sluice::mpm
