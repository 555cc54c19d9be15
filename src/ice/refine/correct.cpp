// Adding differences of fluxes to cells, as far as they can bear it.
//
//   rho' = rho + drho,  m' = m + dm,  E' = E + dE_tot - v.dm + |v|^2 drho/2 - rho' |dv|^2/2
// with v = m/rho and dv = (dm - v drho)/rho': total energy in the frame of the cell, so that no
// kinetic energy is subtracted. In the classic form the change of internal energy is given itself.
// A cell keeps at least a tenth of its density and of its internal energy.
#include <cmath>
#include <limits>

#include "ice/refine/ice_transfer.hpp"

namespace sluice::ice {
namespace {

constexpr double least_kept = 0.1;
constexpr double shares[] = {1.0, 0.5, 0.25, 0.125};

struct Cell {
  double rho, m[3], E;
};

class Corrector {
 public:
  Corrector(int components, bool internal_energy)
      : components_(components), internal_energy_(internal_energy) {}

  // The state after this share of the change.
  Cell changed(const Cell& s, const Cell& change, double share) const {
    Cell n;
    const double drho = share * change.rho;
    n.rho = s.rho + drho;
    double square = 0, along = 0, lag = 0;
    for (int c = 0; c < components_; ++c) {
      const double v = s.m[c] / s.rho, dm = share * change.m[c];
      const double shift = dm - v * drho;
      n.m[c] = s.m[c] + dm;
      square += v * v;
      along += v * dm;
      lag += shift * shift;
    }
    n.E = s.E + share * change.E;
    if (!internal_energy_) n.E += (0.5 * square * drho - along) - 0.5 * lag / n.rho;
    return n;
  }

  static bool bearable(const Cell& before, const Cell& after) {
    constexpr double most = std::numeric_limits<double>::max();
    return after.rho >= least_kept * before.rho && after.E >= least_kept * before.E &&
           after.rho <= most && after.E <= most;
  }

 private:
  int components_;
  bool internal_energy_;
};

}  // namespace

void IceTransfer::correct(const StateViews& state, const ConservedChange& change,
                          std::span<double> share) const {
  const Corrector corrector(components_, internal_energy_);
  const auto energy = static_cast<std::size_t>(1 + components_);
  for (std::size_t n = 0; n < change.cells.size(); ++n) {
    const std::ptrdiff_t place = state[0].offset(change.cells[n]);
    Cell s{}, d{};
    s.rho = state[0].data[place];
    d.rho = change.amount[0][n];
    s.E = state[energy](change.cells[n]);
    d.E = change.amount[energy][n];
    for (int c = 0; c < components_; ++c) {
      const auto q = static_cast<std::size_t>(1 + c);
      s.m[c] = state[q](change.cells[n]);
      d.m[c] = change.amount[q][n];
    }
    share[n] = 0.0;
    for (const double part : shares) {
      const Cell now = corrector.changed(s, d, part);
      if (!Corrector::bearable(s, now)) continue;
      state[0].data[place] = now.rho;
      state[energy](change.cells[n]) = now.E;
      for (int c = 0; c < components_; ++c)
        state[static_cast<std::size_t>(1 + c)](change.cells[n]) = now.m[c];
      share[n] = part;
      break;
    }
  }
}

}  // namespace sluice::ice
