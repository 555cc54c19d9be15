// What transfer and integration take from the energy of particles becomes heat of them.
//
// A particle gives its share of mass to nodes, and its stress pushes them. Of a step, with any
// velocity u of nodes,
//
//   P = sum m S dv . u + dk V sigma : sum u (x) grad S
//   loss = P - (change of its kinetic energy, its spin's too) - (U+ - U)
//
// adds up to the energy account's T + R, as M dv is the impulse of all stress on a node. Taken
// are the velocities by which energy passes: u = (v + vh)/2, v as particles gave it, vh those of
// which L is taken, v* where nothing is mapped back. Of v* alone some particles would lose for
// ever what others win, without any loss of all. Impulses J from outside are in M dv, but their
// work is that with (v + v*)/2: vh is v* where contact or a given velocity acts, and of gravity
// J . (u - (v + v*)/2) is subtracted.
//
// Of a wave that still swings with the step: forces of one time work on velocities half a step
// before and behind. With v and the first half of the change of kinetic energy in the interval
// before, and vh, the second half and U+ - U in the interval behind, it does not. A particle keeps
//
//   B = loss of all intervals so far, and what is open of the next one
//   G = max(-D, g) for g < 0, phi g for g > 0,   g = loss of all intervals - E
//
// with E = m sum_ed (L - W)_ed^2 <r_d^2>/2, kinetic energy within a cell, which nodes have and
// particles do not. G is heat; E and what is open of B are not lost: the total energy counts both.
// D is that of the artificial viscosity. A gain takes heat back, but no more than what these two
// have given: of the part T_l of the temperature that is theirs, which compression changes as it
// changes T, a gain takes the share that it takes of G + D. So no particle is cooled below the
// temperature that its deformation gives it. What a
// particle where it crosses kinks of shape functions loses others win: phi <= 1, one for each body,
// is such that all its heat is what the body has lost, and no more.
#pragma once
#include <vector>

#include "mpm/step/mapped_back.hpp"
#include "mpm/step/solid_effect.hpp"

namespace sluice::mpm {

class LostEnergy final : public SolidEffect {
 public:
  // Keeps references. `mapped`: null where no velocities are mapped back.
  LostEnergy(const MpmScene& solids, const LevelNodes& nodes, const std::vector<Body>& bodies,
             const MappedBack* mapped);

  void begin(const StageScope& scope) override;
  void after_nodes(const NodeStep& step, NodeBooks& books) override;
  // Minus both halves of the change of kinetic energy, of velocities and of spins.
  void moved(const Chunk& chunk) override;
  // Windows of the nodes at the start of the step, with the velocities of both halves.
  void load(const BlockWork& work, int thread) override;
  // Losses of particles that have their new state; where their heat will stand, g or -D.
  void to_particles(const Chunk& chunk) override;
  // After the step on all levels: G and the temperature of it; `share`: phi.
  void give_heat(std::span<const BlockWork> work, int body, double share, double dt) const;

 private:
  struct Reads {
    explicit Reads(const BlockShape& shape)
        : nodes(shape, 1), mapped(shape, 1), before(shape, 1), after(shape, 1) {}
    Window nodes, mapped, before, after;
    GridAtParticles at;
  };
  void add_works(const Chunk& chunk, Reads& reads) const;
  void find_inner(const Chunk& chunk, double* within, double* gained) const;
  // T_l behind the law and the artificial viscosity.
  void carry_temperature(const Chunk& chunk) const;

  const MpmScene* solids_;
  const LevelNodes* nodes_;
  const std::vector<Body>* bodies_;
  const MappedBack* mapped_;
  NodeStep step_;
  std::vector<Reads> reads_;  // by thread
};

}  // namespace sluice::mpm
