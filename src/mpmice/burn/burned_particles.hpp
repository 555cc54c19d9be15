// Solids that become fluid: mass, momentum, energy and volume that particles lose.
//
// A particle keeps its corners and the kernel over them; what of its volume is left, `filled`,
// falls with its mass, and surfaces count by it (geometry/outer_faces.hpp). So stress and J stay as
// they are, the body stays closed, no fragment can turn inside out, and a burned particle leaves
// nothing. With f the share of the mass m that burns:
//
//   m, V, V_0, W: (1 - f) of them;  fluid: + f m, f m v, heat f (W + m c_s T + m Q), f m v^2/2
//
// in the cells of the particle, where its volume opens (burn_products.hpp).
#pragma once
#include "mpmice/burn/burned_sums.hpp"
#include "mpmice/fields/near_cells.hpp"
#include "mpmice/surfaces/solid_sets.hpp"

namespace sluice::mpmice {

// What a particle gives; energy (internal) and kinetic energy per mass.
struct GivenByParticle {
  std::size_t set, particle;
  double mass, energy, kinetic;  // kg, J/kg
  Vec3 velocity{};
};

template <int D>
class BurnedParticles {
 public:
  // `solids`: of the run; materials of the books: all solids, then all fluids.
  BurnedParticles(solids::CoupledSolids& solids, int fluids)
      : solids_(&solids), materials_(static_cast<int>(solids.kinds().size()) + fluids) {}

  // As a step begins: nothing has burned; what surfaces remember, and flames.
  void begin(SolidSets<D>& sets);
  // Particles of a kind lose these shares of their masses (by set and particle), which become a
  // product with Q J/kg more.
  std::vector<GivenByParticle> take(SolidSets<D>& sets, int solid, int product, double Q,
                                    const std::vector<Column>& shares);
  // Whose neighbours have vanished has more outer faces, and goes on where they have ended.
  // Collective.
  void expose_neighbours(const NearCells<D>& near, SolidSets<D>& sets, Communicator& ranks);
  // Into the books of the step. Collective.
  void book(Communicator& ranks, std::span<double> sums) const { burned_.add_to(ranks, sums); }
  // What is left becomes the particles' own when the step is accepted.
  void note(StepJournal& journal, SolidSets<D>& sets) const;
  // Once particles are taken over: those that are burned go.
  void remove(const StageScope& scope) const;

 private:
  solids::CoupledSolids* solids_;
  int materials_;
  BurnedSums burned_;
  bool vanished_ = false;  // has a particle of any rank burned to its end in this step
};

}  // namespace sluice::mpmice
