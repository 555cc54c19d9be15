// Walls of solids that are light beside the fluid (the added mass of explicit steps).
//
//   b = max(0, 1 - rho_s h/(z dt)),  h = 1/sum_d |nhat_d|/dx_d,  z = rho c
// tells how light a wall is: 0 where a layer of the solid one cell thick is heavier than the fluid
// that sound crosses in a step, near 1 where it is next to nothing. In p_w of light walls
// (wall_pressure.cpp)
//   - the solid's side of the Riemann problem counts whole, however little surface lies in the
//     cell: |n| + (1 - |n|) b for |n|. Of the fluid's own pressure, which answers at once to what
//     the wall gives way, 1 - |n| would act on that mass, and grow step by step;
//   - p_s becomes, by its share b, that of the mean stress in the cells around. A light solid is
//     thrown back by heavy fluid as by a rigid wall. There the stress of its outermost particles is
//     larger than the mean over the layer that the nodes feel, by (k h)^2/6 of a wave, which gains
//     energy then. The mean over cells on both sides of that layer loses a little.
// Where b = 0 no bit is another.
#include <algorithm>
#include <cmath>

#include "framework/base/reduction.hpp"
#include "mpmice/step/level_coupling.hpp"

namespace sluice::mpmice {
namespace {

constexpr int cells_deep = 2;  // in which the mean stress behind a light wall is taken

}  // namespace

// Cells in a unit of length along nhat, `size` the length of the smoothed normal.
template <int D>
double LevelCoupling<D>::cells_along_normal(std::size_t i, double size) const {
  double cells = 0;
  for (std::size_t d = 0; d < D; ++d)
    cells += std::fabs(fields_.smooth[d][i]) / size / frame_.spacing[frame_.direction[d]];
  return cells;
}

// The largest of any normal.
template <int D>
double LevelCoupling<D>::most_cells_in_a_length() const {
  double cells = 0;
  for (const int d : frame_.direction) cells += 1 / frame_.spacing[d];
  return cells;
}

template <int D>
double LevelCoupling<D>::length_of_smooth(std::size_t i) const {
  double size = 0;
  for (std::size_t d = 0; d < D; ++d) size += fields_.smooth[d][i] * fields_.smooth[d][i];
  return std::sqrt(size);
}

// How light walls are, b, and the pressure in the solid behind those that are.
template <int D>
void LevelCoupling<D>::find_light_walls(const StageScope& scope, const Column& rho,
                                        const Column& sound) {
  fields_.lightness.assign(frame_.cells.size(), 0.0);
  const bool implicit = fluid_->options().scheme.implicit;
  if (!implicit && !may_be_light_) return;
  bool any = false;
  for_each_cell_near([&](const Cell<D>&, std::size_t i) {
    if (!wet(i) || !(fields_.area[i] > 0)) return;
    const double size = length_of_smooth(i);
    if (!(size > 0)) return;
    const double z = std::min(rho[i] * sound[i], most_impedance(i, size, rho[i], scope.step.dt));
    const double crossed =
        z * scope.step.dt * cells_along_normal(i, size) * fields_.inverse_density[i];
    if (!(crossed > 1)) return;
    fields_.lightness[i] = 1 - 1 / crossed;
    any = true;
  });
  if (!implicit || on_any(scope, any)) find_pressures_behind(scope);
}

// -nhat.sigma.nhat of the mean stress around, by volume.
template <int D>
void LevelCoupling<D>::find_pressures_behind(const StageScope& scope) {
  constexpr int at[3][3] = {{0, 5, 4}, {5, 1, 3}, {4, 3, 2}};  // columns of a symmetric tensor
  constexpr int count = D * (D + 1) / 2;
  std::array<std::array<std::size_t, 2>, count> pairs;
  for (std::size_t a = 0, n = 0; a < D; ++a)
    for (std::size_t b = a; b < D; ++b) pairs[n++] = {a, b};
  const auto stress_of = [&](const SolidSet<D>& s, const std::array<std::size_t, 2>& pair) {
    const int column = at[frame_.direction[pair[0]]][frame_.direction[pair[1]]];
    return s.set->column(static_cast<std::size_t>(s.columns->stress + column));
  };
  const auto volume_of = [](const SolidSet<D>& s) {
    return s.set->column(static_cast<std::size_t>(s.columns->volume));
  };
  const auto counts = [&](const SolidSet<D>& s) {
    return !solids_->scene().materials[static_cast<std::size_t>(s.kind)].rigid;
  };
  double most_volume = 0, most_stress = 0;
  for (const SolidSet<D>& s : sets_) {
    if (!counts(s)) continue;
    for (std::size_t p = 0; p < s.set->size(); ++p)
      most_volume = std::max(most_volume, volume_of(s)[p]);
    for (const auto& pair : pairs)
      for (std::size_t p = 0; p < s.set->size(); ++p)
        most_stress = std::max(most_stress, std::fabs(stress_of(s, pair)[p]));
  }
  Reduction all;
  const auto of_volume = all.add_maximum(most_volume), of_stress = all.add_maximum(most_stress);
  scope.ranks->reduce(all);
  most_volume = std::max(all.maximum(of_volume), 1e-300);
  most_stress = std::max(all.maximum(of_stress), 1e-300);

  CellSums<D> sums;
  sums.begin(frame_.cells, 1 + count);
  for (const SolidSet<D>& s : sets_) {
    if (!counts(s)) continue;
    const CornerColumns<D> corners = corner_columns<D>(frame_, *s.columns, *s.set);
    std::array<const double*, count> stress;
    for (std::size_t n = 0; n < count; ++n) stress[n] = stress_of(s, pairs[n]);
    const double* volume = volume_of(s);
    for (std::size_t p = 0; p < s.set->size(); ++p) {
      const double share = volume[p] / most_volume / most_parts<D>;
      std::array<std::uint64_t, 1 + count> gives;
      gives[0] = to_sum(share);
      for (std::size_t n = 0; n < count; ++n)
        gives[1 + n] = to_sum(share * (stress[n][p] / most_stress));
      for_each_part<D>(frame_, corners, *s.set, p, [&](std::size_t cell) {
        for (int n = 0; n <= count; ++n) sums.lane(n)[cell] += gives[static_cast<std::size_t>(n)];
      });
    }
  }
  sums.sum_over_ranks(*scope.ranks);
  std::array<Column, 1 + count> in_cells;
  for (int n = 0; n <= count; ++n) sums.values(n, in_cells[static_cast<std::size_t>(n)]);

  fields_.pressure_behind = fields_.solid_pressure;
  for_each_cell_near([&](const Cell<D>& c, std::size_t i) {
    if (!(fields_.lightness[i] > 0)) return;
    std::array<double, 1 + count> sum{};
    for_each_around(c, cells_deep, [&](std::size_t j) {
      for (std::size_t n = 0; n <= count; ++n) sum[n] += in_cells[n][j];
    });
    if (!(sum[0] > 0)) return;
    const double size = length_of_smooth(i);
    double p = 0;
    for (std::size_t n = 0; n < count; ++n) {
      const auto [a, b] = pairs[n];
      const double both = fields_.smooth[a][i] / size * (fields_.smooth[b][i] / size);
      p -= (a == b ? 1 : 2) * both * sum[1 + n];
    }
    fields_.pressure_behind[i] = p / sum[0] * most_stress;
  });
}

template double LevelCoupling<1>::cells_along_normal(std::size_t, double) const;
template double LevelCoupling<2>::cells_along_normal(std::size_t, double) const;
template double LevelCoupling<3>::cells_along_normal(std::size_t, double) const;
template double LevelCoupling<1>::most_cells_in_a_length() const;
template double LevelCoupling<2>::most_cells_in_a_length() const;
template double LevelCoupling<3>::most_cells_in_a_length() const;
template double LevelCoupling<1>::length_of_smooth(std::size_t) const;
template double LevelCoupling<2>::length_of_smooth(std::size_t) const;
template double LevelCoupling<3>::length_of_smooth(std::size_t) const;
template void LevelCoupling<1>::find_light_walls(const StageScope&, const Column&, const Column&);
template void LevelCoupling<2>::find_light_walls(const StageScope&, const Column&, const Column&);
template void LevelCoupling<3>::find_light_walls(const StageScope&, const Column&, const Column&);

}  // namespace sluice::mpmice
