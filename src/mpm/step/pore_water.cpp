// Water in pores, from particles to nodes: bounds, the filter of the pressure, sums.
#include "mpm/step/pore_water.hpp"

#include <algorithm>
#include <cmath>

#include "framework/base/reduction.hpp"
#include "mpm/nodes/node_sums.hpp"
#include "mpm/transfer/values_to_grid.hpp"

namespace sluice::mpm {
namespace {

const double* column(const BlockWork& w, int number) {
  return w.set->column(static_cast<std::size_t>(number));
}

// What a NaN may not hide: the bounds of a step that has gone wrong.
void raise(double& bound, double value) {
  if (!(value <= bound)) bound = value;
}

}  // namespace

PoreWater::PoreWater(const MpmScene& solids, const LevelNodes& nodes, std::vector<Body>& bodies,
                     const std::vector<BlockWork>& work)
    : solids_(&solids),
      nodes_(&nodes),
      bodies_(&bodies),
      work_(&work),
      bounds_(solids.materials.size()),
      units_(solids.materials.size()),
      water_(solids.materials.size()),
      scalars_(solids.materials.size()),
      scratch_(solids.materials.size()) {}

const double* PoreWater::acting(const BlockWork& w, const Columns& c) const {
  return solids_->filters_pore_pressure ? scratch(w.kind, w.box).filtered.data()
                                        : column(w, c.pore_pressure);
}

// rho_w V and n rho_w V g/k of a block, and the bounds of all that its particles give.
void PoreWater::look_at(const BlockWork& w, const Columns& c, Bounds& b) {
  const PoreWaterConstants& water = *solids_->materials[static_cast<std::size_t>(w.kind)].water;
  Scratch& s = scratch_[static_cast<std::size_t>(w.kind)][static_cast<std::size_t>(w.box)];
  const double *mass = column(w, c.mass), *of_water = column(w, c.water_mass),
               *V = column(w, c.volume), *V_0 = column(w, c.volume_0),
               *p = column(w, c.pore_pressure);
  const auto v = read_columns<3>(*w.set, c.water_velocity);
  for (std::size_t i = w.run.begin; i < w.run.end; ++i) {
    s.full[i] = water.density * V[i];
    s.drag[i] = porosity(water, V_0[i], V[i]) * s.full[i] * water.drag_of_velocity;
    raise(b.water, of_water[i]);
    raise(b.mass, mass[i]);
    raise(b.pressure, std::fabs(p[i]));
    raise(b.volume, V[i]);
    raise(b.drag, s.drag[i]);
    for (const double* component : v) raise(b.velocity, std::fabs(component[i]));
  }
}

void PoreWater::begin(const StageScope& scope) {
  std::vector<Body>& bodies = *bodies_;
  std::fill(bounds_.begin(), bounds_.end(), Bounds{});
  for (const BlockWork& w : *work_) {
    if (!in(w.kind)) continue;
    std::vector<Scratch>& boxes = scratch_[static_cast<std::size_t>(w.kind)];
    boxes.resize(std::max(boxes.size(), static_cast<std::size_t>(w.box) + 1));
    Scratch& s = boxes[static_cast<std::size_t>(w.box)];
    for (std::vector<double>* beside : {&s.filtered, &s.full, &s.drag, &s.zero})
      beside->resize(w.set->size());
  }
  const ThreadTeam& team = *nodes_->team;
  if (reads_.size() != static_cast<std::size_t>(team.size()))
    reads_.assign(static_cast<std::size_t>(team.size()), Reads(nodes_->shape));
  std::vector<std::vector<Bounds>> by_thread(static_cast<std::size_t>(team.size()), bounds_);
  team.for_each(work_->size(), [&](std::size_t n, int thread) {
    const BlockWork& w = (*work_)[n];
    const auto k = static_cast<std::size_t>(w.kind);
    if (in(w.kind))
      look_at(w, bodies[k].carried->columns, by_thread[static_cast<std::size_t>(thread)][k]);
  });
  constexpr double Bounds::*all[] = {&Bounds::water,    &Bounds::mass,   &Bounds::velocity,
                                     &Bounds::pressure, &Bounds::volume, &Bounds::drag};
  Reduction reduction;
  std::vector<Reduction::Maximum> slots;
  for (std::size_t k = 0; k < bounds_.size(); ++k)
    for (const auto bound : all) {
      for (const std::vector<Bounds>& of : by_thread) raise(bounds_[k].*bound, of[k].*bound);
      slots.push_back(reduction.add_maximum(bounds_[k].*bound));
    }
  scope.ranks->reduce(reduction);
  std::size_t slot = 0;
  for (std::size_t k = 0; k < bounds_.size(); ++k) {
    for (const auto bound : all) bounds_[k].*bound = reduction.maximum(slots[slot++]);
  }
}

// All ranks and images agree on the sums.
void PoreWater::share(int kind, NodeLanes& sums, bool vectors) const {
  Body& body = (*bodies_)[static_cast<std::size_t>(kind)];
  if (vectors)
    nodes_->boundary->fold(kind, body.table, sums);
  else
    nodes_->boundary->fold_scalars(kind, body.table, sums);
  NodeLanes* const groups[] = {&sums};
  nodes_->exchange->share(body.table, groups);
}

// act(work, body, window) for all blocks of particles with water; what it added to the
// window goes to `sums`.
template <class Act>
void PoreWater::sum(std::vector<NodeLanes>& sums, Act&& act) const {
  for (std::size_t k = 0; k < sums.size(); ++k) {
    sums[k].clear();
    if (in(static_cast<int>(k))) sums[k].fit((*bodies_)[k].table);
  }
  const ThreadTeam& team = *nodes_->team;
  std::vector<Window> windows(static_cast<std::size_t>(team.size()),
                              Window(bodies_->front().table.shape(), reach_of(solids_->basis)));
  team.for_each(work_->size(), [&](std::size_t n, int thread) {
    const BlockWork& w = (*work_)[n];
    if (!in(w.kind)) return;
    const auto k = static_cast<std::size_t>(w.kind);
    const Body& body = (*bodies_)[k];
    Window& window = windows[static_cast<std::size_t>(thread)];
    window.begin(w.lowest, w.highest);
    act(w, body, window);
    window.add_to(body.table, sums[k], team.size() > 1);
  });
}

// Lanes become p of the node.
static void to_pressures(const BlockTable& table, double mass_unit, double product_unit,
                         NodeLanes& sums) {
  for (int b = 0; b < table.count(); ++b) {
    std::int64_t* node = sums.sums(b);
    for (int n = 0; n < block_nodes; ++n, node += lanes) {
      const double mass = sum_in(node, 0) / mass_unit;
      const bool any = node[count_lane] != 0 && mass > 0;
      const double p = any ? sum_in(node, 1) / product_unit / mass : 0.0;
      std::fill_n(node, lanes, as_bits(0.0));
      node[0] = as_bits(p);
    }
  }
}

void PoreWater::add_nodes() {
  if (!solids_->filters_pore_pressure) return;
  std::vector<std::vector<std::vector<double>>> product(scratch_.size());  // m_s p
  for (std::size_t k = 0; k < product.size(); ++k)
    for (const Scratch& s : scratch_[k]) product[k].emplace_back(s.full.size());
  sum(scalars_, [&](const BlockWork& w, const Body& body, Window& window) {
    const auto k = static_cast<std::size_t>(w.kind);
    const Columns& c = body.carried->columns;
    const double *m = column(w, c.mass), *p = column(w, c.pore_pressure);
    std::vector<double>& mp = product[k][static_cast<std::size_t>(w.box)];
    for (std::size_t i = w.run.begin; i < w.run.end; ++i) mp[i] = m[i] * p[i];
    const ValueLane values[] = {{m, scale_for(bounds_[k].mass)},
                                {mp.data(), scale_for(bounds_[k].mass * bounds_[k].pressure)}};
    add_values_to_window(solids_->basis, body.grid, places_of(*w.set, c), shape_of(*w.set, c),
                         values, static_cast<int>(w.run.begin), static_cast<int>(w.run.end),
                         window);
  });
  for (std::size_t k = 0; k < scalars_.size(); ++k) {
    const int kind = static_cast<int>(k);
    if (!in(kind)) continue;
    share(kind, scalars_[k], false);
    const BlockTable& table = (*bodies_)[k].table;
    to_pressures(table, scale_for(bounds_[k].mass),
                 scale_for(bounds_[k].mass * bounds_[k].pressure), scalars_[k]);
    nodes_->boundary->unfold_scalars(kind, table, scalars_[k]);
  }
  nodes_->team->for_each(work_->size(), [&](std::size_t n, int thread) {
    const BlockWork& w = (*work_)[n];
    if (in(w.kind)) filter_at(w, reads_[static_cast<std::size_t>(thread)]);
  });
}

// p~ at the particles of a block.
void PoreWater::filter_at(const BlockWork& w, Reads& read) {
  const auto k = static_cast<std::size_t>(w.kind);
  const Body& body = (*bodies_)[k];
  const Columns& c = body.carried->columns;
  read.window.load(w.lowest, w.highest, body.table, scalars_[k]);
  double* to = scratch_[k][static_cast<std::size_t>(w.box)].filtered.data();
  for (std::size_t at = w.run.begin; at < w.run.end; at += chunk_size) {
    const int count = static_cast<int>(std::min<std::size_t>(chunk_size, w.run.end - at));
    read_window(solids_->basis, body.grid, places_of(*w.set, c), shape_of(*w.set, c),
                static_cast<int>(at), count, false, read.window, read.at);
    std::copy_n(read.at.u[0], count, to + at);
  }
}

void PoreWater::give(const BlockWork& w, ParticlesToGrid& columns) const {
  if (in(w.kind))
    columns.pore_pressure =
        acting(w, (*bodies_)[static_cast<std::size_t>(w.kind)].carried->columns);
}

// Lanes become M_w, v_w | F_w, 1 where there is water; else all zero.
static void to_reals(std::int64_t* node, const SumUnits& units) {
  const double mass = sum_in(node, 0) / units.mass;
  double real[lanes] = {};
  if (node[count_lane] != 0 && mass > 0) {
    real[0] = mass;
    for (int d = 0; d < 3; ++d) {
      real[1 + d] = sum_in(node, 1 + d) / units.momentum / mass;
      real[4 + d] = sum_in(node, 4 + d) / units.force;
    }
    real[count_lane] = 1;
  }
  for (int l = 0; l < lanes; ++l) node[l] = as_bits(real[l]);
}

// M_w, v_w | F_w of the water.
void PoreWater::give_water() {
  double slopes = 0;
  for (int d = 0; d < 3; ++d)
    if (nodes_->level.active[static_cast<std::size_t>(d)]) slopes += 1 / nodes_->level.spacing[d];
  for (std::size_t k = 0; k < units_.size(); ++k) {
    const Bounds& b = bounds_[k];
    units_[k] = {scale_for(b.water),
                 scale_for(b.water * b.velocity),
                 scale_for(b.volume * b.pressure * slopes),
                 {}};
  }
  sum(water_, [&](const BlockWork& w, const Body& body, Window& window) {
    const Columns& c = body.carried->columns;
    const double* zero = scratch(w.kind, w.box).zero.data();
    ParticlesToGrid p;
    p.x = places_of(*w.set, c);
    p.shape = shape_of(*w.set, c);
    p.v = read_columns<3>(*w.set, c.water_velocity);
    p.mass = column(w, c.water_mass);
    p.volume = column(w, c.volume);
    p.stress.fill(zero);
    p.pore_pressure = acting(w, c);
    add_to_window(solids_->basis, body.grid, p, static_cast<int>(w.run.begin),
                  static_cast<int>(w.run.end), units_[static_cast<std::size_t>(w.kind)], window);
  });
}

double PoreWater::unit_of_scalar(std::size_t k, bool drag) const {
  const PoreWaterConstants& water = *solids_->materials[k].water;
  return scale_for(drag ? bounds_[k].drag : water.density * bounds_[k].volume);
}

// M_f, D.
void PoreWater::give_scalars() {
  sum(scalars_, [&](const BlockWork& w, const Body& body, Window& window) {
    const auto k = static_cast<std::size_t>(w.kind);
    const Columns& c = body.carried->columns;
    const Scratch& s = scratch(w.kind, w.box);
    const ValueLane values[] = {{s.full.data(), unit_of_scalar(k, false)},
                                {s.drag.data(), unit_of_scalar(k, true)}};
    add_values_to_window(solids_->basis, body.grid, places_of(*w.set, c), shape_of(*w.set, c),
                         values, static_cast<int>(w.run.begin), static_cast<int>(w.run.end),
                         window);
  });
}

void PoreWater::before_nodes() {
  give_water();
  give_scalars();
  for (std::size_t k = 0; k < water_.size(); ++k) {
    const int kind = static_cast<int>(k);
    if (!in(kind)) continue;
    share(kind, water_[k], true);
    share(kind, scalars_[k], false);
    Body& body = (*bodies_)[k];
    for (NodeLanes* all : {&water_[k], &scalars_[k], &body.nodes}) all->fit(body.table);
    for (int b = 0; b < body.table.count(); ++b)
      for (int n = 0; n < block_nodes; ++n) {
        to_reals(water_[k].sums(b) + n * lanes, units_[k]);
        std::int64_t* node = scalars_[k].sums(b) + n * lanes;
        const double full = sum_in(node, 0) / unit_of_scalar(k, false),
                     drag = sum_in(node, 1) / unit_of_scalar(k, true);
        node[0] = as_bits(full);
        node[1] = as_bits(drag);
      }
  }
}

}  // namespace sluice::mpm
