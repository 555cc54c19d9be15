// elastic_plastic, elastic_plastic_hp, rf_elastic_plastic: metals that yield by von Mises (or
// Gurson) with a strength that depends on strain, rate, temperature and pressure. One step of a
// particle:
//
//   Sigma = R_0^T sigma R_0, strain = strain_between(U_0, U_1)     in the body's own axes
//   S_tr  = S + 2 mu strain' (or relaxed by <deviatoric_stress_model>, metal_deviator.hpp),
//     mu and T_m of p, T at the start; T > T_m: S_tr = 0 (do_melting)
//   |S_tr| > (2/3)^(1/2) sigma_y: S and eps_p by the return of metal_return.hpp
//   p     by <equation_of_state>, with the work of the stress
//   dT/dt = chi sigma_y d eps_p/(rho C dt), and -T Gamma_0 dJ/dt with mie_gruneisen
//   sigma = R_1 (S - p I) R_1^T
// Only F enters, so turning the body changes nothing. <objective>false</objective>: dt sym L is
// added in axes that stand still.
#include <algorithm>
#include <cmath>

#include "framework/deck/faults.hpp"
#include "mpm/material/base/batch_math.hpp"
#include "mpm/material/base/cell_pressure_tag.hpp"
#include "mpm/material/base/history_labels.hpp"
#include "mpm/material/base/material_model.hpp"
#include "mpm/material/metal/metal_deviator.hpp"
#include "mpm/material/metal/metal_failure.hpp"
#include "mpm/material/metal/metal_flow.hpp"
#include "mpm/material/metal/metal_moduli.hpp"
#include "mpm/material/metal/metal_pressure.hpp"
#include "mpm/material/metal/metal_return.hpp"

namespace sluice::mpm {
namespace {

struct MetalConstants {
  double bulk = 0, density = 0;
  ShearModulus shear;
  MeltingTemperature melting;
  SpecificHeat heat;
  MetalPressure pressure;
  YieldCondition yield;
  MaxwellElements elements;
  Pores pores;
  Stability stability = Stability::none;
  double taylor_quinney = 0.9, room = 294;
  bool melts = true, check_pores = true, erodes = false, objective = true;
};

class Metal final : public Material {
 public:
  Metal(const MetalConstants& constants, MetalFlow flow) : c_(constants), flow_(std::move(flow)) {
    history_ = {{plastic_strain_label(), 1},
                {plastic_strain_rate_label(), 1},
                {history_label("p.strainRate"), 1}};
    if (c_.pores.evolve || c_.yield.porous) {
      porosity_at_ = columns();
      history_.push_back({history_label("p.porosity"), 1});
    }
    if (c_.erodes) {
      failed_at_ = columns();
      history_.push_back({localized_label(), 1});
    }
    if (c_.pressure.form == MetalPressure::Form::hypo && c_.pressure.expansion != 0) {
      temperature_at_ = columns();
      history_.push_back({strain_temperature_label(), 1});
    }
    if (!c_.elements.none()) {
      elements_at_ = columns();
      history_.push_back({history_label("p.maxwellDeviators"), c_.elements.columns()});
    }
  }

  std::span<const HistoryColumn> history() const override { return history_; }
  double bulk_modulus() const override { return c_.bulk; }
  bool has_shock_equation() const override {
    return c_.pressure.form == MetalPressure::Form::mie_gruneisen;
  }
  double shear_modulus() const override { return c_.shear.mu_0; }
  int failed_column() const override { return failed_at_; }

  void start(const Batch& b) const override {
    for (int i = 0; i < b.count; ++i) {
      for (double* column : b.history) column[i] = 0;
      if (porosity_at_ >= 0) b.history[porosity_at_][i] = c_.pores.at_start(b.id[i]);
      if (temperature_at_ >= 0) b.history[temperature_at_][i] = b.temperature[i];
      for (double* column : b.stress) column[i] = 0;
      b.energy[i] = 0;
      const double J = determinant(at(b.F, i));
      const MetalState state = state_at(J, 0, b.temperature[i]);
      const MetalPressure::Result p =
          c_.pressure({J, J, 0, 0, 0, b.temperature[i], b.temperature[i]});
      b.wave_speed[i] = wave_speed(p.modulus, state.shear, J);
    }
  }

  std::optional<BatchFault> update(const Batch& batch) const override {
    if (const auto fault = fault_of_volume(batch)) return fault;
    return std::visit([&](const auto& flow) { return steps(flow, batch); }, flow_);
  }

 private:
  int columns() const { return static_cast<int>(history_.size()); }

