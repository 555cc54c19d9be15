#include "mpm/transfer/gifts.hpp"

#include <algorithm>

#include "mpm/shape/weights.hpp"

namespace sluice::mpm {
namespace {

// Row d of V sigma, or of V F^-1 sigma (total Lagrangian): three columns of a chunk.
using Rows = double[3][chunk_size];

// Rows of the symmetric tensor xx, yy, zz, yz, xz, xy.
constexpr int rows_of_six[3][3] = {{0, 5, 4}, {5, 1, 3}, {4, 3, 2}};

void stress_row(const ParticlesToGrid& p, int d, int at, int n, double scale, Rows& to) {
  const double* V = p.volume + at;
  for (int e = 0; e < 3; ++e) {
    const double* s = p.stress[rows_of_six[d][e]] + at;
    for (int q = 0; q < n; ++q) to[e][q] = V[q] * scale * s[q];
  }
  for (const double* pressure : {p.extra_pressure, p.pore_pressure})
    if (pressure != nullptr)
      for (int q = 0; q < n; ++q) to[d][q] -= V[q] * scale * pressure[at + q];
}

// Row d of F^-1 = cof(F)^T/J, with V = J V_0.
void reference_row(const ParticlesToGrid& p, int d, int at, int n, double scale, Rows& to) {
  const Nine<const double>& F = p.shape.F;
  Rows all[3];
  for (int e = 0; e < 3; ++e) stress_row(p, e, at, n, scale, all[e]);
  const auto f = [&](int r, int c, int q) { return F[3 * (r % 3) + c % 3][at + q]; };
  for (int q = 0; q < n; ++q) {
    double cofactor[3];  // of F_kd
    double J = 0;
    for (int k = 0; k < 3; ++k) {
      cofactor[k] =
          f(k + 1, d + 1, q) * f(k + 2, d + 2, q) - f(k + 1, d + 2, q) * f(k + 2, d + 1, q);
      J += f(k, d, q) * cofactor[k];
    }
    for (int e = 0; e < 3; ++e)
      to[e][q] =
          (cofactor[0] * all[0][e][q] + cofactor[1] * all[1][e][q] + cofactor[2] * all[2][e][q]) /
          J;
  }
}

// Columns of C of a spin: w x e_d.
void add_spin(const TransferGrid& grid, const ParticlesToGrid& p, int at, int n, double unit,
              NodalContribution* gifts) {
  const double *x = p.spin[0] + at, *y = p.spin[1] + at, *z = p.spin[2] + at;
  for (int q = 0; q < n; ++q) {
    const double mu = p.mass[at + q] * unit;
    const Four columns[3] = {{0, 0, mu * z[q], -(mu * y[q])},
                             {0, -(mu * z[q]), 0, mu * x[q]},
                             {0, mu * y[q], -(mu * x[q]), 0}};
    for (int a = 0; a < grid.count; ++a) gifts[q].affine[a] = columns[grid.active[a]];
  }
}

}  // namespace

void nodal_contributions(const TransferGrid& grid, const ParticlesToGrid& p, int at, int n,
                         const SumUnits& u, NodalContribution* gifts) {
  for (int q = 0; q < n; ++q) {
    const int i = at + q;
    const double m = p.mass[i], mu = m * u.momentum;
    gifts[q].mass_momentum =
        Four{m * u.mass, mu * (p.v[0][i] - u.reference.x), mu * (p.v[1][i] - u.reference.y),
             mu * (p.v[2][i] - u.reference.z)};
    gifts[q].load = Four{};
  }
  if (p.load[0] != nullptr)
    for (int q = 0; q < n; ++q)
      gifts[q].load = Four{p.load[0][at + q] * u.force, p.load[1][at + q] * u.force,
                           p.load[2][at + q] * u.force, 0.0};
  if (p.spin[0] != nullptr) add_spin(grid, p, at, n, u.momentum, gifts);
  for (int a = 0; a < grid.count; ++a) {
    const int d = grid.active[a];
    if (p.volume == nullptr) {
      for (int q = 0; q < n; ++q) gifts[q].traction[a] = Four{};
    } else {
      alignas(64) Rows row;
      if (p.reference_gradients)
        reference_row(p, d, at, n, -u.force, row);
      else
        stress_row(p, d, at, n, -u.force, row);
      for (int q = 0; q < n; ++q) gifts[q].traction[a] = Four{row[0][q], row[1][q], row[2][q], 0.0};
    }
    if (p.affine[0] == nullptr) continue;
    const double* C[3];
    for (int e = 0; e < 3; ++e) C[e] = p.affine[3 * e + d] + at;
    for (int q = 0; q < n; ++q) {
      const double mu = p.mass[at + q] * u.momentum;
      gifts[q].affine[a] = Four{0.0, mu * C[0][q], mu * C[1][q], mu * C[2][q]};
    }
  }
}

}  // namespace sluice::mpm
