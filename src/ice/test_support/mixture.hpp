// Several materials in a box of cells, stepped in this process.
#pragma once
#include <gtest/gtest.h>

#include <functional>
#include <stdexcept>

#include "ice/test_support/classic.hpp"
#include "ice/test_support/fluid.hpp"

namespace sluice::ice {

// What a cell holds of each material at the start: true density, pressure, share of the cell.
struct MixtureCell {
  std::vector<double> volume, density, pressure;
  double velocity[3] = {0, 0, 0};
  std::vector<double> slip{};  // of each material along x, beside that velocity; may be left out
};

// Two materials of one pressure, at rest; V: volume fraction of the first.
inline MixtureCell pair_at_rest(double V, double rho_a, double rho_b, double p) {
  MixtureCell c;
  c.volume = {V, 1 - V};
  c.density = {rho_a, rho_b};
  c.pressure = {p, p};
  return c;
}

// Friction, conduction and heat exchange; of each material, 0 where nothing is given.
struct Transport {
  std::vector<double> viscosity, conductivity;
  double heat_exchange = 0;                         // of every pair, W/(m^3 K)
  std::vector<ViscosityModels> models{};            // of each material
  std::optional<Turbulence> turbulence{};           // of all
  std::vector<WallShear> wall_shear{};              // likewise
  std::function<void(ExchangeSettings&)> change{};  // what else the deck says of exchange
};

class MixtureBox {
 public:
  // The scene is that of the box; its material is replaced by `fluids`.
  MixtureBox(const GasBox& box, const std::vector<Fluid>& fluids,
             const std::function<MixtureCell(Vec3)>& start, const SolverOptions& options = {},
             IntVec3 boxes = {}, const Transport& transport = {},
             double drag = one_velocity_coefficient)
      : fluids_(fluids) {
    Schema schema;
    add_framework_tags(schema);
    add_ice_tags(schema);
    deck_ = load_deck_text(deck_text(box), "box.ups", {}, schema);
    std::vector<Fault> faults = deck_.faults;
    SceneOptions scene_options;
    scene_options.boxes = boxes;
    scene_ = read_scene(deck_, scene_options, faults);
    IceScene ice = read_ice_scene(deck_, scene_, faults);
    const IceMaterial first = ice.materials.front();
    ice.materials.clear();
    for (const Fluid& fluid : fluids) {
      ice.materials.push_back(first);
      ice.materials.back().fluid = fluid;
      const std::size_t m = ice.materials.size() - 1;
      ice.materials.back().index = static_cast<int>(m);
      if (m < transport.viscosity.size()) ice.materials.back().viscosity = transport.viscosity[m];
      if (m < transport.conductivity.size())
        ice.materials.back().conductivity = transport.conductivity[m];
      if (m < transport.models.size()) ice.materials.back().viscosity_models = transport.models[m];
      ice.materials.back().subgrid = transport.turbulence || !transport.wall_shear.empty();
    }
    ice.turbulence = transport.turbulence;
    ice.wall_shear = transport.wall_shear;
    ice.exchange.heat = PairCoefficients(count());
    for (int a = 0; a < count(); ++a)
      for (int b = a + 1; b < count(); ++b) ice.exchange.heat.set(a, b, transport.heat_exchange);
    ice.exchange.momentum = PairCoefficients(count());
    for (int m = 0; m < count(); ++m)
      for (int n = m + 1; n < count(); ++n) ice.exchange.momentum.set(m, n, drag);
    if (transport.change) transport.change(ice.exchange);
    ice_ = std::make_unique<Ice>(scene_, std::move(ice));
    solver_ = std::make_unique<LevelSolver>(*ice_, level(), world(), options);
    fill(start);
    rates_ = solver_->initial_rates();
  }

