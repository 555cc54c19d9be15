#include "kinetics/species_gas.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <utility>

#include "framework/base/error.hpp"

namespace sluice::kinetics {
namespace {

constexpr double reference_temperature = 298.15;

// h/R of the polynomials of a species, K.
double enthalpy(const std::array<double, 7>& a, double T) {
  return ((((a[4] / 5 * T + a[3] / 4) * T + a[2] / 3) * T + a[1] / 2) * T + a[0]) * T + a[5];
}

}  // namespace

SpeciesGas::SpeciesGas(Mechanism mechanism, std::size_t closure)
    : mechanism_(std::move(mechanism)), closure_(closure) {
  const std::vector<Species>& all = mechanism_.species;
  if (closure_ >= all.size())
    throw InputError(fmt::format("mechanism '{}' has {} species, none of number {}",
                                 mechanism_.name, all.size(), closure_));
  T_min_ = 0;
  T_max_ = std::numeric_limits<double>::infinity();
  T_mid_ = all.front().thermo.T_mid;
  for (const Species& s : all) {
    if (s.thermo.T_mid != T_mid_)
      throw InputError(
          fmt::format("mechanism '{}': the polynomials of {} meet at {:g} K, those of "
                      "{} at {:g} K; a mixture needs one temperature for all",
                      mechanism_.name, s.name, s.thermo.T_mid, all.front().name, T_mid_));
    T_min_ = std::max(T_min_, s.thermo.T_low);
    T_max_ = std::min(T_max_, s.thermo.T_high);
  }
  for (const Species& s : all) {
    Row row{};
    const double R = molar_gas_constant / s.molar_mass;
    row[0] = R;
    for (std::size_t n = 0; n < 5; ++n) {
      row[1 + n] = R * s.thermo.low[n];
      row[6 + n] = R * s.thermo.high[n];
    }
    table_.push_back(row);
    heats_.push_back(from_row(row));
    formation_.push_back(
        R * (enthalpy(s.thermo.low, reference_temperature) - reference_temperature) -
        heats_.back().energy(reference_temperature));
  }
  for (std::size_t k = 0; k < carried(); ++k) {
    Row row = table_[species_of(k)];
    for (std::size_t n = 0; n < row.size(); ++n) row[n] -= table_[closure_][n];
    difference_.push_back(row);
  }
  // cv of most species rises with T, that of atoms falls a little: a fine enough look at all.
  lowest_specific_heat_ = std::numeric_limits<double>::infinity();
  constexpr int looks = 64;
  for (const eos::Nasa7Heat& heat : heats_)
    for (int n = 0; n <= looks; ++n) {
      const double T = T_min_ + n * (T_max_ - T_min_) / looks;
      lowest_specific_heat_ = std::min(lowest_specific_heat_, heat.specific_heat(T));
      highest_gamma_ = std::max(highest_gamma_, heat.ratio(T));
    }
}

void SpeciesGas::all_fractions(const double* carried_fractions, double* all) const {
  double rest = 1.0;
  for (std::size_t k = 0; k < carried(); ++k) {
    all[species_of(k)] = carried_fractions[k];
    rest -= carried_fractions[k];
  }
  all[closure_] = rest;
}

}  // namespace sluice::kinetics
