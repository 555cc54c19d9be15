// Boundary conditions as ghost states: what lies outside the domain, from what the deck says.
//
// A ghost state is a density, a velocity and a pressure; the face solver does the rest (a
// prescribed state is filtered by its characteristics, a mirrored one gives a wall exactly).
//
//   symmetry, free-slip wall   mirror, normal velocity negated
//   velocity Dirichlet with no normal component: a wall; the state is mirrored, the tangential
//     velocity about the wall's (viscous) or plainly (inviscid). Density and temperature of a wall
//     act through heat conduction only (heat_flux.cpp): without it they change nothing
//   velocity Dirichlet with a normal component: prescribed
//   Neumann q: the nearest interior cell minus q times the distance (0: a copy)
//   pressure and density: Dirichlet values; where temperature and density are given but not the
//     pressure, it follows from them; where temperature is given but not the density, the density
//     follows from pressure and temperature; all three: pressure and density count
//   LODI: waves.hpp; Sine, inlet profiles, MMS_1: flow_conditions.hpp; slip, creep: wall_slip.hpp
// Under gravity, pressures that are not prescribed continue the discrete hydrostatic balance.
// Several materials: mixture_rule.cpp. What they fill is copied, or follows from given densities;
// all have the ghost's pressure and, in their momentum, their own velocity.
// Scalars: boundary/scalar_ghosts.hpp.
// Ghosts beyond two or three sides hold the mean of what the sides' rules make of each other's
// ghosts: no axis comes first.
#pragma once
#include <array>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "framework/base/exact_sum.hpp"
#include "framework/field/warehouse.hpp"
#include "framework/scene/boundary.hpp"
#include "framework/task/places.hpp"
#include "framework/task/thread_team.hpp"
#include "ice/boundary/ghost_states.hpp"
#include "ice/boundary/region_rules.hpp"
#include "ice/boundary/scalar_ghosts.hpp"
#include "ice/deck/ice_scene.hpp"

namespace sluice::ice {

struct StateSlots {
  Label mass, momentum, energy;
  int material = 0;             // of the momentum; the first of several
  std::vector<int> directions;  // of the momentum components
  Label volume{};               // of several materials
  Label slip{};                 // of those with velocities of their own; none: they have one
  IndexOffsets places{};        // of the materials
  Label offset{};               // of semi-implicit steps: work pressure less that of the state
};

class BoundaryFill {
 public:
  // Of one level of the scene, whose boxes may change later.
  BoundaryFill(const Scene& scene, std::span<const IceMaterial> materials, const StateSlots& slots,
               int level = 0, const FlowConditions& conditions = {},
               std::span<const models::TransportedScalar> scalars = {},
               const models::MixedGas* mixed = nullptr);
  BoundaryFill(const Scene& scene, const IceMaterial& material, const StateSlots& slots,
               int level = 0, const FlowConditions& conditions = {})
      : BoundaryFill(scene, std::span(&material, 1), slots, level, conditions) {}

  // Ghost cells outside the domain of all local boxes: every value depends on cells of the domain
  // only, whatever the boxes and threads. `time`: s.
  // `sums`: what add_sums gives for all boxes of the coarsest level; none: no face has a carrier.
  void fill(Warehouse& state, const ThreadTeam& team, double time = 0,
            std::span<const double> sums = {}) const;
  // Open faces without a velocity far away, and the sums that stand in for it (open_faces.cpp).
  int open_faces() const { return static_cast<int>(open_faces_.size()); }
  int sum_count() const;
  void add_sums(const Warehouse& state, std::span<ExactSum> sums) const;

