#include "ice/conditions/ghost_rule.hpp"

namespace sluice::ice {

bool GhostRule::plain() const {
  return (velocity_kind == Velocity::mirror ||
          (velocity_kind == Velocity::copy && velocity_gradient == Vec3{})) &&
         !fixed_density && !fixed_temperature && density_gradient == 0 && pressure_gradient == 0 &&
         temperature_gradient == 0 && !gives_pressure() && !waves;
}

SideKind GhostRule::side_kind() const {
  if (mirrored()) return SideKind::wall;
  if (waves) return SideKind::open;
  if (is_exact(pressure_flow.get())) return SideKind::pressure;  // and the velocity: as inside
  if (velocity_kind != Velocity::copy) return SideKind::velocity;
  const bool given = gives_pressure() || (fixed_density && fixed_temperature);
  return given ? SideKind::pressure : SideKind::copied;
}

}  // namespace sluice::ice
