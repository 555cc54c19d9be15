// The pressure between the fluid of a cell and the solid in it, and its force on the solid.
//
//   du = (u_s - u).nhat,  z = rho (c + A max(0, du)),  w = 1/(1 + z y)   (A shock slope dUs/du)
//   p_w = p + z w du + (1 - w) |n| (p_s - p),  at least p/10
// with nhat out of the solid, y = 1/(rho_s c_s) (0 where rigid) and p_s the pressure of the solid
// behind the surface: the Riemann problem of fluid and solid along the normal (mpmice_scheme, step
// 3). nhat is smoothed over the cells around, which stairs need; forces take n itself.
#include <algorithm>
#include <cmath>

#include "framework/base/reduction.hpp"
#include "ice/fluid/labels.hpp"
#include "ice/fluid/law_row.hpp"
#include "mpmice/geometry/pieces.hpp"
#include "mpmice/step/fluid_cells.hpp"
#include "mpmice/step/level_coupling.hpp"

namespace sluice::mpmice {
namespace {

constexpr double least_share = 0.1;  // of the fluid's pressure that is left on a wall

}  // namespace

template <int D>
void LevelCoupling<D>::find_pressures(const StageScope& scope, bool solved) {
  constexpr int density = 0, pressure = 1, speed = 2, velocity = 3;
  known_.begin(frame_.box, velocity + D);
  const LevelSolver& level = *scope.levels.front();
  const FluidCells fluid(*fluid_, level.state());
  const WorkPressure of_solve(*fluid_, level.state(), solved);
  for (int b = 0; b < static_cast<int>(level.state().local_boxes().size()); ++b) {
    const FluidBox cells = fluid.box(b);
    const WorkPressure::Box work = of_solve.box(b);
    for_each_cell(frame_.held(level.state().local_boxes()[static_cast<std::size_t>(b)].cells),
                  [&](IntVec3 at) {
                    const std::size_t i = frame_.box.index(frame_.cell(at));
                    if (!wet(i)) return;
                    const FluidState s = cells.at(at);
                    known_.put(density, i, s.rho);
                    known_.put(pressure, i, work.at(at, s.pressure));
                    known_.put(speed, i, s.sound);
                    for (int a = 0; a < D; ++a)
                      known_.put(velocity + a, i,
                                 s.velocity[frame_.direction[static_cast<std::size_t>(a)]]);
                  });
  }
  known_.tell_all(*scope.ranks);
  Column rho, sound;
  std::array<Column, D> u;
  known_.take(density, rho);
  known_.take(pressure, fields_.pressure);
  known_.take(speed, sound);
  for (int a = 0; a < D; ++a) known_.take(velocity + a, u[static_cast<std::size_t>(a)]);
  smooth_normals();
  press_on_walls(rho, sound, u, scope.step.dt);
  fill_dry(fields_.wall_pressure);
}

template <int D>
void LevelCoupling<D>::smooth_normals() {
  for (Column& s : fields_.smooth) s.assign(frame_.box.cells(), 0.0);
  for_each_cell_near([&](const Cell<D>& c, std::size_t i) {
    if (!(fields_.area[i] > 0)) return;
    constexpr int around = D == 1 ? 3 : D == 2 ? 9 : 27;
    for (int n = 0; n < around; ++n) {
      Cell<D> other = c;
      double weight = 1;
      for (int d = 0, rest = n; d < D; ++d, rest /= 3) {
        const int step = rest % 3 - 1;
        other[static_cast<std::size_t>(d)] += step;
        weight *= step == 0 ? 2 : 1;
      }
      other = frame_.wrapped(other);
      if (!frame_.in_domain(other)) continue;
      const std::size_t j = frame_.box.index(other);
      if (!wet(j)) continue;
      for (std::size_t d = 0; d < D; ++d) fields_.smooth[d][i] += weight * fields_.normal[d][j];
    }
  });
}

template <int D>
void LevelCoupling<D>::press_on_walls(const Column& rho, const Column& sound,
                                      const std::array<Column, D>& u, double dt) {
  fields_.wall_pressure = fields_.pressure;
  for_each_cell_near([&](const Cell<D>& c, std::size_t i) {
    if (!wet(i) || !(fields_.area[i] > 0)) return;
    double size = 0, whole = 0, du = 0;
    for (std::size_t d = 0; d < D; ++d) {
      size += fields_.smooth[d][i] * fields_.smooth[d][i];
      whole += fields_.normal[d][i] * fields_.normal[d][i];
    }
    if (!(size > 0) || !(whole > 0)) return;
    size = std::sqrt(size);
    for (std::size_t d = 0; d < D; ++d)
      du += (fields_.surface_velocity[d][i] - u[d][i]) * (fields_.smooth[d][i] / size);
    const double p = pressure_beside_wall(c, i, size);
    const double z = std::min(rho[i] * (sound[i] + shock_slope_ * std::max(0.0, du)),
                              most_impedance(i, size, rho[i], dt));
    const double w = 1 / (1 + z * fields_.compliance[i]);
    const double faced = std::min(1.0, std::sqrt(whole));
    if (D == 1) du *= faced;
    const double pw =
        p + z * w * du + (1 - w) * faced * (fields_.solid_pressure[i] + reference_pressure_ - p);
    fields_.wall_pressure[i] = p > 0 ? std::max(pw, least_share * p) : pw;
  });
}

// What the fluid of a cell can resist with in a semi-implicit step, rho dx/(2 dt): of longer ones
// sound crosses it, and what remains of z du is in the pressure that was solved for
// (ice/pressure/predictions.cpp, j).
template <int D>
double LevelCoupling<D>::most_impedance(std::size_t i, double size, double rho, double dt) const {
  if (!fluid_->options().implicit) return 1e300;
  double per_dx = 0;
  for (std::size_t d = 0; d < D; ++d)
    per_dx += std::fabs(fields_.smooth[d][i]) / size / frame_.spacing[frame_.direction[d]];
  return 0.5 * std::max(0.5, 1 - fields_.theta[i]) * rho / (dt * per_dx);
}

// The fluid's pressure half a cell from the wall along nhat. That of a cell is of its centre, which
// the wall may have passed: of a semi-implicit step
//   p = X + V_s sum_d nhat_d^2 (X_d - X),  V_s = 1 - V, X_d of the cell beside along nhat_d
// Without it the wall stops what a cell of little fluid shares with its neighbour twice over, and
// that swings with a growing amplitude. In an explicit step the two share one state.
template <int D>
double LevelCoupling<D>::pressure_beside_wall(const Cell<D>& c, std::size_t i, double size) const {
  const double X = fields_.pressure[i];
  if (!fluid_->options().implicit) return X;
  double change = 0;
  for (std::size_t d = 0; d < D; ++d) {
    const double n = fields_.smooth[d][i] / size;
    Cell<D> beside = c, face = c;
    beside[d] += n > 0 ? 1 : -1;
    face[d] += n > 0 ? 1 : 0;
    if (!frame_.in_domain(beside) && !frame_.periodic[d]) continue;
    const std::size_t j = frame_.box.index(frame_.inside(beside));
    if (!wet(j) || !(fields_.covered[d][frame_.box.index(face)] < 0.5)) continue;
    change += n * n * (fields_.pressure[j] - X);
  }
  return X + fields_.theta[i] * change;
}

// Cells without fluid, two layers deep: the mean of what their neighbours have. Beyond the domain
// as inside. Which are known then.
template <int D>
std::vector<std::uint8_t> LevelCoupling<D>::fill_dry(Column& values) const {
  std::vector<std::uint8_t> known(frame_.box.cells(), 0);
  for_each_cell_near([&](const Cell<D>&, std::size_t i) { known[i] = wet(i) ? 1 : 0; });
  for (int layer = 0; layer < 2; ++layer) {
    std::vector<std::pair<std::size_t, double>> found;
    for_each_cell_near([&](const Cell<D>& c, std::size_t i) {
      if (known[i] != 0) return;
      double sum = 0;
      int count = 0;
      for_each_neighbour(c, [&](std::size_t j) {
        if (known[j] == 0) return;
        sum += values[j];
        ++count;
      });
      if (count > 0) found.emplace_back(i, sum / count);
    });
    for (const auto& [i, p] : found) {
      values[i] = p;
      known[i] = 1;
    }
  }
  return known;
}

// On corners of the outer faces: -(p_w - p_ref) n m_k of each piece. Solids are free of stress at
// the reference pressure of the deck.
template <int D>
std::vector<mpm::CornerForce> LevelCoupling<D>::forces_on(const SolidSet<D>& s) const {
  std::vector<std::array<std::array<double, corners_of_face<D>>, D>> sums(s.faces.size());
  for_each_piece<D>(s.faces, When::start, 0, s.faces.size(),
                    [&](std::size_t i, int t, const FacetNodes<D>&, const Piece<D>& piece) {
                      // A body that a side of the domain cuts has no surface there.
                      if (!frame_.in_domain(frame_.wrapped(piece.cell))) return;
                      const double p =
                          (fields_.wall_pressure[frame_.box.index(frame_.inside(piece.cell))] -
                           reference_pressure_) *
                          s.faces.weight_of(i);
                      for (std::size_t d = 0; d < D; ++d) {
                        std::array<double, D> moments = piece.m;
                        for (double& m : moments)
                          m *= -p * piece.n[d] * frame_.face_area(static_cast<int>(d));
                        add_to_corners<D>(t, moments, sums[i][d]);
                      }
                    });
  std::vector<mpm::CornerForce> forces;
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
  return forces;
}

// The impulse that comes from outside: of what holds or drives rigid bodies against the fluid; and
// of sides of the domain that cut other bodies, which push these with the reference pressure, of
// which their stress is free. (Around a body that no side cuts it sums to none.)
template <int D>
void LevelCoupling<D>::book_outside(const StageScope& scope) {
  std::array<ExactSum, D> impulse;
  for (const SolidSet<D>& s : sets_) {
    const bool rigid = solids_->scene().materials[static_cast<std::size_t>(s.kind)].rigid;
    for_each_piece<D>(s.faces, When::start, 0, s.faces.size(),
                      [&](std::size_t i, int, const FacetNodes<D>&, const Piece<D>& piece) {
                        const Cell<D> c = frame_.wrapped(piece.cell);
                        if (!frame_.in_domain(c)) return;
                        const double p = rigid ? fields_.wall_pressure[frame_.box.index(c)]
                                               : reference_pressure_ * s.faces.weight_of(i);
                        for (std::size_t d = 0; d < D; ++d)
                          impulse[d].add(scope.step.dt * p * piece.area[d] *
                                         frame_.face_area(static_cast<int>(d)));
                      });
  }
  Reduction all;
  std::vector<Reduction::Sum> slots;
  for (const ExactSum& sum : impulse) slots.push_back(all.add_sum(sum));
  scope.ranks->reduce(all);
  for (std::size_t d = 0; d < D; ++d)
    (*scope.sums)[static_cast<std::size_t>(mpm::StepSums::impulse_x + frame_.direction[d])] +=
        all.sum(slots[d]).value();
}

template <int D>
Verdict LevelCoupling<D>::press_on_solids(const StageScope& scope) {
  // Solids lie on the finest level.
  std::vector<std::vector<std::vector<mpm::CornerForce>>> forces(
      static_cast<std::size_t>(step_->count()));
  for (auto& of_level : forces) of_level.resize(solids_->scene().materials.size());
  for (const SolidSet<D>& s : sets_) {
    if (solids_->scene().materials[static_cast<std::size_t>(s.kind)].rigid) continue;
    const std::vector<mpm::CornerForce> own = forces_on(s);
    auto& all = forces.back()[static_cast<std::size_t>(s.kind)];
    all.insert(all.end(), own.begin(), own.end());
  }
  step_->add_corner_forces(scope, forces);
  book_outside(scope);
  return Verdict::good;
}

template void LevelCoupling<1>::find_pressures(const StageScope&, bool);
template void LevelCoupling<2>::find_pressures(const StageScope&, bool);
template void LevelCoupling<3>::find_pressures(const StageScope&, bool);
template std::vector<std::uint8_t> LevelCoupling<1>::fill_dry(Column&) const;
template std::vector<std::uint8_t> LevelCoupling<2>::fill_dry(Column&) const;
template std::vector<std::uint8_t> LevelCoupling<3>::fill_dry(Column&) const;
template Verdict LevelCoupling<1>::press_on_solids(const StageScope&);
template Verdict LevelCoupling<2>::press_on_solids(const StageScope&);
template Verdict LevelCoupling<3>::press_on_solids(const StageScope&);

}  // namespace sluice::mpmice
