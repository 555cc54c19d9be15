// Behind the sweep: from amounts of cells to the state of the fluid in them.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "framework/base/reduction.hpp"
#include "ice/step/step_bounds.hpp"
#include "mpmice/step/fluid_cells.hpp"
#include "mpmice/step/level_coupling.hpp"
#include "mpmice/step/one_temperature.hpp"
#include "mpmice/step/redistribute.hpp"

namespace sluice::mpmice {

// What the sweep left in cells with solids (amounts) and around them (a state).
template <int D>
void LevelCoupling<D>::gather(const StageScope& scope) {
  const FluidCells fluid(*fluid_, scope.levels.front()->attempted());
  const int C = fluid.components, M = fluid.materials();
  const int kinetic = 0, momentum = 1, first = momentum + C;  // then three of each material
  const int scalar = first + 3 * M, scalars = static_cast<int>(fluid.scalar.size());
  known_.begin(frame_.cells, scalar + scalars);
  amounts_.volume.assign(frame_.cells.size(), 1.0);
  amounts_.near.assign(frame_.cells.size(), 0);
  amounts_.touched.assign(frame_.cells.size(), 0);
  for_each_cell_near([&](const Cell<D>&, std::size_t i) {
    amounts_.volume[i] = 1 - fields_.theta_next[i];
    if (!has_solid(i) && swept_with_solid_[i] == 0) return;
    amounts_.touched[i] = amounts_.near[i] = 1;
  });
  dilate(frame_, 2, amounts_.near);  // what it may share with, and what dry cells see of these
  const Warehouse& state = scope.levels.front()->attempted();
  for (int b = 0; b < static_cast<int>(state.local_boxes().size()); ++b) {
    const FluidBox cells = fluid.box(b);
    frame_.for_each_held(
        state.local_boxes()[static_cast<std::size_t>(b)].cells, [&](IntVec3 at, std::size_t i) {
          if (amounts_.near[i] == 0) return;
          const bool solid = swept_with_solid_[i] != 0;
          double rho = 0, squares = 0;
          for (int m = 0; m < M; ++m) {
            rho += cells.mass(m, at);
            // One fluid beside a solid: its energy is told as `kinetic`.
            const bool apart = M > 1 || !solid;
            known_.put(first + 3 * m, i, cells.mass(m, at));
            known_.put(first + 3 * m + 1, i, M > 1 ? cells.volume(m, at) : amounts_.volume[i]);
            known_.put(first + 3 * m + 2, i, apart ? cells.energy(m, at) : 0.0);
          }
          // What a cell with a solid has is an amount already.
          for (std::size_t s = 0; s < fluid.scalar.size(); ++s) {
            const double carried = solid ? 1.0 : cells.mass(static_cast<int>(fluid.carrier[s]), at);
            known_.put(scalar + static_cast<int>(s), i, carried * cells.scalar(s, at));
          }
          for (int c = 0; c < C; ++c) {
            const double m = cells.momentum(c, at);
            known_.put(momentum + c, i, m);
            squares += m * m;
          }
          known_.put(kinetic, i,
                     !solid  ? 0.5 * squares / rho + cells.energy_of_slip(at)
                     : M > 1 ? cells.fraction(at)
                             : cells.energy(0, at));
        });
  }
  known_.tell_all(*scope.ranks);
  known_.take(kinetic, amounts_.kinetic);
  amounts_.momentum.resize(static_cast<std::size_t>(C));
  for (int c = 0; c < C; ++c)
    known_.take(momentum + c, amounts_.momentum[static_cast<std::size_t>(c)]);
  for (auto* columns : {&amounts_.mass, &amounts_.filled, &amounts_.energy})
    columns->resize(static_cast<std::size_t>(M));
  for (int m = 0; m < M; ++m) {
    const auto k = static_cast<std::size_t>(m);
    known_.take(first + 3 * m, amounts_.mass[k]);
    known_.take(first + 3 * m + 1, amounts_.filled[k]);
    known_.take(first + 3 * m + 2, amounts_.energy[k]);
  }
  amounts_.scalar.resize(fluid.scalar.size());
  for (int s = 0; s < scalars; ++s)
    known_.take(scalar + s, amounts_.scalar[static_cast<std::size_t>(s)]);
}

// Amounts become a state, of several fluids at one pressure. False: some of this rank are none.
template <int D>
bool LevelCoupling<D>::settle(const StageScope& scope) {
  settled_ = amounts_;
  const std::vector<ice::Fluid>& fluids = fluid_->options().materials.fluids;
  const ice::mixture::Equilibration laws(fluids);
  const std::size_t count = fluids.size();
  bool good = true;
  spoilt_.assign(amounts_.near.size(), 0);
  for_each_cell_within(state_reach, [&](const Cell<D>& c, std::size_t i) {
    if (amounts_.near[i] == 0 || !(amounts_.volume[i] > 0)) return;
    if (amounts_.touched[i] == 0) return settle_scalars(i);
    // A gap that no fluid has reached: it waits, as if it were closed.
    if (amounts_.mass_of_all(i) == 0) {
      amounts_.volume[i] = 0;
      fields_.theta_next[i] = 1;
      return;
    }
    double M[ice::max_materials], V[ice::max_materials], E[ice::max_materials];
    if (settle_cell(i, laws, M, V, E)) {
      for (std::size_t m = 0; m < count; ++m) {
        settled_.mass[m][i] = M[m];
        settled_.filled[m][i] = V[m];
        settled_.energy[m][i] = E[m];
      }
      for (Column& m : settled_.momentum) m[i] /= amounts_.volume[i];
      settle_scalars(i);
      return;
    }
    spoilt_[i] = 1;
    if (!good || own_[i] == 0) return;
    good = false;
    const IntVec3 at = frame_.index(c);
    *scope.reason = fmt::format(
        "the fluid left next to a solid in cell [{}, {}, {}] is in an inadmissible state: volume "
        "fraction {:g}",
        at.x, at.y, at.z, amounts_.volume[i]);
    for (std::size_t m = 0; m < count; ++m)
      *scope.reason += fmt::format(
          "; material {}: mass {:g} kg/m^3, volume fraction {:g}, internal energy {:g} J/m^3",
          fluid_->options().place(static_cast<int>(m)), amounts_.mass[m][i], V[m], E[m]);
  });
  return good;
}

// q = A/M: there is no scalar where nothing carries it.
template <int D>
void LevelCoupling<D>::settle_scalars(std::size_t i) {
  const auto& scalars = fluid_->options().materials.scalars;
  for (std::size_t s = 0; s < scalars.size(); ++s) {
    const auto m = static_cast<std::size_t>(scalars[s].material);
    settled_.scalar[s][i] =
        settled_.mass[m][i] > 0 ? amounts_.scalar[s][i] / amounts_.mass[m][i] : 0.0;
  }
}

// Mass, volume and energy per volume of fluid. False: they are no state.
template <int D>
bool LevelCoupling<D>::settle_cell(std::size_t i, const ice::mixture::Equilibration& laws,
                                   double* M, double* V, double* E) const {
  constexpr double trace = 1e-13;  // of the cell's mass and of its volume: round-off
  const std::vector<ice::Fluid>& fluids = fluid_->options().materials.fluids;
  const std::size_t count = fluids.size();
  const double left = amounts_.volume[i], all = amounts_.mass_of_all(i);
  const double rest = amounts_.kinetic[i] - amounts_.moving(i);
  double volume = 0, mass = 0, lost = 0;
  for (std::size_t m = 0; m < count; ++m) {
    M[m] = amounts_.mass[m][i] / left;
    V[m] = count == 1 ? 1.0 : amounts_.filled[m][i] / left;
    E[m] = amounts_.energy[m][i] / left;
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
      if (M[m] > 0 && !fluids[m].admissible(M[m] / V[m], E[m] / V[m])) return false;
    return true;
  };
  if (!admissible() && (count == 1 || !take_one_temperature(fluids, M, V, E) || !admissible()))
    return false;
  return count == 1 || laws.equilibrate({M, V, E}).failed < 0;
}

// Cells without fluid hold the mean of the states around them, two layers deep.
template <int D>
void LevelCoupling<D>::fill_dry_cells() {
  filled_.assign(frame_.cells.size(), 0);
  KeptArray<std::pair<Cell<D>, std::size_t>> dry;
  constexpr int layers = 2;
  for_each_cell_near([&](const Cell<D>&, std::size_t i) {
    if (amounts_.volume[i] > 0 && amounts_.near[i] != 0) filled_[i] = 1;
  });
  CellMask within = filled_;
  dilate(frame_, layers, within);
  for_each_cell_near([&](const Cell<D>& c, std::size_t i) {
    if (!(amounts_.volume[i] > 0) && within[i] != 0) dry.emplace_back(c, i);
  });
  std::vector<Column*> columns;
  settled_.for_each_amount([&](Column& column) { columns.push_back(&column); });
  KeptArray<std::size_t> around;
  // What the cells around hold; false: nothing is known there.
  const auto fill = [&](const Cell<D>& c, std::size_t i) {
    around.clear();
    for_each_neighbour(c, [&](std::size_t j) {
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

// Into the new state. Cells deep in a solid keep what they had.
template <int D>
void LevelCoupling<D>::store(const StageScope& scope) {
  Warehouse& next = scope.levels.front()->attempted();
  const FluidCells before(*fluid_, scope.levels.front()->state()), fluid(*fluid_, next);
  for (int b = 0; b < static_cast<int>(next.local_boxes().size()); ++b) {
    const FluidBox cells = fluid.box(b), old = before.box(b);
    const IndexBox& own = next.local_boxes()[static_cast<std::size_t>(b)].cells;
    frame_.for_each_held(own, [&](IntVec3 at, std::size_t i) {
      if (amounts_.touched[i] == 0) return;
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
      cells.fraction(at) = fields_.theta_next[i];
    });
    next.forget_where(b, [&](const IndexBox& part) { return frame_.holds_any(part); });
  }
}

// A cell whose rest of fluid is no state gives it to the cells around, through covered faces too.
template <int D>
bool LevelCoupling<D>::share_spoilt(const StageScope& scope) {
  constexpr int most = 4;  // rounds
  for (int round = 0; round < most; ++round) {
    amounts_.spoilt = spoilt_;
    refresh_amounts(scope);
    std::optional<Cell<D>> stuck;  // then the cell is no state, and says so
    redistribute<D>(frame_, fields_, amounts_, own_, stuck);
    amounts_.spoilt.clear();
    if (!on_any(scope, !settle(scope))) {
      scope.reason->clear();
      return true;
    }
  }
  share_reason(scope);
  return false;
}

// The reason of the first rank that has one. Collective.
template <int D>
void LevelCoupling<D>::share_reason(const StageScope& scope) {
  if (scope.ranks->size() == 1) return;
  for (const std::string& reason : scope.ranks->gather_to_all(*scope.reason))
    if (!reason.empty()) {
      *scope.reason = reason;
      return;
    }
}

// Amounts of cells as those have them whose cells they are.
template <int D>
void LevelCoupling<D>::refresh_amounts(const StageScope& scope) {
  if (scope.ranks->size() == 1) return;
  std::vector<Column*> columns{&amounts_.volume};
  amounts_.for_each_amount([&](Column& column) { columns.push_back(&column); });
  const int count = static_cast<int>(columns.size());
  known_.begin(frame_.cells, count + 2);
  for_each_own_cell([&](const Cell<D>&, std::size_t i) {
    for (int c = 0; c < count; ++c) known_.put(c, i, (*columns[static_cast<std::size_t>(c)])[i]);
    known_.put(count, i, amounts_.near[i]);
    if (!amounts_.spoilt.empty()) known_.put(count + 1, i, amounts_.spoilt[i]);
  });
  known_.tell_all(*scope.ranks);
  for (int c = 0; c < count; ++c) known_.take(c, *columns[static_cast<std::size_t>(c)]);
  for (std::size_t i = CellBlocks<D>::block_cells; i < amounts_.near.size(); ++i) {
    amounts_.near[i] = known_.value(count, i) != 0 ? 1 : 0;
    if (!amounts_.spoilt.empty()) amounts_.spoilt[i] = known_.value(count + 1, i) != 0 ? 1 : 0;
  }
}

template <int D>
void LevelCoupling<D>::share_small_cells() {
  redistribute<D>(frame_, fields_, amounts_, own_, stuck_);
}

template <int D>
void LevelCoupling<D>::tell_stuck(const StageScope& scope) const {
  scope.reason->clear();
  if (stuck_) {
    const IntVec3 at = frame_.index(*stuck_);
    *scope.reason = fmt::format(
        "solids close cell [{}, {}, {}], and no adjacent cell can take the fluid that it contains",
        at.x, at.y, at.z);
  }
  share_reason(scope);
}

template <int D>
typename LevelCoupling<D>::Agreed LevelCoupling<D>::agree(const StageScope& scope, bool good,
                                                          const Column& moved) {
  book_surface_work(scope, moved);
  Reduction all;
  const auto stuck = all.add_any(stuck_.has_value()), spoilt = all.add_any(!good);
  const Rates own_rates = good ? rates_of_cells() : Rates{};
  const auto deck = all.add_maximum(own_rates.deck), flow = all.add_maximum(own_rates.flow),
             sound = all.add_maximum(own_rates.sound);
  books_.add_to(all);
  std::vector<std::pair<int, std::array<Reduction::Maximum, 6>>> bounds;
  for (int k = 0; k < static_cast<int>(solids_->scene().materials.size()); ++k) {
    if (!exchanges(k)) continue;
    const std::array<Vec3, 2> own = bounds_of_velocities(k);
    bounds.push_back({k, {}});
    for (int n = 0; n < 6; ++n)
      bounds.back().second[static_cast<std::size_t>(n)] =
          all.add_maximum(own[static_cast<std::size_t>(n / 3)][n % 3]);
  }
  scope.ranks->reduce(all);
  const Agreed agreed{all.any(stuck), all.any(spoilt)};
  if (agreed.stuck || agreed.spoilt) return agreed;
  books_.take(all, *scope.sums);
  rates_ = {all.maximum(deck), all.maximum(flow), all.maximum(sound)};
  for (const auto& [kind, slots] : bounds) {
    std::array<Vec3, 2> of_all;
    for (int n = 0; n < 6; ++n)
      of_all[static_cast<std::size_t>(n / 3)][n % 3] =
          all.maximum(slots[static_cast<std::size_t>(n)]);
    step_->level(step_->count() - 1).include_velocities(kind, of_all[0], of_all[1]);
  }
  return agreed;
}

template <int D>
Verdict LevelCoupling<D>::finish_cells(const StageScope& scope) {
  const Column moved = fields_.theta_next;  // parting solids do no work
  swept_with_solid_.assign(frame_.cells.size(), 0);
  for_each_cell_near([&](const Cell<D>&, std::size_t i) { swept_with_solid_[i] = has_solid(i); });
  stuck_.reset();
  part_torn(scope);
  gather(scope);
  take_friction(scope);
  share_small_cells();
  books_.clear_exchange();
  exchange(scope);
  burn(scope);
  Agreed agreed = agree(scope, settle(scope), moved);
  if (agreed.spoilt && !agreed.stuck) {
    if (!share_spoilt(scope)) return Verdict::reject;
    agreed = agree(scope, true, moved);
  }
  if (agreed.stuck) {
    tell_stuck(scope);
    return Verdict::reject;
  }
  fill_dry_cells();
  store(scope);
  return Verdict::good;
}

// Rates of sound and flow in cells of this rank that solids touch; the sweep has rated the others.
template <int D>
typename LevelCoupling<D>::Rates LevelCoupling<D>::rates_of_cells() const {
  const ice::SchemeOptions& o = fluid_->options();
  const ice::mixture::Equilibration laws(o.materials.fluids);
  double deck = 0, flow = 0, sound = 0;
  for_each_own_cell([&](const Cell<D>&, std::size_t i) {
    if (amounts_.touched[i] == 0 || !(amounts_.volume[i] > 0)) return;
    double M[ice::max_materials], V[ice::max_materials], E[ice::max_materials], rho = 0;
    for (std::size_t m = 0; m < o.materials.fluids.size(); ++m) {
      M[m] = settled_.mass[m][i];
      V[m] = o.materials.fluids.size() == 1 ? 1.0 : settled_.filled[m][i];
      E[m] = settled_.energy[m][i];
      rho += M[m];
    }
    const double c = std::sqrt(laws.look({M, V, E}).modulus / rho);
    double sum = 0, all = 0;
    for (std::size_t a = 0; a < D; ++a) {
      const double inverse = 1 / frame_.spacing[o.grid.axes.direction[a]];
      const double u = std::fabs(settled_.momentum[a][i] / rho);
      deck = std::max(deck, (u + o.scheme.sound_speed_factor * c) * inverse);
      sound = std::max(sound, (u + c) * inverse);
      sum += (u + c) * inverse;
      all += u * inverse;
    }
    if (D > 1) sound = std::max(sound, ice::sound_sum_share(o) * sum);
    flow = std::max(flow, all);
  });
  return {deck, flow, sound};
}

template <int D>
Verdict LevelCoupling<D>::limit_step(const StageScope& scope) {
  const std::span<double> maxima =
      fluid_->options().budgets.places.maxima.of(scope.maxima->front());
  const auto include = [&](int slot, double rate) {
    double& own = maxima[static_cast<std::size_t>(slot)];
    own = std::max(own, rate);
  };
  include(ice::StepSlots::deck_rate, rates_.deck);
  include(ice::StepSlots::flow_rate, rates_.flow);
  include(ice::StepSlots::sound_rate, rates_.sound);
  return Verdict::good;
}

template void LevelCoupling<1>::share_small_cells();
template void LevelCoupling<2>::share_small_cells();
template void LevelCoupling<3>::share_small_cells();
template Verdict LevelCoupling<1>::limit_step(const StageScope&);
template Verdict LevelCoupling<2>::limit_step(const StageScope&);
template Verdict LevelCoupling<3>::limit_step(const StageScope&);
template Verdict LevelCoupling<1>::finish_cells(const StageScope&);
template Verdict LevelCoupling<2>::finish_cells(const StageScope&);
template Verdict LevelCoupling<3>::finish_cells(const StageScope&);

}  // namespace sluice::mpmice