  double wave_speed(double modulus, double shear, double J) const {
    return std::sqrt(std::max(modulus + 4.0 / 3 * shear, 1e-3 * c_.bulk) * J / c_.density);
  }

  MetalState state_at(double J, double p, double T) const {
    MetalState state;
    state.temperature = T;
    state.pressure = p;
    state.compression = 1 / J;
    state.density = c_.density / J;
    state.melt = c_.melting(state);
    state.shear = c_.shear(state);
    return state;
  }

  // What turned and strained one particle (T: double) or eight (T: Eight).
  template <class T>
  struct MotionOf {
    std::array<T, 9> R_0, R_1;
    std::array<T, 6> strain;
  };
  using Motion = MotionOf<double>;

  template <class F>
  std::optional<BatchFault> steps(const F& flow, const Batch& b) const {
    std::optional<BatchFault> fault;
    const auto go = [&](std::size_t i, const Motion& move) {
      const int p = static_cast<int>(i);
      if (!fault && !step(flow, b, p, move))
        fault = BatchFault{p, "past the pole of Mie-Grueneisen", volume(b, p)};
    };
    for_eights(0, static_cast<std::size_t>(b.count), [&](auto p) {
      const auto moves = motion_of(b, p);
      for (std::size_t l = 0; l < p.count; ++l) go(p.i + l, lane_of(moves, l));
    });
    return fault;
  }
  static const Motion& lane_of(const Motion& one, std::size_t) { return one; }
  static Motion lane_of(const MotionOf<Eight>& all, std::size_t l) {
    Motion one;
    for (std::size_t m = 0; m < 9; ++m) {
      one.R_0[m] = all.R_0[m][l];
      one.R_1[m] = all.R_1[m][l];
    }
    for (std::size_t m = 0; m < 6; ++m) one.strain[m] = all.strain[m][l];
    return one;
  }
  static double volume(const Batch& b, int i) { return determinant(at(b.F, i)); }

  template <class P>
  MotionOf<typename P::Number> motion_of(const Batch& b, const P& p) const {
    using T = typename P::Number;
    if (!c_.objective) {
      std::array<T, 9> L = at(b.L, p), still;
      for (T& x : L) x *= b.dt;
      for (std::size_t m = 0; m < 9; ++m) still[m] = T{} + identity[m];
      return {still, still, symmetric(L)};
    }
    const PolarOf<T> old = polar(at(b.old_F, p)), now = polar(at(b.F, p));
    return {old.R, now.R, strain_between(old.U, now.U)};
  }

  template <class F>
  bool step(const F& flow, const Batch& b, int i, const Motion& move) const {
    const Matrix F_0 = at(b.old_F, i), F_1 = at(b.F, i);
    const double J_0 = determinant(F_0), J_1 = determinant(F_1), dt = b.dt;
    const Symmetric old = pushed(at(b.old_stress, i), transposed(move.R_0));
    const Symmetric S_0 = deviator(old), strain = deviator(move.strain);
    const double p_0 = -trace(old) / 3, T = b.temperature[i];
    const MetalState state = state_at(J_1, p_0, T);
    const double old_strain = b.old_history[0][i];
    const double old_porosity = porosity_at_ >= 0 ? b.old_history[porosity_at_][i] : 0;

    const MaxwellElements::Trial trial = trial_of(b, i, state.shear, S_0, strain);
    Symmetric S = trial.S;
    const double size = std::sqrt(double_dot(S, S));
    const auto here = flow.at(state);
    MetalReturn r;
    const bool liquid = T > state.melt;
    if (liquid && c_.melts) {
      r.keep = 0;
    } else {
      r = returned(flow, here, c_.yield,
                   {size, trial.mu, old_strain, b.old_history[1][i], -3 * p_0, old_porosity, dt});
    }
    const Symmetric direction = combined(1 / (size + 1e-300), S, 0, S);
    for (double& x : S) x *= r.keep;

    const double work = 0.5 * (J_0 * double_dot(S_0, strain) + J_1 * double_dot(S, strain));
    const double E_0 = b.old_energy[i] / b.volume_0[i];
    const double rest = temperature_at_ >= 0 ? b.old_history[temperature_at_][i] : c_.room;
    const double heat = b.heat != nullptr ? b.heat[i] / b.volume_0[i] : 0;
    const MetalPressure::Result pressure = c_.pressure({J_0, J_1, p_0, E_0 + heat, work, rest, T});
    if (!pressure.good) return false;
    b.energy[i] = b.volume_0[i] * (E_0 + work - 0.5 * (p_0 + pressure.p) * (J_1 - J_0));
    b.wave_speed[i] = wave_speed(pressure.modulus, state.shear, J_1);

    Symmetric sigma = S;
    for (std::size_t k = 0; k < 3; ++k) sigma[k] -= pressure.p;
    sigma = pushed(sigma, move.R_1);
    for (std::size_t k = 0; k < 6; ++k) b.stress[k][i] = sigma[k];

    const double C = c_.heat(T);
    if (elements_at_ >= 0)
      b.heating[i] += relaxed(b, i, state.shear, strain, trial, r, liquid && c_.melts) /
                      (state.density * C * dt);
    add_heating(b, i, state, r, C, J_1 - J_0);

    b.history[0][i] = old_strain + r.more_strain;
    b.history[1][i] = r.more_strain / dt;
    b.history[2][i] = root_2_3 * std::sqrt(double_dot(move.strain, move.strain)) / dt;
    const double porosity = grow_pores(b, i, J_1 / J_0, old_porosity, old_strain, r);
    if (temperature_at_ >= 0) b.history[temperature_at_][i] = T;
    if (failed_at_ >= 0)
      b.history[failed_at_][i] = b.old_history[failed_at_][i] != 0
                                     ? b.old_history[failed_at_][i]
                                     : failed(flow, here, state, move.strain, direction, r,
                                              old_strain, porosity, C, dt, liquid);
    return true;
  }

