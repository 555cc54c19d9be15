// What spreads in solids, on the nodes of a level: heat by conduction, with heat through surfaces,
// thermal contact and temperatures of sides; a concentration by diffusion, with those of sides.
//
//   M = sum m S,  T_i = T_ref + (sum m (T - T_ref) S)/M           from the particles
//   Q_i = sum (q_p S - V k grad T . grad S),  grad T = sum T_i grad S   with the T_i of now
//   T_i <- T_i + dt Q_i/(c_v M);  thermal contact T_i = sum m c T/sum m c;  temperatures of sides
//   dT/dt = (T_i - T_i of the start)/dt, which the particles gather
//
// In as many parts of a step as the explicit conduction needs, k dt/(rho c_v) sum 2/h^2 <= 1 a
// part,
// so that conduction never limits the step of the waves. Nothing happens while all temperatures are
// equal. The transfers are those of the momentum: -V k grad T stands for a row of the stress.
// Of a concentration C per mass the same with C for T, m D for V k and 1 for c_v.
#pragma once
#include "mpm/step/level_nodes.hpp"
#include "mpm/step/outside_forces.hpp"
#include "mpm/step/solid_effect.hpp"

namespace sluice::mpm {

// What spreads.
struct Spreading {
  int Columns::*value;                                // of particles: T
  int Columns::*weight;                               // V, or m: of what passes by a gradient
  double (*conductivity)(const SolidMaterial&);       // k of that; 0: it does not spread there
  double (*capacity)(const SolidMaterial&);           // c_v; 0: nothing is stored there
  SolidBoundary::Kind prescribed, gradient_of_sides;  // conditions of sides
  bool heat;                                          // loads bring some, thermal contact passes it
};
extern const Spreading heat_spreads, concentration_spreads;

class Heat final : public SolidEffect {
 public:
  // Can it move in this scene.
  static bool possible(const MpmScene& solids, const Spreading& what = heat_spreads);
  // Keeps references.
  Heat(const Scene& scene, const MpmScene& solids, const LevelNodes& nodes,
       std::vector<Body>& bodies, const std::vector<BlockWork>& work, const OutsideForces& outside,
       const Spreading& what = heat_spreads);

  // Finds the rates of this step; collective.
  void before_particles(const StageScope& scope, NodeBooks& books) override;
  // The column of heat by loads, where it is saved.
  void moved(const Chunk& chunk) override;
  // T <- T + dt dT/dt; a concentration within the bounds of the material.
  void to_particles(const Chunk& chunk) override;

 private:
  // Beside the particles of one set.
  struct Scratch {
    std::vector<double> rate, source, gradient[3], zero;
  };
  struct Ranges {
    double low = 1e300, high = -1e300;    // temperatures, those of sides too
    std::vector<double> specific_weight;  // by kind, largest V/m
    std::vector<double> source;           // by kind, largest |q_p|
    bool driven = false;                  // a source or a gradient at a side
  };
  Scratch& scratch(int kind, int box) {
    return scratch_[static_cast<std::size_t>(kind)][static_cast<std::size_t>(box)];
  }
  void make_room(bool conducts);
  // Do loads bring heat into the particles.
  bool is_heated(const BlockWork& work) const;
  void find_loads(const BlockWork& work, double time, Ranges& ranges);
  void share_ranges(Communicator& ranks, Ranges& ranges) const;
  Ranges find_ranges(const StageScope& scope);
  double rate_of_conduction(const Ranges& ranges) const;
  void to_nodes(const Ranges& ranges);
  void agree(std::size_t kind, const SumUnits& units);
  // The largest |V k dT/dx_d| of each kind.
  std::vector<double> find_gradients(const StageScope& scope);
  void find_fluxes(const Ranges& ranges, const std::vector<double>& bound);
  void take_part(double dt);
  void meet();
  void set_sides();
  void find_rates(double dt);
  bool side_value(IntVec3 node, int material, double& value) const;
  double inner_temperature(const Body& body, IntVec3 node, const SolidBoundary& side) const;

  struct Flux {
    NodeLanes nodes;  // sums of Q_i where forces stand
    SumUnits units;
  };

  const Spreading* what_;
  const Scene* scene_;
  const LevelNodes* space_;
  std::vector<Body>* bodies_;
  const std::vector<BlockWork>* work_;
  const OutsideForces* outside_;
  const MpmScene* solids_;
  bool active_ = false;
  double reference_ = 0;
  std::vector<NodeLanes> nodes_;  // by kind: T - T_ref, -, -, M | dT/dt, T at first, -, 1
  std::vector<Flux> flux_;        // by kind
  std::vector<std::vector<Scratch>> scratch_;
};

}  // namespace sluice::mpm
