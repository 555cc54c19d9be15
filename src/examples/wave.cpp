// The wave equation in cells; the equations are in the header.
#include "examples/wave.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "framework/deck/faults.hpp"
#include "framework/grid/nodes.hpp"
#include "framework/refine/face_table.hpp"
#include "framework/scene/deck_values.hpp"

namespace sluice::examples {
namespace {

constexpr int stages = 4;
// Oscillations exp(i w t) stay bounded while w dt is at most this; the fastest one of the grid has
// w = 2 sqrt(sum over d of 1 / dx_d^2).
constexpr double stable_runge_kutta = 2.8;  // 2 sqrt(2), rounded down
constexpr double stable_euler = 2.0;

Label stage_label(const char* field, const char* unit, int stage) {
  return declare_label(
      {fmt::format("{}{}", field, stage + 1), ValueType::real, Centring::cell, unit,
       fmt::format("{} of state {} of a Runge-Kutta step (wave)", field, stage + 1)});
}

// phi and pi of a state as a task reads them: two variables, or two components of one.
struct Fields {
  In phi, pi;
  int pi_component = 0;

  const double* phi_row(const Row& row, int axis = 0, int shift = 0) const {
    return row(phi, 0, axis, shift);
  }
  const double* pi_row(const Row& row) const { return row(pi, pi_component); }
};

// out += share * Laplacian of phi.
void add_laplacian(const Row& row, const Fields& y, const Axes& axes, double share, double* out) {
  const double* here = y.phi_row(row);
  for (int a = 0; a < axes.count; ++a) {
    const double dx = row.step().spacing[axes.direction[a]];
    const double factor = share / (dx * dx);
    const double *below = y.phi_row(row, a, -1), *above = y.phi_row(row, a, 1);
#pragma GCC ivdep
    for (int i = 0; i < row.count(); ++i)
      out[i] += factor * ((below[i] - here[i]) - (here[i] - above[i]));
  }
}

// The states of a step as variables: the old one has a variable for each field, the others have
// their fields as components.
struct Variables {
  VariableId old_phi, old_pi, new_phi, new_pi;
  VariableId stage[stages];  // from 1 on
  MaximumGroup rates;        // of the step
};

Fields read_state(TaskBuilder& task, const Variables& v, int stage, Stencil of_phi) {
  if (stage == 0) return {task.read(v.old_phi, of_phi), task.read(v.old_pi)};
  const In both = task.read(v.stage[stage], of_phi);
  return {both, both, 1};
}

// y(stage) = y + share dt f(y(stage - 1)).
void add_stage(TaskList& list, int effect, const Variables& v, const Axes& axes, int stage,
               double share) {
  TaskBuilder task = list.task(fmt::format("state {}", stage + 1), effect);
  const Fields old = read_state(task, v, 0, Stencil::point());
  const Fields from = read_state(task, v, stage - 1, Stencil::box(1));
  const Out to = task.write(v.stage[stage]);
  task.kernel([=](const Row& row) {
    const double dt = share * row.step().dt;
    double *phi = row(to, 0), *pi = row(to, 1);
    const double *old_phi = old.phi_row(row), *speed = from.pi_row(row);
#pragma GCC ivdep
    for (int i = 0; i < row.count(); ++i) phi[i] = old_phi[i] + dt * speed[i];
    std::copy_n(old.pi_row(row), row.count(), pi);
    add_laplacian(row, from, axes, dt, pi);
  });
}

// y' = (-y + y2 + 2 y3 + y4) / 3 + dt/6 f(y4).
void add_last_stage(TaskList& list, int effect, const Variables& v, const Axes& axes, double rate) {
  TaskBuilder task = list.task("step", effect);
  const Fields y1 = read_state(task, v, 0, Stencil::point());
  const Fields y2 = read_state(task, v, 1, Stencil::point());
  const Fields y3 = read_state(task, v, 2, Stencil::point());
  const Fields y4 = read_state(task, v, 3, Stencil::box(1));
  const Out phi = task.write(v.new_phi), pi = task.write(v.new_pi);
  task.kernel([=](const Row& row) {
    const auto blend = [&](double* to, const double* a, const double* b, const double* c,
                           const double* d) {
#pragma GCC ivdep
      for (int i = 0; i < row.count(); ++i) to[i] = ((b[i] - a[i]) + 2 * c[i] + d[i]) * (1.0 / 3.0);
    };
    blend(row(phi), y1.phi_row(row), y2.phi_row(row), y3.phi_row(row), y4.phi_row(row));
    blend(row(pi), y1.pi_row(row), y2.pi_row(row), y3.pi_row(row), y4.pi_row(row));
    const double sixth = row.step().dt / 6;
    double* to = row(phi);
    const double* speed = y4.pi_row(row);
#pragma GCC ivdep
    for (int i = 0; i < row.count(); ++i) to[i] += sixth * speed[i];
    add_laplacian(row, y4, axes, sixth, row(pi));
    row.reductions().maximum(v.rates, ordered_bits(rate));
  });
}

// phi' = phi + dt pi; pi' = pi + dt Laplacian(phi').
void add_euler(TaskList& list, int effect, const Variables& v, const Axes& axes, double rate) {
  TaskBuilder first = list.task("phi", effect);
  const Fields old = read_state(first, v, 0, Stencil::point());
  const Out moved = first.write(v.stage[1]);
  first.kernel([=](const Row& row) {
    double* phi = row(moved);
    const double *from = old.phi_row(row), *speed = old.pi_row(row);
#pragma GCC ivdep
    for (int i = 0; i < row.count(); ++i) phi[i] = from[i] + row.step().dt * speed[i];
  });
  TaskBuilder second = list.task("pi", effect);
  const In phi = second.read(v.stage[1], Stencil::box(1)), pi = second.read(v.old_pi);
  const Out new_phi = second.write(v.new_phi), new_pi = second.write(v.new_pi);
  second.kernel([=](const Row& row) {
    std::copy_n(row(phi), row.count(), row(new_phi));
    std::copy_n(row(pi), row.count(), row(new_pi));
    add_laplacian(row, {phi, phi}, axes, row.step().dt, row(new_pi));
    row.reductions().maximum(v.rates, ordered_bits(rate));
  });
}

// What a deck may save of the states within a step: a task each, as only those wanted are stored.
void add_stage_outputs(TaskList& list, int effect, const WaveLabels& labels, const Variables& v) {
  for (int stage = 0; stage < stages; ++stage) {
    const auto save = [&](Label label, auto row_of) {
      TaskBuilder task = list.task("save " + label.name(), effect);
      const Fields y = read_state(task, v, stage, Stencil::point());
      const Out to = task.write(list.output(label, 0));
      task.kernel([=](const Row& row) { std::copy_n(row_of(y, row), row.count(), row(to)); });
    };
    save(labels.phi_stage[stage], [](const Fields& y, const Row& row) { return y.phi_row(row); });
    save(labels.pi_stage[stage], [](const Fields& y, const Row& row) { return y.pi_row(row); });
  }
}

// The cell inside that a cell beyond a mirror stands for: reflected until it is in the domain.
int mirrored(int i, int lower, int upper) {
  const int n = upper - lower;
  const int around = (((i - lower) % (2 * n)) + 2 * n) % (2 * n);
  return lower + (around < n ? around : 2 * n - 1 - around);
}

}  // namespace

WaveLabels claim_wave_labels() {
  WaveLabels l;
  l.phi = claim_label(
      {"phi", ValueType::real, Centring::cell, "1", "solution of the wave equation (wave)"});
  l.pi =
      claim_label({"pi", ValueType::real, Centring::cell, "1/s", "rate of change of phi (wave)"});
  for (std::size_t n = 0; n < stages; ++n) {
    l.phi_stage[n] = stage_label("phi", "1", static_cast<int>(n));
    l.pi_stage[n] = stage_label("pi", "1/s", static_cast<int>(n));
  }
  return l;
}

Wave::Wave(const Scene& scene, const WaveScene& settings)
    : PlainComponent(scene, "wave", "wave equation"), settings_(settings) {}

// States 2 to 4 and the step itself each read one cell further.
std::vector<SlotInfo> Wave::slots() const {
  const int ghosts = settings_.runge_kutta ? stages : 1;
  return {{labels_.phi, 0, 1, ghosts}, {labels_.pi, 0, 1, ghosts}};
}

void Wave::initialise(Warehouse& state) const {
  const double r = settings_.radius;
  for (int b = 0; b < static_cast<int>(state.local_boxes().size()); ++b) {
    const RealView phi = state.view(0, 0, b), pi = state.view(1, 0, b);
    for_each_cell(state.local_boxes()[b].cells, [&](IntVec3 c) {
      Vec3 x = state.level().centre(c);
      double square = 0;
      for (int d = 0; d < 3; ++d)
        if (state.level().active[d]) square += x[d] * x[d];
      phi(c) = std::exp(-square / (r * r)) / (r * r * r);
      pi(c) = 0;
    });
  }
}

void Wave::fill_boundary(Warehouse& state, double /*time*/, std::span<const double> /*sums*/,
                         const ThreadTeam& /*team*/) const {
  const IndexBox& domain = state.level().domain;
  for (int b = 0; b < static_cast<int>(state.local_boxes().size()); ++b)
    for (const Side side : all_sides) {
      if (!ends_at(state.level(), side)) continue;
      const int d = direction_of(side);
      for (int slot = 0; slot < 2; ++slot) {
        const RealView v = state.view(slot, 0, b);
        IndexBox outside = v.box;
        (is_plus(side) ? outside.lower : outside.upper)[d] =
            is_plus(side) ? std::max(domain.upper[d], v.box.lower[d])
                          : std::min(domain.lower[d], v.box.upper[d]);
        for_each_cell(outside, [&](IntVec3 c) {
          IntVec3 source = c;
          source[d] = mirrored(c[d], domain.lower[d], domain.upper[d]);
          v(c) = v(source);
        });
      }
    }
}

double Wave::step_of(const Vec3& spacing) const {
  const Level& coarsest = level(0);
  double smallest = 0, sum = 0;
  for (int d = 0; d < 3; ++d) {
    if (!coarsest.active[d]) continue;
    smallest = smallest > 0 ? std::min(smallest, spacing[d]) : spacing[d];
    sum += 1 / (spacing[d] * spacing[d]);
  }
  const double stable = settings_.runge_kutta ? stable_runge_kutta : stable_euler;
  return std::min(smallest, stable / (2 * std::sqrt(sum)) / scene().time.timestep_multiplier);
}

void Wave::declare(TaskList& list, const StepVariant& variant) const {
  const Level& grid = level(variant.level);
  const Axes axes = active_axes(grid);
  const double rate = 1 / step_of(grid.spacing);
  Variables v;
  v.rates = rate_;
  v.old_phi = list.old_state(labels_.phi, 0, 1);
  v.old_pi = list.old_state(labels_.pi, 0, 1);
  v.new_phi = list.new_state(labels_.phi, 0, 1);
  v.new_pi = list.new_state(labels_.pi, 0, 1);
  if (!settings_.runge_kutta) {
    v.stage[1] = list.temporary("phi moved");
    add_euler(list, equation, v, axes, rate);
    return;
  }
  for (int s = 1; s < stages; ++s) v.stage[s] = list.temporary(fmt::format("state {}", s + 1), 2);
  add_stage(list, equation, v, axes, 1, 0.5);
  add_stage(list, equation, v, axes, 2, 0.5);
  add_stage(list, equation, v, axes, 3, 1.0);
  add_last_stage(list, equation, v, axes, rate);
  add_stage_outputs(list, saved, labels_, v);
}

// Where the central difference of phi, not divided by the spacing, exceeds the deck's threshold.
void Wave::declare_diagnostics(TaskList& list, int l) const {
  PlainComponent::declare_diagnostics(list, l);
  const Axes axes = active_axes(level(l));
  const double threshold = settings_.refine_threshold;
  TaskBuilder task = list.task("refinement", saved);
  const In phi = task.read(list.old_state(labels_.phi, 0, 1), Stencil::box(1));
  const Out flag = task.write(list.output(refine_flag(), 0));
  task.kernel([=](const Row& row) {
    double* to = row(flag);
    std::fill_n(to, row.count(), 0.0);
    if (threshold <= 0) return;
    for (int a = 0; a < axes.count; ++a) {
      const double *below = row(phi, 0, a, -1), *above = row(phi, 0, a, 1);
      for (int i = 0; i < row.count(); ++i)
        to[i] += 0.25 * (above[i] - below[i]) * (above[i] - below[i]);
    }
    for (int i = 0; i < row.count(); ++i) to[i] = to[i] > threshold * threshold ? 1.0 : 0.0;
  });
}

void Wave::measure_rates(const Warehouse& state, Reductions& rates) const {
  rates.maximum(rate_, ordered_bits(1 / step_of(state.level().spacing)));
}

StepLimit Wave::limit(const std::vector<double>& maxima) const {
  return {1 / rate_.of(maxima).front(), "smallest spacing, or the longest stable step"};
}

void add_wave_tags(Schema& schema) {
  schema.add(
      tag("Wave", "the wave equation in cells")
          .with_children(
              {tag("radius", "radius of the initial bump")
                   .real()
                   .above(0)
                   .unit("length")
                   .by_default("0.05"),
               tag("initial_condition", "Chombo: a bump at the origin, at rest")
                   .words({"Chombo"})
                   .by_default("Chombo"),
               tag("integration", "method in time").words({"Euler", "RK4"}).by_default("Euler"),
               tag("refine_threshold",
                   "cells are refined where phi changes by more from one to the next; 0: none")
                   .real()
                   .at_least(0)
                   .by_default("0")}));
}

std::unique_ptr<Component> make_wave(const Deck& deck, const Scene& scene,
                                     std::vector<Fault>& faults) {
  const DeckNode* block = need_block(deck, scene, "Wave", faults);
  for (const BoundarySide& side : scene.boundary.sides)
    for (const BoundaryRegion& region : side.regions)
      for (const Condition& c : region.conditions)
        if (!c.zero_gradient() && c.kind != ConditionKind::symmetry)
          add_error(faults, c.where, "all sides of the component wave are symmetry planes",
                    "remove this condition");
  if (any_error(faults)) return nullptr;
  WaveScene settings;
  settings.radius = block->real("radius");
  settings.runge_kutta = block->string("integration") == "RK4";
  settings.refine_threshold = block->real("refine_threshold");
  return std::make_unique<Wave>(scene, settings);
}

}  // namespace sluice::examples
