// Forces of the fluid on the surfaces of solids: its pressure and its friction.
#include <algorithm>
#include <cmath>

#include "framework/base/reduction.hpp"
#include "mpmice/geometry/pieces.hpp"
#include "mpmice/step/level_coupling.hpp"

namespace sluice::mpmice {

// On corners of the outer faces: (-(p_w - p_ref) n + t |n|) m_k of each piece, t: friction of the
// fluid. Solids are free of stress at the reference pressure of the deck.
template <int D>
void LevelCoupling<D>::add_forces_on(const SolidSet<D>& s,
                                     std::vector<mpm::CornerForce>& forces) const {
  const bool rubs = fluid_->options().transport.viscous;
  std::array<double, D> per_largest;  // face area over the largest, in which areas are counted
  for (std::size_t d = 0; d < D; ++d)
    per_largest[d] = frame_.face_area(static_cast<int>(d)) / frame_.largest_face();
  KeptArray<std::array<std::array<double, corners_of_face<D>>, D>> sums(s.faces.size());
  s.pieces.for_each(s.faces, [&](std::size_t i, int t, const Piece<D>& piece) {
    // A body that a side of the domain cuts has no surface there.
    if (!frame_.in_domain(frame_.wrapped(piece.cell))) return;
    const std::size_t c = frame_.cells.index(frame_.inside(piece.cell));
    const double p = (fields_.wall_pressure[c] - reference_pressure_) * s.faces.weight_of(i);
    const double size = rubs ? area_of(piece) * s.faces.weight_of(i) : 0.0;
    const double share = overlap_ && fields_.area[c] > 0 ? area_of(piece) / fields_.area[c] : 0.0;
    for (std::size_t d = 0; d < D; ++d) {
      double force = -p * piece.n[d] * frame_.face_area(static_cast<int>(d));
      if (overlap_) force -= p * share * fields_.normal_beyond[d][c] * per_largest[d];
      if (rubs) force += fields_.friction[d][c] * size;
      std::array<double, D> moments = piece.m;
      for (double& m : moments) m *= force;
      add_to_corners<D>(t, moments, sums[i][d]);
    }
  });
  for (std::size_t i = 0; i < sums.size(); ++i)
    for (std::size_t k = 0; k < corners_of_face<D>; ++k) {
      mpm::CornerForce f;
      const std::size_t p = s.faces.particle[i];
      const int corner = s.faces.corner(i, static_cast<int>(k));
      for (int d = 0; d < 3; ++d)
        f.place[d] =
            s.set->column(static_cast<std::size_t>(s.columns->corners + 3 * corner + d))[p];
      for (std::size_t a = 0; a < D; ++a) f.force[frame_.direction[a]] = sums[i][a][k];
      forces.push_back(f);
    }
}

// Of the whole facet, m^2.
template <int D>
double LevelCoupling<D>::area_of(const Piece<D>& piece) const {
  double squares = 0;
  for (std::size_t d = 0; d < D; ++d) {
    const double a = piece.n[d] * frame_.face_area(static_cast<int>(d));
    squares += a * a;
  }
  return std::sqrt(squares);
}

// That of its particle, which may turn, or, where a rule prescribes it, at the middle of the piece.
template <int D>
Vec3 LevelCoupling<D>::velocity_of(const SolidSet<D>& s, std::size_t face,
                                   const Piece<D>& piece) const {
  const mpm::MasterMotion* motion = step_->level(step_->count() - 1).motion_of(s.kind);
  const std::size_t p = s.faces.particle[face];
  const auto v = mpm::read_columns<3>(*s.set, s.columns->velocity);
  const Vec3 middle{v[0][p], v[1][p], v[2][p]};
  const bool turns = s.columns->spin >= 0;
  if (!(piece.s > 0) || (motion == nullptr && !turns)) return middle;
  Vec3 place = s.set->position(p);
  for (std::size_t a = 0; a < D; ++a) {
    const int d = frame_.direction[a];
    place[d] = frame_.anchor[d] + (piece.cell[a] + piece.arm[a] / piece.s) * frame_.spacing[d];
  }
  if (motion != nullptr) return motion->at(place);
  const auto w = mpm::read_columns<3>(*s.set, s.columns->spin);
  return middle + cross({w[0][p], w[1][p], w[2][p]}, place - s.set->position(p));
}

template <int D>
bool LevelCoupling<D>::all_rigid() const {
  const auto& kinds = solids_->scene().materials;
  return std::all_of(kinds.begin(), kinds.end(), [](const auto& m) { return m.rigid; });
}

// The impulse of all walls on the fluid, N s: dt sum p_w (a_- - a_+) over its cells, also where
// bodies overlap and a face to a cell without fluid is not covered. Of this rank's cells.
template <int D>
void LevelCoupling<D>::add_forces_of_walls(std::size_t d, double dt, ExactSum& sum) const {
  const double impulse = dt * frame_.face_area(static_cast<int>(d));
  for_each_own_cell([&](const Cell<D>& c, std::size_t i) {
    if (!wet(i)) return;
    const auto closed = [&](const Cell<D>& face, Cell<D> beyond) {
      const bool side = !frame_.in_domain(beyond) && !frame_.periodic[d];
      beyond = frame_.inside(beyond);
      return side || wet(frame_.cells.index(beyond)) ? fields_.covered[d][frame_.cells.index(face)]
                                                     : 1.0;
    };
    Cell<D> below = c, above = c;
    --below[d];
    ++above[d];
    sum.add(fields_.wall_pressure[i] * (closed(c, below) - closed(above, above)) * impulse);
  });
}

// Where bodies overlap, faces are covered once and surfaces are counted twice: what the fluid gives
// to walls, p_w (a_- - a_+), and what surfaces get, p_w n, would differ.
template <int D>
void LevelCoupling<D>::find_overlaps() {
  constexpr double cleaned = 1e-6;  // well above what cleaning volume fractions and faces changes
  overlap_ = false;
  if (all_rigid()) return;
  for (std::size_t d = 0; d < D; ++d) {
    const Column& covered = fields_.covered[d];
    Column& beyond = fields_.normal_beyond[d];
    beyond.assign(frame_.cells.size(), 0.0);
    for_each_cell_near([&](const Cell<D>& c, std::size_t i) {
      Cell<D> above = c;
      ++above[d];
      const double more = covered[i] - covered[frame_.cells.index(above)] - fields_.normal[d][i];
      if (!(std::fabs(more) > cleaned)) return;
      beyond[i] = more;
      overlap_ = true;
    });
  }
}

// The impulse that comes from outside: of what holds or drives rigid bodies against the fluid; and
// of sides of the domain that cut other bodies, which push these with the reference pressure, of
// which their stress is free. (Around a body that no side cuts it sums to none.) And the force on
// rigid bodies.
template <int D>
void LevelCoupling<D>::book_outside(const StageScope& scope) {
  using Of = mpm::StepSums;
  const bool rubs = fluid_->options().transport.viscous;
  const double dt = scope.step.dt;
  books_.clear_forces();
  ExactSum none;
  // Where all are rigid the impulse is that of the walls on the fluid, without friction.
  const auto impulse = [&](std::size_t d) -> ExactSum& {
    return all_rigid() ? none : books_.of_forces(Of::impulse_x + frame_.direction[d]);
  };
  const auto reaction = [&](std::size_t d) -> ExactSum& {
    return books_.of_forces(Of::reaction_x + frame_.direction[d]);
  };
  for (const SolidSet<D>& s : sets_) {
    const bool rigid = solids_->scene().materials[static_cast<std::size_t>(s.kind)].rigid;
    s.pieces.for_each(s.faces, [&](std::size_t i, int, const Piece<D>& piece) {
      const Cell<D> c = frame_.wrapped(piece.cell);
      if (!frame_.in_domain(c)) return;
      const std::size_t n = frame_.cells.index(c);
      const double weight = s.faces.weight_of(i);
      const double size = rigid && rubs ? area_of(piece) * piece.s * weight : 0.0;
      const Vec3 v = rigid && rubs ? velocity_of(s, i, piece) : Vec3{};
      for (std::size_t d = 0; d < D; ++d) {
        const double area = piece.area[d] * frame_.face_area(static_cast<int>(d));
        if (!rigid) {
          impulse(d).add(reference_pressure_ * weight * (dt * area));
          continue;
        }
        impulse(d).add(fields_.wall_pressure[n] * (dt * area));
        reaction(d).add(-(fields_.wall_pressure[n] - reference_pressure_) * area);
        if (!rubs) continue;
        const double force = size * fields_.friction[d][n];
        reaction(d).add(force);
        books_.of_forces(Of::impulse_x + frame_.direction[d]).add(-force * dt);
        books_.of_forces(Of::work).add(-force * dt * v[frame_.direction[d]]);
      }
    });
  }
  for (std::size_t d = 0; d < D && all_rigid(); ++d)
    add_forces_of_walls(d, dt, books_.of_forces(Of::impulse_x + frame_.direction[d]));
}

template <int D>
Verdict LevelCoupling<D>::press_on_solids(const StageScope& scope) {
  // Solids lie on the finest level.
  corner_forces_.resize(static_cast<std::size_t>(step_->count()));
  for (auto& of_level : corner_forces_) {
    of_level.resize(solids_->scene().materials.size());
    for (auto& of_kind : of_level) of_kind.clear();
  }
  for (const SolidSet<D>& s : sets_) {
    if (solids_->scene().materials[static_cast<std::size_t>(s.kind)].rigid) continue;
    add_forces_on(s, corner_forces_.back()[static_cast<std::size_t>(s.kind)]);
  }
  step_->add_corner_forces(scope, corner_forces_);
  book_outside(scope);
  return Verdict::good;
}

template Vec3 LevelCoupling<1>::velocity_of(const SolidSet<1>&, std::size_t, const Piece<1>&) const;
template Vec3 LevelCoupling<2>::velocity_of(const SolidSet<2>&, std::size_t, const Piece<2>&) const;
template Vec3 LevelCoupling<3>::velocity_of(const SolidSet<3>&, std::size_t, const Piece<3>&) const;
template void LevelCoupling<1>::find_overlaps();
template void LevelCoupling<2>::find_overlaps();
template void LevelCoupling<3>::find_overlaps();
template bool LevelCoupling<1>::all_rigid() const;
template bool LevelCoupling<2>::all_rigid() const;
template bool LevelCoupling<3>::all_rigid() const;
template Verdict LevelCoupling<1>::press_on_solids(const StageScope&);
template Verdict LevelCoupling<2>::press_on_solids(const StageScope&);
template Verdict LevelCoupling<3>::press_on_solids(const StageScope&);

}  // namespace sluice::mpmice
