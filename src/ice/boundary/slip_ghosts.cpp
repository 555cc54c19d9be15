// Ghosts of walls along which a rarefied gas slips.
#include <algorithm>

#include "ice/boundary/ghost_states.hpp"
#include "ice/conditions/wall_slip.hpp"

namespace sluice::ice {

GhostStates::Neighbours GhostStates::neighbours(IntVec3 cell, int e) const {
  const Level& level = *setting_.level;
  Neighbours at{cell, cell, 0};
  --at.low[e];
  ++at.high[e];
  if (!level.periodic[e]) {
    if (cell[e] < level.domain.lower[e] || cell[e] >= level.domain.upper[e]) return {cell, cell, 0};
    at.low[e] = std::max(at.low[e], level.domain.lower[e]);
    at.high[e] = std::min(at.high[e], level.domain.upper[e] - 1);
  }
  const IndexBox& box = v_.mass.front().box;
  at.steps = at.high[e] - at.low[e];
  if (!level.active[e] || at.low[e] < box.lower[e] || at.high[e] >= box.upper[e]) at.steps = 0;
  return at;
}

// What pulls at the gas, from the discrete hydrostatic balance, and how it warms, along a wall.
void GhostStates::differences_along(IntVec3 cell, int e, SlipCell& slip) const {
  const Neighbours at = neighbours(cell, e);
  if (at.steps == 0) return;
  const RealView& mass = v_.mass.front();
  const double dx = setting_.level->spacing[e], length = at.steps * dx;
  double weight = 0;  // sum of g dx (rho + rho)/2 over the steps
  for (IntVec3 c = at.low; c[e] < at.high[e];) {
    IntVec3 next = c;
    ++next[e];
    weight += 0.5 * setting_.gravity[e] * dx * (mass(c) + mass(next));
    c = next;
  }
  const GasAt low = gas_at(at.low), high = gas_at(at.high);
  slip.pull = ((high.p - low.p) - weight) / length - setting_.conditions.slip->force[e];
  slip.warming = (high.T - low.T) / length;
}

GhostStates::GasAt GhostStates::gas_at(IntVec3 cell) const {
  Fluid room;
  const Fluid& fluid = laws_.at(cell, 0, room);
  const double rho = v_.mass.front()(cell), rho_e = v_.energy.front()(cell);
  return {rho, fluid.pressure(rho, rho_e), fluid.temperature(rho, rho_e)};
}

// Of the molecules: their free path knows neither sponge layers nor eddies.
double GhostStates::viscosity(IntVec3 cell, double T) const {
  if (setting_.sutherland) return setting_.sutherland->viscosity(T);
  double mu = 0;
  laws_.row(cell, 0).viscosity(1, setting_.viscosity, &mu);
  return mu;
}

// On the wall beside a ghost, along the wall.
Vec3 GhostStates::gliding_velocity(const GhostRule& rule, IntVec3 ghost) const {
  IntVec3 beside = ghost;
  beside[d_] = plus_ ? setting_.level->domain.upper[d_] - 1 : setting_.level->domain.lower[d_];
  const GasAt gas = gas_at(beside);
  SlipCell cell;
  cell.rho = gas.rho;
  cell.p = gas.p;
  cell.temperature = gas.T;
  cell.viscosity = viscosity(beside, gas.T);
  cell.spacing = setting_.level->spacing[d_];
  const SlipSettings& settings = *setting_.conditions.slip;
  Vec3 on_wall = rule.velocity;
  for (std::size_t c = 0; c < v_.momentum.size(); ++c) {
    const int e = setting_.directions[c];
    if (e == d_) continue;
    cell.velocity = v_.momentum[c](beside) / gas.rho;
    cell.wall_velocity = rule.velocity[e];
    cell.pull = cell.warming = 0;
    if (settings.second_order() || rule.creep) differences_along(beside, e, cell);
    on_wall[e] = slip_velocity(settings, cell, rule.creep);
  }
  return on_wall;
}

}  // namespace sluice::ice
