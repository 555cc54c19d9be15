// Combustion of hydrogen: 9 species (H, H2, O, OH, H2O, O2, HO2, H2O2, N2), 23 reactions.
//
// Reference: Burke, Chaos, Ju, Dryer, Klippenstein, Int. J. Chem. Kinet. 44 (2012) 444; without
// argon and helium, and with the one set of efficiencies of H + O2 (+ M) for nitrogen. The fits of
// transport are of the kinetic theory of gases.
#pragma once
#include "kinetics/mechanism.hpp"

namespace sluice::kinetics {

const Mechanism& burke_hydrogen();

}  // namespace sluice::kinetics
