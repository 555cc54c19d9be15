#include "ice/scalars/reactions.hpp"

#include <cmath>
#include <memory>
#include <vector>

#include "framework/base/error.hpp"
#include "framework/base/lending_pool.hpp"
#include "ice/scalars/release_rows.hpp"
#include "ice/step/effect_ids.hpp"
#include "kinetics/reactor.hpp"

namespace sluice::ice::scalars {
namespace {

using Reactors = LendingPool<kinetics::Reactor>;

std::shared_ptr<Reactors> make_reactors(const models::Combustion& model) {
  const kinetics::Tolerances tolerances{model.relative_tolerance, model.temperature_tolerance,
                                        model.fraction_tolerance};
  return std::make_shared<Reactors>([gas = model.gas, tolerances] {
    return std::make_unique<kinetics::Reactor>(*gas, tolerances);
  });
}

struct Handles {
  ReleaseHandles release;
  std::vector<In> before;  // fractions after their transport
  std::vector<Out> now;
  Out last_step;
};

// Whether there is anything to integrate: the checks that follow find other states.
bool is_state(double rho, double E, const double* Y, std::size_t count) {
  double sum = rho + E;
  for (std::size_t k = 0; k < count; ++k) sum += Y[k];
  return rho > 0 && E > 0 && std::isfinite(sum);
}

// A cell whose reactions cannot be integrated is left as it is, a fault of the step.
void react_row(const Row& row, const Handles& h, const SchemeOptions& o,
               kinetics::Reactor& reactor) {
  const double* rho = row(h.release.end.next.rho);
  double* E = row(h.release.end.next.energy);
  double* last_step = row(h.last_step);
  const HeatBudget books(row, h.release, o);
  const double dt = row.step().dt;
  const std::size_t count = h.before.size();
  double Y[models::max_species];
  for (int i = 0; i < row.count(); ++i) {
    for (std::size_t k = 0; k < count; ++k) Y[k] = row(h.before[k])[i];
    kinetics::Reactor::Result done{0, dt, 0};
    if (is_state(rho[i], E[i], Y, count)) {
      try {
        done = reactor.advance(rho[i], E[i] / rho[i], Y, dt);
      } catch (const PhysicsError&) {
        const auto heat =
            o.materials.mixed->species->gas->heat([&](std::size_t k) { return Y[k]; });
        done.last_step = -heat.temperature(E[i] / rho[i]);
      }
    }
    for (std::size_t k = 0; k < count; ++k) row(h.now[k])[i] = Y[k];
    E[i] += done.heat;
    last_step[i] = done.last_step;
    books.add(i, done.heat);
  }
  admissible_row<1>(row, o.grid.axes, {{{last_step, fault_reactions, [](double x) { return -x; }}}},
                    o.materials.index);
}

// The reacting species of a graph: what of their variables tasks need.
struct Carried {
  std::vector<const ScalarVariables::Each*> each;