  // Ghosts outside the domain of a change of the pressure that is solved for: as the state's, 0
  // where the pressure is given.
  void fill_increment(Warehouse& state, int slot, const ThreadTeam& team) const;
  // Walls let nothing pass: the face solver sets u_f = 0 there, whatever the ghosts hold.
  bool has_walls(Side side) const { return has_walls_[index_of(side)]; }
  // `cell`: any cell with the transverse indices of the face.
  bool is_wall(Side side, IntVec3 cell) const { return rule(side, cell).mirrored(); }
  Vec3 wall_velocity(Side side, IntVec3 cell) const;  // m/s
  const WallHeat& wall_heat(Side side, IntVec3 cell, int material = 0) const;
  // Has a wall's gas another temperature than the wall (slip)?
  bool has_heat_slip() const { return has_heat_slip_; }
  const FlowConditions& conditions() const { return setting_.conditions; }
  // Open faces (LODI).
  bool has_waves(Side side) const { return has_waves_[index_of(side)]; }
  int wave_directions() const;  // with open faces
  bool lets_waves_out(Side side, IntVec3 cell) const { return rule(side, cell).waves; }
  // Walls that hold what touches them: their ghosts are 2 u_wall - u along the face.
  bool is_no_slip(Side side, IntVec3 cell) const {
    return setting_.viscous && rule(side, cell).velocity_kind == GhostRule::Velocity::wall;
  }
  SideKind side_kind(Side side, IntVec3 cell) const { return rule(side, cell).side_kind(); }
  // Faces through which the velocity is given (step/held_faces.hpp).
  bool holds_velocities() const;
  bool holds_velocities(Side side) const { return holds_[index_of(side)]; }
  bool holds_velocity(Side side, IntVec3 cell) const { return rule(side, cell).holds_velocity(); }
  // On the face at a time (s), m/s; `in_ghost`: what the ghost cell has, of conditions that do not
  // swing.
  double held_velocity(Side side, IntVec3 cell, double in_ghost, double time) const;
  // Of an open face: what its pressure is drawn to, how strongly, over which length.
  struct FarPressure {
    double pressure, sigma, length;  // Pa; a factor without unit; m
  };
  FarPressure far_pressure(Side side, IntVec3 cell) const;

 private:
  // The region of a boundary face; beyond the domain that of its image or of the nearest face.
  std::size_t region(Side side, IntVec3 cell) const;
  const GhostRule& rule(Side side, IntVec3 cell) const {
    return rules_[index_of(side)][region(side, cell)];
  }
  bool copies(Side side, std::size_t region) const;  // state by state, or mirrored
  void add_region(Side side, const BoundaryRegion& region, std::span<const IceMaterial> materials);
  void number_open_face(Side side);  // that of the region added last
  std::vector<std::optional<Vec3>> carriers(std::span<const double> sums) const;
  BoundaryViews views(const Warehouse& state, int box) const;
  RealView offset_view(const Warehouse& state, int box) const;
  std::vector<scalars::GhostViews> scalar_views(const Warehouse& state, int box) const;
  // `everywhere`: whether or not the material is there.
  void fill_scalars(Warehouse& state, int box, const IndexBox& ghosts, Side side,
                    bool everywhere) const;
  void fill_flow(Warehouse& state, int box, const IndexBox& ghosts, Side side,
                 const Moment& moment) const;
  // Of open faces, a row of cells at a time (boundary/open_sides.cpp).
  void fill_open_side(GhostStates& states, const IndexBox& ghosts, Side side) const;
  void fill_offset(Warehouse& state, int box, const IndexBox& ghosts, Side side,
                   const Moment& moment) const;
  // Of a number that has no rule of its own: mirrored or copied, 0 where the pressure is given.
  void fill_like_pressure(const RealView& view, const IndexBox& ghosts, Side side) const;
  // By any rule but waves.
  void fill_ghost(GhostStates& states, Side side, std::size_t region, IntVec3 ghost) const;
  void fill_side(Warehouse& state, int box, const IndexBox& ghosts, Side side,
                 const Moment& moment) const;
  void fill_direction(Warehouse& state, int width, int direction, const ThreadTeam& team,
                      const Moment& moment) const;
  // Does the order in which these sides fill a ghost matter?
  bool commute(std::span<const Side> sides) const;
  void fill_meeting(Warehouse& state, int box, const IndexBox& ghosts, std::span<const Side> sides,
                    const Moment& moment) const;
  void even_out_edges(Warehouse& state, int box, int width, const Moment& moment) const;
  IndexBox ghost_region(const Warehouse& state, int box, int ghost_width, Side side) const;

  BoundarySetting setting_;
  StateSlots slots_;
  const Level* level_;
  std::array<std::vector<GhostRule>, 6> rules_;  // by side, by region; of several, the common one
  std::array<std::vector<MixtureRule>, 6> mixtures_;  // of several materials
  std::span<const models::TransportedScalar> scalars_;
  std::array<std::vector<std::vector<scalars::GhostRule>>, 6> scalar_rules_;  // by region, scalar
  std::array<std::unique_ptr<RegionMap>, 6> regions_;
  std::array<bool, 6> has_walls_{}, has_waves_{}, holds_{};
  bool has_heat_slip_ = false;
  std::vector<int> open_faces_;  // their directions
};

}  // namespace sluice::ice
