#include "peridynamics/bonds/bond_kernels.hpp"

#include <Eigen/Eigenvalues>

#include "framework/base/eight.hpp"

namespace sluice::peridynamics {
namespace {

using EightFloats = float __attribute__((vector_size(32), may_alias, aligned(4)));

constexpr Eight all_of(double x) {
  return Eight{x, x, x, x, x, x, x, x};
}
[[gnu::always_inline]] inline Eight any_weight(const float* w) {
  return __builtin_convertvector(*reinterpret_cast<const EightFloats*>(w), Eight);
}

// Numbers of the eight neighbours of a row.
struct Beside {
  std::int32_t base;
  [[gnu::always_inline]] Eight operator()(const double* column) const {
    return eight_at(column + base);
  }
};
struct Listed {
  const std::int32_t* j;
  [[gnu::always_inline]] Eight operator()(const double* column) const {
    return Eight{column[j[0]], column[j[1]], column[j[2]], column[j[3]],
                 column[j[4]], column[j[5]], column[j[6]], column[j[7]]};
  }
};

// act(neighbours, row) for each row of a chunk.
template <class Act>
[[gnu::always_inline]] inline void for_rows(const BondTile& tile, const BondChunk& chunk,
                                            Act&& act) {
  for (std::size_t row = chunk.begin; row < chunk.end; ++row) {
    const std::int32_t base = tile.base[row];
    if (base >= 0)
      act(Beside{base}, row);
    else
      act(Listed{tile.index.data() + 8 * static_cast<std::size_t>(~base)}, row);
  }
}

// Places of a chunk's points, and how a bond of each lies and is stretched.
template <int D>
struct Geometry {
  Eight X[D], u[D];

  Geometry(const BondInput& in, int first) {
    for (int d = 0; d < D; ++d) {
      X[d] = eight_at(in.X[static_cast<std::size_t>(d)] + first);
      u[d] = eight_at(in.u[static_cast<std::size_t>(d)] + first);
    }
  }

