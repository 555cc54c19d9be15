// The dynamic model of M. Germano, U. Piomelli, P. Moin and W. H. Cabot, Phys. Fluids A 3 (1991)
// 1760, with the least squares of D. K. Lilly, Phys. Fluids A 4 (1992) 633, Favre means.
//
//   L_ij = ^(rho u_i u_j) - ^(rho u_i) ^(rho u_j)/^rho
//   M_ij = 2 Delta^2 [ ^(rho |S| S*_ij) - alpha^2 ^rho |^S| ^S*_ij ]
//   C = <L_ij M_ij>/<M_ij M_ij>,  mu_t = rho C Delta^2 |S|,  0 <= C <= 1/4
// ^ is the test filter of width alpha Delta, S* the deviator of S, < > the test filter once more.
// Limits of C: energy never comes back from below the grid, and C_s is at most 1/2.
#include <algorithm>
#include <cmath>

#include "ice/transport/strain.hpp"
#include "ice/transport/test_filter.hpp"

namespace sluice::ice {
namespace {

// threshold: upper bound of the square of Smagorinsky's constant in the dynamic model; unit: 1;
//   test: none
constexpr double max_constant = 0.25;

// Where the products of a cell stand: density, momentum, pairs of rho u u, of rho |S| S*, of S.
template <int C>
struct Products {
  static constexpr int pairs = C * (C + 1) / 2;
  static constexpr int rho = 0, momentum = 1, flux = 1 + C, stress = flux + pairs,
                       strain = stress + pairs, count = strain + pairs;
  static constexpr int pair(int a, int b) { return a * C - a * (a - 1) / 2 + (b - a); }
};

// Sum over all i, j of f(i, j) that is symmetric. Carried components apart, as in strain.hpp.
template <int D, int C, class F>
double contract(F f) {
  double along = 0, carried = 0, across = 0, other = 0;
  for (int a = 0; a < C; ++a) {
    (a < D ? along : carried) += f(a, a);
    for (int b = a + 1; b < C; ++b) (b < D ? across : other) += f(a, b);
  }
  return (along + carried) + 2.0 * (across + other);
}

template <int D, int C>
void product_row(const Row& row, In rho, In velocity, Out out, const SchemeOptions& o,
                 bool by_direction) {
  using P = Products<C>;
  const VelocityRows<D, C> u(row, velocity, o, by_direction);
  const double* here[C];
  for (int c = 0; c < C; ++c) here[c] = row(velocity, by_direction ? o.grid.direction[c] : c);
  const double* r = row(rho);
  double* q[P::count];
  for (int k = 0; k < P::count; ++k) q[k] = row(out, k);
  for (int i = 0; i < row.count(); ++i) {
    const double size = std::sqrt(u.strain_squared(i));
    double along = 0, carried = 0;
    for (int c = 0; c < C; ++c) (c < D ? along : carried) += u.slope(c, c, i);
    const double mean = (along + carried) / C;
    q[P::rho][i] = r[i];
    for (int a = 0; a < C; ++a) {
      q[P::momentum + a][i] = r[i] * here[a][i];
      for (int b = a; b < C; ++b) {
        const int k = P::pair(a, b);
        const double S = u.strain(a, b, i);
        q[P::flux + k][i] = r[i] * (here[a][i] * here[b][i]);
        q[P::strain + k][i] = S;
        q[P::stress + k][i] = r[i] * size * (a == b ? S - mean : S);
      }
    }
  }
}

// L_ij M_ij and M_ij M_ij from filtered products.
template <int D, int C>
void identity_row(const Row& row, In in, Out out, const SchemeOptions& o) {
  using P = Products<C>;
  const double* q[P::count];
  for (int k = 0; k < P::count; ++k) q[k] = row(in, k);
  const double width = filter_width(o, row.step().spacing);
  const double alpha = o.transport.models.turbulence->test_filter_width;
  double *LM = row(out, 0), *MM = row(out, 1);
  for (int i = 0; i < row.count(); ++i) {
    const auto S = [&](int a, int b) { return q[P::strain + P::pair(a, b)][i]; };
    const double size =
        std::sqrt(2.0 * contract<D, C>([&](int a, int b) { return S(a, b) * S(a, b); }));
    double along = 0, carried = 0;
    for (int c = 0; c < C; ++c) (c < D ? along : carried) += S(c, c);
    const double mean = (along + carried) / C, rho = q[P::rho][i];
    const auto M = [&](int a, int b) {
      const double deviator = a == b ? S(a, b) - mean : S(a, b);
      return 2.0 * width * width *
             (q[P::stress + P::pair(a, b)][i] - alpha * alpha * rho * size * deviator);
    };
    const auto L = [&](int a, int b) {
      return q[P::flux + P::pair(a, b)][i] - q[P::momentum + a][i] * q[P::momentum + b][i] / rho;
    };
    LM[i] = contract<D, C>([&](int a, int b) { return L(a, b) * M(a, b); });
    MM[i] = contract<D, C>([&](int a, int b) { return M(a, b) * M(a, b); });
  }
}

template <int D, int C>
void eddy_row(const Row& row, In rho, In velocity, In identity, Out eddy, const SchemeOptions& o,
              bool by_direction) {
  const VelocityRows<D, C> u(row, velocity, o, by_direction);
  const double width = filter_width(o, row.step().spacing);
  const double *r = row(rho), *LM = row(identity, 0), *MM = row(identity, 1);
  double* mu = row(eddy);
  for (int i = 0; i < row.count(); ++i) {
    const double constant = MM[i] > 0 ? std::clamp(LM[i] / MM[i], 0.0, max_constant) : 0.0;
    mu[i] = r[i] * constant * width * width * std::sqrt(u.strain_squared(i));
  }
}

}  // namespace

void add_dynamic_eddy_viscosity(const TransportTask& t, const StateVariables& state,
                                VariableId eddy) {
  dispatch(t.options.grid.axes.count, t.options.grid.components, [&]<int D, int C>() {
    const SchemeOptions o = t.options;
    const bool by_direction = state.by_direction;
    constexpr int count = Products<C>::count;
    const VariableId products = t.list.temporary(t.name + "products of the flow", count);
    {
      TaskBuilder task = t.list.task(t.name + "products of the flow", t.effect);
      const In rho = task.read(state.rho), u = task.read(state.velocity, Stencil::box(1));
      const Out out = task.write(products);
      task.kernel([=](const Row& row) { product_row<D, C>(row, rho, u, out, o, by_direction); });
    }
    const VariableId filtered = add_test_filter(t, products, count, "products");
    const VariableId identity = t.list.temporary(t.name + "identity of Germano", 2);
    {
      TaskBuilder task = t.list.task(t.name + "identity of Germano", t.effect);
      const In in = task.read(filtered);
      const Out out = task.write(identity);
      task.kernel([=](const Row& row) { identity_row<D, C>(row, in, out, o); });
    }
    const VariableId mean = add_test_filter(t, identity, 2, "identity");
    TaskBuilder task = t.list.task(t.name + "eddy viscosity", t.effect);
    const In rho = task.read(state.rho), u = task.read(state.velocity, Stencil::box(1));
    const In in = task.read(mean);
    const Out out = task.write(eddy);
    task.kernel([=](const Row& row) { eddy_row<D, C>(row, rho, u, in, out, o, by_direction); });
  });
}

}  // namespace sluice::ice
