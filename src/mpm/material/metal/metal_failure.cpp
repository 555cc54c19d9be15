// Pores and stability of a metal.
#include "mpm/material/metal/metal_failure.hpp"

#include "mpm/material/base/metal_parts.hpp"
#include "mpm/material/base/particle_random.hpp"

namespace sluice::mpm {

double Pores::at_start(std::int64_t id) const {
  if (deviation == 0) return mean;
  return std::clamp(mean + deviation * particle_gauss(id, 0x706f726573, 0), 0.0, 0.999);
}

namespace {

bool drucker(const Symmetric& D, const Symmetric& N, double mu, double K, double c) {
  const double volume = trace(D), along = double_dot(N, D);
  const Symmetric d = deviator(D);
  return K * volume * volume + 2 * mu * double_dot(d, d) - c * along * along <= 0;
}

bool becker(const Symmetric& N, double mu, double K, double c) {
  const Principal of_N = principal(N);
  const double N_1 = of_N.values[2], N_3 = of_N.values[0];
  const double beta = (K + mu / 3) / (mu * (K + 4 * mu / 3));
  const auto value = [&](double x) {
    const double along = N_1 * x + N_3 * (1 - x);
    return (N_1 * N_1 * x + N_3 * N_3 * (1 - x)) / mu - beta * along * along;
  };
  // A parabola that opens downward: greatest at its vertex, or at an end.
  const double d = N_1 - N_3;
  const double vertex =
      d == 0 ? 0 : ((N_1 * N_1 - N_3 * N_3) / mu - 2 * beta * N_3 * d) / (2 * beta * d * d);
  return c * value(std::clamp(vertex, 0.0, 1.0)) >= 1;
}

const std::vector<Part>& yields() {
  static const std::vector<Part> list = {
      {"vonMises", {}},
      {"gurson",
       {positive("q1", "weight of the pores"), positive("q2", "weight of the pressure"),
        number("q3", "weight of the squared pores"), number("k", "growth of f* beyond f_c"),
        positive("f_c", "porosity of pore coalescence")}}};
  return list;
}
const std::vector<std::string> yields_not_supported = {"rousselier"};
const std::vector<Part>& checks() {
  static const std::vector<Part> list = {
      {"none", {}}, {"drucker", {}}, {"becker", {}}, {"drucker_becker", {}}};
  return list;
}
const std::vector<std::string> checks_not_supported = {"acoustic"};

}  // namespace

bool unstable(Stability check, const Symmetric& strain, const Symmetric& N, double mu, double K,
              double hardening) {
  if (check == Stability::none) return false;
  const double below = 2 * mu + 2.0 / 3 * hardening;
  if (!(below > 0)) return true;  // stress falls faster than any elastic unloading
  const double c = 4 * mu * mu / below;
  const bool by_drucker = check != Stability::becker && drucker(strain, N, mu, K, c);
  return by_drucker || (check != Stability::drucker && becker(N, mu, K, c));
}

TagSpec yield_condition_tag() {
  return submodel_tag("yield_condition", "yield condition of the metal", yields(),
                      yields_not_supported);
}
TagSpec stability_tag() {
  return submodel_tag("stability_check", "criterion of failure by instability; with <erosion>",
                      checks(), checks_not_supported);
}
Tags pore_tags() {
  return {
      choice("evolve_porosity", "whether pores grow", true),
      number("initial_mean_porosity", "initial porosity", 0.002).at_least(0),
      number("initial_std_porosity", "standard deviation of the initial porosity", 0).at_least(0),
      tag("initial_porosity_distrib", "distribution of the random values")
          .words({"constant", "gauss"})
          .by_default("constant"),
      positive_or("critical_porosity", "porosity at which the particle fails", 0.5),
      number("frac_nucleation", "f_n, porosity of nucleated pores", 0.1),
      number("meanstrain_nucleation", "eps_n, mean plastic strain of nucleation", 0.3),
      positive_or("stddevstrain_nucleation", "s_n, its standard deviation", 0.1)};
}

YieldCondition read_yield_condition(const Parameters& model) {
  YieldCondition yield;
  const ChosenSubmodel chosen =
      choose_submodel(model, "yield_condition", yields(), yields_not_supported);
  if (chosen.index != 1) return yield;
  const Parameters p = inside_submodel(model, "yield_condition", yields()[1]);
  if (p.good())
    yield = {true, p.real("q1"), p.real("q2"), p.real("q3"), p.real("k"), p.real("f_c")};
  return yield;
}
Stability read_stability(const Parameters& model) {
  const ChosenSubmodel chosen =
      choose_submodel(model, "stability_check", checks(), checks_not_supported);
  return chosen.index < 0 ? Stability::none : static_cast<Stability>(chosen.index);
}
Pores read_pores(const Parameters& p) {
  Pores pores;
  pores.evolve = p.flag("evolve_porosity");
  pores.mean = p.real("initial_mean_porosity");
  if (p.word("initial_porosity_distrib") == "gauss")
    pores.deviation = p.real("initial_std_porosity");
  pores.critical = p.real("critical_porosity");
  pores.f_n = p.real("frac_nucleation");
  pores.eps_n = p.real("meanstrain_nucleation");
  pores.s_n = p.real("stddevstrain_nucleation");
  return pores;
}

}  // namespace sluice::mpm
