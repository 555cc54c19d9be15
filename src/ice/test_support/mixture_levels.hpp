// States of several materials in one box, for tests of what happens where levels meet.
#pragma once
#include "ice/levels/mixture_transfer.hpp"
#include "ice/test_support/fluid.hpp"
#include "ice/test_support/transfer.hpp"

namespace sluice::ice {

// Two gases and a liquid.
inline std::vector<Fluid> three_fluids() {
  return {ideal_gas(1.4, 700), stiffened_gas(4.4, 60), ideal_gas(5.0 / 3, 300)};
}

class MixtureState {
 public:
  MixtureState(const IndexBox& box, const TransferCase& c, std::size_t materials,
               bool multi_velocity = false)
      : box_(box), layout_{materials, static_cast<std::size_t>(c.components), multi_velocity} {
    data_.assign(layout_.quantities(), std::vector<double>(box.volume(), 0.0));
    const BoxState shape(box, c);
    for (std::vector<double>& values : data_) {
      RealView v = shape.views().front();
      v.data = values.data();
      views_.push_back(v);
    }
  }
  MixtureState(const MixtureState&) = delete;
  MixtureState& operator=(const MixtureState&) = delete;

  const IndexBox& box() const { return box_; }
  const MixtureLayout& layout() const { return layout_; }
  const StateViews& views() const { return views_; }
  double& at(std::size_t q, IntVec3 cell) const { return views_[q](cell); }
  double& mass(std::size_t m, IntVec3 cell) const { return at(layout_.mass(m), cell); }
  double& energy(std::size_t m, IntVec3 cell) const { return at(layout_.energy(m), cell); }
  double& volume(std::size_t m, IntVec3 cell) const { return at(layout_.volume(m), cell); }
  double& momentum(std::size_t c, IntVec3 cell) const { return at(layout_.momentum(c), cell); }
  double& slip(std::size_t m, std::size_t c, IntVec3 cell) const {
    return at(layout_.slip(m, c), cell);
  }

  double density(IntVec3 cell) const {
    double rho = 0;
    for (std::size_t m = 0; m < layout_.materials; ++m) rho += mass(m, cell);
    return rho;
  }
  long double total_energy(IntVec3 cell) const {
    long double square = 0, internal = 0;
    for (std::size_t c = 0; c < layout_.components; ++c)
      square += static_cast<long double>(momentum(c, cell)) * momentum(c, cell);
    for (std::size_t m = 0; m < layout_.materials; ++m) {
      internal += energy(m, cell);
      for (std::size_t c = 0; c < layout_.components && layout_.multi_velocity; ++c)
        if (const long double S = slip(m, c, cell); S != 0) internal += S * S / (2 * mass(m, cell));
    }
    return internal + square / (2.0L * density(cell));
  }
  // A material that fills a share of a cell with this density at this pressure.
  void put(std::size_t m, const Fluid& fluid, double share, double rho, double p, IntVec3 cell) {
    volume(m, cell) = share;
    mass(m, cell) = share * rho;
    energy(m, cell) = share > 0 ? share * fluid.energy_from_pressure(rho, p, 300) : 0.0;
  }
  void set_velocity(const double* u, IntVec3 cell) {
    for (std::size_t c = 0; c < layout_.components; ++c) momentum(c, cell) = density(cell) * u[c];
  }
  double pressure(std::size_t m, const Fluid& fluid, IntVec3 cell) const {
    return fluid.pressure(mass(m, cell) / volume(m, cell), energy(m, cell) / volume(m, cell));
  }

 private:
  IndexBox box_;
  MixtureLayout layout_;
  std::vector<std::vector<double>> data_;
  StateViews views_;
};

// Cells of one, two or three of the materials in patches, at random densities. A velocity and a
// pressure of their own in each cell, or these of all.
inline void fill_with_mixtures(MixtureState& state, const std::vector<Fluid>& fluids, unsigned seed,
                               const double* velocity = nullptr, double pressure = 0) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> share(0.1, 1.0), power(-2, 2), speed(-1, 1);
  for_each_cell(state.box(), [&](IntVec3 cell) {
    // Bits of the materials: mostly those of the block of three cells a direction.
    const int block = (cell.x + 30) / 3 + 2 * ((cell.y + 30) / 3) + (cell.z + 30) / 3;
    unsigned which = 1U << static_cast<unsigned>(block % 3);
    if (random() % 4 == 0) which = static_cast<unsigned>(random() % 7) + 1;
    double shares[3], sum = 0;
    for (unsigned m = 0; m < 3; ++m) {
      shares[m] = (which >> m & 1U) != 0 ? share(random) : 0.0;
      if (random() % 8 == 0) shares[m] *= 1e-12;
      sum += shares[m];
    }
    const double p = pressure > 0 ? pressure : std::pow(10.0, power(random));
    for (unsigned m = 0; m < 3; ++m)
      state.put(m, fluids[m], shares[m] / sum, std::pow(10.0, power(random)), p, cell);
    double own[3];
    for (double& u : own) u = speed(random);
    state.set_velocity(velocity != nullptr ? velocity : own, cell);
  });
}

// Means of all quantities and of total energy in place of the internal ones.
inline Conserved mean_of(const MixtureState& state, const IndexBox& cells) {
  const MixtureLayout& l = state.layout();
  Conserved m;
  m.value.assign(l.quantities() + 1, 0);
  m.magnitude = m.value;
  const auto n = static_cast<long double>(cells.volume());
  for_each_cell(cells, [&](IntVec3 cell) {
    for (std::size_t q = 0; q <= l.quantities(); ++q) {
      if (q >= l.energy(0) && q < l.volume(0)) continue;
      const long double x = q == l.quantities() ? state.total_energy(cell) : state.at(q, cell);
      m.value[q] += x / n;
      m.magnitude[q] += std::fabs(x) / n;
    }
  });
  return m;
}

inline int different(const MixtureState& a, const MixtureState& b, const IndexBox& cells) {
  int count = 0;
  for_each_cell(cells, [&](IntVec3 cell) {
    for (std::size_t q = 0; q < a.layout().quantities(); ++q)
      count += !same_bits(a.at(q, cell), b.at(q, cell));
  });
  return count;
}

// Cells that break a rule: absent materials are zero throughout, volumes fill the cell, to the bit
// where a material is alone, and what is present is a state of its law.
inline int broken_cells(const MixtureState& state, const std::vector<Fluid>& fluids,
                        const IndexBox& cells) {
  int broken = 0;
  for_each_cell(cells, [&](IntVec3 cell) {
    double volume = 0;
    int present = 0;
    bool fine = true;
    for (std::size_t m = 0; m < fluids.size(); ++m) {
      const double M = state.mass(m, cell), V = state.volume(m, cell), E = state.energy(m, cell);
      volume += V;
      if (M == 0.0) {
        fine = fine && V == 0.0 && E == 0.0;
        continue;
      }
      ++present;
      fine = fine && M > 0 && V > 0 && fluids[m].admissible(M / V, E / V);
    }
    fine = fine && present > 0 && std::fabs(volume - 1.0) < 1e-15;
    if (present == 1) fine = fine && volume == 1.0;
    broken += !fine;
  });
  return broken;
}

}  // namespace sluice::ice