  // Steps to `time`, each as long as the scheme allows; returns how many.
  int run(double time) {
    int steps = 0;
    while (time_ < time) {
      const double allowed = limit().dt;
      step(time_ + allowed > time ? time - time_ : allowed);
      ++steps;
    }
    return steps;
  }
  void steps(int count) {
    for (int n = 0; n < count; ++n) step(limit().dt);
  }
  // Labels that each step stores.
  void save(std::vector<Label> wanted) { wanted_ = std::move(wanted); }
  // In a cell, or on the low face of one.
  double saved(Label label, int material, IntVec3 cell, int component = 0) const {
    const Warehouse& outputs = solver_->outputs();
    return outputs.view(outputs.find(label, material), component, 0)(cell);
  }
  // Of the next step.
  StepLimit limit() const { return ice_->step().limit(rates_); }
  // Tries again with masked slopes, then with half the step, as a run does.
  void step(double dt) {
    for (int halvings = 0; halvings < 20; ++halvings, dt *= 0.5) {
      for (int redo = 0; redo < 3; ++redo) {
        solver_->fill_ghosts(time_);
        const StepAttempt& a = solver_->attempt(time_, dt, wanted_, control_.get());
        if (a.faults == 0) {
          rates_ = a.maxima;
          sums_ = a.sums;
          solver_->advance();
          solver_->accept();
          time_ += dt;
          return;
        }
        last_fault_ = a.first_fault;
        ++rejected_;
        if (redo < 2) solver_->mask_faults();
      }
      solver_->reject();
    }
    throw PhysicsError("inadmissible step: " + ice_->step().describe_fault(last_fault_.kind) + " " +
                       std::to_string(last_fault_.value) + " in cell " +
                       std::to_string(last_fault_.cell.x) + " at " + std::to_string(time_));
  }

  double mass(int m, IntVec3 c) const { return view(labels().mass, m, 0, c)(c); }
  double volume(int m, IntVec3 c) const {
    return fluids_.size() == 1 ? 1.0 : view(labels().volume, m, 0, c)(c);
  }
  double energy(int m, IntVec3 c) const { return view(labels().energy, m, 0, c)(c); }
  double momentum(int d, IntVec3 c) const { return view(labels().momentum, 0, d, c)(c); }
  double density(IntVec3 c) const {
    double sum = 0;
    for (int m = 0; m < count(); ++m) sum += mass(m, c);
    return sum;
  }
  double velocity(IntVec3 c, int d = 0) const { return momentum(d, c) / density(c); }
  bool is_multi_velocity() const { return solver_->state().find(labels().slip, 0) >= 0; }
  // Of a material that has its own; that of the mixture where it is absent.
  double velocity_of(int m, IntVec3 c, int d = 0) const {
    const double M = mass(m, c);
    return velocity(c, d) + (M > 0 ? view(labels().slip, m, d, c)(c) / M : 0.0);
  }
  // As the scheme has it: weighted with compressibility.
  double pressure(IntVec3 c) const {
    double sum = 0, weight = 0;
    for (int m = 0; m < count(); ++m) {
      if (mass(m, c) == 0) continue;
      const Fluid& fluid = fluids_[m];
      const double V = volume(m, c), rho = mass(m, c) / V;
      const double p = fluid.pressure(rho, energy(m, c) / V);
      const double w = V / fluid.bulk_modulus(rho, p);
      sum += w * p;
      weight += w;
    }
    return sum / weight;
  }
  Totals totals() const {
    Totals t;
    ice_->budgets().add_totals(solver_->state(), LevelCoverage(), t);
    return t;
  }

  int count() const { return static_cast<int>(fluids_.size()); }
  const Level& level() const { return scene_.grid.levels.front(); }
  const IndexBox& domain() const { return level().domain; }
  double time() const { return time_; }
  int rejected() const { return rejected_; }
  LevelSolver& solver() { return *solver_; }
  const Ice& ice() const { return *ice_; }
  RealView view(Label label, int material, int component, IntVec3 cell) const {
    const Warehouse& state = solver_->state();
    const int slot = state.find(label, material);
    for (int b = 0; b < static_cast<int>(state.local_boxes().size()); ++b)
      if (state.local_boxes()[b].cells.contains(cell)) return state.view(slot, component, b);
    throw std::logic_error("no box holds the cell");
  }

