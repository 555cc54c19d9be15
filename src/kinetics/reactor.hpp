// A cell of gas that reacts at constant volume without exchange of heat.
//
//   dc_k/dt = omega_k (rates.hpp),   dT/dt = -sum u_k omega_k / sum c_k cv_k
// with the molar internal energies u_k, energies of formation among them. The unknowns are all c_k
// and T. T only steers the rates: what is handed back is the change of mass fractions, and the
// heat that follows from it, so that e + sum Y_k e0_k (species_gas.hpp) is kept to round-off
// whatever the tolerances. Atoms are kept to round-off too (element_keeper.hpp): fractions that
// end a little below 0, of the size of the tolerance, are set to 0 before. Fractions that are
// negative at the start take no part and keep their value.
//
// Inert cells are left as they are, see Reactor::inert_share.
#pragma once
#include <cstddef>
#include <memory>
#include <vector>

#include "kinetics/element_keeper.hpp"
#include "kinetics/rates.hpp"
#include "kinetics/species_gas.hpp"
#include "kinetics/stiff_solver.hpp"

namespace sluice::kinetics {

// Of local errors; relative ones of all unknowns. What the fractions of radicals err by before they
// have grown moves the ignition: that of hydrogen and air at 1000 K, in calls of 2 microseconds, by
// 3e-3 of the delay with fraction = 1e-12, by 1e-4 with 1e-14 for a fifth more time.
struct Tolerances {
  double relative = 1e-8;
  double temperature = 1e-6;  // K
  double fraction = 1e-14;    // of mass
};

// One object per thread.
class Reactor : private StiffSystem {
 public:
  // Keeps a reference to the gas. InputError: a tolerance that is not positive.
  Reactor(const SpeciesGas& gas, Tolerances tolerances);
  Reactor(const Reactor&) = delete;
  Reactor& operator=(const Reactor&) = delete;

  // A cell is inert where the rates of the start, kept up for `horizon` or dt if that is longer,
  // change no mass fraction by more than this share of its tolerance (or of 1e-12 if that is
  // less), nor T by more than this share of its own. The step itself is mostly a millionth of the
  // horizon and less, so a chain of reactions may multiply radicals a million times within it
  // before the cell's change reaches the share; and initiation as slow as this is that of a gas
  // too cold for chains to branch.
  static constexpr double inert_share = 0.1;
  static constexpr double horizon = 1.0;  // s

  struct Result {
    double heat = 0;       // released, J/m^3: -rho sum of dY_k e0_k
    double last_step = 0;  // s; dt where the cell is inert
    long steps = 0;        // 0 where the cell is inert
  };
  // Over dt > 0, s. rho: kg/m^3; energy: the sensible one of the start, J/kg; Y: carried() mass
  // fractions, changed in place. The bits do not depend on earlier calls. PhysicsError with T, rho
  // and Y where the integration fails; Y is then as it was.
  Result advance(double rho, double energy, double* Y, double dt);

 private:
  bool slopes(const double* y, double* f) override;
  void jacobian(const double* y, double** columns) override;

  double start(double rho, double energy, const double* Y);
  bool inert(double rho, double dt);
  double commit(double rho, double* Y);
  [[noreturn]] void fail(double rho, double T, const double* Y, const std::string& problem) const;

  const SpeciesGas& gas_;
  Tolerances tolerances_;
  Rates rates_;
  ElementKeeper keeper_;
  StiffSolver solver_;
  std::vector<double> molar_mass_;  // by species, kg/mol
  // Workspaces by species.
  std::vector<double> fractions_, start_, change_, slopes_, by_c_, by_T_;
};

}  // namespace sluice::kinetics
