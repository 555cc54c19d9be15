// p_alpha: a porous solid whose pores close under pressure (Herrmann 1969; Carroll and Holt 1972).
//
//   alpha = v/v_s                 distension; alpha0 = rhoS/density at the start
//   p     = p_s(v_s, e)/alpha,    sigma = -p I
//   p_s   = rhoS C_0^2 eta (1 - Gamma_0 eta/2)/(1 - S eta)^2
//           + Gamma_0 rhoS [e + c_v (T_start - T_0)],
//           eta = 1 - J_s,  J_s = J alpha0/alpha;   rhoS C_0^2 eta + ... for eta < 0
//   alpha <= 1 + (alpha_e - 1) [(Ps - p)/(Ps - Pe)]^2 between Pe and Ps, 1 beyond     crushing
//   alpha - 1 = (alpha_u - 1) e^(-k p) below that curve                        elastic, reversible
// e is the work done on the body, per mass: that of closing pores heats the solid. alpha_u, the
// distension without pressure, only falls; alpha_e is alpha at Pe of the fresh body. The elastic
// part is a choice: what is left of the pores closes in proportion to itself, with k such that the
// bulk modulus of the fresh body is K0, as Herrmann's form has it there:
//   k (alpha0 - 1) = alpha0 (1/K0 - alpha0/(rhoS C_0^2))
// p and e are solved together, e_1 = e_0 - (p_0 + p_1)(v_1 - v_0)/2: one step over a shock lands on
// the Hugoniot of the porous body. Temperature: of the solid along its isentrope, and the work of
// the pores as heat. With <shear_modulus>: sigma = -p I + s/J (shear_return.hpp), what it stores is
// no part of e, plastic work is. No strength ends tension.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "framework/deck/faults.hpp"
#include "mpm/material/base/batch_math.hpp"
#include "mpm/material/base/history_labels.hpp"
#include "mpm/material/base/material_model.hpp"
#include "mpm/material/base/shear_return.hpp"

namespace sluice::mpm {
namespace {

struct PorousConstants {
  double Pe = 0, Ps = 0;
  double alpha_0 = 1, elastic_limit = 1;  // alpha0, alpha_e
  double closing = 0;                     // k, 1/Pa
  double K_0 = 0;
  double stiffness = 0, Gamma_0 = 0, S = 0;  // of the solid; rhoS C_0^2, Pa
  double solid_density = 0, density = 0, specific_heat = 0, T_0 = 0;
  double shear = 0, yield = 0, hardening = 0;  // G, sigma_Y, H, Pa
};

constexpr int b_column = 3, plastic_column = 9;  // of bodies with strength in shear

struct Pores {
  double alpha, slope;  // d alpha/dp
  bool crushing;
};

class PorousSolid final : public Material {
 public:
  explicit PorousSolid(const PorousConstants& constants) : c_(constants) {
    history_ = {{history_label("p.alpha"), 1},
                {history_label("p.alphaUnloaded"), 1},
                {history_label("p.thermalPressure"), 1}};
    if (!(c_.shear > 0)) return;
    history_.push_back({history_label("p.bElBar"), 6});
    history_.push_back({plastic_strain_label(), 1});
  }
  std::span<const HistoryColumn> history() const override { return history_; }
  double bulk_modulus() const override { return c_.K_0; }
  bool has_shock_equation() const override { return true; }
  double shear_modulus() const override { return c_.shear; }

  void start(const Batch& b) const override {
    for (int i = 0; i < b.count; ++i) {
      const double J = determinant(at(b.F, i));
      Step s = {J, J, 0, 0, 0, c_.alpha_0};
      s.thermal = c_.Gamma_0 * c_.solid_density * c_.specific_heat * (b.temperature[i] - c_.T_0);
      const State now = solved(s);
      b.history[2][i] = s.thermal;
      b.energy[i] = 0;
      set(b, i, J, now, {{}, {1, 1, 1}, 1, 0});
    }
  }

