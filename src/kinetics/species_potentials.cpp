#include "kinetics/species_potentials.hpp"

#include <algorithm>
#include <cmath>

namespace sluice::kinetics {
namespace {

using Row = std::array<double, 7>;

double heat_over_R(const Row& a, double T) {
  return (((a[4] * T + a[3]) * T + a[2]) * T + a[1]) * T + a[0];
}
double enthalpy_over_R(const Row& a, double T) {  // h/R, K
  return ((((a[4] / 5 * T + a[3] / 4) * T + a[2] / 3) * T + a[1] / 2) * T + a[0]) * T + a[5];
}
double entropy_over_R(const Row& a, double T, double log_T) {
  return (((a[4] / 4 * T + a[3] / 3) * T + a[2] / 2) * T + a[1]) * T + a[0] * log_T + a[6];
}

// The row whose cp/R these coefficients give, through the h/R and s/R of `from` at T.
Row joined(const std::array<double, 5>& coefficients, const Row& from, double T) {
  Row row{};
  std::copy(coefficients.begin(), coefficients.end(), row.begin());
  row[5] = enthalpy_over_R(from, T) - enthalpy_over_R(row, T);
  row[6] = entropy_over_R(from, T, std::log(T)) - entropy_over_R(row, T, std::log(T));
  return row;
}

}  // namespace

SpeciesPotentials::SpeciesPotentials(const SpeciesGas& gas) {
  const std::size_t count = gas.count();
  for (std::vector<Row>& rows : rows_) rows.resize(count);
  heat_.resize(count);
  enthalpy_.resize(count);
  gibbs_.resize(count);
  const eos::Nasa7Heat& any = gas.heat_of(0);
  bounds_ = {any.T_min, any.T_mid, any.T_max};
  for (std::size_t k = 0; k < count; ++k) {
    const eos::Nasa7Heat& law = gas.heat_of(k);
    Row low{};
    std::copy(law.low.begin(), law.low.end(), low.begin());
    low[5] = (gas.sensible_enthalpy(k, law.T_min) + gas.formation_energy(k)) / law.gas_constant -
             enthalpy_over_R(low, law.T_min);
    low[6] = gas.mechanism().species[k].thermo.low[6];
    const Row high = joined(law.high, low, law.T_mid);
    rows_[0][k] = joined({heat_over_R(low, law.T_min), 0, 0, 0, 0}, low, law.T_min);
    rows_[1][k] = low;
    rows_[2][k] = high;
    rows_[3][k] = joined({heat_over_R(high, law.T_max), 0, 0, 0, 0}, high, law.T_max);
  }
}

void SpeciesPotentials::at(double T) {
  const std::size_t range = T < bounds_[0] ? 0 : T < bounds_[1] ? 1 : T < bounds_[2] ? 2 : 3;
  const double inverse = 1 / T, log_T = std::log(T);
  const std::vector<Row>& rows = rows_[range];
  for (std::size_t k = 0; k < rows.size(); ++k) {
    heat_[k] = heat_over_R(rows[k], T);
    enthalpy_[k] = enthalpy_over_R(rows[k], T) * inverse;
    gibbs_[k] = enthalpy_[k] - entropy_over_R(rows[k], T, log_T);
  }
}

}  // namespace sluice::kinetics
