// The pressure between the fluid of a cell and the solid in it.
//
//   du = (u_s - u).nhat,  z = rho (c + A max(0, du)),  w = 1/(1 + z y)   (A shock slope dUs/du)
//   p_w = p + z w du + (1 - w) |n| (p_s - p),  at least p/10
// with nhat out of the solid, y = 1/(rho_s c_s) (0 where rigid) and p_s the pressure of the solid
// behind the surface: the Riemann problem of fluid and solid along the normal (mpmice_scheme, step
// 3). nhat is smoothed over the cells around, which stairs need; forces take n itself. Of solids
// that are light beside the fluid |n| and p_s are others (light_walls.cpp), and a fluid that bears
// tension has no least p_w there.
#include <algorithm>
#include <cmath>

#include "mpmice/step/fluid_cells.hpp"
#include "mpmice/step/level_coupling.hpp"

namespace sluice::mpmice {
namespace {

constexpr double least_share = 0.1;  // of the fluid's pressure that is left on a wall

}  // namespace

// Lanes of what is told of the fluid's state.
template <int D>
struct StateLanes {
  static constexpr int density = 0, pressure = 1, speed = 2, velocity = 3, viscous = velocity + D;
};

// Cells whose state somebody asks for: around those with solids. A solve and explosives look
// farther.
template <int D>
CellMask LevelCoupling<D>::cells_beside_walls() const {
  if (fluid_->options().scheme.implicit || !burns_.empty()) return CellMask(frame_.cells.size(), 1);
  CellMask mask(frame_.cells.size(), 0);
  for (const CellBox<D>& box : occupied_.boxes())
    frame_.cells.for_each_part(frame_.touched_around(box), [&](const CellBox<D>& part) {
      for_each_cell_of<D>(part, [&](const Cell<D>& c) {
        const std::size_t i = frame_.cells.index(frame_.wrapped(c));
        if (i >= CellBlocks<D>::block_cells) mask[i] = 1;
      });
    });
  return mask;
}

// Of this rank's cells with fluid, for those that share their blocks.
template <int D>
void LevelCoupling<D>::tell_fluid_states(const StageScope& scope, bool solved) {
  using Lanes = StateLanes<D>;
  const bool rubs = fluid_->options().transport.viscous && !solved;
  known_.begin(frame_.cells, rubs ? Lanes::viscous + 1 : Lanes::viscous);
  const LevelSolver& level = *scope.levels.front();
  const CellMask asked = cells_beside_walls();
  const FluidCells fluid(*fluid_, level.state());
  const WorkPressure of_solve(*fluid_, level.state(), solved);
  for (int b = 0; b < static_cast<int>(level.state().local_boxes().size()); ++b) {
    const FluidBox cells = fluid.box(b);
    const WorkPressure::Box work = of_solve.box(b);
    frame_.for_each_held(level.state().local_boxes()[static_cast<std::size_t>(b)].cells,
                         [&](IntVec3 at, std::size_t i) {
                           if (asked[i] == 0 || !(cells.fraction(at) < 1)) return;
                           const FluidState s = cells.at(at);
                           known_.put(Lanes::density, i, s.rho);
                           known_.put(Lanes::pressure, i, work.at(at, s.pressure));
                           known_.put(Lanes::speed, i, s.sound);
                           for (int a = 0; a < D; ++a)
                             known_.put(Lanes::velocity + a, i,
                                        s.velocity[frame_.direction[static_cast<std::size_t>(a)]]);
                           if (rubs) known_.put(Lanes::viscous, i, cells.viscosity(at));
                         });
  }
}

// rho c of the fluid in this rank's cells, as they are known now.
template <int D>
double LevelCoupling<D>::highest_impedance() const {
  double most = 0;
  for (std::size_t i = 0; i < frame_.cells.size(); ++i)
    most = std::max(
        most, known_.value(StateLanes<D>::density, i) * known_.value(StateLanes<D>::speed, i));
  return most;
}

// From what is known of the fluid.
template <int D>
void LevelCoupling<D>::find_pressures(const StageScope& scope, bool solved) {
  using Lanes = StateLanes<D>;
  Column rho, sound;
  std::array<Column, D> u;
  known_.take(Lanes::density, rho);
  known_.take(Lanes::pressure, fields_.pressure);
  known_.take(Lanes::speed, sound);
  for (int a = 0; a < D; ++a) known_.take(Lanes::velocity + a, u[static_cast<std::size_t>(a)]);
  smooth_normals();
  find_light_walls(scope, rho, sound);
  press_on_walls(rho, sound, u, scope.step.dt);
  if (fluid_->options().transport.viscous && !solved) {
    Column viscosity;
    known_.take(Lanes::viscous, viscosity);
    rub_on_walls(rho, viscosity, u, scope.step.dt);
  }
  fill_dry(fields_.wall_pressure);
}

template <int D>
void LevelCoupling<D>::smooth_normals() {
  for (Column& s : fields_.smooth) s.assign(frame_.cells.size(), 0.0);
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
      const std::size_t j = frame_.cells.index(other);
      if (!wet(j)) continue;
      for (std::size_t d = 0; d < D; ++d)
        fields_.smooth[d][i] += weight * fields_.normal[d][j] *
                                (frame_.face_area(static_cast<int>(d)) / frame_.largest_face());
    }
  });
}

