// Heat between nodes: temperatures from particles, of sides, of bodies that touch, and fluxes.
#include <algorithm>
#include <cmath>

#include "mpm/step/heat.hpp"
#include "mpm/step/heat_lanes.hpp"

namespace sluice::mpm {
namespace {

bool on_side(const Level& level, Side side, IntVec3 node) {
  const int d = direction_of(side);
  if (!level.active[static_cast<std::size_t>(d)]) return false;
  return is_plus(side) ? node[d] >= level.domain.upper[d] : node[d] <= level.domain.lower[d];
}

}  // namespace

// What the sides prescribe at a node: the last entry counts.
bool Heat::side_value(IntVec3 node, int material, double& value) const {
  bool any = false;
  for (const SolidBoundary& b : solids_->boundaries) {
    if (b.kind != what_->prescribed || (b.material >= 0 && b.material != material) ||
        !on_side(space_->level, b.side, node))
      continue;
    if (b.region > 0) {
      const Vec3 place = space_->level.anchor + to_real(node) * space_->level.spacing;
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

// Masses and temperatures of all nodes; those at sides as these prescribe.
void Heat::to_nodes(const Ranges& ranges) {
  reference_ = 0.5 * (ranges.low + ranges.high);
  const double spread = std::max(ranges.high - reference_, reference_ - ranges.low);
  const int reach = reach_of(solids_->basis);
  std::vector<SumUnits> units(nodes_.size());
  for (std::size_t k = 0; k < nodes_.size(); ++k) {
    const Body& body = (*bodies_)[k];
    units[k].mass = scale_for(body.rates.mass);
    units[k].momentum = scale_for(body.rates.mass * spread);
    units[k].reference = {reference_, 0, 0};
    nodes_[k].clear();
    nodes_[k].fit(body.table);
  }
  const ThreadTeam& team = *space_->team;
  std::vector<Window> windows(static_cast<std::size_t>(team.size()),
                              Window(bodies_->front().table.shape(), reach));
  team.for_each(work_->size(), [&](std::size_t n, int thread) {
    const BlockWork& w = (*work_)[n];
    const auto k = static_cast<std::size_t>(w.kind);
    Body& body = (*bodies_)[k];
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
  for (std::size_t k = 0; k < nodes_.size(); ++k) agree(k, units[k]);
}

// All images and ranks agree on the sums of a body; these become temperatures.
void Heat::agree(std::size_t k, const SumUnits& units) {
  Body& body = (*bodies_)[k];
  space_->boundary->fold_scalars(static_cast<int>(k), body.table, nodes_[k]);
  NodeLanes* const groups[] = {&nodes_[k]};
  space_->exchange->share(body.table, groups);
  body.nodes.fit(body.table);
  for_each_full_node(body, nodes_[k], [&](int, int, IntVec3, std::int64_t* node) {
    const double mass = sum_in(node, 0) / units.mass;
    const double T = mass > 0 ? sum_in(node, 1) / units.momentum / mass : 0.0;
    for (int l = 0; l < lanes; ++l) node[l] = 0;
    if (!(mass > 0)) return;
    node[temperature_lane] = node[first_lane] = as_bits(T);
    node[mass_lane] = as_bits(mass);
    node[count_lane] = 1;
  });
}

// Temperatures of sides; where a side has a gradient g, its nodes take that of the node inside less
// g h.
void Heat::set_sides() {
  for (std::size_t k = 0; k < nodes_.size(); ++k) {
    const Body& body = (*bodies_)[k];
    for_each_full_node(body, nodes_[k], [&](int, int, IntVec3 at, std::int64_t* node) {
      for (const SolidBoundary& b : solids_->boundaries)
        if (b.kind == what_->gradient_of_sides && on_side(space_->level, b.side, at) &&
            (b.material < 0 || b.material == static_cast<int>(k)))
          node[temperature_lane] = as_bits(inner_temperature(body, at, b));
      double value = 0;
      if (side_value(at, static_cast<int>(k), value))
        node[temperature_lane] = as_bits(value - reference_);
    });
    space_->boundary->unfold_scalars(static_cast<int>(k), body.table, nodes_[k]);
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
  inner[d] =
      is_plus(b.side) ? space_->level.domain.upper[d] - 1 : space_->level.domain.lower[d] + 1;
  bool there = false;
  const double T = lane_of(inner, there);
  if (!there) return lane_of(at, there);
  return T - b.value.x * space_->level.spacing[d];
}

void Heat::find_fluxes(const Ranges& ranges, const std::vector<double>& bound) {
  const int reach = reach_of(solids_->basis);
  double slopes = 0;
  for (int d = 0; d < 3; ++d)
    if (space_->level.active[static_cast<std::size_t>(d)]) slopes += 1 / space_->level.spacing[d];
  for (std::size_t k = 0; k < nodes_.size(); ++k) {
    flux_[k].units.force = scale_for(bound[k] * slopes + ranges.source[k]);
    flux_[k].nodes.clear();
    flux_[k].nodes.fit((*bodies_)[k].table);
  }
  const ThreadTeam& team = *space_->team;
  std::vector<Window> windows(static_cast<std::size_t>(team.size()),
                              Window(bodies_->front().table.shape(), reach));
  team.for_each(work_->size(), [&](std::size_t n, int thread) {
    const BlockWork& w = (*work_)[n];
    const auto k = static_cast<std::size_t>(w.kind);
    Body& body = (*bodies_)[k];
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
                  static_cast<int>(w.run.end), flux_[k].units, window);
    window.add_to(body.table, flux_[k].nodes, team.size() > 1);
  });
  for (std::size_t k = 0; k < nodes_.size(); ++k) {
    Body& body = (*bodies_)[k];
    space_->boundary->fold_scalars(static_cast<int>(k), body.table, flux_[k].nodes);
    NodeLanes* const groups[] = {&flux_[k].nodes};
    space_->exchange->share(body.table, groups);
    nodes_[k].fit(body.table);
    body.nodes.fit(body.table);
  }
}

// T <- T + dt Q/(c M).
void Heat::take_part(double dt) {
  for (std::size_t k = 0; k < nodes_.size(); ++k) {
    const Body& body = (*bodies_)[k];
    const double c = what_->capacity(*body.material);
    if (!(c > 0)) continue;
    for_each_full_node(body, nodes_[k], [&](int b, int n, IntVec3, std::int64_t* node) {
      const double Q = sum_in(flux_[k].nodes.sums(b) + n * lanes, 4) / flux_[k].units.force;
      node[temperature_lane] =
          as_bits(as_real(node[temperature_lane]) + dt * Q / (c * as_real(node[mass_lane])));
    });
  }
}

// All materials at a node take the mean temperature, by their capacities.
void Heat::meet() {
  std::vector<Body>& bodies = *bodies_;
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

}  // namespace sluice::mpm
