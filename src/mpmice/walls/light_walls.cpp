#include "mpmice/walls/light_walls.hpp"

#include <algorithm>
#include <cmath>

#include "mpmice/fields/agreement.hpp"

namespace sluice::mpmice {
namespace {

constexpr int cells_deep = 2;  // in which the mean stress behind a light wall is taken

// The components of a symmetric tensor in D directions.
template <int D>
constexpr std::array<std::array<std::size_t, 2>, D*(D + 1) / 2> components() {
  std::array<std::array<std::size_t, 2>, D*(D + 1) / 2> pairs{};
  for (std::size_t a = 0, n = 0; a < D; ++a)
    for (std::size_t b = a; b < D; ++b) pairs[n++] = {a, b};
  return pairs;
}

template <int D>
const double* stress_of(const Frame<D>& frame, const SolidSet<D>& s,
                        const std::array<std::size_t, 2>& pair) {
  constexpr int at[3][3] = {{0, 5, 4}, {5, 1, 3}, {4, 3, 2}};  // columns of a symmetric tensor
  const int column = at[frame.direction[pair[0]]][frame.direction[pair[1]]];
  return s.set->column(static_cast<std::size_t>(s.columns->stress + column));
}

template <int D>
const double* volume_of(const SolidSet<D>& s) {
  return s.set->column(static_cast<std::size_t>(s.columns->volume));
}

}  // namespace

template <int D>
void LightWalls<D>::find(const NearCells<D>& near, const SolidSets<D>& sets,
                         const OnSurfaces<D>& surface, const SmoothNormals<D>& normals,
                         const Column& z, double dt, Communicator& ranks) {
  if (!may_be_light_) return;
  lightness_.assign(near.size(), 0.0);
  bool any = false;
  near.for_each([&](const Cell<D>&, std::size_t i) {
    if (!(z[i] > 0)) return;
    const double size = normals.length(i);
    const double crossed =
        z[i] * dt * normals.cells_along(near.frame(), i, size) * surface.inverse_density[i];
    if (!(crossed > 1)) return;
    lightness_[i] = 1 - 1 / crossed;
    any = true;
  });
  if (implicit_ || on_any(ranks, any)) find_behind(near, sets, surface, normals, ranks);
}

// Collective.
template <int D>
typename LightWalls<D>::Scales LightWalls<D>::largest_of(const Frame<D>& frame,
                                                         const SolidSets<D>& sets,
                                                         Communicator& ranks) const {
  Scales most;
  for (const SolidSet<D>& s : sets.all()) {
    if (sets.kind_of(s).rigid) continue;
    for (std::size_t p = 0; p < s.set->size(); ++p)
      most.volume = std::max(most.volume, volume_of(s)[p]);
    for (const auto& pair : components<D>())
      for (std::size_t p = 0; p < s.set->size(); ++p)
        most.stress = std::max(most.stress, std::fabs(stress_of(frame, s, pair)[p]));
  }
  Reduction all;
  const auto volume = all.add_maximum(most.volume), stress = all.add_maximum(most.stress);
  ranks.reduce(all);
  return {std::max(all.maximum(volume), 1e-300), std::max(all.maximum(stress), 1e-300)};
}

template <int D>
void LightWalls<D>::add(const Frame<D>& frame, const SolidSet<D>& s, const Scales& most,
                        CellSums<D>& sums) const {
  constexpr auto pairs = components<D>();
  const CornerColumns<D> corners = corner_columns<D>(frame, *s.columns, *s.set);
  std::array<const double*, pairs.size()> stress;
  for (std::size_t n = 0; n < pairs.size(); ++n) stress[n] = stress_of(frame, s, pairs[n]);
  const double* volume = volume_of(s);
  for (std::size_t p = 0; p < s.set->size(); ++p) {
    const double share = volume[p] / most.volume / most_parts<D>;
    std::array<std::uint64_t, 1 + pairs.size()> gives;
    gives[0] = to_sum(share);
    for (std::size_t n = 0; n < pairs.size(); ++n)
      gives[1 + n] = to_sum(share * (stress[n][p] / most.stress));
    for_each_part<D>(frame, corners, *s.set, p, [&](std::size_t cell) {
      for (std::size_t n = 0; n < gives.size(); ++n)
        sums.lane(static_cast<int>(n))[cell] += gives[n];
    });
  }
}

// -nhat.sigma.nhat of the mean stress around, by volume.
template <int D>
void LightWalls<D>::find_behind(const NearCells<D>& near, const SolidSets<D>& sets,
                                const OnSurfaces<D>& surface, const SmoothNormals<D>& normals,
                                Communicator& ranks) {
  constexpr auto pairs = components<D>();
  const Frame<D>& frame = near.frame();
  const Scales most = largest_of(frame, sets, ranks);
  CellSums<D> sums;
  sums.begin(frame.cells, 1 + stresses);
  for (const SolidSet<D>& s : sets.all())
    if (!sets.kind_of(s).rigid) add(frame, s, most, sums);
  sums.sum_over_ranks(ranks);
  InCells in_cells;
  for (int n = 0; n <= stresses; ++n) sums.values(n, in_cells[static_cast<std::size_t>(n)]);

  behind_ = surface.pressure;
  near.for_each([&](const Cell<D>& c, std::size_t i) {
    if (!(lightness_[i] > 0)) return;
    std::array<double, 1 + stresses> sum{};
    near.for_each_around(c, cells_deep, [&](std::size_t j) {
      for (std::size_t n = 0; n < sum.size(); ++n) sum[n] += in_cells[n][j];
    });
    if (!(sum[0] > 0)) return;
    const double size = normals.length(i);
    double p = 0;
    for (std::size_t n = 0; n < pairs.size(); ++n) {
      const auto [a, b] = pairs[n];
      const double both = normals.along(a, i) / size * (normals.along(b, i) / size);
      p -= (a == b ? 1 : 2) * both * sum[1 + n];
    }
    behind_[i] = p / sum[0] * most.stress;
  });
}

template class LightWalls<1>;
template class LightWalls<2>;
template class LightWalls<3>;

}  // namespace sluice::mpmice
