// <damage_model> and <erosion>: what makes particles of any law fail, and what failed ones bear.
//
// Both wrap a law: its history comes first, then p.damage, p.epsf, p.localizedMPM, p.timeofloc as
// they are needed. The law works as ever; then damage looks at its stress, then erosion takes the
// stress of failed particles. Where that changes the stress, the energy is the work of the rest.
#pragma once
#include <memory>
#include <vector>

#include "mpm/material/base/parameters.hpp"

namespace sluice::mpm {

// The children <damage_model> and <erosion> of a <material>, described.
TagSpec damage_model_tag();
TagSpec erosion_tag();

// Whether the material has an <erosion> that acts: laws then look for failure of their own.
bool erodes(const DeckNode& material);

// The law with the damage and erosion of the material around it; itself where there are none. Null
// after adding faults.
std::shared_ptr<const Material> with_failure(std::shared_ptr<const Material> law,
                                             const DeckNode& material,
                                             const MaterialConstants& constants,
                                             std::vector<Fault>& faults);

}  // namespace sluice::mpm
