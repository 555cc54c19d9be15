// Masses and energies of particles at both ends of a step, into the books of their bodies; and how
// many have parted from their neighbours.
#pragma once
#include "mpm/step/parted_neighbours.hpp"
#include "mpm/step/solid_effect.hpp"

namespace sluice::mpm {

class EnergyBooks final : public SolidEffect {
 public:
  void to_particles(const Chunk& chunk) override;
};

class PartedBooks final : public SolidEffect {
 public:
  // Whether particles of some body can part.
  static bool possible(const MpmScene& solids, const std::vector<Carried>& carried,
                       const Level& level);
  PartedBooks(const MpmScene& solids, const std::vector<Carried>& carried, const Level& level);
  void to_particles(const Chunk& chunk) override;

 private:
  std::vector<PartedNeighbours> parted_;  // by body
};

}  // namespace sluice::mpm