  std::optional<BatchFault> update(const Batch& b) const override {
    if (const auto fault = fault_of_volume(b)) return fault;
    for (int i = 0; i < b.count; ++i) {
      const double J_0 = determinant(at(b.old_F, i)), J = determinant(at(b.F, i));
      const double p_0 = -(b.old_stress[0][i] + b.old_stress[1][i] + b.old_stress[2][i]) / 3;
      const Shear shear = sheared(b, i);
      const double E_0 = b.old_energy[i] / b.volume_0[i] - shear.stored_before + shear.heat;
      const double heat = b.heat != nullptr ? b.heat[i] / b.volume_0[i] : 0;
      const Step s = {J_0, J, p_0, E_0 + heat, b.old_history[2][i], b.old_history[1][i]};
      const State now = solved(s);
      if (!now.good) return BatchFault{i, "past the pole of Mie-Grueneisen", J};
      const double mean_p = 0.5 * (p_0 + now.p);
      b.history[2][i] = s.thermal;
      b.energy[i] = b.volume_0[i] * (E_0 - mean_p * (J - J_0) + shear.stored);
      const double old_alpha = b.old_history[0][i];
      const double solid_0 = J_0 * c_.alpha_0 / old_alpha, solid = J * c_.alpha_0 / now.alpha;
      const double of_pores =
          -mean_p * 0.5 * (solid_0 + solid) / c_.solid_density * (now.alpha - old_alpha);
      const double warmed = std::expm1(-c_.Gamma_0 * (solid - solid_0));
      if (b.isentropic != nullptr) b.isentropic[i] = warmed;
      b.heating[i] +=
          (b.temperature[i] * warmed + (of_pores + shear.heat / c_.density) / c_.specific_heat) /
          b.dt;
      set(b, i, J, now, shear.state);
    }
    return std::nullopt;
  }

 private:
  // From J_0, p_0 and E_0 (work, J per m^3 at the start) to J_1.
  struct Step {
    double J_0, J_1, p_0, E_0, thermal, unloaded;
  };
  struct State {
    double p, alpha, unloaded;
    double modulus;  // -J dp/dJ while no pore crushes, Pa
    bool good = true;
  };

  // Shear of a step, J per m^3 at the start.
  struct Shear {
    ShearState state{{}, {1, 1, 1}, 1, 0};
    double stored_before = 0, stored = 0, heat = 0;
  };
  Shear sheared(const Batch& b, int i) const {
    Shear to;
    if (!(c_.shear > 0)) return to;
    std::array<double, 6> old_b;
    for (int k = 0; k < 6; ++k) old_b[k] = b.old_history[b_column + k][i];
    std::array<double, 9> f = at(b.L, i);
    for (double& x : f) x *= b.dt;
    for (const std::size_t e : {0, 4, 8}) f[e] += 1;
    const double alpha = b.old_history[plastic_column][i];
    to.state = shear_return(old_b, f, c_.shear, c_.yield, c_.hardening, alpha);
    to.stored_before = 0.5 * c_.shear * (old_b[0] + old_b[1] + old_b[2] - 3);
    to.stored = 1.5 * c_.shear * (to.state.m - 1);
    to.heat = (to.state.alpha - alpha) * (c_.yield + 0.5 * c_.hardening * (to.state.alpha + alpha));
    return to;
  }

  void set(const Batch& b, int i, double J, const State& now, const ShearState& shear) const {
    b.history[0][i] = now.alpha;
    b.history[1][i] = now.unloaded;
    double modulus = std::max(now.modulus, 1e-3 * c_.K_0);
    for (std::size_t k = 0; k < 6; ++k) {
      b.stress[k][i] = (k < 3 ? -now.p : 0) + shear.s[k] / J;
      if (c_.shear > 0) b.history[b_column + k][i] = shear.b[k];
    }
    if (c_.shear > 0) {
      b.history[plastic_column][i] = shear.alpha;
      modulus += c_.shear * (4.0 / 3 * shear.m + eigenvalue_reach(shear.b, shear.m)) / J;
    }
    b.wave_speed[i] = std::sqrt(modulus * J / c_.density);
  }

