#include "mpm/step/heat.hpp"

#include <algorithm>
#include <cmath>

#include "framework/base/largest.hpp"
#include "framework/base/reduction.hpp"
#include "mpm/step/heat_lanes.hpp"

namespace sluice::mpm {
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

Heat::Heat(const Scene& scene, const MpmScene& solids, const LevelNodes& nodes,
           std::vector<Body>& bodies, const std::vector<BlockWork>& work,
           const OutsideForces& outside, const Spreading& what)
    : what_(&what),
      scene_(&scene),
      space_(&nodes),
      bodies_(&bodies),
      work_(&work),
      outside_(&outside),
      solids_(&solids),
      nodes_(solids.materials.size()),
      flux_(solids.materials.size()),
      scratch_(solids.materials.size()) {}

// Sources of loads alone, then all that conduction needs: 48 bytes a particle, where heat moves.
void Heat::make_room(bool conducts) {
  for (const BlockWork& w : *work_) {
    if (w.run.begin != 0) continue;  // once a set
    std::vector<Scratch>& boxes = scratch_[static_cast<std::size_t>(w.kind)];
    if (boxes.size() <= static_cast<std::size_t>(w.box))
      boxes.resize(static_cast<std::size_t>(w.box) + 1);
    Scratch& s = boxes[static_cast<std::size_t>(w.box)];
    const std::size_t n = w.set->size();
    if (!conducts) {
      if (is_heated(w)) s.source.assign(n, 0.0);
      continue;
    }
    if (!is_heated(w)) s.source.assign(n, 0.0);
    for (std::vector<double>* column :
         {&s.rate, &s.gradient[0], &s.gradient[1], &s.gradient[2], &s.zero})
      column->assign(n, 0.0);
  }
}

bool Heat::is_heated(const BlockWork& w) const {
  if (!what_->heat) return false;
  const Columns& c = (*bodies_)[static_cast<std::size_t>(w.kind)].carried->columns;
  return c.marks >= 0 && outside_->loads().heats(w.kind);
}

// Heat of loads into the particles of a block, and what bounds the sums of it.
void Heat::find_loads(const BlockWork& w, double time, Ranges& r) {
  const Columns& c = (*bodies_)[static_cast<std::size_t>(w.kind)].carried->columns;
  const auto k = static_cast<std::size_t>(w.kind);
  const double* T = w.set->column(static_cast<std::size_t>(c.*what_->value));
  const double* m = w.set->column(static_cast<std::size_t>(c.mass));
  const double* V = w.set->column(static_cast<std::size_t>(c.*what_->weight));
  double* q = is_heated(w) ? scratch(w.kind, w.box).source.data() : nullptr;
  if (q != nullptr)
    outside_->loads().add_heat(time, outside_->counts(),
                               outside_->loaded(w.kind, *w.set, w.run.begin, w.run.end), q);
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

void Heat::share_ranges(Communicator& ranks, Ranges& r) const {
  Reduction all;
  const auto low = all.add_minimum(r.low);
  const auto high = all.add_maximum(r.high);
  std::vector<Reduction::Maximum> slots;
  for (const double v : r.specific_weight) slots.push_back(all.add_maximum(v));
  for (const double q : r.source) slots.push_back(all.add_maximum(q));
  ranks.reduce(all);
  r.low = all.minimum(low);
  r.high = all.maximum(high);
  for (std::size_t k = 0; k < nodes_.size(); ++k) {
    r.specific_weight[k] = all.maximum(slots[k]);
    r.source[k] = all.maximum(slots[nodes_.size() + k]);
    r.driven |= r.source[k] > 0;
  }
}

Heat::Ranges Heat::find_ranges(const StageScope& scope) {
  Ranges r;
  r.specific_weight.resize(nodes_.size());
  r.source.resize(nodes_.size());
  for (const BlockWork& w : *work_) find_loads(w, scope.step.time, r);
  share_ranges(*scope.ranks, r);
  for (const SolidBoundary& b : solids_->boundaries) {
    if (b.kind == what_->prescribed) {
      r.low = std::min(r.low, b.value.x);
      r.high = std::max(r.high, b.value.x);
    }
    r.driven |= b.kind == what_->gradient_of_sides;
  }
  return r;
}

std::vector<double> Heat::find_gradients(const StageScope& scope) {
  const int reach = reach_of(solids_->basis);
  const ThreadTeam& team = *space_->team;
  const auto threads = static_cast<std::size_t>(team.size());
  std::vector<Window> windows(threads, Window(bodies_->front().table.shape(), reach));
  std::vector<GridAtParticles> reads(threads);
  std::vector<std::vector<double>> most(threads, std::vector<double>(nodes_.size()));
  team.for_each(work_->size(), [&](std::size_t n, int thread) {
    const BlockWork& w = (*work_)[n];
    const auto k = static_cast<std::size_t>(w.kind), t = static_cast<std::size_t>(thread);
    const Body& body = (*bodies_)[k];
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
  scope.ranks->reduce(all);
  for (std::size_t k = 0; k < nodes_.size(); ++k) most[0][k] = all.maximum(slots[k]);
  return most[0];
}

void Heat::find_rates(double dt) {
  for (std::size_t k = 0; k < nodes_.size(); ++k)
    for_each_full_node((*bodies_)[k], nodes_[k], [&](int, int, IntVec3, std::int64_t* node) {
      node[rate_lane] = as_bits((as_real(node[temperature_lane]) - as_real(node[first_lane])) / dt);
      node[first_lane] = node[met_lane] = as_bits(0.0);
    });
  const int reach = reach_of(solids_->basis);
  const ThreadTeam& team = *space_->team;
  const auto threads = static_cast<std::size_t>(team.size());
  std::vector<Window> windows(threads, Window(bodies_->front().table.shape(), reach));
  std::vector<GridAtParticles> reads(threads);
  team.for_each(work_->size(), [&](std::size_t n, int thread) {
    const BlockWork& w = (*work_)[n];
    const auto k = static_cast<std::size_t>(w.kind), t = static_cast<std::size_t>(thread);
    const Body& body = (*bodies_)[k];
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

// Of explicit conduction, 1/s.
double Heat::rate_of_conduction(const Ranges& ranges) const {
  double rate = 0;
  for (std::size_t k = 0; k < nodes_.size(); ++k) {
    const SolidMaterial& m = solids_->materials[k];
    if (!(what_->conductivity(m) > 0)) continue;
    double slopes = 0;
    for (int d = 0; d < 3; ++d)
      if (space_->level.active[static_cast<std::size_t>(d)])
        slopes += 2 / (space_->level.spacing[d] * space_->level.spacing[d]);
    rate = std::max(
        rate, what_->conductivity(m) / what_->capacity(m) * ranges.specific_weight[k] * slopes);
  }
  return rate;
}

void Heat::before_particles(const StageScope& scope, NodeBooks& /*books*/) {
  make_room(false);
  const Ranges ranges = find_ranges(scope);
  active_ = ranges.driven || ranges.high > ranges.low;
  if (!active_) return;
  make_room(true);
  to_nodes(ranges);
  set_sides();
  const double dt = scope.step.dt, rate = rate_of_conduction(ranges);
  const int parts = static_cast<int>(std::min(1e4, std::max(1.0, std::ceil(dt * rate))));
  for (int part = 0; part < parts; ++part) {
    find_fluxes(ranges, find_gradients(scope));
    take_part(dt / parts);
    if (what_->heat && solids_->thermal_contact) meet();
    set_sides();
  }
  find_rates(dt);
}

void Heat::moved(const Chunk& chunk) {
  const int column = chunk.columns().heat_source;
  if (!what_->heat || column < 0) return;
  double* to = chunk.made(column);
  const double* q = active_ ? scratch(chunk.kind(), chunk.work->box).source.data() : nullptr;
  for (int n = 0; n < chunk.n; ++n)
    to[n] = q != nullptr ? q[chunk.at + static_cast<std::size_t>(n)] : 0;
}

void Heat::to_particles(const Chunk& chunk) {
  if (!active_) return;
  const double* rate = scratch(chunk.kind(), chunk.work->box).rate.data() + chunk.at;
  const double dt = chunk.dt();
  double* T = chunk.made(chunk.columns().*what_->value);
  if (what_->heat) {
    for (int q = 0; q < chunk.n; ++q) T[q] += dt * rate[q];
    return;
  }
  if (!chunk.body->material->diffusion) return;
  const Diffusion& bounds = *chunk.body->material->diffusion;
  const double* before = chunk.old(chunk.columns().*what_->value);
  for (int q = 0; q < chunk.n; ++q)
    T[q] = std::clamp(before[q] + dt * rate[q], bounds.least, bounds.most);
}

}  // namespace sluice::mpm
