// hypo_elastic: linear elasticity in rate form.
//
//   sigma_m   = R^(1/2) sigma_n R^(-1/2)                     at the middle of the step
//   sigma_n+1 = R^(1/2) [sigma_m + dt (2 G dev D + K tr D I)] R^(-1/2),   D less thermal strain
// R and D by Hughes and Winget (objective_step.hpp). <objective>false</objective>: R = I and
// D = sym L, where turning a stressed body gives false stress.
#include <cmath>

#include "mpm/material/base/cell_pressure_tag.hpp"
#include "mpm/material/base/history_labels.hpp"
#include "mpm/material/base/material_model.hpp"
#include "mpm/material/base/rate_form.hpp"

namespace sluice::mpm {
namespace {

class HypoElastic final : public Material {
 public:
  HypoElastic(double bulk, double shear, double density, double expansion, bool objective)
      : bulk_(bulk),
        shear_(shear),
        density_(density),
        expansion_(expansion),
        objective_(objective) {
    if (expansion != 0)
      history_.push_back(
          {declare_label(
               {"p.strainTemperature", ValueType::real, Centring::particle, "K",
                "temperature up to which the thermal strain of a rate-form law is applied"}),
           1});
  }

  std::span<const HistoryColumn> history() const override { return history_; }

  void start(const Batch& b) const override {
    start_without_stress(b, bulk_, shear_, density_);
    if (expansion_ != 0)
      for (int i = 0; i < b.count; ++i) b.history[0][i] = b.temperature[i];
  }

  std::optional<BatchFault> update(const Batch& b) const override {
    if (objective_)
      expansion_ != 0 ? step<true, true>(b) : step<true, false>(b);
    else
      expansion_ != 0 ? step<false, true>(b) : step<false, false>(b);
    return fault_of_volume(b);
  }
  double bulk_modulus() const override { return bulk_; }
  double shear_modulus() const override { return shear_; }

 private:
  template <bool objective, bool thermal>
  void step(const Batch& batch) const {
    const Nine<const double> L = batch.L, F_old = batch.old_F, F = batch.F;
    const Six<const double> old_stress = batch.old_stress;
    const Six<double> stress = batch.stress;
    const double *volume_0 = batch.volume_0, *old_energy = batch.old_energy;
    const double* temperature = batch.temperature;
    const double* taken_to = thermal ? batch.old_history[0] : nullptr;
    double* now_taken_to = thermal ? batch.history[0] : nullptr;
    double *energy = batch.energy, *wave_speed = batch.wave_speed;
    const double G2 = 2 * shear_, third = bulk_ - 2.0 / 3 * shear_, dt = batch.dt;
    const double per_density = (bulk_ + 4.0 / 3 * shear_) / density_, expansion = expansion_;
#pragma GCC ivdep
    for (int i = 0; i < batch.count; ++i) {
      const ObjectiveStep move = rate_step<objective>(at(L, i), dt);
      const std::array<double, 6> d = move.strain;
      const std::array<double, 6> old = half_turned<objective>(at(old_stress, i), move);
      double volume = third * (d[0] + d[1] + d[2]);
      if constexpr (thermal) {
        volume -= 3 * bulk_ * expansion * (temperature[i] - taken_to[i]);
        now_taken_to[i] = temperature[i];
      }
      const std::array<double, 6> middle = {
          old[0] + G2 * d[0] + volume, old[1] + G2 * d[1] + volume, old[2] + G2 * d[2] + volume,
          old[3] + G2 * d[3],          old[4] + G2 * d[4],          old[5] + G2 * d[5]};
      const std::array<double, 6> s = half_turned<objective>(middle, move);
      const double J = determinant(at(F, i));
      energy[i] =
          old_energy[i] + work_of_step(volume_0[i], determinant(at(F_old, i)), old, J, middle, d);
      wave_speed[i] = std::sqrt(J * per_density);
      put(stress, i, s);
    }
  }

  double bulk_, shear_, density_, expansion_;
  bool objective_;
  std::vector<HistoryColumn> history_;
};

}  // namespace

MaterialModel hypo_elastic_model() {
  return {
      "hypo_elastic",
      {},
      "linear elasticity in rate form",
      {tag("G", "shear modulus, Pa").once().real().at_least(0), positive("K", "bulk modulus, Pa"),
       number("alpha", "linear thermal expansion, 1/K; in addition to that of the material", 0),
       cell_pressure_tag("useModifiedEOS"), objective_tag()},
      [](const Parameters& p) -> std::shared_ptr<const Material> {
        return std::make_shared<HypoElastic>(p.real("K"), p.real("G"), p.constants().density,
                                             p.real("alpha") + p.constants().thermal_expansion,
                                             p.flag("objective"));
      }};
}

}  // namespace sluice::mpm
