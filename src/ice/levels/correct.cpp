// Adding differences of fluxes to cells, as far as they can bear it.
#include "ice/levels/correction.hpp"
#include "ice/levels/gas_transfer.hpp"

namespace sluice::ice {

void IceTransfer::correct(const StateViews& state, const ConservedChange& change,
                          std::span<double> share) const {
  const std::size_t energy = 1 + components_;
  for (std::size_t n = 0; n < change.cells.size(); ++n) {
    const std::ptrdiff_t place = state[0].offset(change.cells[n]);
    GasCell s{}, d{};
    s.rho = state[0].data[place];
    d.rho = change.amount[0][n];
    s.E = state[energy](change.cells[n]);
    d.E = change.amount[energy][n];
    for (int c = 0; c < components_; ++c) {
      const std::size_t q = 1 + c;
      s.m[c] = state[q](change.cells[n]);
      d.m[c] = change.amount[q][n];
    }
    share[n] = correct_gas(s, d, components_, internal_energy_, fluid_);
    state[0].data[place] = s.rho;
    state[energy](change.cells[n]) = s.E;
    for (int c = 0; c < components_; ++c) state[1 + c](change.cells[n]) = s.m[c];
  }
}

}  // namespace sluice::ice