 private:
  void fill(const std::function<MixtureCell(Vec3)>& start) {
    for_each_cell(domain(), [&](IntVec3 c) {
      const MixtureCell s = start(level().centre(c));
      double rho = 0;
      for (int m = 0; m < count(); ++m) {
        const double V = s.volume[m], r = s.density[m];
        const double M = V > 0 ? V * r : 0.0;
        view(labels().mass, m, 0, c)(c) = M;
        if (count() > 1) view(labels().volume, m, 0, c)(c) = V;
        view(labels().energy, m, 0, c)(c) =
            V > 0 ? V * fluids_[m].energy_from_pressure(r, s.pressure[m], 300.0) : 0.0;
        rho += M;
      }
      const int slot = solver_->state().find(labels().momentum, 0);
      for (int d = 0; d < solver_->state().info(slot).components; ++d)
        view(labels().momentum, 0, d, c)(c) = rho * s.velocity[d];
      if (s.slip.empty()) return;
      double sum = 0;
      for (int m = 0; m < count(); ++m) sum += mass(m, c) * s.slip[m];
      view(labels().momentum, 0, 0, c)(c) += sum;
      for (int m = 0; m < count(); ++m) {
        const double M = mass(m, c);
        view(labels().slip, m, 0, c)(c) = M == rho ? 0.0 : M * (s.slip[m] - sum / rho);
      }
    });
    solver_->mark_modified();
  }

  std::vector<Fluid> fluids_;
  Deck deck_;
  Scene scene_;
  std::unique_ptr<Ice> ice_;
  std::unique_ptr<LevelSolver> solver_;
  std::shared_ptr<RunControl> control_ = shared_control();
  std::vector<double> rates_, sums_;
  std::vector<Label> wanted_;
  CellFault last_fault_;
  double time_ = 0;
  int rejected_ = 0;
};

inline double total_energy(const Totals& t) {
  return t.internal_energy.sum.value() + t.kinetic_energy.sum.value();
}

// The mass of each material and the energy of a closed box, to a share of themselves.
inline void expect_kept(const Totals& before, const Totals& after, double limit) {
  for (std::size_t m = 0; m < before.mass.size(); ++m)
    EXPECT_LE(std::fabs(after.mass[m].sum.value() - before.mass[m].sum.value()),
              limit * before.mass[m].sum.value());
  const double e0 = total_energy(before), e1 = total_energy(after);
  std::printf("dE/E %.1e\n", (e1 - e0) / e0);
  EXPECT_LE(std::fabs(e1 - e0), limit * e0);
}

// The state of all cells, number by number; `mirror`: as the image along x has it.
inline std::vector<double> bits_of(const MixtureBox& run, bool mirror) {
  const double sign = mirror ? -1 : 1;
  const bool multi_velocity = run.is_multi_velocity();
  std::vector<double> all;
  for_each_cell(run.domain(), [&](IntVec3 c) {
    IntVec3 from = c;
    if (mirror) from.x = run.domain().upper.x - 1 - c.x;
    for (int m = 0; m < run.count(); ++m) {
      for (const double v : {run.mass(m, from), run.volume(m, from), run.energy(m, from)})
        all.push_back(v);
      if (multi_velocity) all.push_back(sign * run.view(labels().slip, m, 0, from)(from) + 0.0);
    }
    all.push_back(sign * run.momentum(0, from) + 0.0);
    if (run.domain().size().y > 1) all.push_back(run.momentum(1, from) + 0.0);
  });
  return all;
}

// `run_with`(options, boxes): the bits of 48 x 40 cells at the end of a run.
template <class RunWith>
void expect_same_bits_however_cut(RunWith run_with) {
  const std::vector<double> reference = run_with({}, {1, 1, 1});
  SolverOptions all;
  all.force_all = true;
  EXPECT_EQ(reference, run_with(all, {1, 1, 1}));
  SolverOptions small;
  small.block = {16, 8, 1};
  EXPECT_EQ(reference, run_with(small, {1, 1, 1}));
  EXPECT_EQ(reference, run_with({}, {2, 3, 1}));
  SolverOptions threads;
  threads.threads = 2;
  threads.block = {12, 8, 1};
  EXPECT_EQ(reference, run_with(threads, {1, 2, 1}));
}

}  // namespace sluice::ice
