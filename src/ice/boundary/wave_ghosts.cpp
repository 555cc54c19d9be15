// Ghosts that continue the cell next to the face as waves let them.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>

#include "ice/boundary/ghost_states.hpp"
#include "ice/boundary/waves.hpp"

namespace sluice::ice {
namespace {

// The tangents of a face, in rising order.
constexpr int tangents[3][2] = {{1, 2}, {0, 2}, {0, 1}};

}  // namespace

GhostStates::FaceFrame GhostStates::in_face_frame(int e) const {
  if (e == d_) return {0, plus_ ? 1.0 : -1.0};
  return {e == tangents[d_][0] ? 1 : 2, 1.0};
}

void GhostStates::to_face_frame(Vec3 u, WaveState& s) const {
  for (int e = 0; e < 3; ++e) {
    const auto [component, sign] = in_face_frame(e);
    s.u[component] = sign * u[e];
  }
}

double GhostStates::pressure(IntVec3 cell) const {
  if (!v_.volume.empty()) return mixture_pressure(cell);
  Fluid room;
  return laws_.at(cell, 0, room).pressure(v_.mass.front()(cell), v_.energy.front()(cell));
}

double GhostStates::sound_speed(IntVec3 cell, const WaveState& s) const {
  Fluid room;
  if (v_.volume.empty()) return laws_.at(cell, 0, room).sound_speed(s.rho, s.p);
  double compliance = 0;  // 1/K
  for (std::size_t m = 0; m < v_.mass.size(); ++m) {
    const double M = v_.mass[m](cell), V = v_.volume[m](cell);
    if (M == 0.0) continue;
    const Fluid& fluid = laws_.at(cell, m, room);
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

double GhostStates::lowest_pressure(IntVec3 cell) const {
  double lowest = -std::numeric_limits<double>::infinity();
  for (std::size_t m = 0; m < v_.mass.size(); ++m)
    if (v_.mass[m](cell) > 0.0) lowest = std::max(lowest, setting_.fluids[m].lowest_pressure());
  return lowest;
}

// Of material `m`, alone in the source; momentum for all.
void GhostStates::waves(const GhostRule& rule, const WaveState& out, IntVec3 ghost, IntVec3 source,
                        std::size_t m) const {
  Fluid room, source_room;
  const Fluid& fluid = laws_.at(ghost, m, room);
  double rho = rule.fixed_density ? rule.density : out.rho;
  double p = rule.gives_pressure()
                 ? given_pressure(rule, ghost, source, rho)
                 : out.p + hydrostatic(source, ghost, rho, out.p - fluid.lowest_pressure());
  const double source_rho = v_.mass[m](source);
  const double T =
      rule.fixed_temperature
          ? rule.temperature
          : laws_.at(source, m, source_room).temperature(source_rho, v_.energy[m](source));
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
  const Vec3 given = given_velocity(rule, ghost, source, rho);
  const double distance = std::abs(ghost[d_] - source[d_]) * setting_.level->spacing[d_];
  const double source_rho = v_.density(source);
  for (std::size_t c = 0; c < v_.momentum.size(); ++c) {
    const int e = setting_.directions[c];
    const auto [t, sign] = in_face_frame(e);
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
void GhostStates::mixture_waves(const MixtureRule& rule, const WaveState& out, IntVec3 ghost,
                                IntVec3 source) {
  IntVec3 inner = source;
  if (setting_.level->domain.size()[d_] > 1) inner[d_] += plus_ ? -1 : 1;
  const int alone = alone_in(source);
  if (alone >= 0 && alone == alone_in(inner)) {
    waves(rule.parts[alone].rule, out, ghost, source, alone);
    return keep_slip(ghost, source);
  }
  const std::size_t count = v_.mass.size();
  const double p_source = mixture_pressure(source);
  const double p =
      rule.common.gives_pressure()
          ? given_pressure(rule.common, ghost, source, out.rho)
          : out.p + hydrostatic(source, ghost, out.rho, out.p - lowest_pressure(source));
  double filled = 0;
  Fluid room;
  for (std::size_t m = 0; m < count; ++m) {
    Part& part = parts_[m];
    part = {};
    const double M = v_.mass[m](source), V = v_.volume[m](source);
    if (M == 0.0) continue;
    const Fluid& fluid = laws_.at(source, m, room);
    const double rho = M / V, change = (p - p_source) / fluid.bulk_modulus(rho, p_source);
    part.rho = rho * (1.0 + std::clamp(change, -max_change_by_waves, max_change_by_waves));
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
        present ? part.V * laws_.at(ghost, m, room).energy_from_pressure(part.rho, p, part.T) : 0.0;
    if (present) rho += M;
  }
  wave_momentum(rule.common, out, ghost, source, rho);
  keep_slip(ghost, source);
}

}  // namespace sluice::ice
