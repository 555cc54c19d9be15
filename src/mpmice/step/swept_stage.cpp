// What the solids do to cells and faces in the step, told to the sweep of the fluid.
#include <fmt/format.h>

#include <cmath>

#include "framework/base/reduction.hpp"
#include "ice/fluid/labels.hpp"
#include "mpmice/step/level_coupling.hpp"

namespace sluice::mpmice {

// Do the solids of this rank end where the arrays have room for them.
template <int D>
bool LevelCoupling<D>::stays_near() const {
  for (const SolidSet<D>& s : sets_) {
    const CornerColumns<D> from = corner_columns<D>(frame_, *s.columns, *s.set),
                           to = corner_columns<D>(frame_, *s.columns, *s.next);
    for (std::size_t a = 0; a < D; ++a) {
      const double width = frame_.spacing[frame_.direction[a]];
      int far = 0;
      for (std::size_t k = 0; k < from.size(); ++k) {
        const double *x = from[k][a], *y = to[k][a];
        for (std::size_t p = 0; p < s.set->size(); ++p)
          far |= std::fabs(y[p] - x[p]) <= s.moves[p] * width ? 0 : 1;
      }
      if (far != 0) return false;
    }
  }
  return true;
}

template <int D>
bool LevelCoupling<D>::on_any(const StageScope& scope, bool here) {
  Reduction all;
  const auto any = all.add_any(here);
  scope.ranks->reduce(all);
  return all.any(any);
}

template <int D>
Verdict LevelCoupling<D>::find_swept_volumes(const StageScope& scope) {
  if (on_any(scope, !stays_near())) {
    *scope.reason = fmt::format(
        "a solid moves by more than {} cells, or by more than {} though it began slowly",
        Frame<D>::most_move, Frame<D>::slow_move);
    return Verdict::reject;
  }
  find_all_faces(scope, true);
  SolidInCells<D> at_end;
  SweptVolumes<D> swept;
  geometry_.find_moved(frame_, sets_, *scope.ranks, at_end, swept);
  take_geometry(at_end, fields_.theta_next, fields_.covered_next);
  fields_.mean_covered = std::move(swept.A);
  fields_.swept = std::move(swept.C);
  for (Column& a : fields_.mean_covered) clean_covered_parts(a);
  keep_pockets();
  close_cells_at_sides();
  mean_over_cells(scope);
  tell_fluid(scope);
  return Verdict::good;
}

// What surfaces that have moved from theta to these fractions work on the fluid, by pressure and
// friction; not where a gap waits for fluid. Of rigid solids it comes from outside (that of
// friction is booked with its force).
template <int D>
void LevelCoupling<D>::book_surface_work(const StageScope& scope, const Column& moved) {
  const bool rigid = all_rigid(), rubs = fluid_->options().transport.viscous;
  books_.clear_work();
  ExactSum& work = books_.of_work(rigid ? mpm::StepSums::work : mpm::StepSums::surface_work);
  for_each_own_cell([&](const Cell<D>&, std::size_t i) {
    const bool waits = fields_.theta[i] >= 1 && fields_.theta_next[i] >= 1;
    if (!waits && swept_with_solid_[i] != 0)
      work.add(fields_.wall_pressure[i] * (moved[i] - fields_.theta[i]) * frame_.cell_volume);
    for (std::size_t d = 0; d < D && rubs && !rigid; ++d)
      work.add(-fields_.friction[d][i] * fields_.area[i] * fields_.surface_velocity[d][i] *
               (scope.step.dt * frame_.largest_face()));
  });
  if (!rigid) add_growth(work);
}

// Less what the reference pressure works on them as they grow: what the totals count, also where
// bodies overlap.
template <int D>
void LevelCoupling<D>::add_growth(ExactSum& work) const {
  for (const SolidSet<D>& s : sets_) {
    const auto column = static_cast<std::size_t>(s.columns->volume);
    const double *before = s.set->column(column), *after = s.next->column(column);
    for (std::size_t p = 0; p < s.set->size(); ++p) {
      work.add(-reference_pressure_ * after[p]);
      work.add(reference_pressure_ * before[p]);
    }
  }
}

// A pocket of fluid that solids close, with nobody beside it to take what it holds, is kept open by
// a little.
template <int D>
void LevelCoupling<D>::keep_pockets() {
  constexpr double least_pocket = 1e-3;  // of a cell
  KeptArray<std::size_t> pockets;
  for_each_cell_near([&](const Cell<D>& c, std::size_t i) {
    if (!wet(i) || fields_.theta_next[i] < 1) return;
    bool taken = false;
    for_each_neighbour(c, [&](std::size_t j) { taken |= fields_.theta_next[j] < 1 - 1e-8; });
    if (!taken) pockets.push_back(i);
  });
  for (const std::size_t i : pockets)
    fields_.theta_next[i] = 1 - std::min(least_pocket, 1 - fields_.theta[i]);
}

// A cell without fluid on a side of the domain that a body covers all step long has no open faces,
// though the side has taken particles that close them.
template <int D>
void LevelCoupling<D>::close_cells_at_sides() {
  const auto whole = [&](std::size_t d, std::size_t face) {
    return fields_.covered[d][face] >= 1 && fields_.covered_next[d][face] >= 1 &&
           fields_.mean_covered[d][face] >= 1;
  };
  KeptArray<Cell<D>> closed;
  for_each_cell_near([&](const Cell<D>& c, std::size_t i) {
    if (fields_.theta[i] < 1 || fields_.theta_next[i] < 1) return;
    for (std::size_t d = 0; d < D; ++d) {
      if (frame_.periodic[d]) continue;
      Cell<D> above = c;
      ++above[d];
      if ((c[d] == frame_.domain.lower[d] && whole(d, i)) ||
          (above[d] == frame_.domain.upper[d] && whole(d, frame_.cells.index(above))))
        closed.push_back(c);
    }
  });
  for (const Cell<D>& c : closed)
    for (std::size_t d = 0; d < D; ++d) {
      Cell<D> above = c;
      ++above[d];
      for (const std::size_t face : {frame_.cells.index(c), frame_.cells.index(above)})
        for (auto* covered : {&fields_.covered, &fields_.covered_next, &fields_.mean_covered})
          (*covered)[d][face] = 1;
    }
}

// Cells in which the middles of particles lie whose parts cells with fluid may ask for, or their
// neighbours. Solves and tracers, which move with solids that overtake them, ask everywhere.
template <int D>
CellMask LevelCoupling<D>::cells_beside_fluid() const {
  if (fluid_->options().scheme.implicit || fluid_->tracers() != nullptr)
    return CellMask(frame_.cells.size(), 1);
  CellMask mask(frame_.cells.size(), 0);
  for_each_cell_near([&](const Cell<D>&, std::size_t i) { mask[i] = has_solid(i) ? 1 : 0; });
  dilate(frame_, 1, mask);
  for_each_cell_near([&](const Cell<D>&, std::size_t i) {
    if (fields_.theta[i] >= 1 && fields_.theta_next[i] >= 1) mask[i] = 0;
  });
  dilate(frame_, 2, mask);  // the cell beside, and the middle of a part in it
  return mask;
}

// Of the particles of all solids and ranks.
template <int D>
double LevelCoupling<D>::mass_of_heaviest() const {
  double most = 1e-300;
  const mpm::SolidStep& solids = step_->level(step_->count() - 1);
  for (const mpm::Body& body : solids.bodies()) most = std::max(most, body.rates.mass);
  return most;
}

// What any of them covers in the step along a direction, m/s.
template <int D>
double LevelCoupling<D>::fastest_way(double dt) const {
  double width = 0;
  for (const int d : frame_.direction) width = std::max(width, frame_.spacing[d]);
  return std::max(step_->level(step_->count() - 1).outcome().travel * width / dt, 1e-300);
}

// Mass of the solids in cells beside fluid and their velocity, from a 2^D-th of each particle half
// way between its middle and each corner; velocities are those of the step, (x' - x)/dt.
template <int D>
void LevelCoupling<D>::mean_over_cells(const StageScope& scope) {
  const double dt = scope.step.dt;
  const auto speed = [&](const SolidSet<D>& s, std::size_t p, int d) {
    return (s.next->coordinate(d)[p] - s.set->coordinate(d)[p]) / dt;
  };
  const double most_mass = mass_of_heaviest(), most_speed = fastest_way(dt);
  CellSums<D> sums;
  sums.begin(frame_.cells, 1 + D);
  const CellMask beside = cells_beside_fluid();
  for (const SolidSet<D>& s : sets_) {
    const CornerColumns<D> x = corner_columns<D>(frame_, *s.columns, *s.set);
    const double* m = s.set->column(static_cast<std::size_t>(s.columns->mass));
    for (std::size_t p = 0; p < s.set->size(); ++p) {
      if (beside[frame_.cells.index(middle_of(*s.set, p))] == 0) continue;
      const std::uint64_t share = to_sum(m[p] / most_mass / most_parts<D>);
      std::array<std::uint64_t, D> moving;
      for (std::size_t a = 0; a < D; ++a)
        moving[a] = to_sum(m[p] / most_mass / most_parts<D> *
                           (speed(s, p, frame_.direction[a]) / most_speed));
      for_each_part<D>(frame_, x, *s.set, p, [&](std::size_t cell) {
        sums.lane(0)[cell] += share;
        for (std::size_t a = 0; a < D; ++a) sums.lane(1 + static_cast<int>(a))[cell] += moving[a];
      });
    }
  }
  sums.sum_over_ranks(*scope.ranks);
  sums.values(0, fields_.mass);
  for (std::size_t a = 0; a < D; ++a) {
    Column& v = fields_.velocity[a];
    sums.values(1 + static_cast<int>(a), v);
    for (std::size_t i = 0; i < v.size(); ++i)
      v[i] = fields_.mass[i] > 0 ? v[i] / fields_.mass[i] * most_speed : 0.0;
  }
  for (double& mass : fields_.mass)
    mass *= most_mass * (most_parts<D> / (1 << D)) / frame_.cell_volume;
}

template bool LevelCoupling<1>::on_any(const StageScope&, bool);
template double LevelCoupling<1>::mass_of_heaviest() const;
template bool LevelCoupling<2>::on_any(const StageScope&, bool);
template double LevelCoupling<2>::mass_of_heaviest() const;
template bool LevelCoupling<3>::on_any(const StageScope&, bool);
template double LevelCoupling<3>::mass_of_heaviest() const;
template void LevelCoupling<1>::book_surface_work(const StageScope&, const Column&);
template void LevelCoupling<2>::book_surface_work(const StageScope&, const Column&);
template void LevelCoupling<3>::book_surface_work(const StageScope&, const Column&);
template Verdict LevelCoupling<1>::find_swept_volumes(const StageScope&);
template Verdict LevelCoupling<2>::find_swept_volumes(const StageScope&);
template Verdict LevelCoupling<3>::find_swept_volumes(const StageScope&);

}  // namespace sluice::mpmice
