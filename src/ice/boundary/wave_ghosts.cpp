// Ghosts that continue the cell next to the face as waves let them.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>

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

double GhostStates::pressure(IntVec3 cell) const {
  if (!v_.volume.empty()) return mixture_pressure(cell);
  Fluid room;
  return fluid_of(cell, room).pressure(v_.mass.front()(cell), v_.energy.front()(cell));
}

double GhostStates::sound_speed(IntVec3 cell, const WaveState& s) const {
  Fluid room;
  if (v_.volume.empty()) return fluid_of(cell, room).sound_speed(s.rho, s.p);
  double compliance = 0;  // 1/K
  for (std::size_t m = 0; m < v_.mass.size(); ++m) {
    const double M = v_.mass[m](cell), V = v_.volume[m](cell);
    if (M == 0.0) continue;
    const Fluid& fluid = fluid_of(cell, room, m);
    if (V == 1.0) return fluid.sound_speed(M, s.p);
    compliance += V / fluid.bulk_modulus(M / V, s.p);
  }
  return std::sqrt(1.0 / (compliance * s.rho));
}

WaveState GhostStates::wave_state(IntVec3 cell) const {
  WaveState s;
  s.rho = v_.density(cell);
  s.p = pressure(cell);
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

WaveCell GhostStates::wave_cell(const GhostRule& rule, IntVec3 source) const {
  const Level& level = *setting_.level;
  const LodiSettings& settings = *setting_.conditions.lodi;
  WaveCell cell;
  cell.here = wave_state(source);
  cell.spacing = level.spacing[d_];
  cell.domain_size = level.domain.size()[d_] * level.spacing[d_];
  cell.sound_speed = sound_speed(source, cell.here);
  if (settings.velocity_infinity && settings.rho_infinity) {
    cell.far_known = true;
    cell.far.rho = *settings.rho_infinity;
    to_face_frame(*settings.velocity_infinity, cell.far);
  } else if (rule.open_face >= 0 && !moment_.carriers.empty()) {
    const auto& carrier = moment_.carriers[static_cast<std::size_t>(rule.open_face)];
    cell.carrier_known = carrier.has_value();
    if (carrier) to_face_frame(*carrier, cell.carrier);
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
  in.sound_speed = sound_speed(inner, in.here);
  for (int t = 0; t < 2; ++t) in.along[t] = along(inner, tangents[d_][t]);
  const double here = transverse_part(cell), change = here - transverse_part(in);
  return here + 0.5 * layers * std::clamp(change, -std::fabs(here), std::fabs(here));
}

// The state that waves leave in a ghost, without hydrostatic pressure.
WaveState GhostStates::continued(const GhostRule& rule, IntVec3 source, int layers,
                                 double lowest_pressure) const {
  const WaveCell cell = wave_cell(rule, source);
  const double distance = layers * cell.spacing;
  const WaveState slope =
      outward_slopes(cell, transverse_part_of(cell, source, layers), *setting_.conditions.lodi);
  const double step =
      distance * std::min(largest_share(cell.here.rho, distance * slope.rho),
                          largest_share(cell.here.p - lowest_pressure, distance * slope.p));
  WaveState s = cell.here;
  s.rho += step * slope.rho;
  s.p += step * slope.p;
  for (int t = 0; t < 3; ++t) s.u[t] += step * slope.u[t];
  return s;
}

// Of material `m`, alone in the source; momentum for all.
void GhostStates::waves(const GhostRule& rule, IntVec3 ghost, IntVec3 source, std::size_t m) const {
  Fluid room, source_room;
  const Fluid& fluid = fluid_of(ghost, room, m);
  const int layers = std::abs(ghost[d_] - source[d_]);
  const WaveState out = continued(rule, source, layers, fluid.lowest_pressure());
  double rho = rule.fixed_density ? rule.density : out.rho;
  double p = rule.fixed_pressure || rule.sine_pressure ? given_pressure(rule, ghost, source)
                                                       : out.p + hydrostatic(source, ghost, rho);
  const double source_rho = v_.mass[m](source);
  const double T =
      rule.fixed_temperature
          ? rule.temperature
          : fluid_of(source, source_room, m).temperature(source_rho, v_.energy[m](source));
  if (rule.fixed_temperature) {
    if (rule.fixed_density)
      p = fluid.pressure(rho, fluid.energy_from_temperature(rho, T));
    else
      rho = fluid.density(p, T);
  }
  for (const auto* views : {&v_.mass, &v_.energy, &v_.volume})
    for (const RealView& v : *views) v(ghost) = 0.0;
  v_.mass[m](ghost) = rho;
  v_.energy[m](ghost) = fluid.energy_from_pressure(rho, p, T);
  if (!v_.volume.empty()) v_.volume[m](ghost) = 1.0;
  wave_momentum(rule, out, ghost, source, rho);
}

void GhostStates::wave_momentum(const GhostRule& rule, const WaveState& out, IntVec3 ghost,
                                IntVec3 source, double rho) const {
  const Vec3 given = given_velocity(rule, ghost, source);
  const double distance = std::abs(ghost[d_] - source[d_]) * setting_.level->spacing[d_];
  const double source_rho = v_.density(source);
  for (std::size_t c = 0; c < v_.momentum.size(); ++c) {
    const int e = setting_.directions[c];
    const int t = e == d_ ? 0 : e == tangents[d_][0] ? 1 : 2;
    const double sign = t == 0 && !plus_ ? -1.0 : 1.0;
    v_.momentum[c](ghost) =
        rho * (rule.velocity_kind == GhostRule::Velocity::copy
                   ? sign * out.u[t]
                   : velocity(rule, given, v_.momentum[c](source) / source_rho, e, distance));
  }
}

// The material that fills a cell alone; none: -1. Beside a trace its volume is 1, too.
int GhostStates::alone_in(IntVec3 cell) const {
  int only = -1;
  for (std::size_t m = 0; m < v_.mass.size(); ++m) {
    if (v_.mass[m](cell) == 0.0) continue;
    if (only >= 0) return -1;
    only = static_cast<int>(m);
  }
  return only;
}

// A mixture goes out as it is: mass fractions stay, each material is pressed along its isentrope.
void GhostStates::mixture_waves(const MixtureRule& rule, IntVec3 ghost, IntVec3 source) {
  IntVec3 inner = source;
  inner[d_] += plus_ ? -1 : 1;
  const int alone = alone_in(source);
  if (alone >= 0 && alone == alone_in(inner)) {
    const auto m = static_cast<std::size_t>(alone);
    waves(rule.parts[m].rule, ghost, source, m);
    return keep_slip(ghost, source);
  }
  const std::size_t count = v_.mass.size();
  double lowest = -std::numeric_limits<double>::infinity();
  for (std::size_t m = 0; m < count; ++m)
    if (v_.mass[m](source) > 0.0) lowest = std::max(lowest, setting_.fluids[m].lowest_pressure());
  const WaveState out = continued(rule.common, source, std::abs(ghost[d_] - source[d_]), lowest);
  const double p_source = mixture_pressure(source);
  const double p = rule.common.fixed_pressure || rule.common.sine_pressure
                       ? given_pressure(rule.common, ghost, source)
                       : out.p + hydrostatic(source, ghost, out.rho);
  double filled = 0;
  Fluid room;
  for (std::size_t m = 0; m < count; ++m) {
    Part& part = parts_[m];
    part = {};
    const double M = v_.mass[m](source), V = v_.volume[m](source);
    if (M == 0.0) continue;
    const Fluid& fluid = fluid_of(source, room, m);
    const double rho = M / V, change = (p - p_source) / fluid.bulk_modulus(rho, p_source);
    part.rho = rho * (1.0 + std::clamp(change, -most_change, most_change));
    part.T = fluid.temperature(rho, v_.energy[m](source) / V);
    part.V = V * (rho / part.rho);
    filled += part.V;
  }
  double rho = 0;
  for (std::size_t m = 0; m < count; ++m) {
    Part& part = parts_[m];
    // A cell that is full to round-off stays as it is.
    if (p != p_source) part.V = part.V == filled ? 1.0 : part.V / filled;
    const bool present = part.V > 0;
    const double M = part.V * part.rho;
    v_.volume[m](ghost) = present ? part.V : 0.0;
    v_.mass[m](ghost) = present ? M : 0.0;
    v_.energy[m](ghost) =
        present ? part.V * fluid_of(ghost, room, m).energy_from_pressure(part.rho, p, part.T) : 0.0;
    if (present) rho += M;
  }
  wave_momentum(rule.common, out, ghost, source, rho);
  keep_slip(ghost, source);
}

}  // namespace sluice::ice
