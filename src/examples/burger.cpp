// The equation of Burgers by MUSCL-Hancock on nodes; the steps are numbered as in the header.
#include "examples/burger.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "framework/deck/faults.hpp"
#include "framework/grid/nodes.hpp"
#include "framework/refine/face_table.hpp"
#include "framework/scene/deck_values.hpp"

namespace sluice::examples {
namespace {

constexpr double largest_courant = 0.5;  // share of a cell that a step may cross

// Van Leer's: smooth, and 0 where the differences have different signs.
double limited(double below, double above) {
  const double product = below * above;
  return product > 0 ? 2 * product / (below + above) : 0.0;
}

double godunov(double low, double high) {
  const double a = std::max(low, 0.0), b = std::min(high, 0.0);
  return 0.5 * std::max(a * a, b * b);
}

// What the tasks of a step hand to each other.
struct Variables {
  VariableId old_u, new_u;
  VariableId slope, half;  // slope: a component for each axis
  VariableId flux[3];      // by axis
  MaximumGroup rates;      // of the step
};

// 1 and 2.
void add_half_step(TaskList& list, int effect, const Variables& v, const Axes& axes) {
  TaskBuilder task = list.task("slopes and half a step", effect);
  const In u = task.read(v.old_u, Stencil::box(1));
  const Out slope = task.write(v.slope), half = task.write(v.half);
  task.kernel([=](const Row& row) {
    const double* here = row(u);
    double* h = row(half);
    const int n = row.count();
    std::copy_n(here, n, h);
    for (int a = 0; a < axes.count; ++a) {
      const double *below = row(u, 0, a, -1), *above = row(u, 0, a, 1);
      const double share = 0.5 * row.step().dt / row.step().spacing[axes.direction[a]];
      double* s = row(slope, a);
      for (int i = 0; i < n; ++i) {
        s[i] = limited(here[i] - below[i], above[i] - here[i]);
        h[i] -= share * here[i] * s[i];
      }
    }
  });
}

// 3.
void add_flux(TaskList& list, int effect, const Variables& v, const Axes& axes, int a) {
  TaskBuilder task = list.task(std::string("flux ") + "xyz"[axes.direction[a]], effect);
  const Stencil below = Stencil::along(axes.direction[a], 1, 0);
  const In half = task.read(v.half, below), slope = task.read(v.slope, below);
  const Out flux = task.write(v.flux[a]);
  task.kernel([=](const Row& row) {
    const double *h = row(half), *h_low = row(half, 0, a, -1);
    const double *s = row(slope, a), *s_low = row(slope, a, a, -1);
    double* f = row(flux);
    for (int i = 0; i < row.count(); ++i)
      f[i] = godunov(h_low[i] + 0.5 * s_low[i], h[i] - 0.5 * s[i]);
  });
}

// 4.
void add_update(TaskList& list, int effect, const Variables& v, const Axes& axes) {
  TaskBuilder task = list.task("step", effect);
  const In u = task.read(v.old_u);
  In flux[3];
  for (int a = 0; a < axes.count; ++a)
    flux[a] = task.read(v.flux[a], Stencil::along(axes.direction[a], 0, 1));
  const Out next = task.write(v.new_u);
  task.kernel([=](const Row& row) {
    double* to = row(next);
    std::copy_n(row(u), row.count(), to);
    double slowness = 0;  // sum over d of 1 / dx_d
    for (int a = 0; a < axes.count; ++a) {
      const double per_length = 1 / row.step().spacing[axes.direction[a]];
      const double share = row.step().dt * per_length;
      const double *low = row(flux[a]), *high = row(flux[a], 0, a, 1);
#pragma GCC ivdep
      for (int i = 0; i < row.count(); ++i) to[i] -= share * (high[i] - low[i]);
      slowness += per_length;
    }
    double fastest = 0;
    for (int i = 0; i < row.count(); ++i) fastest = std::max(fastest, std::abs(to[i]));
    row.reductions().maximum(v.rates, ordered_bits(fastest * slowness));
  });
}

}  // namespace

Label Burger::label() {
  static const Label u = declare_label(
      {"u", ValueType::real, Centring::node, "1", "solution of Burgers' equation (burger)"});
  return u;
}

double Burger::start(const Vec3& x) {
  constexpr double pi = std::numbers::pi;
  return std::sin(pi * x.x) + std::sin(2 * pi * x.y) + std::sin(3 * pi * x.z);
}

Burger::Burger(const Scene& scene, double dt)
    : PlainComponent(scene, "burger", "Burgers' equation"), dt_(dt) {
  label();
}

// A step reads two nodes away: fluxes at both sides of a node, from slopes on either side of them.
std::vector<SlotInfo> Burger::slots() const {
  return {{label(), 0, 1, 2}};
}

void Burger::initialise(Warehouse& state) const {
  for (int b = 0; b < static_cast<int>(state.local_boxes().size()); ++b) {
    const RealView u = state.view(0, 0, b);
    for_each_cell(state.local_boxes()[b].cells,
                  [&](IntVec3 i) { u(i) = start(node_position(state.level(), i)); });
  }
}

// Nodes on a side, and those beyond it, copy the inner nodes: a direction after the other, so that
// edges copy the nodes diagonally inside.
void Burger::fill_boundary(Warehouse& state, double /*time*/, std::span<const double> /*sums*/,
                           const ThreadTeam& /*team*/) const {
  const Level& grid = state.level();
  const IndexBox inner = inner_nodes(grid);
  for (int b = 0; b < static_cast<int>(state.local_boxes().size()); ++b) {
    const RealView u = state.view(0, 0, b);
    for (const Side side : all_sides) {
      if (!ends_at(grid, side)) continue;
      const int d = direction_of(side);
      const int from = is_plus(side) ? inner.upper[d] - 1 : inner.lower[d];
      IndexBox outside = u.box;
      (is_plus(side) ? outside.lower : outside.upper)[d] = is_plus(side) ? from + 1 : from;
      for_each_cell(intersection(outside, u.box), [&](IntVec3 i) {
        IntVec3 source = i;
        source[d] = from;
        u(i) = u(source);
      });
    }
  }
}

void Burger::declare(TaskList& list, const StepVariant& variant) const {
  const Axes axes = active_axes(level(variant.level));
  Variables v;
  v.rates = rate_;
  v.old_u = list.old_state(label(), 0, 1);
  v.new_u = list.new_state(label(), 0, 1);
  v.slope = list.temporary("slope", axes.count);
  v.half = list.temporary("u after half a step");
  for (int a = 0; a < axes.count; ++a)
    v.flux[a] = list.temporary(std::string("flux ") + "xyz"[axes.direction[a]]);
  add_half_step(list, equation, v, axes);
  for (int a = 0; a < axes.count; ++a) add_flux(list, equation, v, axes, a);
  add_update(list, equation, v, axes);
}

void Burger::measure_rates(const Warehouse& state, Reductions& rates) const {
  const Level& grid = state.level();
  double slowness = 0;
  for (std::size_t d = 0; d < 3; ++d)
    if (grid.active[d]) slowness += 1 / grid.spacing[static_cast<int>(d)];
  for (int b = 0; b < static_cast<int>(state.local_boxes().size()); ++b) {
    const RealView u = state.view(0, 0, b);
    double fastest = 0;
    for_each_cell(state.local_boxes()[b].cells,
                  [&](IntVec3 i) { fastest = std::max(fastest, std::abs(u(i))); });
    rates.maximum(rate_, ordered_bits(fastest * slowness));
  }
}

StepLimit Burger::limit(const std::vector<double>& maxima) const {
  const double stable = largest_courant / rate_.of(maxima).front();
  if (stable < dt_) return {stable, "scheme: 1/2 / sum |u|/dx"};
  return {dt_, "deck: delt"};
}

void add_burger_tags(Schema& schema) {
  schema.add(tag("Burger", "Burgers' equation without friction, on nodes")
                 .child(tag("delt", "longest step").once().real().above(0).unit("time")));
}

std::unique_ptr<Component> make_burger(const Deck& deck, const Scene& scene,
                                       std::vector<Fault>& faults) {
  const DeckNode* block = need_block(deck, scene, "Burger", faults);
  need_one_level(scene, faults);
  for (const BoundarySide& side : scene.boundary.sides)
    for (const BoundaryRegion& region : side.regions)
      for (const Condition& c : region.conditions)
        add_warning(faults, c.where,
                    "this condition has no effect: sides of burger copy their "
                    "inner nodes",
                    "remove it");
  const Level& grid = scene.grid.levels.front();
  for (int d = 0; d < 3; ++d)
    if (ends_at(grid, side_of(d, false)) && grid.domain.size()[d] < 2)
      add_error(faults, scene.grid_settings.where,
                fmt::format("burger needs two cells or more along {}", "xyz"[d]));
  if (any_error(faults)) return nullptr;
  return std::make_unique<Burger>(scene, block->real("delt"));
}

}  // namespace sluice::examples
