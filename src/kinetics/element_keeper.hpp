// Changes of concentrations that make or destroy no atoms.
//
// Reactions keep the atoms of each element; the round-off of many steps, and negative
// concentrations set to 0, do not quite. The excess r_e = sum_k a_ek dc_k goes back in proportion
// to what there is of each species: dc_k -= c_k sum_e a_ek l_e with
// sum_f (sum_k a_ek c_k a_fk) l_f = r_e. So nothing becomes negative, what is absent stays so, and
// the correction is as small as the excess.
#pragma once
#include <cstddef>
#include <vector>

#include "kinetics/mechanism.hpp"

namespace sluice::kinetics {

class ElementKeeper {
 public:
  explicit ElementKeeper(const Mechanism& mechanism);

  // c: concentrations at the end by species, mol/m^3, none negative; change: less those of the
  // start. Both corrected.
  void correct(double* c, double* change);

 private:
  void solve();

  std::size_t species_, elements_;
  std::vector<double> atoms_;   // at element * species + species
  std::vector<double> matrix_;  // elements * elements
  std::vector<double> excess_;  // then l
};

}  // namespace sluice::kinetics
