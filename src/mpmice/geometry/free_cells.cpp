#include "mpmice/geometry/free_cells.hpp"

#include <cmath>
#include <cstdlib>

#include "mpmice/geometry/inside_points.hpp"

namespace sluice::mpmice {
namespace {

bool all_odd(const auto& cell) {
  for (const int i : cell)
    if ((i & 1) == 0) return false;
  return true;
}

// Along all directions, the cells whose points may lie between low and high.
template <int D>
bool find_cells(const std::array<double, D>& low, const std::array<double, D>& high, Cell<D>& first,
                Cell<D>& last) {
  constexpr double hair = 1e-9;
  for (std::size_t d = 0; d < D; ++d) {
    first[d] = static_cast<int>(std::ceil(low[d] - inside_point[d] - hair));
    last[d] = static_cast<int>(std::floor(high[d] - inside_point[d] + hair));
    if (first[d] > last[d]) return false;
  }
  return true;
}

}  // namespace

template <int D>
void FreeCells<D>::begin(const CellBlocks<D>& cells, const PeriodicSides<D>& sides) {
  sides_ = sides;
  sums_.begin(cells, 2);
}

template <int D>
CellBox<D> FreeCells<D>::own_cells(std::size_t n) const {
  CellBox<D> box = cells().cells(n);
  for (std::size_t d = 0; d < D; ++d) {
    if (!sides_.periodic[d]) continue;
    box.lower[d] = std::max(box.lower[d], sides_.domain.lower[d]);
    box.upper[d] = std::min(box.upper[d], sides_.domain.upper[d]);
  }
  return box;
}

template <int D>
void FreeCells<D>::mark_spans(const Cell<D>& base, const std::array<CellSpan, D>& spans) {
  CellBox<D> box;
  for (std::size_t d = 0; d < D; ++d) {
    box.lower[d] = base[d] + spans[d].low;
    box.upper[d] = base[d] + spans[d].high + 1;
  }
  for_each_cell_of<D>(box, [&](const Cell<D>& c) { marks()[cells().index_to_add(c)] += 1; });
}

template <int D>
void FreeCells<D>::add(const SolidParticles<D>& particles, When when, std::size_t begin,
                       std::size_t end, CellSums<D>& to) const {
  const CornerColumns<D>& x = particles.corners(when);
  constexpr std::size_t chunk = 64;
  std::array<double[chunk], D> low, high;
  for (std::size_t at = begin; at < end; at += chunk) {
    const std::size_t n = std::min(chunk, end - at);
    for (std::size_t d = 0; d < D; ++d) {
      std::fill_n(low[d], chunk, 1e300);
      std::fill_n(high[d], chunk, -1e300);
      for (const auto& corner : x) {
        const double* places = corner[d] + at;
        for (std::size_t q = 0; q < n; ++q) {
          low[d][q] = places[q] < low[d][q] ? places[q] : low[d][q];
          high[d][q] = places[q] > high[d][q] ? places[q] : high[d][q];
        }
      }
      const double origin = particles.units.origin[d], inverse = particles.units.inverse[d];
      for (std::size_t q = 0; q < n; ++q) {
        low[d][q] = (low[d][q] - origin) * inverse;
        high[d][q] = (high[d][q] - origin) * inverse;
      }
    }
    for (std::size_t q = 0; q < n; ++q) {
      std::array<double, D> lowest, highest;
      for (std::size_t d = 0; d < D; ++d) {
        lowest[d] = low[d][q];
        highest[d] = high[d][q];
      }
      Cell<D> first, last;
      if (find_cells<D>(lowest, highest, first, last))
        ask(particles, when, at + q, first, last, to);
    }
  }
}

template <int D>
void FreeCells<D>::ask(const SolidParticles<D>& particles, When when, std::size_t p,
                       const Cell<D>& first, const Cell<D>& last, CellSums<D>& to) const {
  if (!particles.is_there(p)) return;
  CellBox<D> box{first, last};
  for (int& upper : box.upper) ++upper;
  const bool beyond = sides_.any_beyond(box);
  const CornerColumns<D>& x = particles.corners(when);
  ParticleCorners<D> corners;
  bool known = false;
  for_each_cell_of<D>(box, [&](const Cell<D>& c) {
    const Cell<D> cell = beyond ? sides_.image(c) : c;
    if (!all_odd(cell)) return;
    for (std::size_t k = 0; k < x.size() && !known; ++k)
      for (std::size_t d = 0; d < D; ++d)
        corners[k][d] =
            on_planes((x[k][d][p] - particles.units.origin[d]) * particles.units.inverse[d]);
    known = true;
    std::array<double, D> point;
    for (std::size_t d = 0; d < D; ++d) point[d] = c[d] + inside_point[d];
    const int k = winding_number<D>(corners, point);
    if (k == 0) return;
    to.lane(points)[cells().index_to_add(cell)] +=
        static_cast<std::uint64_t>(static_cast<std::int64_t>(k)) * to_sum(particles.part(p));
  });
}

template <int D>
void FreeCells<D>::finish() {
  sums_.fold(sides_, mark);
  constexpr std::size_t n = CellBlocks<D>::block_cells;
  const std::size_t blocks = cells().block_count();
  whole_.assign(1 + blocks, 1);
  starts_.assign(1 + blocks, 0);
  any_without_ = false;
  const std::uint64_t* marked = sums_.lane(mark);
  for (std::size_t b = 1; b <= blocks; ++b) {
    for (std::size_t i = b * n; i < (b + 1) * n; ++i) whole_[b] &= marked[i] == 0 ? 1 : 0;
    const CellBox<D> own = own_cells(b);
    any_cell_of<D>(own, [&](const Cell<D>& c) {
      const std::size_t i = b * n + BlockDirectory<D>::place_of(c);
      if (marked[i] != 0 || !all_odd(c)) return false;
      starts_[b] = i;
      return true;
    });
    any_without_ |= starts_[b] == 0 && !own.empty();
  }
}

namespace {

// theta of a block from one of its cells.
template <int D>
class RowsOfBlock {
 public:
  RowsOfBlock(const FreeCells<D>& free, const LanesOfDirections<D>& N,
              const LanesOfDirections<D>& T, std::uint64_t* theta)
      : free_(free), N_(N), T_(T), theta_(theta) {}

