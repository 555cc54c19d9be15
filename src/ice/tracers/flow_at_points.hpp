// The velocity with which a material moves at any point of a box, from a conserved state.
#pragma once
#include <array>
#include <vector>

#include "framework/field/warehouse.hpp"
#include "framework/particle/point_stencil.hpp"
#include "framework/task/places.hpp"

namespace sluice::ice {

// How the flow is stored.
struct FlowStorage {
  int materials = 1;
  std::vector<int> directions;  // of the components of the momentum
  bool multi_velocity = false;
  IndexOffsets places{};  // of the materials
  bool solids = false;    // are beside them
};

class FlowAtPoints {
 public:
  // Of one local box: with velocities of their own that of `material`, else the common one.
  // `walls`: the state that a step began with, which knows how solids move in it (solids alone).
  FlowAtPoints(const Warehouse& state, int box, int material, const FlowStorage& flow,
               const Warehouse& walls);

  // Linear between cell centres; m and m/s. False: too far outside the box.
  bool velocity(Vec3 point, Vec3& u) const {
    const PointStencil stencil = stencil_at(*level_, point);
    if (!known_.contains(stencil.cells())) return false;
    u = interpolate(stencil, [this](IntVec3 cell) { return in_cell(cell); });
    return true;
  }

 private:
  // In cells that solids fill: their velocity, as the faces of the cell have it.
  Vec3 solid_velocity(IntVec3 cell) const {
    Vec3 u{};
    for (const Component& c : solids_) {
      IntVec3 above = cell;
      ++above[c.direction];
      const double low = c.value(cell);
      u[c.direction] = c.value.box.contains(above) ? 0.5 * (low + c.value(above)) : low;
    }
    return u;
  }
  Vec3 in_cell(IntVec3 cell) const {
    if (!solids_.empty() && fraction_(cell) >= 1) return solid_velocity(cell);
    double rho = 0;
    for (const ConstRealView& mass : masses_) rho += mass(cell);
    if (rho == 0) return {};
    Vec3 u{};
    for (const Component& c : momentum_) u[c.direction] = c.value(cell) / rho;
    if (slip_.empty()) return u;
    const double own = own_mass_(cell);
    if (own == 0) return u;
    for (const Component& c : slip_) u[c.direction] += c.value(cell) / own;
    return u;
  }

  struct Component {
    int direction;
    ConstRealView value;
  };
  const Level* level_;
  IndexBox known_;
  std::vector<ConstRealView> masses_;
  std::vector<Component> momentum_, slip_, solids_;  // along active directions
  ConstRealView own_mass_, fraction_;
};

}  // namespace sluice::ice
