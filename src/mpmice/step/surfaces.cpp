// Surfaces of solids in cells: geometry, and means over the pieces in each cell.
#include <cmath>

#include "framework/base/reduction.hpp"
#include "ice/fluid/labels.hpp"
#include "mpmice/geometry/pieces.hpp"
#include "mpmice/step/fluid_cells.hpp"
#include "mpmice/step/level_coupling.hpp"
#include "mpmice/step/partly_burned.hpp"

namespace sluice::mpmice {
namespace {

// -n.sigma.n of a particle.
template <int D>
double pressure_along(const Frame<D>& frame, const std::array<const double*, 6>& stress,
                      std::size_t p, const std::array<double, D>& n) {
  constexpr int at[3][3] = {{0, 5, 4}, {5, 1, 3}, {4, 3, 2}};
  double sum = 0;
  for (std::size_t a = 0; a < D; ++a)
    for (std::size_t b = 0; b < D; ++b)
      sum += n[a] * n[b] *
             stress[static_cast<std::size_t>(at[frame.direction[a]][frame.direction[b]])][p];
  return -sum;
}

double at_least_something(double scale) {
  return scale > 0 ? scale : 1.0;
}

}  // namespace

template <int D>
void LevelCoupling<D>::list_sets(const StageScope& scope) {
  ParticleCloud& cloud = *scope.particles;
  const int level = scope.levels.front()->level().index;
  std::size_t n = 0;
  for (int k = 0; k < static_cast<int>(solids_->scene().materials.size()); ++k) {
    ParticleStore& store = cloud.store(k);
    for (int b = 0; b < store.box_count(level); ++b, ++n) {
      if (n == sets_.size()) sets_.emplace_back();
      SolidSet<D>& s = sets_[n];
      s.kind = k;
      s.columns = &solids_->carried()[static_cast<std::size_t>(k)].columns;
      s.part = solids_->carried()[static_cast<std::size_t>(k)].filled;
      s.surface_column = solids_->carried()[static_cast<std::size_t>(k)].surface;
      s.flame_column = solids_->carried()[static_cast<std::size_t>(k)].flame;
      s.present = &store.set(level, b);
      s.set = s.present;
      s.next = &store.next(level, b);
      s.parted.clear();
      s.dropped.clear();
      s.outer.clear();
    }
  }
  sets_.resize(n);
}

// Who shares blocks follows from the boxes of the level.
template <int D>
void LevelCoupling<D>::share_blocks(const StageScope& scope) {
  std::vector<RankBox<D>> boxes = boxes_of_ranks<D>(frame_, scope.levels.front()->level());
  if (sharers_ == nullptr || !sharers_->fits(boxes))
    sharers_ = std::make_unique<BlockSharers<D>>(std::move(boxes), frame_.all_sides(),
                                                 frame_.room(), *scope.ranks);
}

// Cells of this rank's boxes: books count no others. And how far all others lie from these, as far
// as any stage asks.
template <int D>
void LevelCoupling<D>::mark_own_cells(const StageScope& scope) {
  own_.assign(frame_.cells.size(), 0);
  for (const GridBox& box : scope.levels.front()->state().local_boxes())
    frame_.for_each_held(box.cells, [&](IntVec3, std::size_t i) { own_[i] = 1; });
  distance_.clear();
  if (scope.ranks->size() == 1) return;
  constexpr std::uint8_t beyond = 255;
  distance_.assign(frame_.cells.size(), beyond);
  CellMask within = own_;
  for (std::uint8_t reach = 0; reach <= farthest_asked; ++reach) {
    if (reach > 0) dilate(frame_, 1, within);
    for (std::size_t i = 0; i < within.size(); ++i)
      if (within[i] != 0 && distance_[i] == beyond) distance_[i] = reach;
  }
}

template <int D>
void LevelCoupling<D>::add_cells_of_solids(double dt) {
  for (SolidSet<D>& s : sets_) {
    s.moves = moves_of<D>(frame_, *s.columns, *s.set, dt);
    const CornerColumns<D> corners = corner_columns<D>(frame_, *s.columns, *s.set);
    add_cells_of<D>(frame_, corners, s.set->size(), s.moves, occupied_);
  }
}

// Cells that the last step left closed in part, if only as gaps that no fluid has reached.
template <int D>
void LevelCoupling<D>::add_cells_kept_closed(const StageScope& scope) {
  const Warehouse& state = scope.levels.front()->state();
  const int slot = state.find(ice::labels().solid_fraction, fluid_->options().place(0));
  for (int b = 0; b < static_cast<int>(state.local_boxes().size()); ++b) {
    const RealView fraction = state.view(slot, 0, b);
    state.for_each_part_other(slot, b, 0.0, [&](const IndexBox& part) {
      for_each_cell(part, [&](IntVec3 at) {
        if (fraction(at) == 0) return;
        const Cell<D> c = frame_.cell(at);
        CellBox<D> one{c, c};
        for (int& upper : one.upper) ++upper;
        occupied_.add(one);
      });
    });
  }
}

// theta and a at one end of the step, as found.
template <int D>
void LevelCoupling<D>::take_geometry(SolidInCells<D>& found, Column& theta,
                                     std::array<Column, D>& covered) {
  theta = std::move(found.theta);
  covered = std::move(found.a);
  clean_volume_fractions(theta);
  for (Column& a : covered) clean_covered_parts(a);
}

// With inner faces where particles have burned in part.
template <int D>
void LevelCoupling<D>::find_all_faces(const StageScope& scope, bool moved) {
  if (burns_.empty()) {
    for (SolidSet<D>& s : sets_) {
      find_faces<D>(frame_, s, moved, outer_faces_of<D>(s));
      if (!moved) s.pieces.cut(s.faces);  // they stay the same until the end
    }
    return;
  }
  PartlyBurned<D> burned;
  burned.find(frame_, sets_, moved, *scope.ranks);
  for (SolidSet<D>& s : sets_) {
    find_faces<D>(frame_, s, moved, burned.faces_in_sums(frame_, s));
    s.pieces.cut(s.faces);
  }
}

// What the last step left is what this one begins with: the geometry, but for pockets that are
// kept open and gaps that hold no fluid.
template <int D>
void LevelCoupling<D>::tell_kept_fractions(const StageScope& scope) {
  kept_.begin(frame_.cells, 1);
  const LevelSolver& level = *scope.levels.front();
  const FluidCells fluid(*fluid_, level.state());
  for (int b = 0; b < static_cast<int>(level.state().local_boxes().size()); ++b) {
    const FluidBox cells = fluid.box(b);
    frame_.for_each_held(level.state().local_boxes()[static_cast<std::size_t>(b)].cells,
                         [&](IntVec3 at, std::size_t i) { kept_.put(0, i, cells.fraction(at)); });
  }
}

template <int D>
Verdict LevelCoupling<D>::find_surfaces(const StageScope& scope) {
  list_sets(scope);
  occupied_.begin(frame_.room());
  add_cells_of_solids(scope.step.dt);
  add_cells_kept_closed(scope);
  occupied_.grow();
  if (scope.ranks->size() > 1) {
    share_blocks(scope);
    occupied_.join(*sharers_, Frame<D>::reach);
  }
  frame_.look_at(occupied_, sharers_.get());
  mark_own_cells(scope);
  for (SolidSet<D>& s : sets_) read_filled<D>(s);
  find_all_faces(scope, false);
  geometry_.begin_at_start(frame_, sets_);
  tell_kept_fractions(scope);
  tell_fluid_states(scope, false);
  sum_over_surfaces(scope);
  share_sums<D>(
      {&geometry_.free_cells(), &geometry_.surfaces(), &kept_.sums(), &means_, &known_.sums()},
      *scope.ranks);
  SolidInCells<D> found;
  geometry_.finish_at_start(frame_, sets_, scope.ranks, found);
  fields_.normal = std::move(found.n);
  take_geometry(found, fields_.theta, fields_.covered);
  for_each_cell_near([&](const Cell<D>&, std::size_t i) { fields_.theta[i] = kept_.value(0, i); });
  mean_over_surfaces();
  find_overlaps();
  find_pressures(scope, false);
  return Verdict::good;
}

// Velocity, pressure -n.sigma.n, compliance 1/(rho c) and 1/rho of the particles behind the
// surface, by area; rigid bodies have neither compliance nor 1/rho.
template <int D>
void LevelCoupling<D>::sum_over_surfaces(const StageScope& scope) {
  KeptArray<double> wave(solids_->scene().materials.size());
  double least = 1e300;
  for (std::size_t a = 0; a < D; ++a) least = std::min(least, frame_.spacing[frame_.direction[a]]);
  for (std::size_t k = 0; k < wave.size(); ++k)
    wave[k] = step_->level(step_->count() - 1).body(static_cast<int>(k)).rates.wave * least;
  SurfaceScales most;
  const auto compliance = [&](const SolidSet<D>& s, std::size_t p) {
    const auto k = static_cast<std::size_t>(s.kind);
    if (solids_->scene().materials[k].rigid || !(wave[k] > 0)) return 0.0;
    const double rho = s.set->column(static_cast<std::size_t>(s.columns->mass))[p] /
                       s.set->column(static_cast<std::size_t>(s.columns->volume))[p];
    return 1 / (rho * wave[k]);
  };
  const auto inverse_density = [&](const SolidSet<D>& s, std::size_t p) {
    return compliance(s, p) * wave[static_cast<std::size_t>(s.kind)];
  };
  for (const SolidSet<D>& s : sets_) {
    const mpm::MasterMotion* motion = step_->level(step_->count() - 1).motion_of(s.kind);
    const auto stress = mpm::read_columns<6>(*s.set, s.columns->stress);
    const auto include = [&](double u) { most.velocity = std::max(most.velocity, std::fabs(u)); };
    for (const std::uint32_t p : s.faces.particle) {
      for (const int d : frame_.direction)
        include(s.set->column(static_cast<std::size_t>(s.columns->velocity + d))[p]);
      for (int k = 0; k < (1 << D) && motion != nullptr; ++k) {
        Vec3 corner = s.set->position(p);
        for (const int d : frame_.direction)
          corner[d] = s.set->column(static_cast<std::size_t>(s.columns->corners + 3 * k + d))[p];
        for (const int d : frame_.direction) include(motion->at(corner)[d]);
      }
      for (const double* e : stress) most.pressure = std::max(most.pressure, 3 * std::fabs(e[p]));
      most.compliance = std::max(most.compliance, compliance(s, p));
      most.inverse_density = std::max(most.inverse_density, inverse_density(s, p));
    }
  }
  Reduction all;
  const auto v = all.add_maximum(most.velocity), p_slot = all.add_maximum(most.pressure),
             y = all.add_maximum(most.compliance), sparse = all.add_maximum(most.inverse_density),
             z = all.add_maximum(highest_impedance());
  scope.ranks->reduce(all);
  may_be_light_ =
      all.maximum(z) * scope.step.dt * most_cells_in_a_length() * all.maximum(sparse) > 1;
  scales_ = {at_least_something(all.maximum(v)), at_least_something(all.maximum(p_slot)),
             at_least_something(all.maximum(y)), at_least_something(all.maximum(sparse))};
  const SurfaceScales& scale = scales_;
  using Lanes = SurfaceLanes<D>;
  const bool rubs = fluid_->options().transport.viscous;
  CellSums<D>& sums = means_;
  sums.begin(frame_.cells, Lanes::count(rubs));
  std::array<double, D> of_largest;
  for (std::size_t a = 0; a < D; ++a)
    of_largest[a] = frame_.face_area(static_cast<int>(a)) / frame_.largest_face();
  for (const SolidSet<D>& s : sets_) {
    if (s.faces.size() == 0) continue;
    const auto stress = mpm::read_columns<6>(*s.set, s.columns->stress);
    s.pieces.for_each(s.faces, [&](std::size_t i, int, const Piece<D>& piece) {
      const std::size_t p = s.faces.particle[i], c = frame_.cells.index_to_add(piece.cell);
      std::array<double, D> unit = piece.n;
      double size = 0;
      for (std::size_t a = 0; a < D; ++a) {
        unit[a] *= of_largest[a];
        size += unit[a] * unit[a];
      }
      size = std::sqrt(size);
      if (!(size > 0)) return;
      for (double& n : unit) n /= size;
      const double A = size * piece.s * s.faces.weight_of(i);
      sums.lane(Lanes::area)[c] += to_sum(A);
      sums.lane(Lanes::pressure)[c] +=
          to_sum(A * (pressure_along<D>(frame_, stress, p, unit) / scale.pressure));
      sums.lane(Lanes::soft)[c] += to_sum(A * (compliance(s, p) / scale.compliance));
      sums.lane(Lanes::light)[c] += to_sum(A * (inverse_density(s, p) / scale.inverse_density));
      const Vec3 u = velocity_of(s, i, piece);
      for (int a = 0; a < D; ++a)
        sums.lane(Lanes::velocity + a)[c] +=
            to_sum(A * (u[frame_.direction[static_cast<std::size_t>(a)]] / scale.velocity));
      for (int a = 0; a < D && rubs; ++a)
        sums.lane(Lanes::place + a)[c] +=
            to_sum(size * s.faces.weight_of(i) * piece.arm[static_cast<std::size_t>(a)]);
    });
  }
}

// Once the sums are those of all ranks.
template <int D>
void LevelCoupling<D>::mean_over_surfaces() {
  using Lanes = SurfaceLanes<D>;
  const bool rubs = fluid_->options().transport.viscous;
  for (int lane = 0; lane < means_.lanes() && frame_.sides().any(); ++lane)
    means_.fold(frame_.sides(), lane);
  means_.values(Lanes::area, fields_.area);
  const auto mean = [&](int lane, double factor, Column& to) {
    means_.values(lane, to);
    for (std::size_t i = 0; i < to.size(); ++i)
      to[i] = fields_.area[i] > 0 ? to[i] / fields_.area[i] * factor : 0.0;
  };
  mean(Lanes::pressure, scales_.pressure, fields_.solid_pressure);
  mean(Lanes::soft, scales_.compliance, fields_.compliance);
  mean(Lanes::light, scales_.inverse_density, fields_.inverse_density);
  for (int a = 0; a < D; ++a)
    mean(Lanes::velocity + a, scales_.velocity,
         fields_.surface_velocity[static_cast<std::size_t>(a)]);
  for (int a = 0; a < D && rubs; ++a)
    mean(Lanes::place + a, 1, fields_.surface_place[static_cast<std::size_t>(a)]);
}

template void LevelCoupling<1>::list_sets(const StageScope&);
template void LevelCoupling<2>::list_sets(const StageScope&);
template void LevelCoupling<3>::list_sets(const StageScope&);
template void LevelCoupling<1>::find_all_faces(const StageScope&, bool);
template void LevelCoupling<2>::find_all_faces(const StageScope&, bool);
template void LevelCoupling<3>::find_all_faces(const StageScope&, bool);
template void LevelCoupling<1>::take_geometry(SolidInCells<1>&, Column&, std::array<Column, 1>&);
template void LevelCoupling<2>::take_geometry(SolidInCells<2>&, Column&, std::array<Column, 2>&);
template void LevelCoupling<3>::take_geometry(SolidInCells<3>&, Column&, std::array<Column, 3>&);
template Verdict LevelCoupling<1>::find_surfaces(const StageScope&);
template Verdict LevelCoupling<2>::find_surfaces(const StageScope&);
template Verdict LevelCoupling<3>::find_surfaces(const StageScope&);

}  // namespace sluice::mpmice
