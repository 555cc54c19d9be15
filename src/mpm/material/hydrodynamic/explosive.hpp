// What explosives as particles have in common: a burnt fraction f that the law of burning gives,
// and the pressure of a mixture after it.
//
//   sigma = -p(v, f) I,   v = J J0 of the solid without pressure   (explosive_mixture.hpp)
//   energy: the work of sigma;   rho c^2 = max(-v dp/dv, 1e-3/K)
#pragma once
#include <algorithm>
#include <cmath>
#include <vector>

#include "mpm/material/base/batch_math.hpp"
#include "mpm/material/base/history_labels.hpp"
#include "mpm/material/base/material.hpp"
#include "mpm/material/hydrodynamic/explosive_mixture.hpp"

namespace sluice::mpm {

class Explosive : public Material {
 public:
  std::span<const HistoryColumn> history() const final { return history_; }
  double bulk_modulus() const final { return 1 / mixture_.K; }

  // Nothing is burnt.
  void start(const Batch& b) const override {
    for (int i = 0; i < b.count; ++i) {
      b.history[0][i] = b.history[1][i] = 0;
      b.energy[i] = 0;
      set_stress(b, i, determinant(at(b.F, i)), 0);
    }
  }

 protected:
  // J0: density of the solid without pressure over that of the material (kg/m^3). Beside f, a law
  // keeps one more number of each particle.
  Explosive(const ExplosiveMixture& mixture, double J0, double density, const char* kept)
      : mixture_(mixture), J0_(J0), density_(density) {
    history_ = {{history_label("p.progressF"), 1}, {history_label(kept), 1}};
  }

  // Particle i after a step, of which f is burnt.
  void set_burnt(const Batch& b, int i, double f) const {
    const double J_0 = determinant(at(b.old_F, i)), J = determinant(at(b.F, i));
    b.history[0][i] = f;
    set_stress(b, i, J, f);
    b.energy[i] =
        b.old_energy[i] + 0.5 * b.volume_0[i] * (b.old_stress[0][i] + b.stress[0][i]) * (J - J_0);
  }
  const ExplosiveMixture& mixture() const { return mixture_; }
  double J0() const { return J0_; }

 private:
  void set_stress(const Batch& b, int i, double J, double f) const {
    const double v = J * J0_, p = mixture_.pressure(v, f);
    for (int k = 0; k < 6; ++k) b.stress[k][i] = k < 3 ? -p : 0;
    const double modulus = std::max(mixture_.modulus(v, f), 1e-3 / mixture_.K);
    b.wave_speed[i] = std::sqrt(modulus * J / density_);
  }

  ExplosiveMixture mixture_;
  double J0_, density_;
  std::vector<HistoryColumn> history_;
};

}  // namespace sluice::mpm