template <int D>
void LevelCoupling<D>::press_on_walls(const Column& rho, const Column& sound,
                                      const std::array<Column, D>& u, double dt) {
  fields_.wall_pressure = fields_.pressure;
  for_each_cell_within(pressure_reach, [&](const Cell<D>& c, std::size_t i) {
    if (!wet(i) || !(fields_.area[i] > 0)) return;
    const double size = length_of_smooth(i);
    double whole = 0, du = 0;
    for (std::size_t d = 0; d < D; ++d) whole += fields_.normal[d][i] * fields_.normal[d][i];
    if (!(size > 0) || !(whole > 0)) return;
    for (std::size_t d = 0; d < D; ++d)
      du += (fields_.surface_velocity[d][i] - u[d][i]) * (fields_.smooth[d][i] / size);
    if (fluid_->options().scheme.implicit) du = approach_at_surface(c, i, size, u, du);
    const double p = pressure_beside_wall(c, i, size);
    const double z = std::min(rho[i] * (sound[i] + shock_slope_ * std::max(0.0, du)),
                              most_impedance(i, size, rho[i], dt));
    const double w = 1 / (1 + z * fields_.compliance[i]);
    const double faced = std::min(1.0, std::sqrt(whole));
    if (D == 1) du *= faced;
    const double light = fields_.lightness[i];
    double share = faced, ps = fields_.solid_pressure[i];
    if (light > 0) {
      share += (1 - faced) * light;
      ps += light * (fields_.pressure_behind[i] - ps);
    }
    const double pw = p + z * w * du + (1 - w) * share * (ps + reference_pressure_ - p);
    const bool bears_tension = light > 0 && p < least_share * rho[i] * sound[i] * sound[i];
    fields_.wall_pressure[i] = p > 0 && !bears_tension ? std::max(pw, least_share * p) : pw;
  });
}

// What the fluid of a cell can resist with in a semi-implicit step, rho dx/(2 dt): of longer ones
// sound crosses it, and what remains of z du is in the pressure that was solved for
// (ice/pressure/predictions.cpp, j).
template <int D>
double LevelCoupling<D>::most_impedance(std::size_t i, double size, double rho, double dt) const {
  if (!fluid_->options().scheme.implicit) return 1e300;
  return 0.5 * std::max(0.5, 1 - fields_.theta[i]) * rho / (dt * cells_along_normal(i, size));
}