  Pores pores(double p, double unloaded) const {
    const double left = (unloaded - 1) * std::exp(-c_.closing * p);
    if (p > c_.Pe) {
      const double r = std::max(c_.Ps - p, 0.0) / (c_.Ps - c_.Pe);
      const double most = (c_.elastic_limit - 1) * r * r;
      if (left > most) return {1 + most, -2 * (c_.elastic_limit - 1) * r / (c_.Ps - c_.Pe), true};
    }
    return {1 + left, -c_.closing * left, false};
  }

  // Cold pressure of the solid at J_s and its derivative by eta; not good past the pole.
  struct Cold {
    double p, slope;
    bool good = true;
  };
  Cold cold(double J_s) const {
    const double eta = 1 - J_s;
    if (eta <= 0) return {c_.stiffness * eta, c_.stiffness};
    const double d = 1 - c_.S * eta;
    if (!(d > 0)) return {0, 0, false};
    const double n = eta * (1 - 0.5 * c_.Gamma_0 * eta);
    return {c_.stiffness * n / (d * d),
            c_.stiffness * ((1 - c_.Gamma_0 * eta) / (d * d) + 2 * n * c_.S / (d * d * d))};
  }

  State solved(const Step& s) const {
    const double growth = s.J_1 - s.J_0, gain = c_.Gamma_0 * c_.alpha_0;
    const double still = s.thermal + gain * (s.E_0 - 0.5 * s.p_0 * growth);
    // Without pores, J_s is known.
    const Cold closed = cold(s.J_1 * c_.alpha_0);
    const double per = 1 + 0.5 * gain * growth;
    if (!closed.good || !(per > 0)) return {0, 1, 1, 0, false};
    if (s.unloaded == 1 || (closed.p + still >= c_.Ps * per))
      return finished(s, (closed.p + still) / per, {1, 0, true});

    // alpha p - p_s rises with p, from below 0 to above 0 at Ps.
    double slope = 0;
    const auto excess = [&](double p) {
      const Pores a = pores(p, s.unloaded);
      const Cold solid = cold(s.J_1 * c_.alpha_0 / a.alpha);
      if (!solid.good) return -std::numeric_limits<double>::infinity();
      slope = per - 1 + a.alpha +
              a.slope * (p - solid.slope * s.J_1 * c_.alpha_0 / (a.alpha * a.alpha));
      return a.alpha * p - solid.p - still + 0.5 * gain * growth * p;
    };
    double low = std::min(s.p_0, c_.Ps), high = c_.Ps, p = low;
    for (double reach = 1e-2 * c_.stiffness; excess(low) > 0 && reach < 1e30; reach *= 2) {
      high = low;
      low -= reach;
    }
    const double enough = 1e-15 * c_.stiffness;
    for (int round = 0; round < 200; ++round) {
      const double f = excess(p);
      if (std::abs(f) <= enough) break;
      (f < 0 ? low : high) = p;
      const double next = p - f / slope;
      p = next > low && next < high ? next : 0.5 * (low + high);
      if (!(high - low > 4e-16 * std::max(std::abs(low), std::abs(high)))) break;
    }
    return finished(s, p, pores(p, s.unloaded));
  }

  State finished(const Step& s, double p, const Pores& a) const {
    State now{p, a.alpha, s.unloaded, 0};
    if (a.crushing)
      now.unloaded =
          a.alpha == 1 ? 1 : std::min(s.unloaded, 1 + (a.alpha - 1) * std::exp(c_.closing * p));
    // With d alpha = -beta dp, dE = -p dJ: from alpha p = p_s(J alpha0/alpha, E).
    const double solid = s.J_1 * c_.alpha_0, beta = c_.closing * (a.alpha - 1);
    const double stiff = cold(solid / a.alpha).slope;
    now.modulus = solid * (stiff / a.alpha + c_.Gamma_0 * p) /
                  (a.alpha + beta * (stiff * solid / (a.alpha * a.alpha) - p));
    return now;
  }

