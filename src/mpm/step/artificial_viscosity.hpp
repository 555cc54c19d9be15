// Artificial viscosity: a pressure q in particles that are compressed, which spreads shocks over a
// few cells. It acts in the forces of the next step.
//
//   tr D < 0:  q = rho (A_1 c_b |tr D| h + A_2 (tr D h)^2),  c_b^2 = K/rho,  h the mean cell width
//
// Its work -q V tr D dt joins the energy of the particle; in materials with plastic flow it is
// heat. Time steps count with it: the speed of sound becomes Q + sqrt(Q^2 + c^2) where
// q = rho Q |tr D| h.
#pragma once
#include "mpm/step/solid_effect.hpp"

namespace sluice::mpm {

class ArtificialViscosity final : public SolidEffect {
 public:
  // Keeps references.
  ArtificialViscosity(const MpmScene& solids, const std::vector<Carried>& carried,
                      const Level& level)
      : solids_(&solids), carried_(&carried), level_(&level) {}
  // Where a material carries q.
  static bool possible(const std::vector<Carried>& carried);

  void give(const BlockWork& work, ParticlesToGrid& columns) const override;
  // q, energy, heating, and the speed that limits the next time step.
  void to_particles(const Chunk& chunk) override;

 private:
  const MpmScene* solids_;
  const std::vector<Carried>* carried_;
  const Level* level_;
};

}  // namespace sluice::mpm
