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
#include "mpm/boundary/node_boundary.hpp"
#include "mpm/nodes/node_exchange.hpp"
#include "mpm/step/columns.hpp"
#include "mpm/transfer/from_grid.hpp"
#include "mpm/transfer/window.hpp"

namespace sluice::mpm {

struct Body;
struct BlockWork;
struct NodeBooks;
struct NodeImpulses;
struct NodeStep;

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

// What a step of solids lends for it.
struct WaterLoan {
  const StageScope* scope;
  std::vector<Body>* bodies;
  const std::vector<BlockWork>* work;
  NodeExchange* exchange;
  const NodeBoundary* boundary;
};

class PoreWater {
 public:
  PoreWater(const MpmScene& solids, const Level& level);
  bool in(int kind) const {
    return solids_->materials[static_cast<std::size_t>(kind)].water.has_value();
  }

  // Bounds of what particles give, Body::pore_pull too; collective.
  void begin(const WaterLoan& loan);
  // With the filter, p~ of all particles. Collective; may add blocks to tables.
  void filter(const WaterLoan& loan);
  // The pressure that acts, of the particles of a set.
  const double* acting(const BlockWork& work, const Columns& columns) const;
  // Sums on nodes, of all ranks; then velocities. Collective.
  void to_nodes(const WaterLoan& loan);

  // Node n of a block after contact A, whose solid has M, v | f: v_s* takes the place of f.
  void kick(const NodeStep& step, int kind, int block, int n, NodeImpulses& of,
            std::int64_t* solid);
  // Velocities that sides give (at the node `at`), books; lanes become v_w*, M_w | dv_w.
  void finish(const NodeStep& step, const NodeBoundary& boundary, int kind, int block, int n,
              IntVec3 at, bool side, bool booked, NodeBooks& books);
  NodeLanes& lanes_of(int kind) { return water_[static_cast<std::size_t>(kind)]; }

  // What a thread reads from the nodes of a block.
  struct Reads {
    explicit Reads(const BlockShape& shape) : window(shape, 1) {}
    Window window;
    GridAtParticles at;
  };
  void load(const BlockWork& work, const Body& body, Reads& reads) const;
  // Velocity and pressure of n particles from `at` on, with what they read of the solid.
  void advance(const BlockWork& work, const Body& body, std::size_t at, int n, double dt,
               const GridAtParticles& solid, Reads& reads) const;

 private:
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
  void share(const WaterLoan& loan, int kind, NodeLanes& lanes, bool vectors) const;
  void look_at(const BlockWork& work, const Columns& columns, Bounds& bounds);
  template <class Act>
  void sum(const WaterLoan& loan, std::vector<NodeLanes>& sums, Act&& act) const;

  const MpmScene* solids_;
  Level level_;
  std::vector<Bounds> bounds_;
  std::vector<SumUnits> units_;
  std::vector<NodeLanes> water_;    // by kind: M_w, v_w | F_w, 1; at last as finish() leaves them
  std::vector<NodeLanes> scalars_;  // M_f, D, or the sums of the filter
  std::vector<std::vector<Scratch>> scratch_;  // by kind and box
};

}  // namespace sluice::mpm
