// Boundary conditions as ghost states: what lies outside the domain, from what the deck says.
//
// A ghost state is a density, a velocity and a pressure; the face solver does the rest (a
// prescribed state is filtered by its characteristics, a mirrored one gives a wall exactly).
//
//   symmetry, free-slip wall   mirror, normal velocity negated
//   velocity Dirichlet with no normal component: a wall; the state is mirrored, the tangential
//     velocity about the wall's (viscous) or plainly (inviscid). Density and temperature of a wall
//     act through heat conduction only: without it they change nothing
//   velocity Dirichlet with a normal component: prescribed
//   Neumann q: the nearest interior cell minus q times the distance (0: a copy)
//   pressure and density: Dirichlet values; where temperature and density are given but not the
//     pressure, it follows from them; where temperature is given but not the density, the density
//     follows from pressure and temperature; all three: pressure and density count
// Under gravity, pressures that are not prescribed continue the discrete hydrostatic balance.
// Ghosts beyond two or three sides hold the mean of what the sides' rules make of each other's
// ghosts: no axis comes first.
#pragma once
#include <array>
#include <memory>
#include <span>
#include <vector>

#include "framework/field/warehouse.hpp"
#include "framework/scene/boundary.hpp"
#include "framework/task/thread_team.hpp"
#include "ice/ice_scene.hpp"

namespace sluice::ice {

// One region's conditions for one material, as numbers.
struct GhostRule {
  enum class Velocity { copy, mirror, wall, prescribed };
  Velocity velocity_kind = Velocity::copy;
  Vec3 velocity{};           // wall or prescribed
  Vec3 velocity_gradient{};  // copy
  bool fixed_density = false, fixed_pressure = false, fixed_temperature = false;
  double density = 0, pressure = 0, temperature = 0;
  double density_gradient = 0, pressure_gradient = 0, temperature_gradient = 0;

  bool mirrored() const {
    return velocity_kind == Velocity::mirror || velocity_kind == Velocity::wall;
  }
  // The conserved state is copied (or mirrored) as it is.
  bool plain() const;
};

// Throws InputError naming the deck line of a condition that is not built.
GhostRule make_rule(const BoundaryRegion& region, int material, int normal);

struct StateSlots {
  Label mass, momentum, energy;
  int material = 0;
  std::vector<int> directions;  // of the momentum components
};

class BoundaryFill {
 public:
  // Of one level of the scene, whose boxes may change later.
  BoundaryFill(const Scene& scene, const IceMaterial& material, const StateSlots& slots,
               int level = 0);

  // Ghost cells outside the domain of all local boxes: every value depends on cells of the domain
  // only, whatever the boxes and threads.
  void fill(Warehouse& state, const ThreadTeam& team) const;
  // The same for one slot that is simply copied outward (masks).
  void copy_outward(Warehouse& state, Label label, int material) const;

  // Walls let nothing pass: the face solver sets u_f = 0 there, whatever the ghosts hold.
  bool has_walls(Side side) const { return has_walls_[static_cast<std::size_t>(side)]; }
  // `cell`: any cell with the transverse indices of the face.
  bool is_wall(Side side, IntVec3 cell) const { return rule(side, cell).mirrored(); }

 private:
  // The rule for a boundary face; beyond the domain that of its image or of the nearest face.
  const GhostRule& rule(Side side, IntVec3 cell) const;
  struct SideRules;
  void fill_side(Warehouse& state, int box, const IndexBox& ghosts, Side side) const;
  void fill_direction(Warehouse& state, int width, int direction, const ThreadTeam& team) const;
  // Does the order in which these sides fill a ghost matter?
  bool commute(std::span<const Side> sides) const;
  void fill_meeting(Warehouse& state, int box, const IndexBox& ghosts,
                    std::span<const Side> sides) const;
  void even_out_edges(Warehouse& state, int box, int width) const;
  IndexBox ghost_region(const Warehouse& state, int box, int ghost_width, Side side) const;

  Vec3 gravity_;
  Fluid fluid_;
  bool viscous_;
  StateSlots slots_;
  const Level* level_;
  std::array<std::vector<GhostRule>, 6> rules_;  // by side, by region
  std::array<std::unique_ptr<RegionMap>, 6> regions_;
  std::array<bool, 6> has_walls_{};
};

}  // namespace sluice::ice
