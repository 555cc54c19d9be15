#include "mpmice/amounts/settled_fluid.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "ice/step/step_bounds.hpp"
#include "mpmice/amounts/one_temperature.hpp"

namespace sluice::mpmice {

// Mass, volume and energy of each fluid per volume of fluid.
template <int D>
struct SettledFluid<D>::OneCell {
  double M[ice::max_materials], V[ice::max_materials], E[ice::max_materials];
};

template <int D>
bool SettledFluid<D>::settle(const NearCells<D>& near, CellAmounts<D>& amounts,
                             SolidGeometry<D>& solid, std::string& reason) {
  settled_ = amounts;
  const std::vector<ice::Fluid>& fluids = fluid_->options().materials.fluids;
  const ice::mixture::Equilibration laws(fluids);
  bool good = true;
  inadmissible_.assign(near.size(), 0);
  near.for_each_within(NearCells<D>::state_reach, [&](const Cell<D>& c, std::size_t i) {
    if (amounts.near[i] == 0 || !(amounts.volume[i] > 0)) return;
    if (amounts.touched[i] == 0) return settle_scalars(amounts, i);
    if (amounts.mass_of_all(i) == 0) {
      amounts.volume[i] = 0;
      solid.theta_next[i] = 1;
      return;
    }
    OneCell cell;
    if (settle_cell(amounts, i, laws, cell)) {
      for (std::size_t m = 0; m < fluids.size(); ++m) {
        settled_.mass[m][i] = cell.M[m];
        settled_.filled[m][i] = cell.V[m];
        settled_.energy[m][i] = cell.E[m];
      }
      for (Column& m : settled_.momentum) m[i] /= amounts.volume[i];
      settle_scalars(amounts, i);
      return;
    }
    inadmissible_[i] = 1;
    if (!good || !near.owns(i)) return;
    good = false;
    reason = fault_of(amounts, i, near.frame().index(c), cell);
  });
  return good;
}

template <int D>
std::string SettledFluid<D>::fault_of(const CellAmounts<D>& amounts, std::size_t i, IntVec3 at,
                                      const OneCell& cell) const {
  std::string text = fmt::format(
      "the fluid left next to a solid in cell [{}, {}, {}] is in an inadmissible state: volume "
      "fraction {:g}",
      at.x, at.y, at.z, amounts.volume[i]);
  for (std::size_t m = 0; m < amounts.mass.size(); ++m)
    text += fmt::format(
        "; material {}: mass {:g} kg/m^3, volume fraction {:g}, internal energy {:g} J/m^3",
        fluid_->options().place(static_cast<int>(m)), amounts.mass[m][i], cell.V[m], cell.E[m]);
  return text;
}

// q = A/M: there is no scalar where nothing carries it.
template <int D>
void SettledFluid<D>::settle_scalars(const CellAmounts<D>& amounts, std::size_t i) {
  const auto& scalars = fluid_->options().materials.scalars;
  for (std::size_t s = 0; s < scalars.size(); ++s) {
    const auto m = static_cast<std::size_t>(scalars[s].material);
    settled_.scalar[s][i] =
        settled_.mass[m][i] > 0 ? amounts.scalar[s][i] / amounts.mass[m][i] : 0.0;
  }
}

// False: they are no state.
template <int D>
bool SettledFluid<D>::settle_cell(const CellAmounts<D>& amounts, std::size_t i,
                                  const ice::mixture::Equilibration& laws, OneCell& cell) const {
  constexpr double trace = 1e-13;  // of the cell's mass and of its volume: round-off
  const std::vector<ice::Fluid>& fluids = fluid_->options().materials.fluids;
  const std::size_t count = fluids.size();
  auto& [M, V, E] = cell;
  const double left = amounts.volume[i], all = amounts.mass_of_all(i);
  const double rest = amounts.kinetic[i] - amounts.moving(i);
  double volume = 0, mass = 0, lost = 0;
  for (std::size_t m = 0; m < count; ++m) {
    M[m] = amounts.mass[m][i] / left;
    V[m] = count == 1 ? 1.0 : amounts.filled[m][i] / left;
    E[m] = amounts.energy[m][i] / left;
    const double least = trace * all / left;
    if (count > 1 && M[m] < -least) return false;
    if (count > 1 && (!(M[m] > 0) || (!(M[m] > least) && !(V[m] > trace)))) {
      lost += E[m];
      M[m] = V[m] = E[m] = 0;
    } else if (!(V[m] > 0)) {
      V[m] = M[m] * left / all;  // something to begin with: the pressure will say it
    }
    volume += V[m];
    mass += M[m];
  }
  if (!(all > 0) || !(mass > 0) || !(volume > 0)) return false;
  for (std::size_t m = 0; m < count; ++m) {
    E[m] += (rest / left + lost) * (M[m] / mass);
    V[m] = V[m] == volume ? 1.0 : V[m] / volume;
  }
  const auto admissible = [&] {
    for (std::size_t m = 0; m < count; ++m)
      if (cell.M[m] > 0 && !fluids[m].admissible(cell.M[m] / cell.V[m], cell.E[m] / cell.V[m]))
        return false;
    return true;
  };
  if (!admissible() && (count == 1 || !take_one_temperature(fluids, M, V, E) || !admissible()))
    return false;
  return count == 1 || laws.equilibrate({M, V, E}).failed < 0;
}

template <int D>
void SettledFluid<D>::fill_dry(const NearCells<D>& near, const CellAmounts<D>& amounts) {
  filled_.assign(near.size(), 0);
  KeptArray<std::pair<Cell<D>, std::size_t>> dry;
  constexpr int layers = 2;
  near.for_each([&](const Cell<D>&, std::size_t i) {
    if (amounts.volume[i] > 0 && amounts.near[i] != 0) filled_[i] = 1;
  });
  CellMask within = filled_;
  dilate(near.frame(), layers, within);
  near.for_each([&](const Cell<D>& c, std::size_t i) {
    if (!(amounts.volume[i] > 0) && within[i] != 0) dry.emplace_back(c, i);
  });
  std::vector<Column*> columns;
  settled_.for_each_amount([&](Column& column) { columns.push_back(&column); });
  KeptArray<std::size_t> around;
  // What the cells around hold; false: nothing is known there.
  const auto fill = [&](const Cell<D>& c, std::size_t i) {
    around.clear();
    near.for_each_neighbour(c, [&](std::size_t j) {
      if (filled_[j] != 0) around.push_back(j);
    });
    if (around.empty()) return false;
    for (Column* column : columns) {
      double sum = 0;
      for (const std::size_t j : around) sum += (*column)[j];
      (*column)[i] = sum / static_cast<double>(around.size());
    }
    return true;
  };
  for (int layer = 0; layer < layers; ++layer) {
    const auto found = std::partition(
        dry.begin(), dry.end(), [&](const auto& cell) { return !fill(cell.first, cell.second); });
    if (found == dry.end()) return;
    for (auto cell = found; cell != dry.end(); ++cell) filled_[cell->second] = 1;
    dry.erase(found, dry.end());
  }
}

template <int D>
void SettledFluid<D>::store(const Frame<D>& frame, const CellAmounts<D>& amounts,
                            const Column& theta, const Warehouse& before, Warehouse& next) const {
  const FluidCells fluid_before(*fluid_, before), fluid(*fluid_, next);
  for (int b = 0; b < static_cast<int>(next.local_boxes().size()); ++b) {
    const FluidBox cells = fluid.box(b), old = fluid_before.box(b);
    const IndexBox& own = next.local_boxes()[static_cast<std::size_t>(b)].cells;
    frame.for_each_held(own, [&](IntVec3 at, std::size_t i) {
      if (amounts.touched[i] == 0) return;
      const bool known = filled_[i] != 0;
      for (int m = 0; m < fluid.materials(); ++m) {
        const auto k = static_cast<std::size_t>(m);
        cells.mass(m, at) = known ? settled_.mass[k][i] : old.mass(m, at);
        cells.energy(m, at) = known ? settled_.energy[k][i] : old.energy(m, at);
        if (fluid.materials() > 1)
          cells.volume(m, at) = known ? settled_.filled[k][i] : old.volume(m, at);
      }
      for (std::size_t s = 0; s < fluid.scalar.size(); ++s)
        cells.scalar(s, at) = known ? settled_.scalar[s][i] : old.scalar(s, at);
      for (int c = 0; c < fluid.components; ++c)
        cells.momentum(c, at) =
            known ? settled_.momentum[static_cast<std::size_t>(c)][i] : old.momentum(c, at);
      cells.bind(at);
      cells.fraction(at) = theta[i];
    });
    next.forget_where(b, [&](const IndexBox& part) { return frame.holds_any(part); });
  }
}

template <int D>
CellRates SettledFluid<D>::rates(const NearCells<D>& near, const CellAmounts<D>& amounts) const {
  const ice::SchemeOptions& o = fluid_->options();
  const ice::mixture::Equilibration laws(o.materials.fluids);
  CellRates most;
  near.for_each_own([&](const Cell<D>&, std::size_t i) {
    if (amounts.touched[i] == 0 || !(amounts.volume[i] > 0)) return;
    OneCell cell;
    double rho = 0;
    for (std::size_t m = 0; m < o.materials.fluids.size(); ++m) {
      cell.M[m] = settled_.mass[m][i];
      cell.V[m] = o.materials.fluids.size() == 1 ? 1.0 : settled_.filled[m][i];
      cell.E[m] = settled_.energy[m][i];
      rho += cell.M[m];
    }
    const double c = std::sqrt(laws.look({cell.M, cell.V, cell.E}).modulus / rho);
    double sum = 0, all = 0;
    for (std::size_t a = 0; a < D; ++a) {
      const double inverse = 1 / near.frame().spacing[o.grid.axes.direction[a]];
      const double u = std::fabs(settled_.momentum[a][i] / rho);
      most.deck = std::max(most.deck, (u + o.scheme.sound_speed_factor * c) * inverse);
      most.sound = std::max(most.sound, (u + c) * inverse);
      sum += (u + c) * inverse;
      all += u * inverse;
    }
    if (D > 1) most.sound = std::max(most.sound, ice::sound_sum_share(o) * sum);
    most.flow = std::max(most.flow, all);
  });
  return most;
}

template class SettledFluid<1>;
template class SettledFluid<2>;
template class SettledFluid<3>;

}  // namespace sluice::mpmice
