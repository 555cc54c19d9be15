#include "mpm/step/heat.hpp"

#include <algorithm>
#include <cmath>

#include "framework/base/largest.hpp"
#include "framework/base/reduction.hpp"
#include "mpm/nodes/node_sums.hpp"
#include "mpm/step/solid_step.hpp"

namespace sluice::mpm {
namespace {

// Lanes of a node while heat moves; at the end the rate stands where the temperature was, among
// those that read_velocities() takes to particles.
constexpr int temperature_lane = 0, mass_lane = 3, first_lane = 5, met_lane = 6, rate_lane = 0;

// act(block, number of the node in it, its index, its lanes) for nodes with mass.
template <class Act>
void for_each_full_node(const Body& body, NodeLanes& nodes, Act&& act) {
  const BlockShape& shape = body.table.shape();
  for (int b = 0; b < body.table.count(); ++b) {
    for_each_node(shape, shape.lower(body.table.block(b)), [&](int n, IntVec3 at) {
      std::int64_t* node = nodes.sums(b) + n * lanes;
      if (node[count_lane] != 0) act(b, n, at, node);
    });
  }
}

bool on_side(const Level& level, Side side, IntVec3 node) {
  const int d = direction_of(side);
  if (!level.active[static_cast<std::size_t>(d)]) return false;
  return is_plus(side) ? node[d] >= level.domain.upper[d] : node[d] <= level.domain.lower[d];
}

}  // namespace

const Spreading heat_spreads = {&Columns::temperature,
                                &Columns::volume,
                                [](const SolidMaterial& m) {
                                  return m.constants.specific_heat > 0 ? m.constants.conductivity
                                                                       : 0.0;
                                },
                                [](const SolidMaterial& m) { return m.constants.specific_heat; },
                                SolidBoundary::Kind::temperature,
                                SolidBoundary::Kind::temperature_gradient,
                                true};
const Spreading concentration_spreads = {
    &Columns::concentration,
    &Columns::mass,
    [](const SolidMaterial& m) { return m.diffusion ? m.diffusion->diffusivity : 0.0; },
    [](const SolidMaterial& m) { return m.diffusion ? 1.0 : 0.0; },
    SolidBoundary::Kind::concentration,
    SolidBoundary::Kind::concentration_gradient,
    false};

bool Heat::possible(const MpmScene& solids, const Spreading& what) {
  if (what.heat ? !solids.heat_conduction : !solids.scalar_diffusion) return false;
  return std::any_of(solids.materials.begin(), solids.materials.end(), [&](const SolidMaterial& m) {
    const bool driven = what.heat && (solids.thermal_contact || solids.use_loads);
    return what.capacity(m) > 0 && (what.conductivity(m) > 0 || driven);
  });
}

Heat::Heat(const Scene& scene, const MpmScene& solids, const Level& level, const Spreading& what)
    : what_(&what),
      scene_(&scene),
      solids_(&solids),
      level_(level),
      nodes_(solids.materials.size()),
      flux_(solids.materials.size()),
      flux_units_(solids.materials.size()),
      scratch_(solids.materials.size()) {}

const double* Heat::rates(int kind, int box) const {
  if (!active_) return nullptr;
  return scratch_[static_cast<std::size_t>(kind)][static_cast<std::size_t>(box)].rate.data();
}

const double* Heat::sources(int kind, int box) const {
  if (!active_) return nullptr;
  return scratch_[static_cast<std::size_t>(kind)][static_cast<std::size_t>(box)].source.data();
}

// What the sides prescribe at a node: the last entry counts.
bool Heat::side_value(IntVec3 node, int material, double& value) const {
  bool any = false;
  for (const SolidBoundary& b : solids_->boundaries) {
    if (b.kind != what_->prescribed || (b.material >= 0 && b.material != material) ||
        !on_side(level_, b.side, node))
      continue;
    if (b.region > 0) {
      const Vec3 place = level_.anchor + to_real(node) * level_.spacing;
      const BoundarySide& side = scene_->boundary.side(b.side);
      if (!side.regions[static_cast<std::size_t>(b.region)].shape.contains(direction_of(b.side),
                                                                           place))
        continue;
    }
    value = b.value.x;
    any = true;
  }
  return any;
}

// Sources of loads alone, then all that conduction needs: 48 bytes a particle, where heat moves.
void Heat::make_room(const HeatLoan& loan, bool conducts) {
  for (const BlockWork& w : *loan.work) {
    if (w.run.begin != 0) continue;  // once a set
    std::vector<Scratch>& boxes = scratch_[static_cast<std::size_t>(w.kind)];
    if (boxes.size() <= static_cast<std::size_t>(w.box))
      boxes.resize(static_cast<std::size_t>(w.box) + 1);
    Scratch& s = boxes[static_cast<std::size_t>(w.box)];
    const std::size_t n = w.set->size();
    if (!conducts) {
      if (is_heated(loan, w)) s.source.assign(n, 0.0);
      continue;
    }
    if (!is_heated(loan, w)) s.source.assign(n, 0.0);
    for (std::vector<double>* column :
         {&s.rate, &s.gradient[0], &s.gradient[1], &s.gradient[2], &s.zero})
      column->assign(n, 0.0);
  }
}

bool Heat::is_heated(const HeatLoan& loan, const BlockWork& w) const {
  if (!what_->heat) return false;
  const Columns& c = (*loan.bodies)[static_cast<std::size_t>(w.kind)].carried->columns;
  return c.marks >= 0 && loan.outside->loads().heats(w.kind);
}

Heat::Ranges Heat::find_ranges(const HeatLoan& loan) {
  Ranges r;
  r.specific_weight.resize(nodes_.size());
  r.source.resize(nodes_.size());
  const double time = loan.scope->step.time;
  for (const BlockWork& w : *loan.work) {
    const Columns& c = (*loan.bodies)[static_cast<std::size_t>(w.kind)].carried->columns;
    const auto k = static_cast<std::size_t>(w.kind);
    const double* T = w.set->column(static_cast<std::size_t>(c.*what_->value));
    const double* m = w.set->column(static_cast<std::size_t>(c.mass));
    const double* V = w.set->column(static_cast<std::size_t>(c.*what_->weight));
    double* q = is_heated(loan, w) ? scratch(w.kind, w.box).source.data() : nullptr;
    if (q != nullptr)
      loan.outside->loads().add_heat(time, loan.outside->counts(),
                                     loan.outside->loaded(w.kind, *w.set, w.run.begin, w.run.end),
                                     q);
    Most high(r.high), low(-r.low), weight(r.specific_weight[k]);
    for_eights(w.run.begin, w.run.end, [&](auto p) {
      high.add(p(T));
      low.add(-p(T));
      weight.add(p(V) / p(m));
    });
    r.high = high.value();
    r.low = -low.value();
    r.specific_weight[k] = weight.value();
    for (std::size_t p = w.run.begin; p < w.run.end && q != nullptr; ++p)
      r.source[k] = std::max(r.source[k], std::fabs(q[p]));
  }
  Reduction all;
  const auto low = all.add_minimum(r.low);
  const auto high = all.add_maximum(r.high);
  std::vector<Reduction::Maximum> slots;
  for (const double v : r.specific_weight) slots.push_back(all.add_maximum(v));
  for (const double q : r.source) slots.push_back(all.add_maximum(q));
  loan.scope->ranks->reduce(all);
  r.low = all.minimum(low);
  r.high = all.maximum(high);
  for (std::size_t k = 0; k < nodes_.size(); ++k) {
    r.specific_weight[k] = all.maximum(slots[k]);
    r.source[k] = all.maximum(slots[nodes_.size() + k]);
    r.driven |= r.source[k] > 0;
  }
  for (const SolidBoundary& b : solids_->boundaries) {
    if (b.kind == what_->prescribed) {
      r.low = std::min(r.low, b.value.x);
      r.high = std::max(r.high, b.value.x);
    }
    r.driven |= b.kind == what_->gradient_of_sides;
  }
  return r;
}

// Masses and temperatures of all nodes; those at sides as these prescribe.
void Heat::to_nodes(const HeatLoan& loan, const Ranges& ranges) {
  reference_ = 0.5 * (ranges.low + ranges.high);
  const double spread = std::max(ranges.high - reference_, reference_ - ranges.low);
  const int reach = reach_of(solids_->basis);
  const ThreadTeam& team = *loan.scope->levels.front()->team();
  std::vector<SumUnits> units(nodes_.size());
  for (std::size_t k = 0; k < nodes_.size(); ++k) {
    const Body& body = (*loan.bodies)[k];
    units[k].mass = scale_for(body.rates.mass);
    units[k].momentum = scale_for(body.rates.mass * spread);
    units[k].reference = {reference_, 0, 0};
    nodes_[k].clear();
    nodes_[k].fit(body.table);
  }
  std::vector<Window> windows(static_cast<std::size_t>(team.size()),
                              Window(loan.bodies->front().table.shape(), reach));
  team.for_each(loan.work->size(), [&](std::size_t n, int thread) {
    const BlockWork& w = (*loan.work)[n];
    const auto k = static_cast<std::size_t>(w.kind);
    Body& body = (*loan.bodies)[k];
    const Columns& c = body.carried->columns;
    const double* zero = scratch(w.kind, w.box).zero.data();
    ParticlesToGrid p;
    p.x = places_of(*w.set, body.carried->columns);
    p.shape = shape_of(*w.set, body.carried->columns);
    p.v = {w.set->column(static_cast<std::size_t>(c.*what_->value)), zero, zero};
    p.mass = w.set->column(static_cast<std::size_t>(c.mass));
    Window& window = windows[static_cast<std::size_t>(thread)];
    window.begin(w.lowest, w.highest);
    add_to_window(solids_->basis, body.grid, p, static_cast<int>(w.run.begin),
                  static_cast<int>(w.run.end), units[k], window);
    window.add_to(body.table, nodes_[k], team.size() > 1);
  });
  for (std::size_t k = 0; k < nodes_.size(); ++k) {
    Body& body = (*loan.bodies)[k];
    loan.boundary->fold_scalars(static_cast<int>(k), body.table, nodes_[k]);
    NodeLanes* const groups[] = {&nodes_[k]};
    loan.exchange->share(body.table, groups);
    body.nodes.fit(body.table);
    for_each_full_node(body, nodes_[k], [&](int, int, IntVec3, std::int64_t* node) {
      const double mass = sum_in(node, 0) / units[k].mass;
      const double T = mass > 0 ? sum_in(node, 1) / units[k].momentum / mass : 0.0;
      for (int l = 0; l < lanes; ++l) node[l] = 0;
      if (!(mass > 0)) return;
      node[temperature_lane] = node[first_lane] = as_bits(T);
      node[mass_lane] = as_bits(mass);
      node[count_lane] = 1;
    });
  }
}

// Temperatures of sides; where a side has a gradient g, its nodes take that of the node inside less
// g h.
void Heat::set_sides(const HeatLoan& loan) {
  for (std::size_t k = 0; k < nodes_.size(); ++k) {
    const Body& body = (*loan.bodies)[k];
    for_each_full_node(body, nodes_[k], [&](int, int, IntVec3 at, std::int64_t* node) {
      for (const SolidBoundary& b : solids_->boundaries)
        if (b.kind == what_->gradient_of_sides && on_side(level_, b.side, at) &&
            (b.material < 0 || b.material == static_cast<int>(k)))
          node[temperature_lane] = as_bits(inner_temperature(body, at, b));
      double value = 0;
      if (side_value(at, static_cast<int>(k), value))
        node[temperature_lane] = as_bits(value - reference_);
    });
    loan.boundary->unfold_scalars(static_cast<int>(k), body.table, nodes_[k]);
  }
}

double Heat::inner_temperature(const Body& body, IntVec3 at, const SolidBoundary& b) const {
  const NodeLanes& nodes =
      nodes_[static_cast<std::size_t>(body.material - solids_->materials.data())];
  const int d = direction_of(b.side);
  const BlockShape& shape = body.table.shape();
  const auto lane_of = [&](IntVec3 node, bool& there) {
    const int block = body.table.find(shape.block_of(node));
    there = block >= 0;
    if (!there) return 0.0;
    const std::int64_t* of = nodes.sums(block) + shape.place(node) * lanes;
    there = of[count_lane] != 0;
    return as_real(of[temperature_lane]);
  };
  IntVec3 inner = at;
  inner[d] = is_plus(b.side) ? level_.domain.upper[d] - 1 : level_.domain.lower[d] + 1;
  bool there = false;
  const double T = lane_of(inner, there);
  if (!there) return lane_of(at, there);
  return T - b.value.x * level_.spacing[d];
}

std::vector<double> Heat::find_gradients(const HeatLoan& loan) {
  const int reach = reach_of(solids_->basis);
  const ThreadTeam& team = *loan.scope->levels.front()->team();
  const auto threads = static_cast<std::size_t>(team.size());
  std::vector<Window> windows(threads, Window(loan.bodies->front().table.shape(), reach));
  std::vector<GridAtParticles> reads(threads);
  std::vector<std::vector<double>> most(threads, std::vector<double>(nodes_.size()));
  team.for_each(loan.work->size(), [&](std::size_t n, int thread) {
    const BlockWork& w = (*loan.work)[n];
    const auto k = static_cast<std::size_t>(w.kind), t = static_cast<std::size_t>(thread);
    const Body& body = (*loan.bodies)[k];
    const double conductivity = what_->conductivity(*body.material);
    if (!(conductivity > 0)) return;
    const double* V = w.set->column(static_cast<std::size_t>(body.carried->columns.*what_->weight));
    Scratch& s = scratch(w.kind, w.box);
    windows[t].load(w.lowest, w.highest, body.table, nodes_[k]);
    const std::array<const double*, 3> x = places_of(*w.set, body.carried->columns);
    const ParticleShape shape = shape_of(*w.set, body.carried->columns);
    for (std::size_t at = w.run.begin; at < w.run.end; at += chunk_size) {
      const int count = static_cast<int>(std::min<std::size_t>(chunk_size, w.run.end - at));
      read_velocities(solids_->basis, body.grid, x, shape, static_cast<int>(at), count, windows[t],
                      reads[t]);
      Most largest(most[t][k]);
      for (int d = 0; d < 3; ++d)
        for_eights(0, static_cast<std::size_t>(count), [&](auto q) {
          const auto flux = conductivity * q(reads[t].L[d]);
          q.put(flux, s.gradient[d].data() + at);
          largest.add(magnitude(q(V + at) * flux));
        });
      most[t][k] = largest.value();
    }
  });
  Reduction all;
  std::vector<Reduction::Maximum> slots;
  for (std::size_t k = 0; k < nodes_.size(); ++k) {
    for (const std::vector<double>& of : most) most[0][k] = std::max(most[0][k], of[k]);
    slots.push_back(all.add_maximum(most[0][k]));
  }
  loan.scope->ranks->reduce(all);
  for (std::size_t k = 0; k < nodes_.size(); ++k) most[0][k] = all.maximum(slots[k]);
  return most[0];
}

void Heat::find_fluxes(const HeatLoan& loan, const Ranges& ranges,
                       const std::vector<double>& bound) {
  const int reach = reach_of(solids_->basis);
  const ThreadTeam& team = *loan.scope->levels.front()->team();
  double slopes = 0;
  for (int d = 0; d < 3; ++d)
    if (level_.active[static_cast<std::size_t>(d)]) slopes += 1 / level_.spacing[d];
  for (std::size_t k = 0; k < nodes_.size(); ++k) {
    flux_units_[k].force = scale_for(bound[k] * slopes + ranges.source[k]);
    flux_[k].clear();
    flux_[k].fit((*loan.bodies)[k].table);
  }
  std::vector<Window> windows(static_cast<std::size_t>(team.size()),
                              Window(loan.bodies->front().table.shape(), reach));
  team.for_each(loan.work->size(), [&](std::size_t n, int thread) {
    const BlockWork& w = (*loan.work)[n];
    const auto k = static_cast<std::size_t>(w.kind);
    Body& body = (*loan.bodies)[k];
    const Scratch& s = scratch(w.kind, w.box);
    const double* zero = s.zero.data();
    ParticlesToGrid p;
    p.x = places_of(*w.set, body.carried->columns);
    p.shape = shape_of(*w.set, body.carried->columns);
    p.v = {zero, zero, zero};
    p.mass = zero;
    p.volume = w.set->column(static_cast<std::size_t>(body.carried->columns.*what_->weight));
    p.stress = {s.gradient[0].data(), zero, zero, zero, s.gradient[2].data(), s.gradient[1].data()};
    p.load = {s.source.data(), zero, zero};
    Window& window = windows[static_cast<std::size_t>(thread)];
    window.begin(w.lowest, w.highest);
    add_to_window(solids_->basis, body.grid, p, static_cast<int>(w.run.begin),
                  static_cast<int>(w.run.end), flux_units_[k], window);
    window.add_to(body.table, flux_[k], team.size() > 1);
  });
  for (std::size_t k = 0; k < nodes_.size(); ++k) {
    Body& body = (*loan.bodies)[k];
    loan.boundary->fold_scalars(static_cast<int>(k), body.table, flux_[k]);
    NodeLanes* const groups[] = {&flux_[k]};
    loan.exchange->share(body.table, groups);
    nodes_[k].fit(body.table);
    body.nodes.fit(body.table);
  }
}

// T <- T + dt Q/(c M).
void Heat::take_part(const HeatLoan& loan, double dt) {
  for (std::size_t k = 0; k < nodes_.size(); ++k) {
    const Body& body = (*loan.bodies)[k];
    const double c = what_->capacity(*body.material);
    if (!(c > 0)) continue;
    for_each_full_node(body, nodes_[k], [&](int b, int n, IntVec3, std::int64_t* node) {
      const double Q = sum_in(flux_[k].sums(b) + n * lanes, 4) / flux_units_[k].force;
      node[temperature_lane] =
          as_bits(as_real(node[temperature_lane]) + dt * Q / (c * as_real(node[mass_lane])));
    });
  }
}

// All materials at a node take the mean temperature, by their capacities.
void Heat::meet(const HeatLoan& loan) {
  std::vector<Body>& bodies = *loan.bodies;
  for (std::size_t k = 0; k < nodes_.size(); ++k)
    for_each_full_node(bodies[k], nodes_[k], [&](int, int, IntVec3 at, std::int64_t* node) {
      double capacity = 0, heat = 0;
      for (std::size_t o = 0; o < nodes_.size(); ++o) {
        const BlockShape& shape = bodies[o].table.shape();
        const int block = bodies[o].table.find(shape.block_of(at));
        if (block < 0) continue;
        const std::int64_t* of = nodes_[o].sums(block) + shape.place(at) * lanes;
        if (of[count_lane] == 0) continue;
        const double own = as_real(of[mass_lane]) * bodies[o].material->constants.specific_heat;
        capacity += own;
        heat += own * as_real(of[temperature_lane]);
      }
      node[met_lane] = capacity > 0 ? as_bits(heat / capacity) : node[temperature_lane];
    });
  for (std::size_t k = 0; k < nodes_.size(); ++k)
    for_each_full_node(bodies[k], nodes_[k], [&](int, int, IntVec3, std::int64_t* node) {
      node[temperature_lane] = node[met_lane];
    });
}

void Heat::to_particles(const HeatLoan& loan, double dt) {
  for (std::size_t k = 0; k < nodes_.size(); ++k)
    for_each_full_node((*loan.bodies)[k], nodes_[k], [&](int, int, IntVec3, std::int64_t* node) {
      node[rate_lane] = as_bits((as_real(node[temperature_lane]) - as_real(node[first_lane])) / dt);
      node[first_lane] = node[met_lane] = as_bits(0.0);
    });
  const int reach = reach_of(solids_->basis);
  const ThreadTeam& team = *loan.scope->levels.front()->team();
  const auto threads = static_cast<std::size_t>(team.size());
  std::vector<Window> windows(threads, Window(loan.bodies->front().table.shape(), reach));
  std::vector<GridAtParticles> reads(threads);
  team.for_each(loan.work->size(), [&](std::size_t n, int thread) {
    const BlockWork& w = (*loan.work)[n];
    const auto k = static_cast<std::size_t>(w.kind), t = static_cast<std::size_t>(thread);
    const Body& body = (*loan.bodies)[k];
    windows[t].load(w.lowest, w.highest, body.table, nodes_[k]);
    const std::array<const double*, 3> x = places_of(*w.set, body.carried->columns);
    const ParticleShape shape = shape_of(*w.set, body.carried->columns);
    double* rate = scratch(w.kind, w.box).rate.data();
    for (std::size_t at = w.run.begin; at < w.run.end; at += chunk_size) {
      const int count = static_cast<int>(std::min<std::size_t>(chunk_size, w.run.end - at));
      read_velocities(solids_->basis, body.grid, x, shape, static_cast<int>(at), count, windows[t],
                      reads[t]);
      std::copy_n(reads[t].u[0], count, rate + at);
    }
  });
}

void Heat::conduct(const HeatLoan& loan) {
  make_room(loan, false);
  const Ranges ranges = find_ranges(loan);
  active_ = ranges.driven || ranges.high > ranges.low;
  if (!active_) return;
  make_room(loan, true);
  to_nodes(loan, ranges);
  set_sides(loan);
  double rate = 0;  // of explicit conduction, 1/s
  for (std::size_t k = 0; k < nodes_.size(); ++k) {
    const SolidMaterial& m = solids_->materials[k];
    if (!(what_->conductivity(m) > 0)) continue;
    double slopes = 0;
    for (int d = 0; d < 3; ++d)
      if (level_.active[static_cast<std::size_t>(d)])
        slopes += 2 / (level_.spacing[d] * level_.spacing[d]);
    rate = std::max(
        rate, what_->conductivity(m) / what_->capacity(m) * ranges.specific_weight[k] * slopes);
  }
  const double dt = loan.scope->step.dt;
  const int parts = static_cast<int>(std::min(1e4, std::max(1.0, std::ceil(dt * rate))));
  for (int part = 0; part < parts; ++part) {
    find_fluxes(loan, ranges, find_gradients(loan));
    take_part(loan, dt / parts);
    if (what_->heat && solids_->thermal_contact) meet(loan);
    set_sides(loan);
  }
  to_particles(loan, dt);
}

}  // namespace sluice::mpm
