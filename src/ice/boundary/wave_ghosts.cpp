// Ghosts that continue the cell next to the face as waves let them.
#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "ice/boundary/ghost_states.hpp"

namespace sluice::ice {
namespace {

constexpr double most_change = 0.5;  // of density, and of pressure above the lowest of the law

// The tangents of a face, in rising order.
constexpr int tangents[3][2] = {{1, 2}, {0, 2}, {0, 1}};

double largest_share(double value, double change) {
  const double size = std::fabs(change), room = most_change * value;
  return size > room ? std::max(room, 0.0) / size : 1.0;
}

}  // namespace

void GhostStates::to_face_frame(Vec3 u, WaveState& s) const {
  s.u[0] = plus_ ? u[d_] : -u[d_];
  for (int t = 0; t < 2; ++t) s.u[1 + t] = u[tangents[d_][t]];
}

WaveState GhostStates::wave_state(IntVec3 cell) const {
  WaveState s;
  s.rho = v_.mass.front()(cell);
  s.p = setting_.fluids.front().pressure(s.rho, v_.energy.front()(cell));
  Vec3 u{};
  for (std::size_t c = 0; c < v_.momentum.size(); ++c)
    u[setting_.directions[c]] = v_.momentum[c](cell) / s.rho;
  to_face_frame(u, s);
  return s;
}

// Central differences; at the edge of the domain one-sided. Cells beyond it have none.
WaveState GhostStates::along(IntVec3 cell, int e) const {
  const Neighbours at = neighbours(cell, e);
  if (at.steps == 0) return {};
  const WaveState a = wave_state(at.low), b = wave_state(at.high);
  const double scale = 1.0 / (at.steps * setting_.level->spacing[e]);
  WaveState slope;
  slope.rho = (b.rho - a.rho) * scale;
  slope.p = (b.p - a.p) * scale;
  for (int t = 0; t < 3; ++t) slope.u[t] = (b.u[t] - a.u[t]) * scale;
  return slope;
}

WaveCell GhostStates::wave_cell(IntVec3 source) const {
  const Level& level = *setting_.level;
  const LodiSettings& settings = *setting_.conditions.lodi;
  WaveCell cell;
  cell.here = wave_state(source);
  cell.spacing = level.spacing[d_];
  cell.domain_size = level.domain.size()[d_] * level.spacing[d_];
  cell.sound_speed = setting_.fluids.front().sound_speed(cell.here.rho, cell.here.p);
  if (settings.velocity_infinity && settings.rho_infinity) {
    cell.far_known = true;
    cell.far.rho = *settings.rho_infinity;
    to_face_frame(*settings.velocity_infinity, cell.far);
  }
  IntVec3 inner = source;
  inner[d_] += plus_ ? -1 : 1;
  const WaveState in = wave_state(inner);
  const double scale = 1.0 / cell.spacing;
  cell.normal.rho = (cell.here.rho - in.rho) * scale;
  cell.normal.p = ((cell.here.p - in.p) - hydrostatic(inner, source, cell.here.rho)) * scale;
  for (int t = 0; t < 3; ++t) cell.normal.u[t] = (cell.here.u[t] - in.u[t]) * scale;
  for (int t = 0; t < 2; ++t) cell.along[t] = along(source, tangents[d_][t]);
  return cell;
}

// Along the way out to a ghost, from the two cells next to the face.
double GhostStates::transverse_part_of(const WaveCell& cell, IntVec3 source, int layers) const {
  WaveCell in = cell;
  IntVec3 inner = source;
  inner[d_] += plus_ ? -1 : 1;
  in.here = wave_state(inner);
  in.sound_speed = setting_.fluids.front().sound_speed(in.here.rho, in.here.p);
  for (int t = 0; t < 2; ++t) in.along[t] = along(inner, tangents[d_][t]);
  const double here = transverse_part(cell), change = here - transverse_part(in);
  return here + 0.5 * layers * std::clamp(change, -std::fabs(here), std::fabs(here));
}

void GhostStates::waves(const GhostRule& rule, IntVec3 ghost, IntVec3 source) const {
  const Fluid& fluid = setting_.fluids.front();
  const WaveCell cell = wave_cell(source);
  const int layers = std::abs(ghost[d_] - source[d_]);
  const double distance = layers * cell.spacing;
  const WaveState slope =
      outward_slopes(cell, transverse_part_of(cell, source, layers), *setting_.conditions.lodi);
  const double step =
      distance * std::min(largest_share(cell.here.rho, distance * slope.rho),
                          largest_share(cell.here.p - fluid.lowest_pressure(), distance * slope.p));
  double rho = rule.fixed_density ? rule.density : cell.here.rho + step * slope.rho;
  double p = rule.fixed_pressure || rule.sine_pressure
                 ? given_pressure(rule)
                 : cell.here.p + step * slope.p + hydrostatic(source, ghost, rho);
  const double T = rule.fixed_temperature
                       ? rule.temperature
                       : fluid.temperature(cell.here.rho, v_.energy.front()(source));
  if (rule.fixed_temperature) {
    if (rule.fixed_density)
      p = fluid.pressure(rho, fluid.energy_from_temperature(rho, T));
    else
      rho = fluid.density(p, T);
  }
  v_.mass.front()(ghost) = rho;
  v_.energy.front()(ghost) = fluid.energy_from_pressure(rho, p, T);
  const Vec3 given = given_velocity(rule, ghost);
  for (std::size_t c = 0; c < v_.momentum.size(); ++c) {
    const int e = setting_.directions[c];
    const int t = e == d_ ? 0 : e == tangents[d_][0] ? 1 : 2;
    const double sign = t == 0 && !plus_ ? -1.0 : 1.0;
    const double u = sign * (cell.here.u[t] + step * slope.u[t]);
    v_.momentum[c](ghost) =
        rho * (rule.velocity_kind == GhostRule::Velocity::copy
                   ? u
                   : velocity(rule, given, v_.momentum[c](source) / cell.here.rho, e, distance));
  }
}

}  // namespace sluice::ice