  PorousConstants c_;
  std::vector<HistoryColumn> history_;
};

bool sound(const Parameters& p, PorousConstants& c) {
  bool good = true;
  const auto wrong = [&](const char* name, const std::string& text) {
    p.error(name, text);
    good = false;
  };
  if (!(c.Ps > c.Pe))
    wrong("Ps", fmt::format("<Ps> is {:g}, expected above <Pe> {:g}", c.Ps, c.Pe));
  if (!(c.alpha_0 > 1)) {
    wrong("rhoS",
          fmt::format("<rhoS> is {:g}, expected above the <density> {:g} of the porous body",
                      c.solid_density, c.density));
    return false;
  }
  const double most = c.stiffness / c.alpha_0;
  if (!(c.K_0 < most)) {
    wrong("K0", fmt::format("<K0> is {:g}, expected below rhoS C_0^2/alpha0 = {:g}: pores do not "
                            "stiffen a body",
                            c.K_0, most));
    return false;
  }
  c.closing = c.alpha_0 * (1 / c.K_0 - c.alpha_0 / c.stiffness) / (c.alpha_0 - 1);
  if (good && !(c.closing * (c.Ps - c.Pe) < 2))
    wrong("K0", fmt::format("<K0> is {:g}: a body this soft would close its pores without crushing "
                            "before <Ps> {:g}",
                            c.K_0, c.Ps));
  c.elastic_limit = 1 + (c.alpha_0 - 1) * std::exp(-c.closing * c.Pe);
  return good;
}

std::shared_ptr<const Material> make(const Parameters& p) {
  PorousConstants c;
  c.Pe = p.real("Pe");
  c.Ps = p.real("Ps");
  c.K_0 = p.real("K0");
  c.solid_density = p.real("rhoS");
  c.density = p.constants().density;
  c.specific_heat = p.constants().specific_heat;
  c.alpha_0 = c.solid_density / c.density;
  c.stiffness = c.solid_density * p.real("C_0") * p.real("C_0");
  c.Gamma_0 = p.real("Gamma_0");
  c.S = p.real("S_alpha");
  c.T_0 = p.real("T_0");
  bool good = sound(p, c);
  if (!(c.specific_heat > 0)) {
    p.error("T_0", "<specific_heat> of the material must be greater than 0");
    good = false;
  }
  c.shear = p.real("shear_modulus");
  c.yield = p.real("yield_stress");
  c.hardening = p.real("hardening_modulus");
  if (!good) return nullptr;
  const auto differs = [&](const char* name, double counts, const char* of) {
    if (p.has(name) && !(std::abs(p.real(name) / counts - 1) < 0.01))
      add_warning(p.faults(), p.block(name)->where,
                  fmt::format("p_alpha: <{}> is {:g}, but {} = {:g} is used", name, p.real(name),
                              of, counts),
                  "");
  };
  differs("alpha0", c.alpha_0, "<rhoS>/<density>");
  differs("Ks", c.stiffness, "<rhoS> <C_0>^2");
  return std::make_shared<PorousSolid>(c);
}

}  // namespace

MaterialModel p_alpha_model() {
  Tags tags = {
      positive("Pe", "pressure at the onset of pore collapse, Pa"),
      positive("Ps", "pressure of complete pore collapse, Pa"),
      positive("rhoS", "density of the solid, kg/m^3"),
      positive("K0", "bulk modulus of the porous body at rest, Pa"),
      positive("C_0", "sound speed of weak shocks in the solid, m/s"),
      tag("Gamma_0", "Grueneisen coefficient of the solid").once().real().at_least(0),
      tag("S_alpha", "slope of its shock speed against particle speed").once().real().at_least(0),
      positive_or("T_0", "temperature at which the solid has no thermal pressure, K", 300),
      tag("alpha0", "compared with <rhoS>/<density>, which is used").real().at_least(1),
      tag("Ks", "compared with <rhoS> <C_0>^2, which is used, Pa").real().above(0)};
  tags.push_back(number("shear_modulus", "G of the porous body, Pa; 0: none", 0).at_least(0));
  tags.push_back(number("yield_stress", "initial von Mises yield stress, Pa", 0).at_least(0));
  tags.push_back(number("hardening_modulus", "sigma_Y over plastic strain, Pa", 0).at_least(0));
  return {"p_alpha", {}, "porous solid with pore collapse under pressure", tags, make};
}

}  // namespace sluice::mpm
