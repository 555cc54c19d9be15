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
#include "framework/run/component/step_shape.hpp"
#include "mpm/boundary/node_boundary.hpp"
#include "mpm/nodes/node_exchange.hpp"
#include "mpm/step/columns.hpp"
#include "mpm/step/outside_forces.hpp"

namespace sluice::mpm {

struct Body;
struct BlockWork;

// What a step of solids lends for it.
struct HeatLoan {
  const StageScope* scope;
  std::vector<Body>* bodies;
  const std::vector<BlockWork>* work;
  NodeExchange* exchange;
  const NodeBoundary* boundary;
  const OutsideForces* outside;
};

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

class Heat {
 public:
  // Can it move in this scene.
  static bool possible(const MpmScene& solids, const Spreading& what = heat_spreads);
  Heat(const Scene& scene, const MpmScene& solids, const Level& level,
       const Spreading& what = heat_spreads);

  // Finds the rates of this step; collective.
  void conduct(const HeatLoan& loan);
  // dT/dt of the particles of a set, K/s; null: none this step.
  const double* rates(int kind, int box) const;
  // Heat of loads into the particles of a set, W; null: none this step.
  const double* sources(int kind, int box) const;

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
  void make_room(const HeatLoan& loan, bool conducts);
  // Do loads bring heat into the particles.
  bool is_heated(const HeatLoan& loan, const BlockWork& work) const;
  Ranges find_ranges(const HeatLoan& loan);
  void to_nodes(const HeatLoan& loan, const Ranges& ranges);
  // The largest |V k dT/dx_d| of each kind.
  std::vector<double> find_gradients(const HeatLoan& loan);
  void find_fluxes(const HeatLoan& loan, const Ranges& ranges, const std::vector<double>& bound);
  void take_part(const HeatLoan& loan, double dt);
  void meet(const HeatLoan& loan);
  void set_sides(const HeatLoan& loan);
  void to_particles(const HeatLoan& loan, double dt);
  bool side_value(IntVec3 node, int material, double& value) const;
  double inner_temperature(const Body& body, IntVec3 node, const SolidBoundary& side) const;

  const Spreading* what_;
  const Scene* scene_;
  const MpmScene* solids_;
  Level level_;
  bool active_ = false;
  double reference_ = 0;
  std::vector<NodeLanes> nodes_, flux_;  // by kind: T - T_ref, -, -, M | dT/dt, T at first, -, 1
  std::vector<SumUnits> flux_units_;
  std::vector<std::vector<Scratch>> scratch_;
};

}  // namespace sluice::mpm