  // `start` has its value.
  void follow(const CellBox<D>& own, std::size_t block, const Cell<D>& start) {
    CellBox<D> known{start, start};
    for (int& upper : known.upper) ++upper;
    for (std::size_t d = 0; d < D; ++d) {
      const std::size_t step = CellBlocks<D>::stride(static_cast<int>(d));
      for_each_cell_of<D>(known, [&](const Cell<D>& c) {
        const std::size_t from =
            block * CellBlocks<D>::block_cells + BlockDirectory<D>::place_of(c);
        for (std::size_t i = from, n = count(own.upper[d] - 1 - c[d]); n-- > 0; i += step)
          put(i + step, theta_[i] - T_[d][i] - N_[d][i + step] + T_[d][i + step]);
        for (std::size_t i = from, n = count(c[d] - own.lower[d]); n-- > 0; i -= step)
          put(i - step, theta_[i] - T_[d][i] + N_[d][i] + T_[d][i - step]);
      });
      known.lower[d] = own.lower[d];
      known.upper[d] = own.upper[d];
    }
  }

 private:
  static std::size_t count(int n) { return static_cast<std::size_t>(n); }
  void put(std::size_t i, std::uint64_t value) {
    theta_[i] = free_.is_free(i) ? whole_if_near(value) : value;
  }
  static std::uint64_t whole_if_near(std::uint64_t value) {
    constexpr auto unit = static_cast<std::int64_t>(sum_unit);
    const auto v = static_cast<std::int64_t>(value);
    const std::int64_t k = (v + (v >= 0 ? unit / 2 : -unit / 2)) / unit;
    return std::llabs(v - k * unit) < (unit >> 43) ? static_cast<std::uint64_t>(k * unit) : value;
  }

  const FreeCells<D>& free_;
  LanesOfDirections<D> N_, T_;
  std::uint64_t* theta_;
};

}  // namespace

template <int D>
void follow_cells(const FreeCells<D>& free, const LanesOfDirections<D>& N,
                  const LanesOfDirections<D>& T, const std::uint64_t* references,
                  KeptArray<std::uint64_t>& theta) {
  constexpr std::size_t n = CellBlocks<D>::block_cells;
  theta.assign(free.cells().size(), 0);
  RowsOfBlock<D> rows(free, N, T, theta.data());
  for (std::size_t b = 1; b <= free.cells().block_count(); ++b) {
    const CellBox<D> own = free.own_cells(b);
    if (own.empty()) continue;
    Cell<D> start = own.lower;
    std::size_t at = b * n + BlockDirectory<D>::place_of(start);
    if (free.begins_free(b)) {
      at = free.start(b);
      any_cell_of<D>(own, [&](const Cell<D>& c) {
        start = c;
        return b * n + BlockDirectory<D>::place_of(c) == at;
      });
      theta[at] = free.inside(at);
      if (free.is_whole(b)) {
        std::fill_n(theta.data() + b * n, n, theta[at]);
        continue;
      }
    } else if (references != nullptr) {
      theta[at] = references[b];
    }
    rows.follow(own, b, start);
  }
}

template <int D>
void copy_images(const CellBlocks<D>& cells, const PeriodicSides<D>& sides,
                 KeptArray<double>& values) {
  if (!sides.any()) return;
  for (std::size_t b = 1; b <= cells.block_count(); ++b) {
    const CellBox<D> box = cells.cells(b);
    if (!sides.any_beyond(box)) continue;
    for_each_cell_of<D>(box, [&](const Cell<D>& c) {
      const Cell<D> image = sides.image(c);
      if (image != c) values[cells.index(c)] = values[cells.index(image)];
    });
  }
}

template class FreeCells<1>;
template class FreeCells<2>;
template class FreeCells<3>;
template void follow_cells<1>(const FreeCells<1>&, const LanesOfDirections<1>&,
                              const LanesOfDirections<1>&, const std::uint64_t*,
                              KeptArray<std::uint64_t>&);
template void follow_cells<2>(const FreeCells<2>&, const LanesOfDirections<2>&,
                              const LanesOfDirections<2>&, const std::uint64_t*,
                              KeptArray<std::uint64_t>&);
template void follow_cells<3>(const FreeCells<3>&, const LanesOfDirections<3>&,
                              const LanesOfDirections<3>&, const std::uint64_t*,
                              KeptArray<std::uint64_t>&);
template void copy_images<1>(const CellBlocks<1>&, const PeriodicSides<1>&, KeptArray<double>&);
template void copy_images<2>(const CellBlocks<2>&, const PeriodicSides<2>&, KeptArray<double>&);
template void copy_images<3>(const CellBlocks<3>&, const PeriodicSides<3>&, KeptArray<double>&);

}  // namespace sluice::mpmice
