#include "kinetics/reactor.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "framework/base/error.hpp"

namespace sluice::kinetics {
namespace {

// Beyond these a trial of Newton's method has gone astray.
constexpr double coldest = 1, hottest = 1e5;  // K

}  // namespace

Reactor::Reactor(const SpeciesGas& gas, Tolerances tolerances)
    : gas_(gas),
      tolerances_(tolerances),
      rates_(gas),
      keeper_(gas.mechanism()),
      solver_(*this, gas.count() + 1) {
  if (!(tolerances.relative > 0 && tolerances.temperature > 0 && tolerances.fraction > 0))
    throw InputError("the tolerances of the chemistry must be positive");
  const std::size_t count = gas.count();
  for (const Species& species : gas.mechanism().species) molar_mass_.push_back(species.molar_mass);
  for (std::vector<double>* space : {&fractions_, &start_, &change_, &by_T_}) space->resize(count);
  slopes_.resize(count + 1);
  by_c_.resize(count * count);
}

bool Reactor::slopes(const double* y, double* f) {
  const std::size_t count = gas_.count();
  const double T = y[count];
  if (!(T > coldest && T < hottest)) return false;
  rates_.at(T);
  rates_.production(y, f);
  const double* h = rates_.potentials().enthalpy();
  const double* cp = rates_.potentials().heat();
  double released = 0, capacity = 0;  // over R T, and over R
  for (std::size_t k = 0; k < count; ++k) {
    released -= (h[k] - 1) * f[k];
    capacity += (cp[k] - 1) * y[k];
  }
  f[count] = T * released / capacity;
  return std::isfinite(f[count]);
}

// The derivative of cv by T is left out.
void Reactor::jacobian(const double* y, double** columns) {
  const std::size_t count = gas_.count();
  const double T = y[count];
  slopes(y, slopes_.data());
  rates_.derivatives(y, by_c_.data(), by_T_.data());
  const double* h = rates_.potentials().enthalpy();
  const double* cp = rates_.potentials().heat();
  double capacity = 0, released_by_T = 0;  // over R
  for (std::size_t k = 0; k < count; ++k) {
    capacity += (cp[k] - 1) * y[k];
    released_by_T -= (cp[k] - 1) * slopes_[k] + T * (h[k] - 1) * by_T_[k];
  }
  const double inverse = 1 / capacity;
  for (std::size_t j = 0; j < count; ++j) {
    const double* of_c = &by_c_[j * count];
    double released = 0;
    for (std::size_t k = 0; k < count; ++k) {
      columns[j][k] = of_c[k];
      released -= (h[k] - 1) * of_c[k];
    }
    columns[j][count] = (T * released - slopes_[count] * (cp[j] - 1)) * inverse;
  }
  std::copy(by_T_.begin(), by_T_.end(), columns[count]);
  columns[count][count] = released_by_T * inverse;
}

// Sets the unknowns; the temperature.
double Reactor::start(double rho, double energy, const double* Y) {
  const std::size_t count = gas_.count();
  gas_.all_fractions(Y, fractions_.data());
  double* y = solver_.unknowns();
  double* absolute = solver_.absolute_tolerances();
  for (std::size_t k = 0; k < count; ++k) {
    y[k] = start_[k] = rho * std::max(fractions_[k], 0.0) / molar_mass_[k];
    absolute[k] = rho * tolerances_.fraction / molar_mass_[k];
  }
  absolute[count] = tolerances_.temperature;
  y[count] = gas_.heat([&](std::size_t k) { return Y[k]; }).temperature(energy);
  return y[count];
}

bool Reactor::inert(double rho, double dt) {
  const std::size_t count = gas_.count();
  if (!slopes(solver_.unknowns(), slopes_.data())) return false;
  const double time = std::max(dt, horizon);
  const double fraction = inert_share * std::min(tolerances_.fraction, 1e-12);
  for (std::size_t k = 0; k < count; ++k)
    if (!(std::abs(slopes_[k]) * molar_mass_[k] * time <= fraction * rho)) return false;
  return std::abs(slopes_[count]) * time <= inert_share * tolerances_.temperature;
}

// The change of the concentrations as one of Y; the heat that it releases.
double Reactor::commit(double rho, double* Y) {
  double* y = solver_.unknowns();
  for (std::size_t k = 0; k < gas_.count(); ++k) {
    y[k] = std::max(y[k], 0.0);
    change_[k] = y[k] - start_[k];
  }
  keeper_.correct(y, change_.data());
  const double closure = gas_.formation_energy(gas_.closure());
  double heat = 0;
  for (std::size_t k = 0; k < gas_.carried(); ++k) {
    const std::size_t species = gas_.species_of(k);
    const double old = Y[k];
    Y[k] = old + change_[species] * molar_mass_[species] / rho;
    heat -= (Y[k] - old) * (gas_.formation_energy(species) - closure);
  }
  return rho * heat;
}

void Reactor::fail(double rho, double T, const double* Y, const std::string& problem) const {
  std::string fractions;
  for (std::size_t k = 0; k < gas_.carried(); ++k)
    fractions += fmt::format(", {} {:.6g}", gas_.name_of(k), Y[k]);
  throw PhysicsError(
      fmt::format("the chemistry of a cell with T = {:.6g} K, density {:.6g} kg/m^3, mass "
                  "fractions{} cannot be integrated: {}",
                  T, rho, fractions.substr(std::min<std::size_t>(1, fractions.size())), problem));
}

Reactor::Result Reactor::advance(double rho, double energy, double* Y, double dt) {
  const double T = start(rho, energy, Y);
  if (rates_.reactions() == 0 || inert(rho, dt)) return {0, dt, 0};
  const StiffSolver::Outcome outcome = solver_.advance(dt, tolerances_.relative);
  if (!outcome.good) fail(rho, T, Y, outcome.problem);
  return {commit(rho, Y), outcome.last_step, outcome.steps};
}

}  // namespace sluice::kinetics
