// comp_neo_hook_plastic: the neo-Hookean solid that yields by von Mises with linear hardening
// (shear_return.hpp).
#include <algorithm>
#include <cmath>

#include "mpm/material/base/batch_math.hpp"
#include "mpm/material/base/history_labels.hpp"
#include "mpm/material/base/objective_step.hpp"
#include "mpm/material/base/particle_random.hpp"
#include "mpm/material/base/shear_return.hpp"
#include "mpm/material/elastic/neo_hook.hpp"

namespace sluice::mpm {
namespace {

constexpr int alpha_column = 6, yield_column = 7;  // b_e in 0..5

class NeoHookPlastic final : public Material {
 public:
  NeoHookPlastic(const NeoHookConstants& constants, const Parameters& p)
      : c_(constants),
        yield_(p.real("yield_stress")),
        hardening_(p.real("hardening_modulus")),
        alpha_(p.real("alpha")),
        range_(p.word("yield_distrib") == "uniform" ? p.real("yield_range") : 0),
        seed_(static_cast<std::uint64_t>(p.real("yield_seed"))) {
    history_ = {
        {history_label("p.bElBar"), 6}, {plastic_strain_label(), 1}, {yield_stress_label(), 1}};
  }

  std::span<const HistoryColumn> history() const override { return history_; }

  void start(const Batch& b) const override {
    for (int i = 0; i < b.count; ++i) {
      for (int k = 0; k < 6; ++k) b.history[k][i] = k < 3 ? 1 : 0;
      b.history[alpha_column][i] = alpha_;
      b.history[yield_column][i] =
          range_ == 0 ? yield_ : yield_ + range_ * (2 * particle_random(b.id[i], seed_, 0) - 1);
      const double J = determinant(at(b.F, i)) * c_.J0;
      const double pressure = 0.5 * c_.bulk * (J - 1 / J);
      for (int k = 0; k < 6; ++k) b.stress[k][i] = k < 3 ? pressure : 0;
      b.energy[i] = b.volume_0[i] * 0.5 * c_.bulk * volume_logs(J).energy;
      b.wave_speed[i] = std::sqrt((0.5 * c_.bulk * (J * J + 1) + 4.0 / 3 * c_.shear) / c_.density);
    }
  }

  std::optional<BatchFault> update(const Batch& batch) const override {
    if (c_.expansion != 0 && batch.temperature != nullptr)
      step<true>(batch);
    else
      step<false>(batch);
    return fault_of_volume(batch);
  }
  double bulk_modulus() const override { return c_.bulk; }
  double shear_modulus() const override { return c_.shear; }

 private:
  template <bool thermal>
  void step(const Batch& batch) const {
    const Nine<const double> F_columns = batch.F, L_columns = batch.L;
    const Six<double> stress = batch.stress;
    Six<const double> old_b;
    Six<double> b_e;
    for (int k = 0; k < 6; ++k) {
      old_b[k] = batch.old_history[k];
      b_e[k] = batch.history[k];
    }
    const double *old_alpha = batch.old_history[alpha_column], *volume_0 = batch.volume_0;
    const double *old_yield = batch.old_history[yield_column], *temperature = batch.temperature;
    double *alpha = batch.history[alpha_column], *yield = batch.history[yield_column];
    double *energy = batch.energy, *wave_speed = batch.wave_speed;
    const double K = c_.bulk, G = c_.shear, H = hardening_, J0 = c_.J0, dt = batch.dt;
    const double per_density = 1 / c_.density, alpha_0 = alpha_;
    const double expansion = c_.expansion, room = c_.room;
#pragma GCC ivdep
    for (int i = 0; i < batch.count; ++i) {
      std::array<double, 9> f = at(L_columns, i);
      for (double& x : f) x *= dt;
      f[0] += 1;
      f[4] += 1;
      f[8] += 1;
      const ShearState now = shear_return(at(old_b, i), f, G, old_yield[i], H, old_alpha[i]);
      const std::array<double, 6> s = now.s, b = now.b;
      const double a = now.alpha, m = now.m;
      alpha[i] = a;
      yield[i] = old_yield[i];

      const double J_F = determinant(at(F_columns, i)), J = J_F * J0;
      double pressure = 0.5 * K * (J - 1 / J), stored = 0.5 * K * volume_logs(J).energy;
      if constexpr (thermal) {
        const double J_T = thermal_volume(expansion, temperature[i], room);
        const double of_heat = 0.5 * K * (J_T - 1 / J_T);
        pressure -= of_heat;
        stored -= 0.5 * K * volume_logs(J_T).energy + of_heat * (J - J_T);
      }
      const double per_J = 1 / J_F;
      stress[0][i] = pressure + per_J * s[0];
      stress[1][i] = pressure + per_J * s[1];
      stress[2][i] = pressure + per_J * s[2];
      stress[3][i] = per_J * s[3];
      stress[4][i] = per_J * s[4];
      stress[5][i] = per_J * s[5];
      // What is stored, and the plastic work until now: the integral of sigma_Y + H alpha.
      const double plastic = (a - alpha_0) * (old_yield[i] + 0.5 * H * (a + alpha_0));
      energy[i] = volume_0[i] * (stored + 1.5 * G * (m - 1) + plastic);
      const double modulus = 0.5 * K * (J * J + 1) + G * (4.0 / 3 * m + eigenvalue_reach(b, m));
      wave_speed[i] = std::sqrt(modulus * per_density);
      b_e[0][i] = b[0];
      b_e[1][i] = b[1];
      b_e[2][i] = b[2];
      b_e[3][i] = b[3];
      b_e[4][i] = b[4];
      b_e[5][i] = b[5];
    }
  }

  NeoHookConstants c_;
  double yield_, hardening_, alpha_, range_;
  std::uint64_t seed_;
  std::vector<HistoryColumn> history_;
};

}  // namespace

std::shared_ptr<const Material> make_neo_hook_plastic(const NeoHookConstants& constants,
                                                      const Parameters& p) {
  if (constants.shear > 0) return std::make_shared<NeoHookPlastic>(constants, p);
  p.error("shear_modulus", "a body that yields needs a shear modulus greater than 0");
  return nullptr;
}

}  // namespace sluice::mpm