  // The deviator if the step is elastic, from the one before it.
  MaxwellElements::Trial trial_of(const Batch& b, int i, double mu, const Symmetric& before,
                                  const Symmetric& strain) const {
    if (elements_at_ < 0) return {combined(1, before, 2 * mu, strain), mu};
    return c_.elements.trial(b.old_history.subspan(elements_at_), i, mu, b.dt, strain);
  }

  // Heating by plastic work, and by compression along an isentrope; C: J/(kg K).
  void add_heating(const Batch& b, int i, const MetalState& state, const MetalReturn& r, double C,
                   double stretch) const {
    b.heating[i] += c_.taylor_quinney * r.yield * r.more_strain / (state.density * C * b.dt);
    if (c_.pressure.form != MetalPressure::Form::mie_gruneisen) return;
    const double warmed = std::expm1(-c_.pressure.Gamma_0 * stretch);
    b.heating[i] += b.temperature[i] * warmed / b.dt;
    if (b.isentropic != nullptr) b.isentropic[i] = warmed;
  }

  // The porosity behind the step; `stretch`: of the volume.
  double grow_pores(const Batch& b, int i, double stretch, double old_porosity, double old_strain,
                    const MetalReturn& r) const {
    if (porosity_at_ < 0) return old_porosity;
    double porosity = old_porosity;
    if (c_.pores.evolve)
      porosity = c_.pores.grown(old_porosity, std::log(stretch), old_strain, r.more_strain);
    return b.history[porosity_at_][i] = porosity;
  }

  // Writes the Maxwell elements; what they turned into heat, J/m^3.
  double relaxed(const Batch& b, int i, double mu, const Symmetric& strain,
                 const MaxwellElements::Trial& trial, const MetalReturn& r, bool melted) const {
    const std::size_t at_first = elements_at_;
    const std::span<double* const> now = b.history.subspan(at_first);
    if (melted) {
      for (double* column : now) column[i] = 0;
      return 0;
    }
    // Less the plastic strain, (1 - keep) S_tr/(2 mu).
    const Symmetric rest = combined(1, strain, -(1 - r.keep) / (2 * trial.mu), trial.S);
    return c_.elements.take(b.old_history.subspan(at_first), now, i, mu, b.dt, rest);
  }

  // 1 where the particle fails in this step.
  template <class F, class Here>
  double failed(const F& flow, const Here& here, const MetalState& state, const Symmetric& strain,
                const Symmetric& N, const MetalReturn& r, double old_strain, double porosity,
                double C, double dt, bool liquid) const {
    if (liquid || r.soft) return 1;
    if (c_.check_pores && porosity_at_ >= 0 && porosity > c_.pores.critical) return 1;
    if (c_.stability == Stability::none || !(r.more_strain > 0)) return 0;
    // d sigma_f/d eps_p with the heat that the strain makes.
    const double more = 1e-4, rate = r.more_strain / dt;
    MetalState warmer = state;
    warmer.temperature += c_.taylor_quinney * r.yield * more / (state.density * C);
    const double hardening = (flow.stress(flow.at(warmer), old_strain + more, rate) -
                              flow.stress(here, old_strain, rate)) /
                             more;
    return unstable(c_.stability, strain, N, state.shear, c_.bulk, hardening) ? 1 : 0;
  }

