// Ghost states of one gas and of mixtures.
#include "ice/boundary/ghost_states.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "ice/boundary/waves.hpp"

namespace sluice::ice {

GhostStates::GhostStates(const BoundarySetting& setting, const BoundaryViews& views, int direction,
                         bool plus, const Moment& moment)
    : setting_(setting),
      v_(views),
      laws_{setting.fluids, setting.mixed, views.composition},
      d_(direction),
      plus_(plus),
      moment_(moment) {
  if (views.mass.size() > 1) parts_.resize(views.mass.size());
}

double GhostStates::half_weight() const {
  return (plus_ ? 0.5 : -0.5) * setting_.gravity[d_] * setting_.level->spacing[d_];
}

// Hydrostatic difference of pressure from the source cell out to the ghost cell: the sum of
// g dx (rho + rho)/2 over the steps between them. Ghost densities closer in are filled already.
// A column that weighs more than it is pressed leaves a tenth of `room`, the pressure above the
// lowest one of the law: a ghost without a sound speed would spoil the flux of the wall.
double GhostStates::hydrostatic(IntVec3 source, IntVec3 ghost, double rho_ghost,
                                double room) const {
  const double half = half_weight();
  if (half == 0) return 0;
  double change = 0;
  IntVec3 c = source;
  while (c[d_] != ghost[d_]) {
    IntVec3 next = c;
    next[d_] += plus_ ? 1 : -1;
    const double rho_next = next[d_] == ghost[d_] ? rho_ghost : v_.density(next);
    change += half * (v_.density(c) + rho_next);
    c = next;
  }
  return std::max(change, -0.9 * std::max(0.0, room));
}

void GhostStates::plain(const GhostRule& rule, IntVec3 ghost, IntVec3 source) const {
  for (const auto* views : {&v_.mass, &v_.energy, &v_.volume})
    for (const RealView& v : *views) v(ghost) = v(source);
  const bool mirrored = rule.velocity_kind == GhostRule::Velocity::mirror;
  for (const auto* vectors : {&v_.momentum, &v_.slip})
    for (std::size_t c = 0; c < vectors->size(); ++c) {
      const bool turned = mirrored && setting_.directions[c % v_.momentum.size()] == d_;
      const double value = (*vectors)[c](source);
      (*vectors)[c](ghost) = turned ? -value : value;
    }
}

GhostPlace GhostStates::place(const PrescribedFlow& flow, IntVec3 ghost, IntVec3 source) const {
  const Level& level = *setting_.level;
  GhostPlace at;
  at.centre = level.centre(ghost);
  for (int e = 0; e < 3; ++e) {
    at.height[e] = (ghost[e] - level.domain.lower[e] + 0.5) * level.spacing[e];
    at.domain_size[e] = level.domain.size()[e] * level.spacing[e];
  }
  at.time = moment_.time;
  at.viscosity = setting_.viscosity;
  if (flow.nature() == PrescribedFlow::Nature::wave) {
    const WaveState s = wave_state(source);
    const double inward = sound_speed(source, s) - s.u[0];
    const double off = (std::abs(ghost[d_] - source[d_]) - 0.5) * level.spacing[d_];
    at.arrival = inward > 0 ? off / inward : 0.0;
  }
  return at;
}

double GhostStates::given_pressure(const GhostRule& rule, IntVec3 ghost, IntVec3 source,
                                   double rho) const {
  if (rule.pressure_flow == nullptr) return rule.pressure;
  return rule.pressure_flow->pressure(place(*rule.pressure_flow, ghost, source), rho);
}

Vec3 GhostStates::given_velocity(const GhostRule& rule, IntVec3 ghost, IntVec3 source,
                                 double rho) const {
  if (rule.velocity_kind == GhostRule::Velocity::slip)
    return setting_.viscous ? gliding_velocity(rule, ghost) : rule.velocity;
  if (rule.velocity_kind != GhostRule::Velocity::flow) return rule.velocity;
  return rule.velocity_flow->velocity(place(*rule.velocity_flow, ghost, source), rule.velocity,
                                      rho);
}

double GhostStates::velocity(const GhostRule& rule, Vec3 given, double u, int direction,
                             double distance) const {
  switch (rule.velocity_kind) {
    case GhostRule::Velocity::copy:
      return u - rule.velocity_gradient[direction] * distance;
    case GhostRule::Velocity::mirror:
      return direction == d_ ? -u : u;
    case GhostRule::Velocity::wall:
    case GhostRule::Velocity::slip:
      if (direction == d_) return -u;
      return setting_.viscous ? 2.0 * given[direction] - u : u;
    case GhostRule::Velocity::prescribed:
    case GhostRule::Velocity::flow:
      return given[direction];
  }
  return u;
}

// What enters slower than sound has the density and the temperature that are given, whatever
// pressure is given beside them: that comes from inside.
bool GhostStates::enters_by_temperature(const GhostRule& rule, const Fluid& fluid, double rho,
                                        Vec3 given) const {
  if (!rule.fixed_pressure || !rule.fixed_density || !rule.fixed_temperature) return false;
  if (!rule.holds_velocity()) return false;
  const double inward = plus_ ? -given[d_] : given[d_];
  return inward < fluid.sound_speed(rho, rule.pressure);
}

void GhostStates::gas(const GhostRule& rule, IntVec3 ghost, IntVec3 source) const {
  Fluid room, source_room;
  const Fluid& fluid = laws_.at(ghost, 0, room);
  const Fluid& source_fluid = laws_.at(source, 0, source_room);
  const RealView &mass = v_.mass.front(), &energy = v_.energy.front();
  const double distance = std::abs(ghost[d_] - source[d_]) * setting_.level->spacing[d_];
  const double source_rho = mass(source), source_E = energy(source);
  double rho = rule.fixed_density ? rule.density : source_rho - rule.density_gradient * distance;
  const double p_source = source_fluid.pressure(source_rho, source_E);
  const bool given_T = rule.fixed_temperature || rule.temperature_gradient != 0;
  const double T = rule.fixed_temperature ? rule.temperature
                                          : source_fluid.temperature(source_rho, source_E) -
                                                rule.temperature_gradient * distance;
  Vec3 given = given_velocity(rule, ghost, source, rho);
  double p;
  if (enters_by_temperature(rule, fluid, rho, given)) {
    p = fluid.pressure(rho, fluid.energy_from_temperature(rho, T));
  } else if (rule.gives_pressure()) {
    p = given_pressure(rule, ghost, source, rho);
  } else if (rule.fixed_density && given_T) {
    p = fluid.pressure(rho, fluid.energy_from_temperature(rho, T));
  } else {
    p = p_source - rule.pressure_gradient * distance;
    if (given_T && !rule.fixed_density) rho = fluid.density(p, T);
    p += hydrostatic(source, ghost, rho, p - fluid.lowest_pressure());
  }
  if (given_T && !rule.fixed_density) rho = fluid.density(p, T);
  // A flow that depends on the density has that of the ghost.
  if (rule.velocity_kind == GhostRule::Velocity::flow)
    given = given_velocity(rule, ghost, source, rho);
  mass(ghost) = rho;
  energy(ghost) = fluid.energy_from_pressure(rho, p, T);
  for (std::size_t c = 0; c < v_.momentum.size(); ++c)
    v_.momentum[c](ghost) = rho * velocity(rule, given, v_.momentum[c](source) / source_rho,
                                           setting_.directions[c], distance);
}

double GhostStates::mixture_pressure(IntVec3 source) const {
  double work = 0, volume = 0;
  Fluid room;
  for (std::size_t m = 0; m < v_.mass.size(); ++m) {
    const double M = v_.mass[m](source), V = v_.volume[m](source);
    if (M == 0.0) continue;
    const double p = laws_.at(source, m, room).pressure(M / V, v_.energy[m](source) / V);
    if (V == 1.0) return p;
    work += V * p;
    volume += V;
  }
  return work / volume;
}

// What the ghost has of the cell that it looks at, before pressure and temperatures act on it.
void GhostStates::commit(const MixtureRule& rule, IntVec3 ghost, IntVec3 source, double distance) {
  Fluid room;
  for (std::size_t m = 0; m < parts_.size(); ++m) {
    const MixtureRule::Part& r = rule.parts[m];
    const double M = v_.mass[m](source), V = v_.volume[m](source);
    Part& part = parts_[m];
    part = {};
    part.law = &laws_.at(ghost, m, law_in_ghost_);
    part.given_T = r.rule.fixed_temperature || r.rule.temperature_gradient != 0;
    if (M > 0.0) {
      part.V = part.V_source = V;
      part.rho = (M - r.rule.density_gradient * distance) / V;
      part.T = laws_.at(source, m, room).temperature(M / V, v_.energy[m](source) / V) -
               r.rule.temperature_gradient * distance;
    }
    if (r.rule.fixed_temperature) part.T = r.rule.temperature;
  }
}

// Sets true densities and shares at a pressure so that the cell is full; its density.
double GhostStates::fill_cell(const MixtureRule& rule, double p) {
  double given = 0, taken = 0;
  for (std::size_t m = 0; m < parts_.size(); ++m) {
    const MixtureRule::Part& r = rule.parts[m];
    Part& part = parts_[m];
    const bool fixed = r.rule.fixed_density;
    if (r.absent) {
      part.V = 0;
    } else if (fixed && r.volume > 0) {
      part.V = r.volume;
      part.rho = r.rule.density / r.volume;
    } else if (fixed) {
      if (r.rule.specific_volume > 0)
        part.rho = 1.0 / r.rule.specific_volume;
      else if (part.T > 0)
        part.rho = part.law->density(p, part.T);
      part.V = part.rho > 0 ? r.rule.density / part.rho : 0.0;
    } else if (part.V > 0 && part.given_T) {
      part.rho = part.law->density(p, part.T);
    }
    (fixed ? given : taken) += part.V;
  }
  // Nothing that is given or may be taken over: what the source has.
  if (given + taken == 0)
    for (Part& part : parts_) taken += part.V = part.V_source;
  // Those taken over leave room for those given.
  const double room = 1.0 - given;
  const double of_taken = taken > 0 && room > 0 ? room / taken : 0.0;
  const double of_given = of_taken > 0 || given == 0 ? 1.0 : 1.0 / given;
  double rho = 0;
  for (std::size_t m = 0; m < parts_.size(); ++m) {
    Part& part = parts_[m];
    const double factor = rule.parts[m].rule.fixed_density && given > 0 ? of_given : of_taken;
    // A cell that is full to round-off stays as it is.
    if (factor != 1.0) part.V = part.V == taken + given ? 1.0 : part.V * factor;
    rho += part.V * part.rho;
  }
  return rho;
}

void GhostStates::mixture(const MixtureRule& rule, IntVec3 ghost, IntVec3 source) {
  const double distance = std::abs(ghost[d_] - source[d_]) * setting_.level->spacing[d_];
  commit(rule, ghost, source, distance);
  double p = given_pressure(rule.common, ghost, source, 0);
  double rho = 0;
  if (!rule.common.gives_pressure()) {
    p = mixture_pressure(source) - rule.common.pressure_gradient * distance;
    rho = fill_cell(rule, p);
    p += hydrostatic(source, ghost, rho, p - lowest_pressure(source));
  }
  rho = fill_cell(rule, p);
  bool slides = rule.common.mirrored();  // one velocity: one viscous material sticks for all
  for (std::size_t m = 0; m < parts_.size(); ++m) {
    const Part& part = parts_[m];
    const bool present = part.V > 0;
    slides = slides && !(present && setting_.rubs[m]);
    v_.volume[m](ghost) = present ? part.V : 0.0;
    v_.mass[m](ghost) = present ? part.V * part.rho : 0.0;
    v_.energy[m](ghost) =
        present ? part.V * part.law->energy_from_pressure(part.rho, p, part.T) : 0.0;
  }
  set_velocities(rule, ghost, source, distance, slides);
}

// Each material has its own rule, and its own velocity in the source where the scene says so.
void GhostStates::set_velocities(const MixtureRule& rule, IntVec3 ghost, IntVec3 source,
                                 double distance, bool slides) {
  const std::size_t components = v_.momentum.size();
  const double source_rho = v_.density(source), rho = v_.density(ghost);
  for (std::size_t c = 0; c < components; ++c) {
    const double common = v_.momentum[c](source) / source_rho;
    const int direction = setting_.directions[c];
    double momentum = 0;
    for (std::size_t m = 0; m < parts_.size(); ++m) {
      Part& part = parts_[m];
      if (!(part.V > 0)) continue;
      const GhostRule& of_part = rule.parts[m].rule;
      const double M = v_.mass[m](source);
      const double u =
          v_.slip.empty() || M == 0.0 ? common : common + v_.slip[m * components + c](source) / M;
      part.u = !slides           ? velocity(of_part, given_velocity(of_part, ghost, source, rho), u,
                                            direction, distance)
               : direction == d_ ? -u
                                 : u;
      momentum += part.V * part.rho * part.u;
    }
    v_.momentum[c](ghost) = momentum;
    for (std::size_t m = 0; m < parts_.size() && !v_.slip.empty(); ++m) {
      const double M = v_.mass[m](ghost);
      v_.slip[m * components + c](ghost) =
          M > 0 && M != rho ? M * (parts_[m].u - momentum / rho) : 0.0;
    }
  }
}

// What moves against the mixture in the source does so in the ghost.
void GhostStates::keep_slip(IntVec3 ghost, IntVec3 source) const {
  const std::size_t components = v_.momentum.size();
  if (v_.slip.empty()) return;
  const double rho = v_.density(ghost);
  for (std::size_t c = 0; c < components; ++c) {
    double sum = 0;
    for (std::size_t m = 0; m < v_.mass.size(); ++m) {
      const double M = v_.mass[m](source), kept = v_.mass[m](ghost);
      RealView slip = v_.slip[m * components + c];
      slip(ghost) = M > 0 && kept > 0 ? slip(source) / M * kept : 0.0;
      sum += slip(ghost);
    }
    for (std::size_t m = 0; m < v_.mass.size(); ++m)
      v_.slip[m * components + c](ghost) -= v_.mass[m](ghost) / rho * sum;
  }
}

}  // namespace sluice::ice
