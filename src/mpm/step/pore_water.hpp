// Water in the pores of solids: a second velocity field on the nodes of a material, and the
// pressure of the pores. One-point two-phase formulation (I. Jassim, D. Stolle, P. Vermeer,
// Int. J. Numer.
// Anal. Meth. Geomech. 37 (2013) 2470; K. Soga and others, Geotechnique 66 (2016) 248).
//
// A particle carries v_s, v_w, the masses m_s = (1 - n0) rho_s V_0 and m_w = n0 rho_w V_0, which
// stay, the pore pressure p (compression positive), and sigma' as the stress that its law gives.
// Its porosity follows from J, as grains keep their volume: n = 1 - (1 - n0)/J, and never below
// least_porosity. On nodes, each a sum over particles with S,
//
//   M_s = sum m_s,  M_w = sum m_w,  M_f = sum rho_w V,  D = sum n rho_w V g/k
//   F_w = sum p V grad S,  f = -sum V (sigma' - p I) grad S
//   a_w = F_w/M_f + g,  a_s = (f - (M_w/M_f) F_w)/M_s + g,  lambda = D/M_f (1 + M_w/M_s)
//   d(v_w - v_s)/dt = a_w - a_s - lambda (v_w - v_s)
//   M_s dv_s/dt + M_w dv_w/dt = f + (M_s + M_w) g
//
// of which the first is solved exactly over a kick, with a_w and a_s as they are, so that no drag
// limits the time step; the second holds to round-off. Artificial damping acts on both velocities.
// Contact acts on v_s, before and after the kick; sides of the domain give both velocities.
// Particles then have (n at the start of the step, both L of the step)
//
//   v_w += sum S dv_w,  p -= dt (K_w/n) [(1 - n) tr L_s + n tr L_w]
//
// With the filter the p above that acts on nodes is p~ = sum S (sum m_s p S/M_s): the particles'
// own p goes on without it. All that acts on water vanishes at surfaces of the material: water
// drains
// there.
#pragma once
#include <memory>
#include <vector>

#include "framework/run/component/step_shape.hpp"
#include "mpm/step/body.hpp"
#include "mpm/step/level_nodes.hpp"
#include "mpm/step/solid_effect.hpp"
#include "mpm/transfer/from_grid.hpp"
#include "mpm/transfer/window.hpp"

namespace sluice::mpm {

// Grains that fill all space would leave water no volume.
inline constexpr double least_porosity = 1e-3;

// n of a particle.
inline double porosity(const PoreWaterConstants& water, double volume_0, double volume) {
  const double n = 1 - (1 - water.porosity) * volume_0 / volume;
  return n > least_porosity ? n : least_porosity;
}

// Both velocities after a kick, along one direction: solved as above.
struct PhasePair {
  double solid = 0, water = 0;        // M_s, M_w
  double relaxation = 0;              // lambda, 1/s
  double of_solid = 0, of_water = 0;  // v_s, v_w
  void kick(double time, double a_solid, double a_water);
};

// c of the faster wave through both, where they do not drag each other, for the largest step:
// waves with drag are none faster. In place of those of the law, n particles from `at` on, whose
// volumes are those of `now`.
void add_water_to_waves(const SolidMaterial& material, const Columns& columns,
                        const ParticleSet& set, const ParticleSet& now, std::size_t at, int n,
                        double* wave_speed);

class PoreWater final : public SolidEffect {
 public:
  // Keeps references.
  PoreWater(const MpmScene& solids, const LevelNodes& nodes, std::vector<Body>& bodies,
            const std::vector<BlockWork>& work);
  bool in(int kind) const {
    return solids_->materials[static_cast<std::size_t>(kind)].water.has_value();
  }

  // Bounds of what particles give.
  void begin(const StageScope& scope) override;
  double tension(int body) const override {
    const Bounds& b = bounds_[static_cast<std::size_t>(body)];
    return b.volume * b.pressure;
  }
  // With the filter, p~ of all particles; may add blocks to tables.
  void add_nodes() override;
  void give(const BlockWork& work, ParticlesToGrid& columns) const override;
  // Sums on nodes, of all ranks; then velocities.
  void before_nodes() override;

  // Both velocities of nodes after contact A, whose solids have M, v | f: v_s* replaces f.
  void start_block(BlockMember of) override;
  bool kick_block(const NodeStep& step, BlockMember of, BlockImpulses& impulses) override;
  // Velocities that sides give, books; lanes become v_w*, M_w | dv_w.
  void finish_block(const NodeStep& step, BlockMember of, bool side, bool booked,
                    NodeBooks& books) override;
  // What mirrors gave, and velocities to images.
  void after_nodes(const NodeStep& step, NodeBooks& books) override;
  void load(const BlockWork& work, int thread) override;
  // Velocity and pressure, with what particles read of the solid; the fastest waves.
  void to_particles(const Chunk& chunk) override;

 private:
  // What a thread reads from the nodes of a block.
  struct Reads {
    explicit Reads(const BlockShape& shape) : window(shape, 1) {}
    Window window;
    GridAtParticles at;
  };
  // Beside the particles of one set: p~, rho_w V, n rho_w V g/k, 0.
  struct Scratch {
    std::vector<double> filtered, full, drag, zero;
  };
  struct Bounds {  // of one kind
    double water = 0, mass = 0, velocity = 0, pressure = 0, volume = 0, drag = 0;
  };
  const Scratch& scratch(int kind, int box) const {
    return scratch_[static_cast<std::size_t>(kind)][static_cast<std::size_t>(box)];
  }
  // The pressure that acts, of the particles of a set.
  const double* acting(const BlockWork& work, const Columns& columns) const;
  void filter_at(const BlockWork& work, Reads& reads);
  void give_water();
  void give_scalars();
  double unit_of_scalar(std::size_t kind, bool drag) const;
  NodeLanes& lanes_of(int kind) { return water_[static_cast<std::size_t>(kind)]; }
  void share(int kind, NodeLanes& lanes, bool vectors) const;
  static void kick_node(const NodeStep& step, NodeImpulses& of, std::int64_t* solid,
                        std::int64_t* water, const std::int64_t* scalars);
  void finish_node(const NodeStep& step, int kind, IntVec3 at, bool side, bool booked,
                   std::int64_t* node, NodeBooks& books) const;
  void look_at(const BlockWork& work, const Columns& columns, Bounds& bounds);
  template <class Act>
  void sum(std::vector<NodeLanes>& sums, Act&& act) const;

  const MpmScene* solids_;
  const LevelNodes* nodes_;
  std::vector<Body>* bodies_;
  const std::vector<BlockWork>* work_;
  std::vector<Bounds> bounds_;
  std::vector<SumUnits> units_;
  std::vector<NodeLanes> water_;    // by kind: M_w, v_w | F_w, 1; at last as finish() leaves them
  std::vector<NodeLanes> scalars_;  // M_f, D, or the sums of the filter
  std::vector<std::vector<Scratch>> scratch_;  // by kind and box
  std::vector<Reads> reads_;                   // by thread
};

}  // namespace sluice::mpm
