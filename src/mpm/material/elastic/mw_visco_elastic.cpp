// mw_visco_elastic: a spring and a Maxwell element side by side (the standard linear solid), in
// shear and in volume.
//
//   sigma  = sigma_e + sigma_v
//   sigma_e' = 2 G_e dev D + K_e tr D I
//   dev sigma_v' = 2 G_v dev D - (G_v/eta_s) dev sigma_v,   p_v' = -K_v tr D - (K_v/eta_v) p_v
// so that a Maxwell element in steady flow bears 2 eta_s dev D and eta_v tr D. Rates in axes that
// turn by Hughes and Winget (objective_step.hpp), half of the turn before the change and half
// behind. With x = dt G_v/eta_s the relaxation in a step of constant D is exact, stable for any x:
//   S <- e^-x S + 2 G_v dt dev D (1 - e^-x)/x
#include <cmath>

#include "mpm/material/base/history_labels.hpp"
#include "mpm/material/base/material_model.hpp"
#include "mpm/material/base/maxwell_step.hpp"
#include "mpm/material/base/rate_form.hpp"

namespace sluice::mpm {
namespace {

struct StandardSolid {
  double spring_shear, spring_bulk;    // Pa
  double maxwell_shear, maxwell_bulk;  // Pa
  double shear_time, bulk_time;        // of relaxation, s
  double density;
  bool objective;

  double shear() const { return spring_shear + maxwell_shear; }
  double bulk() const { return spring_bulk + maxwell_bulk; }
};

class MaxwellSolid final : public Material {
 public:
  explicit MaxwellSolid(const StandardSolid& constants) : c_(constants) {
    history_ = {{history_label("p.maxwellElement"), 6}};
  }
  std::span<const HistoryColumn> history() const override { return history_; }
  double bulk_modulus() const override { return c_.bulk(); }
  double shear_modulus() const override { return c_.shear(); }

  void start(const Batch& b) const override {
    start_without_stress(b, c_.bulk(), c_.shear(), c_.density);
    for (double* column : b.history)
      for (int i = 0; i < b.count; ++i) column[i] = 0;
  }

  std::optional<BatchFault> update(const Batch& b) const override {
    c_.objective ? step<true>(b) : step<false>(b);
    return fault_of_volume(b);
  }

 private:
  template <bool objective>
  void step(const Batch& batch) const {
    const Nine<const double> L = batch.L, F_old = batch.old_F, F = batch.F;
    const Six<const double> old_stress = batch.old_stress;
    Six<const double> old_element;
    Six<double> element;
    for (std::size_t k = 0; k < 6; ++k) {
      old_element[k] = batch.old_history[k];
      element[k] = batch.history[k];
    }
    const Six<double> stress = batch.stress;
    const double *volume_0 = batch.volume_0, *old_energy = batch.old_energy;
    double *energy = batch.energy, *wave_speed = batch.wave_speed;
    const double dt = batch.dt, spring_G2 = 2 * c_.spring_shear, spring_K = c_.spring_bulk;
    const MaxwellStep of_shear = maxwell_step(dt / c_.shear_time);
    const MaxwellStep of_bulk = maxwell_step(dt / c_.bulk_time);
    const double kept = of_shear.kept, G2 = 2 * c_.maxwell_shear * of_shear.taken;
    const double mean_kept = of_bulk.kept, K = c_.maxwell_bulk * of_bulk.taken;
    const double per_density = (c_.bulk() + 4.0 / 3 * c_.shear()) / c_.density;
#pragma GCC ivdep
    for (int i = 0; i < batch.count; ++i) {
      const ObjectiveStep move = rate_step<objective>(at(L, i), dt);
      const std::array<double, 6> d = move.strain;
      const std::array<double, 6> old = half_turned<objective>(at(old_stress, i), move);
      const std::array<double, 6> old_m = half_turned<objective>(at(old_element, i), move);
      const double volume = d[0] + d[1] + d[2], third = volume * (1.0 / 3);
      const double old_mean = (old_m[0] + old_m[1] + old_m[2]) * (1.0 / 3);
      // Of the element: on the diagonal the mean goes its own way.
      const double mean = mean_kept * old_mean + K * volume - kept * old_mean - G2 * third;
      const std::array<double, 6> m = {
          kept * old_m[0] + G2 * d[0] + mean, kept * old_m[1] + G2 * d[1] + mean,
          kept * old_m[2] + G2 * d[2] + mean, kept * old_m[3] + G2 * d[3],
          kept * old_m[4] + G2 * d[4],        kept * old_m[5] + G2 * d[5]};
      const double pressed = spring_K * volume - spring_G2 * third;
      const std::array<double, 6> middle = {old[0] - old_m[0] + spring_G2 * d[0] + pressed + m[0],
                                            old[1] - old_m[1] + spring_G2 * d[1] + pressed + m[1],
                                            old[2] - old_m[2] + spring_G2 * d[2] + pressed + m[2],
                                            old[3] - old_m[3] + spring_G2 * d[3] + m[3],
                                            old[4] - old_m[4] + spring_G2 * d[4] + m[4],
                                            old[5] - old_m[5] + spring_G2 * d[5] + m[5]};
      const std::array<double, 6> s = half_turned<objective>(middle, move);
      const std::array<double, 6> now = half_turned<objective>(m, move);
      const double J = determinant(at(F, i));
      energy[i] =
          old_energy[i] + work_of_step(volume_0[i], determinant(at(F_old, i)), old, J, middle, d);
      wave_speed[i] = std::sqrt(J * per_density);
      put(stress, i, s);
      put(element, i, now);
    }
  }

  StandardSolid c_;
  std::vector<HistoryColumn> history_;
};

std::shared_ptr<const Material> make(const Parameters& p) {
  StandardSolid c;
  c.spring_shear = p.real("e_shear_modulus");
  c.spring_bulk = p.real("e_bulk_modulus");
  c.maxwell_shear = p.real("ve_shear_modulus");
  c.maxwell_bulk = p.real("ve_bulk_modulus");
  if (!(c.bulk() > 0)) {
    p.error("e_bulk_modulus",
            "<e_bulk_modulus> and <ve_bulk_modulus> are both 0: the body sustains no pressure");
    return nullptr;
  }
  const auto time = [](double viscosity, double modulus) {
    return modulus > 0 ? viscosity / modulus : 1;
  };
  c.shear_time = time(p.real("ve_deviatoric_viscosity"), c.maxwell_shear);
  c.bulk_time = time(p.real("ve_volumetric_viscosity"), c.maxwell_bulk);
  c.density = p.constants().density;
  c.objective = p.flag("objective");
  return std::make_shared<MaxwellSolid>(c);
}

}  // namespace

MaterialModel mw_visco_elastic_model() {
  const auto modulus = [](const char* name, const char* doc) {
    return tag(name, doc).once().real().at_least(0);
  };
  return {"mw_visco_elastic",
          {},
          "a spring and a Maxwell element in parallel, in rate form",
          {modulus("e_shear_modulus", "G_e of the spring, Pa"),
           modulus("e_bulk_modulus", "K_e of the spring, Pa"),
           modulus("ve_shear_modulus", "G_v of the Maxwell element, Pa"),
           modulus("ve_bulk_modulus", "K_v of the Maxwell element, Pa"),
           positive("ve_deviatoric_viscosity",
                    "eta_s, Pa s: shear stress relaxes within the time eta_s/G_v"),
           positive("ve_volumetric_viscosity",
                    "eta_v, Pa s: pressure relaxes within the time eta_v/K_v"),
           objective_tag()},
          make};
}

}  // namespace sluice::mpm
