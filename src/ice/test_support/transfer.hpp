// States of one box for tests of what happens where levels meet.
#pragma once
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <ostream>
#include <random>
#include <vector>

#include "framework/grid/box_list.hpp"
#include "ice/levels/gas_transfer.hpp"

namespace sluice::ice {

// One case: how many directions, which ratio, how many components of momentum.
struct TransferCase {
  std::array<bool, 3> active{true, true, false};
  IntVec3 ratio{2, 2, 1};
  int components = 2;

  TransferGeometry geometry() const { return {ratio, active}; }
  friend void PrintTo(const TransferCase& c, std::ostream* out) {
    for (int d = 0; d < 3; ++d)
      if (c.active[d]) *out << "xyz"[d] << c.ratio[d] << " ";
    *out << c.components << " components";
  }
};

inline std::vector<TransferCase> transfer_cases() {
  return {{{true, false, false}, {2, 1, 1}, 1}, {{true, false, false}, {4, 1, 1}, 2},
          {{false, true, false}, {1, 2, 1}, 3}, {{true, true, false}, {2, 2, 1}, 2},
          {{true, false, true}, {4, 1, 4}, 3},  {{true, true, false}, {4, 2, 1}, 2},
          {{true, true, true}, {2, 2, 2}, 3},   {{true, true, true}, {4, 4, 4}, 3},
          {{true, true, true}, {2, 1, 4}, 3}};
}

// The whole state of a box.
class BoxState {
 public:
  BoxState(const IndexBox& box, const TransferCase& c) : box_(box), components_(c.components) {
    const std::size_t n = box.volume();
    data_.assign(components_ + 2, std::vector<double>(n, 0.0));
    for (std::vector<double>& values : data_) {
      RealView v;
      v.data = values.data();
      v.box = box;
      std::ptrdiff_t stride = 1;
      for (int d = 0; d < 3; ++d) {
        v.stride[d] = c.active[d] ? stride : 0;
        if (c.active[d]) stride *= box.size()[d];
      }
      views_.push_back(v);
    }
  }
  BoxState(const BoxState&) = delete;
  BoxState& operator=(const BoxState&) = delete;

  const IndexBox& box() const { return box_; }
  const StateViews& views() const { return views_; }
  int components() const { return components_; }
  int quantities() const { return components_ + 2; }
  double& at(int q, IntVec3 cell) const { return views_[q](cell); }
  double& rho(IntVec3 cell) const { return at(0, cell); }
  double& momentum(int c, IntVec3 cell) const { return at(1 + c, cell); }
  double& energy(IntVec3 cell) const { return at(1 + components_, cell); }
  long double total_energy(IntVec3 cell) const {
    long double square = 0;
    for (int c = 0; c < components_; ++c)
      square += static_cast<long double>(momentum(c, cell)) * momentum(c, cell);
    return energy(cell) + square / (2.0L * rho(cell));
  }
  void fill(double density, const double* velocity, double internal, IntVec3 cell) {
    rho(cell) = density;
    for (int c = 0; c < components_; ++c) momentum(c, cell) = density * velocity[c];
    energy(cell) = internal;
  }

 private:
  IndexBox box_;
  int components_;
  std::vector<std::vector<double>> data_;
  StateViews views_;
};

// Coarse cells of a case, with one layer around them; inactive directions have one cell.
inline IndexBox coarse_cells(const TransferCase& c, int n) {
  IndexBox box{{0, 0, 0}, {1, 1, 1}};
  for (int d = 0; d < 3; ++d)
    if (c.active[d]) {
      box.lower[d] = -2;
      box.upper[d] = n - 2 + d;
    }
  return box;
}

inline IndexBox with_layer(const IndexBox& cells, const TransferCase& c) {
  IntVec3 layer{};
  for (int d = 0; d < 3; ++d) layer[d] = c.active[d] ? 1 : 0;
  return cells.grown(layer);
}

// Densities, pressures over many powers of ten, Mach numbers up to millions.
inline void fill_wildly(BoxState& state, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> power(-3, 3), speed(-1, 1);
  for_each_cell(state.box(), [&](IntVec3 cell) {
    double u[3];
    const double scale = std::pow(10.0, power(random));
    for (double& component : u) component = scale * speed(random);
    const double rho = std::pow(10.0, power(random));
    state.fill(rho, u, std::pow(10.0, 2.0 * power(random)), cell);
  });
}

// The fine cells of a coarse one.
inline IndexBox children_of(IntVec3 cell, const TransferCase& c) {
  return refine(IndexBox{cell, cell + IntVec3::all(1)}, c.ratio);
}

inline bool same_bits(double a, double b) {
  return std::memcmp(&a, &b, sizeof a) == 0;
}

// How many values of two states differ in their bits, in these cells.
inline int different(const BoxState& a, const BoxState& b, const IndexBox& cells) {
  int count = 0;
  for_each_cell(cells, [&](IntVec3 cell) {
    for (int q = 0; q < a.quantities(); ++q) count += !same_bits(a.at(q, cell), b.at(q, cell));
  });
  return count;
}

// Means of the conserved quantities of fine cells: mass, momenta, total energy; and of what their
// sums are made of, which is what round-off is measured by.
struct Conserved {
  std::vector<long double> value, magnitude;
};

inline Conserved mean_of(const BoxState& state, const IndexBox& cells) {
  Conserved m;
  const int energy = state.components() + 1;
  m.value.assign(energy + 1, 0);
  m.magnitude = m.value;
  const auto n = static_cast<long double>(cells.volume());
  for_each_cell(cells, [&](IntVec3 cell) {
    for (int q = 0; q <= energy; ++q) {
      const long double x = q == energy ? state.total_energy(cell) : state.at(q, cell);
      m.value[q] += x / n;
      m.magnitude[q] += std::fabs(x) / n;
    }
  });
  return m;
}

// Largest difference of two sets of means, as a share of their magnitude.
inline double worst_difference(const Conserved& a, const Conserved& b) {
  long double worst = 0;
  for (std::size_t q = 0; q < a.value.size(); ++q) {
    const long double scale = std::max(a.magnitude[q], b.magnitude[q]);
    if (scale > 0) worst = std::max(worst, std::fabs(a.value[q] - b.value[q]) / scale);
  }
  return static_cast<double>(worst);
}

}  // namespace sluice::ice
