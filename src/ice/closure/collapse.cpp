// Bubbles take the temperature of the liquid that closes on them.
#include "ice/closure/collapse.hpp"

namespace sluice::ice::mixture {
namespace {

// threshold: share of the cell's mass below which a gas is a bubble that takes the temperature of
//   the liquid that closes on it: air of 1 bar in 1e-3 of a cell of water; unit: 1; test:
//   Cavitation.OpensAndCollapses
constexpr double trace_of_mass = 1e-6;
// threshold: growth of its pressure in one step, as a factor, above which a bubble counts as
//   closing; unit: 1; test: Cavitation.OpensAndCollapses
constexpr double closing = 4.0;

// gamma - 1; of what is no gas 0.
double gas_ratio(const Fluid& fluid) {
  const eos::IdealGas* law = fluid.heat ? nullptr : fluid.gamma_law();
  return law == nullptr ? 0.0 : law->gamma - 1.0;
}

}  // namespace

Collapse::Collapse(const std::vector<Fluid>& fluids) : fluids_(fluids) {
  bool gas = false, liquid = false;
  for (const Fluid& fluid : fluids) {
    G_.push_back(gas_ratio(fluid));
    (G_.back() > 0.0 ? gas : liquid) = true;
  }
  possible_ = gas && liquid;
}

void Collapse::set_law(int m, const Fluid& fluid) {
  fluids_[m] = fluid;
  G_[m] = gas_ratio(fluid);
}

std::uint64_t Collapse::traces_of_gas(const Equilibration::Cell& cell, double density) const {
  std::uint64_t set = 0;
  for (std::size_t m = 0; m < G_.size(); ++m)
    if (G_[m] > 0.0 && cell.M[m] > 0.0 && cell.M[m] < trace_of_mass * density)
      set |= std::uint64_t{1} << m;
  return set;
}

void Collapse::remember(const Equilibration::Cell& cell, std::uint64_t traces,
                        double* before) const {
  for_each_of(traces, [&](int m) { before[m] = G_[m] * cell.E[m] / cell.V[m]; });
}

bool Collapse::settle(const Equilibration::Cell& cell, std::uint64_t traces, const double* before,
                      double q) const {
  int heaviest = 0;
  for (int m = 1; m < static_cast<int>(G_.size()); ++m)
    if (cell.M[m] > cell.M[heaviest]) heaviest = m;
  if (G_[heaviest] > 0.0) return false;
  bool changed = false;
  for_each_of(traces, [&](int m) {
    if (!(q > closing * before[m])) return;
    const double V = cell.V[heaviest];
    const double T = fluids_[heaviest].temperature(cell.M[heaviest] / V, cell.E[heaviest] / V);
    const double E = cell.M[m] * fluids_[m].specific_heat * T;  // e = cv T
    if (!(E < cell.E[m])) return;
    const double volume = G_[m] * E / q;  // V = (gamma - 1) E / q
    cell.E[heaviest] += cell.E[m] - E;
    cell.V[heaviest] += cell.V[m] - volume;
    cell.E[m] = E;
    cell.V[m] = volume;
    changed = true;
  });
  return changed;
}

}  // namespace sluice::ice::mixture
