// The state of one ghost cell from that of the cell that it looks at.
#pragma once
#include <optional>
#include <span>
#include <vector>

#include "framework/base/kept_array.hpp"
#include "framework/field/array_view.hpp"
#include "framework/grid/level.hpp"
#include "ice/boundary/region_rules.hpp"
#include "ice/deck/transport_settings.hpp"
#include "ice/fluid/laws_in_box.hpp"

namespace sluice::ice {

// State arrays of one box; by material, momentum by component, all per volume of the cell (kg/m^3,
// kg/(m^2 s), J/m^3; volume: a fraction). No volumes with one material. Slip (momentum relative to
// the mixture) by material and component, where each material has a velocity of its own.
struct BoundaryViews {
  KeptArray<RealView> mass, energy, volume, momentum, slip;
  std::vector<RealView> composition;  // of a gas that is a mixture: its fractions

  double density(IntVec3 c) const {
    double rho = mass.front()(c);
    for (std::size_t m = 1; m < mass.size(); ++m) rho += mass[m](c);
    return rho;
  }
};

struct SlipCell;
struct WaveState;

// What holds on all sides.
struct BoundarySetting {
  std::vector<Fluid> fluids;                // by material
  const models::MixedGas* mixed = nullptr;  // of the one gas, where it is a mixture
  std::vector<bool> rubs;                   // by material: it has a viscosity
  std::vector<int> directions;              // of the momentum components
  Vec3 gravity{};
  bool viscous = false;
  double viscosity = 0;                  // of one material, Pa s; the largest of a mixture
  std::optional<Sutherland> sutherland;  // its law in place of the number
  const Level* level = nullptr;
  FlowConditions conditions;
};

// When ghosts are filled, and what was found on the whole boundary for it.
struct Moment {
  double time = 0;
  // What carries things out through open faces without a velocity far away (open_faces.cpp); none
  // where the coarsest level has no cell.
  std::vector<std::optional<Vec3>> carriers;
};

// On one side, at a moment; ghosts are to be filled from the boundary outward.
class GhostStates {
 public:
  GhostStates(const BoundarySetting& setting, const BoundaryViews& views, int direction, bool plus,
              const Moment& moment);

  void plain(const GhostRule& rule, IntVec3 ghost, IntVec3 source) const;
  void gas(const GhostRule& rule, IntVec3 ghost, IntVec3 source) const;
  void mixture(const MixtureRule& rule, IntVec3 ghost, IntVec3 source);
  // `out`: what waves leave there (wave_rows.hpp), without hydrostatic pressure.
  void waves(const GhostRule& rule, const WaveState& out, IntVec3 ghost, IntVec3 source,
             std::size_t material = 0) const;
  void mixture_waves(const MixtureRule& rule, const WaveState& out, IntVec3 ghost, IntVec3 source);
  double pressure(IntVec3 cell) const;

 private:
  friend class WaveRows;
  struct Part {
    double rho = 0, V = 0, T = 0;  // true density, share of the cell
    double V_source = 0;
    const Fluid* law = nullptr;
    double u = 0;  // along one component
    bool given_T = false;
  };
  // Hydrostatic difference of pressure over one step outward, over the sum of its two densities.
  double half_weight() const;
  double hydrostatic(IntVec3 source, IntVec3 ghost, double rho_ghost, double room) const;
  // `given`: that of the rule at this ghost.
  double velocity(const GhostRule& rule, Vec3 given, double source_u, int direction,
                  double distance) const;
  bool enters_by_temperature(const GhostRule& rule, const Fluid& fluid, double rho,
                             Vec3 given) const;
  // Where a rule gives them; `rho`: density of the ghost, on which an exact flow may depend.
  Vec3 given_velocity(const GhostRule& rule, IntVec3 ghost, IntVec3 source, double rho) const;
  double given_pressure(const GhostRule& rule, IntVec3 ghost, IntVec3 source, double rho) const;
  GhostPlace place(const PrescribedFlow& flow, IntVec3 ghost, IntVec3 source) const;
  Vec3 gliding_velocity(const GhostRule& rule, IntVec3 ghost) const;
  // The one gas in a cell.
  struct GasAt {
    double rho, p, T;
  };
  GasAt gas_at(IntVec3 cell) const;
  double viscosity(IntVec3 cell, double T) const;
  // Cells on both sides of one along a direction, for differences; the cell itself where they end.
  struct Neighbours {
    IntVec3 low, high;
    int steps = 0;
  };
  Neighbours neighbours(IntVec3 cell, int direction) const;
  void differences_along(IntVec3 cell, int direction, SlipCell& slip) const;
  // Where a direction is in the frame of the face, and with which sign.
  struct FaceFrame {
    int component = 0;
    double sign = 1;
  };
  FaceFrame in_face_frame(int direction) const;
  void to_face_frame(Vec3 u, WaveState& s) const;
  double sound_speed(IntVec3 cell, const WaveState& s) const;
  double lowest_pressure(IntVec3 cell) const;  // of the laws of what is there
  WaveState wave_state(IntVec3 cell) const;
  void wave_momentum(const GhostRule& rule, const WaveState& out, IntVec3 ghost, IntVec3 source,
                     double rho) const;
  int alone_in(IntVec3 cell) const;
  double mixture_pressure(IntVec3 source) const;
  void commit(const MixtureRule& rule, IntVec3 ghost, IntVec3 source, double distance);
  double fill_cell(const MixtureRule& rule, double p);
  void set_velocities(const MixtureRule& rule, IntVec3 ghost, IntVec3 source, double distance,
                      bool slides);
  void keep_slip(IntVec3 ghost, IntVec3 source) const;

  const BoundarySetting& setting_;
  const BoundaryViews& v_;
  const LawsInBox laws_;
  int d_;
  bool plus_;
  const Moment& moment_;
  std::vector<Part> parts_;
  Fluid law_in_ghost_;  // of a part whose law is made for the cell
};

}  // namespace sluice::ice