// (u_s - u).nhat with the velocity of the fluid carried on to the surface, of a semi-implicit step:
// that of the middle of what the cell holds differs from the wall's by (h/2) du/dn in a flow that
// follows the wall, and z times that is no wave, but a drag that grows with the sound speed. The
// slope is that to the next cell along the largest component of nhat; a small cell has one state
// with that one. Taken where it makes du smaller, at most to 0.
template <int D>
double LevelCoupling<D>::approach_at_surface(const Cell<D>& c, std::size_t i, double size,
                                             const std::array<Column, D>& u, double du) const {
  constexpr double small_volume = 0.5;
  std::size_t along = 0;
  for (std::size_t d = 1; d < D; ++d)
    if (std::fabs(fields_.smooth[d][i]) > std::fabs(fields_.smooth[along][i])) along = d;
  const int away = fields_.smooth[along][i] > 0 ? 1 : -1;
  const double V = 1 - fields_.theta[i];
  const bool shares = V < small_volume;
  Cell<D> from = c, to = c;
  if (shares) from[along] += away;
  to[along] = from[along] + away;
  for (const Cell<D>& other : {from, to})
    if (!frame_.periodic[along] && !frame_.in_domain(other)) return du;
  const std::size_t a = frame_.cells.index(frame_.inside(from)),
                    b = frame_.cells.index(frame_.inside(to));
  if (!wet(a) || !wet(b)) return du;
  double slope = 0;
  for (std::size_t d = 0; d < D; ++d) slope += (u[d][b] - u[d][a]) * (fields_.smooth[d][i] / size);
  const double distance = 0.5 * (shares ? 1 + V : V), at_surface = du + slope * distance;
  if (!(at_surface * du > 0)) return 0;
  return std::fabs(at_surface) < std::fabs(du) ? at_surface : du;
}

// The fluid's pressure half a cell from the wall along nhat. That of a cell is of its centre, which
// the wall may have passed: of a semi-implicit step
//   p = X + V_s sum_d nhat_d^2 (X_d - X),  V_s = 1 - V, X_d of the cell beside along nhat_d
// Without it the wall stops what a cell of little fluid shares with its neighbour twice over, and
// that swings with a growing amplitude. In an explicit step the two share one state.
template <int D>
double LevelCoupling<D>::pressure_beside_wall(const Cell<D>& c, std::size_t i, double size) const {
  const double X = fields_.pressure[i];
  if (!fluid_->options().scheme.implicit) return X;
  double change = 0;
  for (std::size_t d = 0; d < D; ++d) {
    const double n = fields_.smooth[d][i] / size;
    Cell<D> beside = c, face = c;
    beside[d] += n > 0 ? 1 : -1;
    face[d] += n > 0 ? 1 : 0;
    if (!frame_.in_domain(beside) && !frame_.periodic[d]) continue;
    const std::size_t j = frame_.cells.index(frame_.inside(beside));
    if (!wet(j) || !(fields_.covered[d][frame_.cells.index(face)] < 0.5)) continue;
    change += n * n * (fields_.pressure[j] - X);
  }
  return X + fields_.theta[i] * change;
}

// Cells without fluid, two layers deep: the mean of what their neighbours have. Beyond the domain
// as inside. Which are known then.
template <int D>
KeptArray<std::uint8_t> LevelCoupling<D>::fill_dry(Column& values) const {
  KeptArray<std::uint8_t> known(frame_.cells.size(), 0);
  for_each_cell_near([&](const Cell<D>&, std::size_t i) { known[i] = wet(i) ? 1 : 0; });
  constexpr int layers = 2;
  CellMask within = known;
  dilate(frame_, layers, within);
  for (int layer = 0; layer < layers; ++layer) {
    KeptArray<std::pair<std::size_t, double>> found;
    for_each_cell_near([&](const Cell<D>& c, std::size_t i) {
      if (known[i] != 0 || within[i] == 0) return;
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

template double LevelCoupling<1>::highest_impedance() const;
template double LevelCoupling<2>::highest_impedance() const;
template double LevelCoupling<3>::highest_impedance() const;
template void LevelCoupling<1>::tell_fluid_states(const StageScope&, bool);
template void LevelCoupling<2>::tell_fluid_states(const StageScope&, bool);
template void LevelCoupling<3>::tell_fluid_states(const StageScope&, bool);
template void LevelCoupling<1>::find_pressures(const StageScope&, bool);
template void LevelCoupling<2>::find_pressures(const StageScope&, bool);
template void LevelCoupling<3>::find_pressures(const StageScope&, bool);
template double LevelCoupling<1>::most_impedance(std::size_t, double, double, double) const;
template double LevelCoupling<2>::most_impedance(std::size_t, double, double, double) const;
template double LevelCoupling<3>::most_impedance(std::size_t, double, double, double) const;
template KeptArray<std::uint8_t> LevelCoupling<1>::fill_dry(Column&) const;
template KeptArray<std::uint8_t> LevelCoupling<2>::fill_dry(Column&) const;
template KeptArray<std::uint8_t> LevelCoupling<3>::fill_dry(Column&) const;

}  // namespace sluice::mpmice
