#include "mpm/transfer/gifts.hpp"

#include "framework/base/eight.hpp"
#include "mpm/shape/weights.hpp"

namespace sluice::mpm {
namespace {

// Rows of the symmetric tensor xx, yy, zz, yz, xz, xy.
constexpr int rows_of_six[3][3] = {{0, 5, 4}, {5, 1, 3}, {4, 3, 2}};

// From one member of the contributions to the same of the next particle.
constexpr std::size_t next_particle = sizeof(NodalContribution) / sizeof(Four);

// Four numbers of each particle into a member of its contribution, given that of the chunk's first.
[[gnu::always_inline]] inline void put_lanes(OneOf q, double a, double b, double c, double d,
                                             Four* member) {
  member[q.i * next_particle] = Four{a, b, c, d};
}
[[gnu::always_inline]] inline void put_lanes(EightOf q, const Eight& a, const Eight& b,
                                             const Eight& c, const Eight& d, Four* member) {
  const Eight even_ab = __builtin_shufflevector(a, b, 0, 8, 2, 10, 4, 12, 6, 14);
  const Eight odd_ab = __builtin_shufflevector(a, b, 1, 9, 3, 11, 5, 13, 7, 15);
  const Eight even_cd = __builtin_shufflevector(c, d, 0, 8, 2, 10, 4, 12, 6, 14);
  const Eight odd_cd = __builtin_shufflevector(c, d, 1, 9, 3, 11, 5, 13, 7, 15);
  Four* to = member + q.i * next_particle;
  to[0] = __builtin_shufflevector(even_ab, even_cd, 0, 1, 8, 9);
  to[next_particle] = __builtin_shufflevector(odd_ab, odd_cd, 0, 1, 8, 9);
  to[2 * next_particle] = __builtin_shufflevector(even_ab, even_cd, 2, 3, 10, 11);
  to[3 * next_particle] = __builtin_shufflevector(odd_ab, odd_cd, 2, 3, 10, 11);
  to[4 * next_particle] = __builtin_shufflevector(even_ab, even_cd, 4, 5, 12, 13);
  to[5 * next_particle] = __builtin_shufflevector(odd_ab, odd_cd, 4, 5, 12, 13);
  to[6 * next_particle] = __builtin_shufflevector(even_ab, even_cd, 6, 7, 14, 15);
  to[7 * next_particle] = __builtin_shufflevector(odd_ab, odd_cd, 6, 7, 14, 15);
}

// The columns of one chunk.
struct Chunk {
  const ParticlesToGrid& p;
  std::size_t at;

  template <class Q>
  [[gnu::always_inline]] auto of(const Q& q, const double* column) const {
    return q.behind(at)(column);
  }
  // Row d of V sigma, times a scale.
  template <class Q>
  [[gnu::always_inline]] auto stress_row(const Q& q, int d, double scale) const {
    using T = typename Q::Number;
    const T V = of(q, p.volume) * scale;
    std::array<T, 3> row{V * of(q, p.stress[rows_of_six[d][0]]),
                         V * of(q, p.stress[rows_of_six[d][1]]),
                         V * of(q, p.stress[rows_of_six[d][2]])};
    for (const double* pressure : {p.extra_pressure, p.pore_pressure})
      if (pressure != nullptr) row[d] -= V * of(q, pressure);
    return row;
  }
  // Row d of V F^-1 sigma (total Lagrangian): F^-1 = cof(F)^T/J, with V = J V_0.
  template <class Q>
  [[gnu::always_inline]] auto reference_row(const Q& q, int d, double scale) const {
    using T = typename Q::Number;
    const auto f = [&](int r, int c) { return of(q, p.shape.F[3 * (r % 3) + c % 3]); };
    T cofactor[3];  // of F_kd
    T J{};
    for (int k = 0; k < 3; ++k) {
      cofactor[k] = f(k + 1, d + 1) * f(k + 2, d + 2) - f(k + 1, d + 2) * f(k + 2, d + 1);
      J += f(k, d) * cofactor[k];
    }
    const std::array<T, 3> x = stress_row(q, 0, scale), y = stress_row(q, 1, scale),
                           z = stress_row(q, 2, scale);
    std::array<T, 3> row;
    for (std::size_t e = 0; e < 3; ++e)
      row[e] = (cofactor[0] * x[e] + cofactor[1] * y[e] + cofactor[2] * z[e]) / J;
    return row;
  }
};

// Of column d of C, and of the matrix of a spin, w x e_d: what each component of momentum gets.
template <class Q>
[[gnu::always_inline]] inline auto affine_column(const Chunk& chunk, const Q& q, int d,
                                                 const typename Q::Number& mu) {
  using T = typename Q::Number;
  const ParticlesToGrid& p = chunk.p;
  if (p.affine[0] != nullptr)
    return std::array<T, 3>{mu * chunk.of(q, p.affine[d]), mu * chunk.of(q, p.affine[3 + d]),
                            mu * chunk.of(q, p.affine[6 + d])};
  const T none{}, x = mu * chunk.of(q, p.spin[0]), y = mu * chunk.of(q, p.spin[1]),
                  z = mu * chunk.of(q, p.spin[2]);
  return d == 0   ? std::array<T, 3>{none, z, -y}
         : d == 1 ? std::array<T, 3>{-z, none, x}
                  : std::array<T, 3>{y, -x, none};
}

}  // namespace

void nodal_contributions(const TransferGrid& grid, const ParticlesToGrid& p, int at, int n,
                         const SumUnits& u, NodalContribution* gifts) {
  const Chunk chunk{p, static_cast<std::size_t>(at)};
  const auto count = static_cast<std::size_t>(n);
  for_eights(0, count, [&](auto q) {
    using T = typename decltype(q)::Number;
    const T m = chunk.of(q, p.mass), mu = m * u.momentum;
    put_lanes(q, m * u.mass, mu * (chunk.of(q, p.v[0]) - u.reference.x),
              mu * (chunk.of(q, p.v[1]) - u.reference.y),
              mu * (chunk.of(q, p.v[2]) - u.reference.z), &gifts->mass_momentum);
    if (!p.varies()) return;
    for (int a = 0; a < grid.count; ++a) {
      const std::array<T, 3> column = affine_column(chunk, q, grid.active[a], mu);
      put_lanes(q, T{}, column[0], column[1], column[2], &gifts->affine[a]);
    }
  });
  if (p.volume == nullptr && p.load[0] == nullptr) return;  // nobody asks for forces
  if (p.load[0] != nullptr)
    for_eights(0, count, [&](auto q) {
      using T = typename decltype(q)::Number;
      put_lanes(q, chunk.of(q, p.load[0]) * u.force, chunk.of(q, p.load[1]) * u.force,
                chunk.of(q, p.load[2]) * u.force, T{}, &gifts->load);
    });
  else
    for (int q = 0; q < n; ++q) gifts[q].load = Four{};
  for (int a = 0; a < grid.count; ++a) {
    const int d = grid.active[a];
    if (p.volume == nullptr)
      for (int q = 0; q < n; ++q) gifts[q].traction[a] = Four{};
    else
      for_eights(0, count, [&](auto q) {
        using T = typename decltype(q)::Number;
        const std::array<T, 3> row = p.reference_gradients ? chunk.reference_row(q, d, -u.force)
                                                           : chunk.stress_row(q, d, -u.force);
        put_lanes(q, row[0], row[1], row[2], T{}, &gifts->traction[a]);
      });
  }
}

}  // namespace sluice::mpm
