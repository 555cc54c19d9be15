// jwlpp_mpm: an explosive that turns from Murnaghan's solid into products of JWL (JWL++, Souers
// 2000).
//
//   p = (1 - f) p_M + f p_J   (explosive.hpp)
//   df/dt = G (1 - f) p^b once p has passed the ignition pressure
// The rate is integrated with p on a straight line over sub-steps in which f changes little.
#include <algorithm>
#include <cmath>

#include "mpm/material/base/material_model.hpp"
#include "mpm/material/hydrodynamic/explosive.hpp"

namespace sluice::mpm {
namespace {

struct BurnRate {
  double ignition, G, b, max_burned;
};

class Jwlpp final : public Explosive {
 public:
  Jwlpp(const ExplosiveMixture& mixture, double J0, double density, const BurnRate& rate)
      : Explosive(mixture, J0, density, "p.progressdelF"), c_(rate) {}

  std::optional<BatchFault> update(const Batch& b) const override {
    if (const auto fault = fault_of_volume(b)) return fault;
    for (int i = 0; i < b.count; ++i) {
      const double J_0 = determinant(at(b.old_F, i)), J = determinant(at(b.F, i));
      const double f_0 = b.old_history[0][i], p_0 = -b.old_stress[0][i];
      const double f = p_0 > c_.ignition || f_0 > 0 ? burnt(f_0, J_0, J, b.dt) : f_0;
      b.history[1][i] = f - f_0;
      set_burnt(b, i, f);
    }
    return std::nullopt;
  }

 private:
  // f after a step in which J goes from one value to the other.
  double burnt(double f, double J_0, double J_1, double dt) const {
    constexpr double most = 0.02;  // relative, in a sub-step
    double t = 0;
    for (int k = 0; k < 100000 && t < dt && f < c_.max_burned; ++k) {
      const auto rate = [&](double at_time, double at_f) {
        const double J = (J_0 + (J_1 - J_0) * at_time / dt) * J0();
        return c_.G * std::pow(std::max(mixture().pressure(J, at_f), 0.0), c_.b);
      };
      // Neither 1 - f nor p changes by more than `most`.
      const double r = rate(t, f), J = (J_0 + (J_1 - J_0) * t / dt) * J0();
      const double p = mixture().pressure(J, f), rise = mixture().products(J) - mixture().solid(J);
      const double quickest = r * std::max(1.0, std::abs(rise) * (1 - f) / std::max(p, 1e-300));
      const double h = std::min(dt - t, quickest > 0 ? most / quickest : dt);
      // Midpoint: -d ln(1 - f)/dt = G p^b.
      const double half = 1 - (1 - f) * std::exp(-0.5 * h * r);
      f = 1 - (1 - f) * std::exp(-h * rate(t + 0.5 * h, half));
      t = h == dt - t ? dt : t + h;
      if (1 - f < 1e-12) f = 1;
    }
    return std::min(f, c_.max_burned);
  }

  BurnRate c_;
};

std::shared_ptr<const Material> make(const Parameters& p) {
  const ExplosiveMixture mixture = {p.real("murnaghan_K"), p.real("murnaghan_n"), p.real("jwl_A"),
                                    p.real("jwl_B"),       p.real("jwl_C"),       p.real("jwl_R1"),
                                    p.real("jwl_R2"),      p.real("jwl_om")};
  const BurnRate rate = {p.real("ignition_pressure"), p.real("reaction_G"), p.real("reaction_b"),
                         p.real("max_burned_fraction")};
  double J0 = 1;
  if (p.flag("useInitialStress")) {
    const double base = 1 + mixture.n * mixture.K * p.real("initial_pressure");
    if (!(base > 0)) {
      p.error("initial_pressure", "<initial_pressure> is below the lowest pressure of the solid");
      return nullptr;
    }
    J0 = std::pow(base, -1 / mixture.n);
  }
  return std::make_shared<Jwlpp>(mixture, J0, p.constants().density, rate);
}

}  // namespace

MaterialModel jwlpp_mpm_model() {
  return {
      "jwlpp_mpm",
      {},
      "explosive that reacts from Murnaghan's solid to products of JWL",
      {positive("ignition_pressure", "pressure of ignition, Pa"),
       positive("murnaghan_K", "compressibility of the solid, 1/Pa"),
       positive("murnaghan_n", "derivative of its bulk modulus by pressure"),
       positive("jwl_A", "pressure of the first exponential, Pa"),
       number("jwl_B", "pressure of the second exponential, Pa"),
       number("jwl_C", "pressure of the power of density, Pa"),
       positive("jwl_R1", "first exponent"), positive("jwl_R2", "second exponent"),
       positive("jwl_om", "Grueneisen coefficient"),
       number("jwl_rho0", "accepted without effect: the density of the material is used", 0),
       positive("reaction_G", "rate of burning, 1/(s Pa^b)"),
       positive("reaction_b", "exponent of the pressure"),
       number("max_burn_timestep_size", "accepted without effect: sub-steps follow the rate",
              1e-12),
       number("max_burned_fraction", "burnt fraction at which burning ends", 1).above(0).at_most(1),
       choice("useInitialStress", "whether the initial state has <initial_pressure>", false),
       number("initial_pressure", "Pa", 0),
       choice("doFastStressCompute", "accepted without effect", false),
       number("tolerance_for_Newton_iterations", "accepted without effect", 1e-3),
       number("maximum_number_of_Newton_iterations", "accepted without effect", 20)},
      make};
}

}  // namespace sluice::mpm
