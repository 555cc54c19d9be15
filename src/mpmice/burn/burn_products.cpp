#include "mpmice/burn/burn_products.hpp"

#include <algorithm>
#include <cmath>

#include "framework/base/reduction.hpp"

namespace sluice::mpmice {
namespace {

// Lanes of what is given, per mass of the largest gift.
constexpr int mass_lane = 0, energy_lane = 1, kinetic_lane = 2, momentum_lane = 3;

}  // namespace

// The largest number of parts of the giving particles in a cell: sums need room for no more.
template <int D>
double BurnProducts<D>::most_parts_given(const BurningStep<D>& step,
                                         const std::vector<GivenByParticle>& given) {
  const Frame<D>& frame = step.frame();
  CellSums<D> parts;
  parts.begin(frame.cells, 1);
  for (const GivenByParticle& g : given) {
    const SolidSet<D>& s = step.sets.all()[g.set];
    for_each_part<D>(frame, corner_columns<D>(frame, *s.columns, *s.next), *s.next, g.particle,
                     [&](std::size_t i) { ++parts.lane(0)[i]; });
  }
  parts.sum_over_ranks(*step.scope.ranks);
  return most_of(parts, *step.scope.ranks);
}

template <int D>
bool BurnProducts<D>::find_scales(const BurningStep<D>& step,
                                  const std::vector<GivenByParticle>& given, Scales& most) {
  for (const GivenByParticle& g : given) {
    most.mass = std::max(most.mass, g.mass);
    most.energy = std::max(most.energy, std::fabs(g.energy));
    most.kinetic = std::max(most.kinetic, g.kinetic);
    for (int d = 0; d < 3; ++d) most.speed = std::max(most.speed, std::fabs(g.velocity[d]));
  }
  Reduction all;
  const std::array<Reduction::Maximum, 4> maxima{
      all.add_maximum(most.mass), all.add_maximum(most.energy), all.add_maximum(most.kinetic),
      all.add_maximum(most.speed)};
  const auto any = all.add_any(!given.empty());
  step.scope.ranks->reduce(all);
  if (!all.any(any)) return false;
  most.mass = all.maximum(maxima[0]);
  most.energy = all.maximum(maxima[1]);
  most.kinetic = all.maximum(maxima[2]);
  most.speed = all.maximum(maxima[3]);
  most.room = most_parts_given(step, given);
  return true;
}

template <int D>
void BurnProducts<D>::add_parts(const BurningStep<D>& step, const GivenByParticle& g,
                                const Column& in_cells, const Scales& most, CellSums<D>& sums) {
  const Frame<D>& frame = step.frame();
  const int components = static_cast<int>(step.amounts.momentum.size());
  const auto weight = [&](std::size_t i) { return in_cells.empty() ? 1.0 : in_cells[i]; };
  const SolidSet<D>& s = step.sets.all()[g.set];
  const CornerColumns<D> x = corner_columns<D>(frame, *s.columns, *s.next);
  double whole = 0;  // of the weights of its parts
  for_each_part<D>(frame, x, *s.next, g.particle, [&](std::size_t i) { whole += weight(i); });
  for_each_part<D>(frame, x, *s.next, g.particle, [&](std::size_t i) {
    const double share = g.mass / most.mass / most.room * (weight(i) / whole);
    sums.lane(mass_lane)[i] += to_sum(share);
    sums.lane(energy_lane)[i] += to_sum(share * (g.energy / most.energy));
    sums.lane(kinetic_lane)[i] += to_sum(share * (g.kinetic / most.kinetic));
    for (int k = 0; k < components; ++k) {
      const int d = step.fluid.options().grid.direction[static_cast<std::size_t>(k)];
      sums.lane(momentum_lane + k)[i] += to_sum(share * (g.velocity[d] / most.speed));
    }
  });
}

template <int D>
bool BurnProducts<D>::give(const BurningStep<D>& step, int product,
                           const std::vector<GivenByParticle>& given, const Column& in_cells) {
  Scales most;
  if (!find_scales(step, given, most)) return false;
  const int components = static_cast<int>(step.amounts.momentum.size());
  CellSums<D> sums;
  sums.begin(step.frame().cells, momentum_lane + components);
  for (const GivenByParticle& g : given) add_parts(step, g, in_cells, most, sums);
  sums.sum_over_ranks(*step.scope.ranks);
  const double to_density = most.mass * most.room / step.frame().cell_volume;
  step.near.for_each([&](const Cell<D>&, std::size_t i) {
    if (sums.lane(mass_lane)[i] == 0) return;
    const auto value = [&](int lane) { return from_sum(sums.lane(lane)[i]) * to_density; };
    std::array<double, 3> P{};
    for (int k = 0; k < components; ++k)
      P[static_cast<std::size_t>(k)] = value(momentum_lane + k) * most.speed;
    add(step.amounts, i, product, value(mass_lane), value(energy_lane) * most.energy,
        value(kinetic_lane) * most.kinetic, P);
  });
  return true;
}

template <int D>
void BurnProducts<D>::add(CellAmounts<D>& amounts, std::size_t i, int product, double mass,
                          double energy, double kinetic, const std::array<double, 3>& momentum) {
  const auto m = static_cast<std::size_t>(product);
  amounts.mass[m][i] += mass;
  made_[m][i] += mass;
  amounts.energy[m][i] += energy;
  amounts.kinetic[i] += kinetic;
  for (std::size_t k = 0; k < amounts.momentum.size(); ++k) amounts.momentum[k][i] += momentum[k];
  amounts.touched[i] = 1;
}

template <int D>
Column BurnProducts<D>::all() const {
  Column all(made_.front().size(), 0.0);
  for (const Column& of_one : made_)
    for (std::size_t i = 0; i < all.size(); ++i) all[i] += of_one[i];
  return all;
}

template <int D>
void BurnProducts<D>::fill_opened(const BurningStep<D>& step) const {
  CellAmounts<D>& amounts = step.amounts;
  step.near.for_each([&](const Cell<D>&, std::size_t i) {
    const double volume = 1 - step.solid.theta_next[i], opened = volume - amounts.volume[i];
    if (opened == 0) return;
    amounts.volume[i] = volume;
    amounts.touched[i] = 1;
    double all = 0;
    for (const Column& mass : made_) all += mass[i];
    if (amounts.mass.size() == 1) {
      amounts.filled[0][i] = volume;
    } else if (all > 0) {
      for (std::size_t m = 0; m < made_.size(); ++m)
        amounts.filled[m][i] += opened * (made_[m][i] / all);
    }
  });
}

template class BurnProducts<1>;
template class BurnProducts<2>;
template class BurnProducts<3>;

}  // namespace sluice::mpmice
