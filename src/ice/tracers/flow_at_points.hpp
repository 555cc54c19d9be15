// The velocity with which a material moves at any point of a box, from a conserved state.
#pragma once
#include <array>
#include <vector>

#include "framework/field/warehouse.hpp"
#include "framework/particle/point_stencil.hpp"

namespace sluice::ice {

class FlowAtPoints {
 public:
  // Of one local box; components of the momentum along `directions`. With velocities of their own
  // that of `material`, else the common one.
  FlowAtPoints(const Warehouse& state, int box, int material, int materials,
               const std::vector<int>& directions, bool own_velocities);

  // Linear between cell centres. False: too far outside the box.
  bool velocity(Vec3 point, Vec3& u) const {
    const PointStencil stencil = stencil_at(*level_, point);
    if (!known_.contains(stencil.cells())) return false;
    u = interpolate(stencil, [this](IntVec3 cell) { return in_cell(cell); });
    return true;
  }

 private:
  Vec3 in_cell(IntVec3 cell) const {
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
  std::vector<Component> momentum_, slip_;  // along active directions
  ConstRealView own_mass_;
};

}  // namespace sluice::ice
