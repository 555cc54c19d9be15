// Comparing two archives of which one is the mirror image of the other.
#pragma once
#include <filesystem>
#include <string>

namespace sluice::properties {

// "" when times, levels, outputs and checkpoints (the whole conserved state) of b are the image of
// those of a along `axis`, bit for bit: vectors with the component along it reversed; zeros of
// either sign are equal. Else what differs first. Particles are left out: their order and numbers
// follow the cells of a sweep. With `allowed` above 0: outputs alone, up to that share of the
// largest number of a field (of velocities, of all components, and at least 1e-12 of sqrt(p/rho),
// which
// counts as rest).
std::string mirror_difference(const std::filesystem::path& a, const std::filesystem::path& b,
                              int axis, double allowed = 0);

}  // namespace sluice::properties
