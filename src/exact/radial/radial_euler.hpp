// One-dimensional Euler equations with planar, cylindrical or spherical symmetry on a fixed grid: a
// plain second-order Godunov code, the yardstick of what such a code makes of a problem. Its
// contacts spread; the reference where no closed form exists is RadialLagrangian.
//
// MUSCL-Hancock with limited slopes of primitive variables, HLLC fluxes, and exact cell volumes and
// face areas, so that the pressure term alone is a source:
//   V d(rho, m, E)/dt = -[A F] + (0, p (A+ - A-), 0).
// References: E. F. Toro, Riemann Solvers and Numerical Methods for Fluid Dynamics, 3rd ed.
// (Springer, 2009), sections 10.4-10.6 (HLLC), 14.4 (MUSCL-Hancock), 17.1 (explosions);
// P. Woodward and P. Colella, J. Comput. Phys. 54 (1984) 115-173, section IV (blast waves).
// Limit: one ideal gas; second order in smooth flow, first at shocks, as any such scheme.
#pragma once
#include <vector>

#include "exact/radial/radial_problem.hpp"

namespace sluice::exact {

class RadialEuler {
 public:
  explicit RadialEuler(RadialProblem problem);

  void advance_to(double t);  // from the present time on, s
  double time() const { return time_; }
  const RadialProblem& problem() const { return problem_; }
  int steps() const { return steps_; }

  // Linear between cell centres.
  RadialState at(double r) const;
  // Integrals over the domain, kg and J per m^2 of area, rad of angle and m of length, or solid
  // angle.
  double total_mass() const;
  double total_energy() const;

 private:
  void step(double dt);
  double stable_step() const;
  void fill_ghosts(std::vector<double>& q, double sign_at_wall) const;
  void find_primitives();
  void predict(double dt);
  void mirror_faces();
  void find_fluxes();

  RadialProblem problem_;
  double dr_;
  double time_ = 0;
  int steps_ = 0;
  std::vector<double> area_, volume_, centre_;                       // faces; cells with ghosts
  std::vector<double> rho_, mom_, ene_, u_, p_;                      // cells with two ghosts
  std::vector<double> rho_lo_, u_lo_, p_lo_, rho_hi_, u_hi_, p_hi_;  // predicted face values
  std::vector<double> p_half_;                                       // cells, half a step on
  std::vector<double> flux_rho_, flux_mom_, flux_ene_;               // faces
};

}  // namespace sluice::exact