  MetalConstants c_;
  MetalFlow flow_;
  std::vector<HistoryColumn> history_;
  int porosity_at_ = -1, failed_at_ = -1, temperature_at_ = -1, elements_at_ = -1;
};

std::shared_ptr<const Material> make(const Parameters& p) {
  MetalConstants c;
  c.bulk = p.real("bulk_modulus");
  c.density = p.constants().density;
  c.shear = read_shear_modulus(p, p.real("shear_modulus"));
  c.melting = read_melting(p);
  c.heat = read_specific_heat(p);
  if (!p.flag("compute_specific_heat")) c.heat.form = SpecificHeat::Form::constant;
  if (c.heat.form == SpecificHeat::Form::constant && !(c.heat.value > 0))
    p.error("specific_heat_model", "<specific_heat> of the material must be greater than 0");
  c.pressure = read_metal_pressure(p, c.bulk);
  c.pressure.expansion = p.real("coeff_thermal_expansion");
  c.yield = read_yield_condition(p);
  c.stability = read_stability(p);
  c.pores = read_pores(p);
  c.taylor_quinney = p.real("taylor_quinney_coeff");
  c.room = p.real("initial_material_temperature");
  c.melts = p.flag("do_melting");
  c.check_pores = p.flag("check_TEPLA_failure_criterion");
  c.erodes = p.context().erodes;
  c.objective = p.flag("objective");
  c.elements = read_deviator(p, p.real("shear_modulus"));
  if (p.word("plastic_convergence_algo") == "biswajit")
    add_warning(p.faults(), p.block("plastic_convergence_algo")->where,
                "biswajit is an older return algorithm; radialReturn is used", "remove the tag");
  const std::optional<MetalFlow> flow = read_metal_flow(p);
  return flow ? std::make_shared<Metal>(c, *flow) : nullptr;
}

Tags tags() {
  Tags list = {
      positive("bulk_modulus", "K, Pa: for the first time step, and the default of the parts"),
      positive("shear_modulus", "mu, Pa: for the first time step, and the default of the parts"),
      number("coeff_thermal_expansion",
             "coefficient of linear thermal expansion, 1/K; used by default_hypo and default_hyper",
             0),
      number("taylor_quinney_coeff", "chi, fraction of the plastic work that becomes heat", 0.9)
          .at_least(0)
          .at_most(1),
      positive_or("initial_material_temperature", "temperature without thermal strain, K", 294),
      choice("do_melting", "whether a particle above its melting temperature is a liquid", true),
      choice("compute_specific_heat", "whether <specific_heat_model> is used", false),
      choice("check_TEPLA_failure_criterion",
             "whether a particle fails at <critical_porosity>; "
             "with <erosion>",
             true),
      metal_flow_tag(),
      metal_pressure_tag(),
      shear_modulus_tag(),
      melting_tag(),
      specific_heat_tag(),
      yield_condition_tag(),
      stability_tag(),
      deviator_tag(),
      tag("plastic_convergence_algo", "only radialReturn is supported")
          .words({"radialReturn", "biswajit"})
          .by_default("radialReturn"),
      number("tolerance", "accepted without effect: the return is solved to round-off", 1e-10),
      cell_pressure_tag("useModifiedEOS"),
      choice("isothermal", "accepted without effect", false),
      choice("evolve_damage", "accepted without effect: determined by <damage_model>", false),
      choice("check_max_stress_failure", "accepted without effect", false),
      number("critical_stress", "accepted without effect", 0),
      objective_tag()};
  for (TagSpec& t : pore_tags()) list.push_back(std::move(t));
  return list;
}

}  // namespace

MaterialModel elastic_plastic_model() {
  return {"elastic_plastic",
          {"elasticplastic"},
          "metal whose strength depends on strain, rate, temperature and pressure",
          tags(),
          make};
}
MaterialModel elastic_plastic_hp_model() {
  return {"elastic_plastic_hp", {}, "the same metal under its other name", tags(), make};
}
MaterialModel rf_elastic_plastic_model() {
  Tags list = tags();
  list.push_back(number("volume_expansion_coeff", "strain by diffusion; only 0 is supported", 0)
                     .at_least(0)
                     .at_most(0));
  return {"rf_elastic_plastic", {}, "the same metal, in axes that rotate with it", list, make};
}

}  // namespace sluice::mpm
