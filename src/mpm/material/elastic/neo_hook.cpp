// comp_neo_hook, and the names of its family: elastic here, plastic in neo_hook_plastic.cpp.
#include "mpm/material/elastic/neo_hook.hpp"
#include "mpm/material/base/cell_pressure_tag.hpp"

#include <cmath>

#include "mpm/material/base/batch_math.hpp"
#include "mpm/material/base/material_model.hpp"

namespace sluice::mpm {
namespace {

class NeoHook final : public Material {
 public:
  explicit NeoHook(const NeoHookConstants& constants) : c_(constants) {}

  void start(const Batch& batch) const override { evaluate(batch); }
  std::optional<BatchFault> update(const Batch& batch) const override {
    evaluate(batch);
    return fault_of_volume(batch);
  }
  double bulk_modulus() const override { return c_.bulk; }
  double shear_modulus() const override { return c_.shear; }
  bool stress_of_state() const override { return true; }
  const NeoHookConstants& constants() const { return c_; }

 private:
  void evaluate(const Batch& batch) const {
    if (c_.expansion != 0 && batch.temperature != nullptr)
      evaluate_at<true>(batch);
    else
      evaluate_at<false>(batch);
  }

  template <bool thermal>
  void evaluate_at(const Batch& batch) const {
    const Nine<const double> F_columns = batch.F;
    const Six<double> stress = batch.stress;
    const double *volume_0 = batch.volume_0, *temperature = batch.temperature;
    double *energy = batch.energy, *wave_speed = batch.wave_speed;
    const double K = c_.bulk, G = c_.shear, J0 = c_.J0, expansion = c_.expansion, room = c_.room;
    const double per_density = 1 / c_.density;
#pragma GCC ivdep
    for (int i = 0; i < batch.count; ++i) {
      const std::array<double, 9> F = at(F_columns, i);
      const double J_F = determinant(F), J = J_F * J0;
      const double root = inverse_cube_root(J_F), G_bar = G * root * root;  // G J^(-2/3)
      const std::array<double, 6> b = left_cauchy_green(F);
      const double mean = (b[0] + b[1] + b[2]) * (1.0 / 3);

      const double U = volume_logs(J).energy;
      double pressure = 0.5 * K * (J - 1 / J), stored = 0.5 * K * U;
      if constexpr (thermal) {
        const double J_T = thermal_volume(expansion, temperature[i], room);
        const double of_heat = 0.5 * K * (J_T - 1 / J_T);
        pressure -= of_heat;  // W is least, and 0, at J = J_T
        stored -= 0.5 * K * volume_logs(J_T).energy + of_heat * (J - J_T);
      }
      const double per_J = G_bar / J_F;
      stress[0][i] = pressure + per_J * (b[0] - mean);
      stress[1][i] = pressure + per_J * (b[1] - mean);
      stress[2][i] = pressure + per_J * (b[2] - mean);
      stress[3][i] = per_J * b[3];
      stress[4][i] = per_J * b[4];
      stress[5][i] = per_J * b[5];
      energy[i] = volume_0[i] * (stored + 1.5 * (G_bar * mean - G));
      // rho_0 c^2 = K/2 (J^2 + 1) + G_bar (4/3 mean + reach): no less than the largest eigenvalue
      // of the acoustic tensor in any direction, equal at rest (docs/theory/mpm_materials.md).
      const double modulus =
          0.5 * K * (J * J + 1) + G_bar * (4.0 / 3 * mean + eigenvalue_reach(b, mean));
      wave_speed[i] = std::sqrt(modulus * per_density);
    }
  }

  NeoHookConstants c_;
};

Tags elastic_tags() {
  return {positive("bulk_modulus", "K, Pa"),
          tag("shear_modulus", "G, Pa").once().real().at_least(0),
          cell_pressure_tag("useModifiedEOS"),
          choice("useInitialStress", "whether the initial state has <initial_pressure>", false),
          number("initial_pressure", "p, Pa", 0)};
}

Tags plastic_tags(bool plastic) {
  Tags tags = elastic_tags();
  const Tags further = {choice("usePlasticity", "whether the body yields", plastic),
                        tag("yield_stress", "sigma_Y, Pa").real().at_least(0),
                        number("hardening_modulus", "H, Pa", 0),
                        number("alpha", "initial equivalent plastic strain", 0),
                        tag("yield_distrib",
                            "strength of the particles: one for all, or uniformly distributed over "
                            "sigma_Y -/+ yield_range")
                            .words({"constant", "uniform"})
                            .by_default("constant"),
                        number("yield_range", "half width of the distribution of strengths, Pa", 0),
                        number("yield_seed", "seed of the random strengths", 0)};
  tags.insert(tags.end(), further.begin(), further.end());
  return tags;
}

std::shared_ptr<const Material> make(const Parameters& p) {
  const NeoHookConstants constants = neo_hook_constants(p);
  if (!p.flag("usePlasticity")) return make_neo_hook(constants);
  if (p.has("yield_stress")) return make_neo_hook_plastic(constants, p);
  p.error("yield_stress", "needs <yield_stress> if it yields",
          "or write <usePlasticity>false</usePlasticity>");
  return nullptr;
}

}  // namespace

std::optional<NeoHookConstants> neo_hookean(const Material& law) {
  const auto* neo_hook = dynamic_cast<const NeoHook*>(&law);
  if (neo_hook == nullptr) return std::nullopt;
  return neo_hook->constants();
}

NeoHookConstants neo_hook_constants(const Parameters& p) {
  NeoHookConstants c;
  c.bulk = p.real("bulk_modulus");
  c.shear = p.real("shear_modulus");
  c.density = p.constants().density;
  c.expansion = p.constants().thermal_expansion;
  c.room = p.constants().room_temperature;
  if (p.flag("useInitialStress")) {
    const double x = -p.real("initial_pressure") / c.bulk;  // (J - 1/J)/2 = x
    c.J0 = x + std::sqrt(x * x + 1);
  }
  return c;
}

std::shared_ptr<const Material> make_neo_hook(const NeoHookConstants& constants) {
  return std::make_shared<NeoHook>(constants);
}

MaterialModel comp_neo_hook_model() {
  return {"comp_neo_hook", {"cnh_damage"}, "neo-Hookean solid, elastic", plastic_tags(false), make};
}
MaterialModel comp_neo_hook_plastic_model() {
  return {"comp_neo_hook_plastic",
          {"cnhp_damage"},
          "neo-Hookean solid with von Mises plasticity and linear hardening",
          plastic_tags(true),
          make};
}
MaterialModel UCNH_model() {
  return {"UCNH",
          {"ucnh"},
          "the same solid; <usePlasticity> selects whether it yields",
          plastic_tags(false),
          make};
}

}  // namespace sluice::mpm
