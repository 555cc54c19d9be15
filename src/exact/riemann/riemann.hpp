// Exact solution of the Riemann problem of two ideal gases, vacuum included.
//
// Each side keeps its own ratio of specific heats, so that two-gas problems are covered. The
// pressure p* between the waves is the root of f_L(p) + f_R(p) + u_R - u_L = 0, with
//   f(p) = (p - p_K) sqrt(A/(p + B)),  A = 2/((g+1) rho_K), B = (g-1)/(g+1) p_K   (shock, p > p_K)
//   f(p) = 2 c_K/(g-1) ((p/p_K)^((g-1)/2g) - 1)                                   (rarefaction)
// Reference: E. F. Toro, Riemann Solvers and Numerical Methods for Fluid Dynamics, 3rd ed.
// (Springer, 2009), sections 4.2-4.6, eqs. 4.5-4.8, 4.46-4.50, 4.56, 4.63, 4.74-4.82.
// SI units: kg/m^3, m/s, Pa; gamma is the ratio of specific heats.
#pragma once

namespace sluice::exact {

// One side of a Riemann problem. Density 0 is vacuum (its velocity and pressure do not count).
struct GasState {
  double density = 0, velocity = 0, pressure = 0;
  double gamma = 1.4;
  double sound_speed() const;
};

class RiemannSolution {
 public:
  // Throws InputError when a state is not admissible (density or pressure below zero, a gas of
  // zero pressure on both sides, gamma <= 1).
  RiemannSolution(GasState left, GasState right);

  bool vacuum() const { return vacuum_; }           // a void lies between the two gases
  double star_pressure() const { return p_star_; }  // 0 with a void
  double star_velocity() const { return u_star_; }  // of the contact; 0 with a void
  double star_density_left() const { return rho_star_left_; }
  double star_density_right() const { return rho_star_right_; }

  // Slowest and fastest signal of a side's wave: equal for a shock, head and tail of a fan.
  struct WaveSpeeds {
    double head, tail;
  };
  WaveSpeeds left_wave() const { return left_wave_; }
  WaveSpeeds right_wave() const { return right_wave_; }

  // State on the ray x/t = speed.
  GasState sample(double speed) const;

 private:
  void solve();
  void set_waves();
  GasState sample_right(double speed) const;

  GasState left_, right_;
  bool vacuum_ = false;
  double p_star_ = 0, u_star_ = 0, rho_star_left_ = 0, rho_star_right_ = 0;
  WaveSpeeds left_wave_{}, right_wave_{};
};

}  // namespace sluice::exact