  Carried(const ReactionsInput& v, const SchemeOptions& o) {
    for (const ScalarVariables::Each& e : v.each)
      if (o.materials.scalars[e.index].of_species) each.push_back(&e);
  }
};

void save_change(TaskList& list, const ScalarVariables::Each& e, const SchemeOptions& o) {
  const models::TransportedScalar& s = o.materials.scalars[e.index];
  TaskBuilder task = list.task("save " + s.source().name(), effect_saved_intermediates);
  const In before = task.read(e.now), after = task.read(e.after_reactions);
  const Out out = task.write(list.output(s.source(), s.material));
  task.kernel([=](const Row& row) {
    const double *a = row(before), *b = row(after);
    double* to = row(out);
    for (int i = 0; i < row.count(); ++i) to[i] = b[i] - a[i];
  });
}

struct ChangeHandles {
  std::vector<In> before, after;
};

ChangeHandles read_changes(TaskBuilder& task, const Carried& carried) {
  ChangeHandles h;
  for (const ScalarVariables::Each* e : carried.each) {
    h.before.push_back(task.read(e->now));
    h.after.push_back(task.read(e->after_reactions));
  }
  return h;
}

// -rho sum dY_k (e0_k - e0_N)/dt, N the closure.
void save_heat_release(TaskList& list, VariableId rho_new, const SchemeOptions& o,
                       const Carried& carried) {
  TaskBuilder task = list.task("save " + models::reaction_labels().heat_release.name(),
                               effect_saved_intermediates);
  const ChangeHandles h = read_changes(task, carried);
  const In rho = task.read(rho_new);
  const Out out =
      task.write(list.output(models::reaction_labels().heat_release, o.materials.index));
  task.kernel([=, gas = o.materials.mixed->species->gas](const Row& row) {
    double* to = row(out);
    const double* r = row(rho);
    for (int i = 0; i < row.count(); ++i) to[i] = 0;
    for (std::size_t k = 0; k < h.before.size(); ++k) {
      const double weight =
          (gas->formation_energy(gas->species_of(k)) - gas->formation_energy(gas->closure())) /
          row.step().dt;
      const double *a = row(h.before[k]), *b = row(h.after[k]);
      for (int i = 0; i < row.count(); ++i) to[i] -= r[i] * weight * (b[i] - a[i]);
    }
  });
}

// Whose fraction changes most against its tolerance, from 1; 0 where none changes.
void save_limiter(TaskList& list, const SchemeOptions& o, const Carried& carried) {
  TaskBuilder task =
      list.task("save " + models::reaction_labels().limiter.name(), effect_saved_intermediates);
  const ChangeHandles h = read_changes(task, carried);
  const Out out = task.write(list.output(models::reaction_labels().limiter, o.materials.index));
  task.kernel([=, relative = o.materials.mixed->species->relative_tolerance,
               fraction = o.materials.mixed->species->fraction_tolerance](const Row& row) {
    double* to = row(out);
    for (int i = 0; i < row.count(); ++i) {
      double most = 0;
      to[i] = 0;
      for (std::size_t k = 0; k < h.before.size(); ++k) {
        const double a = row(h.before[k])[i], b = row(h.after[k])[i];
        const double change = std::fabs(b - a) / (relative * std::fabs(b) + fraction);
        if (!(change > most)) continue;
        most = change;
        to[i] = static_cast<double>(k + 1);
      }
    }
  });
}

void save_last_step(TaskList& list, const SchemeOptions& o, VariableId last_step) {
  TaskBuilder task =
      list.task("save " + models::reaction_labels().last_step.name(), effect_saved_intermediates);
  const In in = task.read(last_step);
  const Out out = task.write(list.output(models::reaction_labels().last_step, o.materials.index));
  task.kernel([=](const Row& row) {
    const double* from = row(in);
    double* to = row(out);
    for (int i = 0; i < row.count(); ++i) to[i] = from[i];
  });
}

}  // namespace

void add_reactions(TaskList& list, const ReactionsInput& v, const SchemeOptions& o, int effect) {
  if (!o.materials.releases_heat || !o.materials.mixed->species) return;
  const Carried carried(v, o);
  const VariableId last_step = list.temporary("last step of reactions");
  TaskBuilder task = list.task("reactions", effect);
  Handles h;
  h.release = declare_heat_release(task, v.release, o);
  for (const ScalarVariables::Each* e : carried.each) {
    h.before.push_back(task.read(e->now));
    h.now.push_back(task.write(e->after_reactions));
  }
  h.last_step = task.write(last_step);
  const std::shared_ptr<Reactors> reactors = make_reactors(*o.materials.mixed->species);
  dispatch(o.grid.axes.count, o.grid.components, [&]<int D, int C>() {
    task.kernel([=](const Row& row) {
      begin_heat_release(row, h.release, o);
      reactors->lend([&](kinetics::Reactor& reactor) { react_row(row, h, o, reactor); });
      end_heat_release<D>(row, h.release, o);
    });
  });
  for (const ScalarVariables::Each* e : carried.each) save_change(list, *e, o);
  save_heat_release(list, v.release.rho_new, o, carried);
  save_limiter(list, o, carried);
  save_last_step(list, o, last_step);
}

}  // namespace sluice::ice::scalars
