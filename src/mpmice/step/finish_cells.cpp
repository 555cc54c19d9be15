// Behind the sweep: from amounts of cells to the state of the fluid in them.
#include <fmt/format.h>

#include <cmath>

#include "ice/step/step_bounds.hpp"
#include "mpmice/step/fluid_cells.hpp"
#include "mpmice/step/level_coupling.hpp"
#include "mpmice/step/redistribute.hpp"

namespace sluice::mpmice {

// What the sweep left in cells with solids (amounts and total energy) and around them (a state).
template <int D>
void LevelCoupling<D>::gather(const StageScope& scope) {
  constexpr int mass = 0, energy = 1, momentum = 2;
  const FluidCells fluid(*fluid_, scope.levels.front()->attempted());
  const int C = fluid.components;
  known_.begin(frame_.box, momentum + C);
  amounts_.volume.assign(frame_.box.cells(), 1.0);
  amounts_.near.assign(frame_.box.cells(), 0);
  amounts_.touched.assign(frame_.box.cells(), 0);
  for_each_cell_of_domain([&](const Cell<D>& c, std::size_t i) {
    amounts_.volume[i] = 1 - fields_.theta_next[i];
    if (!has_solid(i)) return;
    amounts_.touched[i] = 1;
    // What it may share with, and what dry cells see of these.
    for_each_around(c, 2, [&](std::size_t j) { amounts_.near[j] = 1; });
  });
  const Warehouse& state = scope.levels.front()->attempted();
  for (int b = 0; b < static_cast<int>(state.local_boxes().size()); ++b) {
    const FluidBox cells = fluid.box(b);
    for_each_cell(state.local_boxes()[static_cast<std::size_t>(b)].cells, [&](IntVec3 at) {
      const std::size_t i = frame_.box.index(frame_.cell(at));
      if (amounts_.near[i] == 0) return;
      const double M = cells.mass(at);
      double E = cells.energy(at);
      for (int c = 0; c < C; ++c) {
        const double m = cells.momentum(c, at);
        known_.put(momentum + c, i, m);
        if (!has_solid(i)) E += 0.5 * m * m / M;
      }
      known_.put(mass, i, M);
      known_.put(energy, i, E);
    });
  }
  known_.tell_all(*scope.ranks);
  known_.take(mass, amounts_.mass);
  known_.take(energy, amounts_.energy);
  amounts_.momentum.resize(static_cast<std::size_t>(C));
  for (int c = 0; c < C; ++c)
    known_.take(momentum + c, amounts_.momentum[static_cast<std::size_t>(c)]);
}

// Amounts become a state. False: some are none.
template <int D>
bool LevelCoupling<D>::settle(const StageScope& scope) {
  const ice::Fluid& law = fluid_->options().fluids.front();
  rho_ = amounts_.mass;
  energy_ = amounts_.energy;
  momentum_ = amounts_.momentum;
  bool good = true;
  for_each_cell_of_domain([&](const Cell<D>& c, std::size_t i) {
    if (amounts_.near[i] == 0 || !(amounts_.volume[i] > 0)) return;
    const double V = amounts_.volume[i], M = amounts_.mass[i];
    double moving = 0;
    for (std::size_t k = 0; k < momentum_.size(); ++k) {
      moving += amounts_.momentum[k][i] * amounts_.momentum[k][i];
      momentum_[k][i] = amounts_.momentum[k][i] / V;
    }
    rho_[i] = M / V;
    energy_[i] = (amounts_.energy[i] - 0.5 * moving / M) / V;
    if (good && !(M > 0 && law.admissible(rho_[i], energy_[i]))) {
      good = false;
      const IntVec3 at = frame_.index(c);
      *scope.reason = fmt::format(
          "the fluid left beside a solid in cell [{}, {}, {}] has no state: volume fraction {:g}, "
          "density {:g} kg/m^3, internal energy {:g} J/m^3",
          at.x, at.y, at.z, V, rho_[i], energy_[i]);
    }
  });
  return good;
}

// Cells without fluid hold the mean of the states around them, two layers deep.
template <int D>
void LevelCoupling<D>::fill_dry_cells() {
  std::vector<std::uint8_t> known(frame_.box.cells(), 0);
  for_each_cell_of_domain([&](const Cell<D>&, std::size_t i) {
    known[i] = amounts_.near[i] != 0 && amounts_.volume[i] > 0 ? 1 : 0;
  });
  for (int layer = 0; layer < 2; ++layer) {
    std::vector<std::size_t> found;
    for_each_cell_of_domain([&](const Cell<D>& c, std::size_t i) {
      if (amounts_.volume[i] > 0 || known[i] != 0) return;
      double rho = 0, E = 0;
      std::array<double, 3> m{};
      int count = 0;
      for_each_neighbour(c, [&](std::size_t j) {
        if (known[j] == 0) return;
        rho += rho_[j];
        E += energy_[j];
        for (std::size_t k = 0; k < momentum_.size(); ++k) m[k] += momentum_[k][j];
        ++count;
      });
      if (count == 0) return;
      rho_[i] = rho / count;
      energy_[i] = E / count;
      for (std::size_t k = 0; k < momentum_.size(); ++k) momentum_[k][i] = m[k] / count;
      found.push_back(i);
    });
    for (const std::size_t i : found) known[i] = 1;
  }
  filled_ = std::move(known);
}

// Into the new state. Cells deep in a solid keep what they had.
template <int D>
void LevelCoupling<D>::store(const StageScope& scope) {
  Warehouse& next = scope.levels.front()->attempted();
  const FluidCells before(*fluid_, scope.levels.front()->state()), fluid(*fluid_, next);
  for (int b = 0; b < static_cast<int>(next.local_boxes().size()); ++b) {
    const FluidBox cells = fluid.box(b), old = before.box(b);
    for_each_cell(next.local_boxes()[static_cast<std::size_t>(b)].cells, [&](IntVec3 at) {
      const std::size_t i = frame_.box.index(frame_.cell(at));
      if (amounts_.touched[i] == 0) return;
      const bool known = filled_[i] != 0;
      cells.mass(at) = known ? rho_[i] : old.mass(at);
      cells.energy(at) = known ? energy_[i] : old.energy(at);
      for (int c = 0; c < fluid.components; ++c)
        cells.momentum(c, at) =
            known ? momentum_[static_cast<std::size_t>(c)][i] : old.momentum(c, at);
    });
  }
  next.forget();
}

template <int D>
Verdict LevelCoupling<D>::finish_cells(const StageScope& scope) {
  gather(scope);
  Cell<D> stuck{};
  if (!redistribute<D>(frame_, fields_, amounts_, stuck)) {
    const IntVec3 at = frame_.index(stuck);
    *scope.reason = fmt::format(
        "solids close cell [{}, {}, {}], and no cell beside it can take the fluid that it holds",
        at.x, at.y, at.z);
    return Verdict::reject;
  }
  exchange(scope);
  if (!settle(scope)) return Verdict::reject;
  fill_dry_cells();
  store(scope);
  return Verdict::good;
}

// Rates of sound and flow in cells that solids touch; the sweep has rated the others.
template <int D>
Verdict LevelCoupling<D>::limit_step(const StageScope& scope) {
  const ice::SchemeOptions& o = fluid_->options();
  const ice::Fluid& law = o.fluids.front();
  double deck = 0, flow = 0, sound = 0;
  for_each_cell_of_domain([&](const Cell<D>&, std::size_t i) {
    if (amounts_.touched[i] == 0 || !(amounts_.volume[i] > 0)) return;
    const double c = law.sound_speed(rho_[i], law.pressure(rho_[i], energy_[i]));
    double sum = 0, all = 0;
    for (std::size_t a = 0; a < D; ++a) {
      const double inverse = 1 / frame_.spacing[o.axes.direction[a]];
      const double u = std::fabs(momentum_[a][i] / rho_[i]);
      deck = std::max(deck, (u + o.sound_speed_knob * c) * inverse);
      sound = std::max(sound, (u + c) * inverse);
      sum += (u + c) * inverse;
      all += u * inverse;
    }
    if (D > 1) sound = std::max(sound, ice::sound_sum_share(o) * sum);
    flow = std::max(flow, all);
  });
  std::vector<double>& maxima = scope.maxima->front();
  const auto include = [&](int slot, double rate) {
    double& own = maxima[static_cast<std::size_t>(o.places.maximum + slot)];
    own = std::max(own, rate);
  };
  include(ice::StepSlots::deck_rate, deck);
  include(ice::StepSlots::flow_rate, flow);
  include(ice::StepSlots::sound_rate, sound);
  return Verdict::good;
}

template Verdict LevelCoupling<1>::limit_step(const StageScope&);
template Verdict LevelCoupling<2>::limit_step(const StageScope&);
template Verdict LevelCoupling<3>::limit_step(const StageScope&);
template Verdict LevelCoupling<1>::finish_cells(const StageScope&);
template Verdict LevelCoupling<2>::finish_cells(const StageScope&);
template Verdict LevelCoupling<3>::finish_cells(const StageScope&);

}  // namespace sluice::mpmice