  struct Bond {
    Eight y[D];     // xi + eta
    Eight product;  // 2 xi.eta + eta.eta
    Eight length;   // y
  };
  template <class Of>
  [[gnu::always_inline]] Bond bond(const BondInput& in, const Of& of) const {
    constexpr Eight least = {1e-300, 1e-300, 1e-300, 1e-300, 1e-300, 1e-300, 1e-300, 1e-300};
    Bond b;
    Eight square = {};
    b.product = Eight{};
    for (int d = 0; d < D; ++d) {
      const Eight xi = of(in.X[static_cast<std::size_t>(d)]) - X[d];
      const Eight eta = of(in.u[static_cast<std::size_t>(d)]) - u[d];
      b.y[d] = xi + eta;
      b.product += eta * (xi + b.y[d]);
      square += b.y[d] * b.y[d];
    }
    b.length = square_root(larger(square, least));
    return b;
  }
};

template <int D>
void extensions(const BondTile& tile, const BondChunk& chunk, const BondInput& in, double* sums) {
  const Geometry<D> here(in, chunk.first);
  Eight sum = {};
  for_rows(tile, chunk, [&](const auto& of, std::size_t row) [[gnu::always_inline]] {
    const auto b = here.bond(in, of);
    const Eight r = eight_at(tile.r.data() + 8 * row);
    const Eight e = b.product / (b.length + r);
    sum += any_weight(tile.w.data() + 8 * row) * of(in.V) * (r * e);
  });
  for (int l = 0; l < chunk.lanes; ++l) sums[chunk.first + l] = sum[l];
}

// Damage of a pair: what it bears, at its bond's g = (t_ij + t_ji)/w.
struct Limits {
  Eight stretch, energy, never, horizon;
  Limits(const BondInput& in, int first) {
    if (in.stretch != nullptr) stretch = eight_at(in.stretch + first);
    if (in.energy != nullptr) energy = eight_at(in.energy + first);
    if (in.energy != nullptr) horizon = eight_at(in.horizon + first);
    never = eight_at(in.never + first);
  }
  template <class Of>
  [[gnu::always_inline]] auto passed(const BondInput& in, const Of& of, const Eight& w,
                                     const Eight& r, const Eight& e, const Eight& g) const {
    const Eight zero = {}, never_here = never + of(in.never);
    auto over = e > all_of(1e300);  // none
    if (in.stretch != nullptr) over |= e > (smaller(stretch, of(in.stretch)) + never_here) * r;
    if (in.energy != nullptr) {
      const Eight delta = smaller(horizon, of(in.horizon));
      Eight omega = all_of(1);
      if (in.influence == Influence::linear) omega = larger(zero, all_of(1) - r / delta);
      if (in.influence == Influence::inverse) omega = delta / r;
      over |= omega * g * e > all_of(2) * (smaller(energy, of(in.energy)) + never_here);
    }
    return over & (e > zero) & (w > zero);
  }
};

// g = r (A_i + A_j) + e (B_i + B_j) + (e/r) (C_i + C_j), e, and 1/y.
template <bool lps, bool pmb>
struct Tension {
  Eight A, B, C;
  Tension(const BondInput& in, int first) {
    if constexpr (lps) A = eight_at(in.A + first);
    if constexpr (lps) B = eight_at(in.B + first);
    if constexpr (pmb) C = eight_at(in.C + first);
  }
  struct Of {
    Eight e, g, per_y, e_per_r, c;
  };
  // One division: 1/(y (y + r)), or 1/(y (y + r) r).
  template <class Neighbours>
  [[gnu::always_inline]] Of operator()(const BondInput& in, const Neighbours& of,
                                       const Eight& product, const Eight& y, const Eight& r) const {
    Of t;
    const Eight sum = y + r;
    if constexpr (pmb) {
      const Eight per = all_of(1) / (y * sum * r);
      t.e = product * (y * r * per);
      t.per_y = sum * r * per;
      t.e_per_r = t.e * (y * sum * per);
      t.c = C + of(in.C);
      t.g = t.e_per_r * t.c;
      if constexpr (lps) t.g += r * (A + of(in.A)) + t.e * (B + of(in.B));
    } else {
      const Eight per = all_of(1) / (y * sum);
      t.e = product * (y * per);
      t.per_y = sum * per;
      t.g = r * (A + of(in.A)) + t.e * (B + of(in.B));
    }
    return t;
  }
};

template <int D, bool lps, bool pmb, bool damage>
bool forces(const BondTile& tile, const BondChunk& chunk, const BondInput& in,
            const BondOutput& out) {
  const Geometry<D> here(in, chunk.first);
  const Tension<lps, pmb> tension(in, chunk.first);
  Eight f[D] = {}, squares = {}, energy = {};
  [[maybe_unused]] decltype(f[0] > f[0]) over = {};
  const auto sum_row = [&](const auto& of, std::size_t row,
                           const auto&... limits) [[gnu::always_inline]] {
    const auto b = here.bond(in, of);
    const Eight r = eight_at(tile.r.data() + 8 * row), w = any_weight(tile.w.data() + 8 * row);
    const auto t = tension(in, of, b.product, b.length, r);
    const Eight wV = w * of(in.V), pull = wV * t.g * t.per_y;
    for (int d = 0; d < D; ++d) f[d] += pull * b.y[d];
    if constexpr (lps) squares += wV * t.e * t.e;
    if constexpr (pmb) energy += wV * t.c * t.e * t.e_per_r;
    if constexpr (damage) ((over |= limits.passed(in, of, w, r, t.e, t.g)), ...);
  };
  if constexpr (damage) {
    const Limits limits(in, chunk.first);
    for_rows(tile, chunk, [&](const auto& of, std::size_t row) [[gnu::always_inline]] {
      sum_row(of, row, limits);
    });
  } else {
    for_rows(tile, chunk,
             [&](const auto& of, std::size_t row) [[gnu::always_inline]] { sum_row(of, row); });
  }
  Eight W = all_of(0.25) * energy;
  if constexpr (lps) W += all_of(0.5) * tension.B * squares;
  bool any = false;
  for (int l = 0; l < chunk.lanes; ++l) {
    for (int d = 0; d < D; ++d) out.force[static_cast<std::size_t>(d)][chunk.first + l] = f[d][l];
    out.bond_energy[chunk.first + l] = W[l];
    if constexpr (damage) any = any || over[l] != 0;
  }
  return any;
}

template <int D, bool lps, bool pmb>
int breaking(BondTile& tile, const BondChunk& chunk, const BondInput& in, int (&broken)[8]) {
  const Geometry<D> here(in, chunk.first);
  const Tension<lps, pmb> tension(in, chunk.first);
  const Limits limits(in, chunk.first);
  int count = 0;
  for_rows(tile, chunk, [&](const auto& of, std::size_t row) {
    const auto b = here.bond(in, of);
    const Eight r = eight_at(tile.r.data() + 8 * row), w = any_weight(tile.w.data() + 8 * row);
    const auto t = tension(in, of, b.product, b.length, r);
    const auto over = limits.passed(in, of, w, r, t.e, t.g);
    for (int l = 0; l < chunk.lanes; ++l) {
      if (over[l] == 0) continue;
      tile.w[8 * row + static_cast<std::size_t>(l)] = -0.0f;
      ++broken[l];
      ++count;
    }
  });
  return count;
}

template <int D, bool lps, bool pmb>
bool forces_of(const BondTile& tile, const BondChunk& chunk, const BondInput& in,
               const BondOutput& out) {
  return in.never != nullptr ? forces<D, lps, pmb, true>(tile, chunk, in, out)
                             : forces<D, lps, pmb, false>(tile, chunk, in, out);
}

}  // namespace

void sum_extensions(const BondTile& tile, const BondChunk& chunk, const BondInput& in,
                    double* sums) {
  if (in.dimensions == 3)
    extensions<3>(tile, chunk, in, sums);
  else
    extensions<2>(tile, chunk, in, sums);
}

bool sum_forces(const BondTile& tile, const BondChunk& chunk, const BondInput& in,
                const BondOutput& out) {
  const bool lps = in.A != nullptr, pmb = in.C != nullptr;
  if (in.dimensions == 3)
    return lps && pmb ? forces_of<3, true, true>(tile, chunk, in, out)
           : lps      ? forces_of<3, true, false>(tile, chunk, in, out)
                      : forces_of<3, false, true>(tile, chunk, in, out);
  return lps && pmb ? forces_of<2, true, true>(tile, chunk, in, out)
         : lps      ? forces_of<2, true, false>(tile, chunk, in, out)
                    : forces_of<2, false, true>(tile, chunk, in, out);
}

int break_bonds(BondTile& tile, const BondChunk& chunk, const BondInput& in, int (&broken)[8]) {
  const bool lps = in.A != nullptr, pmb = in.C != nullptr;
  if (in.dimensions == 3)
    return lps && pmb ? breaking<3, true, true>(tile, chunk, in, broken)
           : lps      ? breaking<3, true, false>(tile, chunk, in, broken)
                      : breaking<3, false, true>(tile, chunk, in, broken);
  return lps && pmb ? breaking<2, true, true>(tile, chunk, in, broken)
         : lps      ? breaking<2, true, false>(tile, chunk, in, broken)
                    : breaking<2, false, true>(tile, chunk, in, broken);
}

void bound_stiffness(const BondTile& tile, const BondChunk& chunk, const BondInput& in,
                     const double* D, double* bound) {
  for (int l = 0; l < chunk.lanes; ++l) {
    const std::size_t i = static_cast<std::size_t>(chunk.first + l);
    double xx = 0, yy = 0, zz = 0, yz = 0, xz = 0, xy = 0;
    for (std::size_t row = chunk.begin; row < chunk.end; ++row) {
      if (!tile.intact(row, l)) continue;
      const std::size_t j = static_cast<std::size_t>(tile.neighbour(row, l));
      const std::size_t at = 8 * row + static_cast<std::size_t>(l);
      const double r = tile.r[at];
      double c = 0;
      if (D != nullptr) c += D[i] + D[j];
      if (in.C != nullptr) c += (in.C[i] + in.C[j]) / r;
      const double scale = tile.w[at] * in.V[j] * c / (r * r);
      const double x = in.X[0][j] - in.X[0][i], y = in.X[1][j] - in.X[1][i],
                   z = in.X[2][j] - in.X[2][i];
      xx += scale * x * x;
      yy += scale * y * y;
      zz += scale * z * z;
      yz += scale * y * z;
      xz += scale * x * z;
      xy += scale * x * y;
    }
    Eigen::Matrix3d sum;
    sum << xx, xy, xz, xy, yy, yz, xz, yz, zz;
    bound[i] = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(sum, Eigen::EigenvaluesOnly)
                   .eigenvalues()
                   .maxCoeff();
  }
}

}  // namespace sluice::peridynamics
