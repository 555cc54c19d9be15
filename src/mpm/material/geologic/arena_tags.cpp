// ArenaSoil: its tags, held against what the law supports.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "framework/deck/faults.hpp"
#include "mpm/material/base/material_model.hpp"
#include "mpm/material/base/metal_parts.hpp"
#include "mpm/material/geologic/arena.hpp"

namespace sluice::mpm {
namespace {

constexpr double min_p0 = 1000;  // Pa: of the model's authors
constexpr const char* spread[] = {"PEAKI1", "FSLOPE", "STREN", "YSLOPE", "BETA", "CR", "T1", "T2"};

TagSpec not_negative(std::string name, std::string doc) {
  return number(std::move(name), std::move(doc)).at_least(0);
}

const std::vector<Part>& elastic_parts() {
  static const std::vector<Part> parts = {
      {"arena",
       {positive("b0", "bulk modulus at rest, relative to that of the grains"),
        not_negative("b1", "stiffening: p = K_s (b0 x + b1 x^b4/(b2 x^b4 + b3)) of a strain x"),
        not_negative("b2", "see b1"), not_negative("b3", "see b1"),
        number("b4", "see b1").at_least(1),
        positive("G0", "shear modulus if Poisson's ratio is not above 0, Pa"),
        number("nu1", "Poisson's ratio is nu1 + nu2 exp(-K_d/K_s)"), number("nu2", "see nu1")}}};
  return parts;
}

const std::vector<Part>& yield_parts() {
  static const std::vector<Part> parts = [] {
    Tags tags = {
        not_negative("PEAKI1", "largest trace of the stress that grains sustain, in tension, Pa"),
        not_negative("FSLOPE", "slope of J2^(1/2) over that trace at PEAKI1"),
        not_negative("STREN", "largest J2^(1/2), Pa; 0: the curve is linear"),
        not_negative("YSLOPE", "slope of the limit curve far in compression"),
        positive("BETA", "1: associated flow; less: less dilatancy; more: more"),
        number("CR", "shape of the cap: (PEAKI1 - kappa)/(PEAKI1 - X)").above(0).at_most(1),
        not_negative("T1", "tau = T1 |D|^-T2, s^(1 - T2); 0: no rate dependence"),
        not_negative("T2", "exponent T2 of the rate dependence"),
        number("PEAKI1_failed", "PEAKI1 of failed soil, Pa", 1e-5).at_least(0),
        tag("FSLOPE_failed", "FSLOPE of failed soil; absent: FSLOPE/2").real().at_least(0),
        tag("STREN_failed", "STREN of failed soil, Pa; absent: STREN/10").real().at_least(0),
        number("YSLOPE_failed", "YSLOPE of failed soil", 1e-5).at_least(0)};
    for (const char* name : spread)
      tags.push_back(tag(std::string("weibullDist_") + name, "not supported").text());
    return std::vector<Part>{{"arena", tags}};
  }();
  return parts;
}

Tags arena_tags() {
  return {
      number("initial_porosity", "initial porosity").above(0).at_most(0.999),
      number("initial_saturation", "initial water saturation of the pores").at_least(0).at_most(1),
      not_negative("initial_fluid_pressure", "initial pressure of pores and body, Pa"),
      not_negative("p0", "trace of the stress at the onset of pore collapse, Pa; at least 1000"),
      positive("p1", "crush curve X = p0 + p1 (phi_0/phi - 1)^(1/p2), Pa"),
      number("p1_sat", "p1 of saturated soil, relative to that of dry soil"),
      positive("p2", "exponent of the crush curve"),
      number("p3", "accepted without effect: -ln(1 - initial_porosity) is used"),
      submodel_tag("elastic_moduli_model", "moduli of the drained soil", elastic_parts()).once(),
      submodel_tag("plastic_yield_condition", "limit curve, cap, rate dependence", yield_parts())
          .once(),
      positive_or("yield_surface_radius_scaling_factor",
                  "a part of a step changes the stress by at most so many sizes of the surface", 1),
      number("subcycling_characteristic_number", "largest number of parts of a step; at least 1",
             256),
      number("consistency_bisection_tolerance",
             "accepted without effect: plastic strains are found to round-off", 1e-4),
      choice("do_damage", "whether stiffness and strength decrease with the time of plastic flow",
             false),
      number("fspeed", "speed of the decrease: C = 1/(1 + exp(fspeed (t/time_at_failure - 1)))",
             1e-9)
          .at_least(0),
      positive_or("time_at_failure", "time of plastic flow where C is 1/2, s", 1e9),
      choice("use_disaggregation_algorithm", "must be false", false),
      tag("reference_porosity", "must be equal to initial_porosity").real(),
      number("p1_density_scale_fac", "must be 0", 0),
      tag("eq_plastic_strain_at_failure", "not supported").real(),
      tag("K0_Murnaghan_EOS", "not supported").real(),
      tag("n_Murnaghan_EOS", "not supported").real()};
}

bool refuse(const Parameters& p, const std::string& name) {
  add_not_built(p.faults(), p.block(name)->where, p.owner() + ": <" + name + ">");
  return false;
}

bool nothing_more(const Parameters& p) {
  bool good = true;
  if (p.flag("use_disaggregation_algorithm")) good = refuse(p, "use_disaggregation_algorithm");
  if (p.has("reference_porosity") && p.real("reference_porosity") != p.real("initial_porosity"))
    good = refuse(p, "reference_porosity");
  if (p.real("p1_density_scale_fac") != 0) good = refuse(p, "p1_density_scale_fac");
  for (const char* name : {"eq_plastic_strain_at_failure", "K0_Murnaghan_EOS", "n_Murnaghan_EOS"})
    if (p.has(name)) good = refuse(p, name);
  return good;
}

bool read_crush(const Parameters& p, WetSoil& soil) {
  soil.phi_0 = p.real("initial_porosity");
  soil.S_0 = p.real("initial_saturation");
  soil.pressure_0 = p.real("initial_fluid_pressure");
  soil.p0 = p.real("p0");
  soil.p1 = p.real("p1");
  soil.p1_sat = p.real("p1_sat");
  soil.p2 = p.real("p2");
  if (soil.p0 < min_p0) {
    add_warning(
        p.faults(), p.block("p0")->where,
        fmt::format("{}: <p0> is less than {:g} Pa, which is used instead", p.owner(), min_p0));
    soil.p0 = min_p0;
  }
  if (std::abs(p.real("p3") - soil.p3()) > 1e-3 * soil.p3())
    add_warning(p.faults(), p.block("p3")->where,
                fmt::format("{}: <p3> has no effect: -ln(1 - initial_porosity) = {:.4g} is used",
                            p.owner(), soil.p3()));
  if (1 - soil.S_0 + soil.p1_sat * soil.S_0 > 0) return true;
  p.error("p1_sat",
          "crushed pores would not harden: 1 - S + p1_sat S must be above 0, S the "
          "<initial_saturation>");
  return false;
}

bool read_elastic(const Parameters& model, WetSoil& soil) {
  const char* name = "elastic_moduli_model";
  const ChosenSubmodel chosen = choose_submodel(model, name, elastic_parts());
  if (chosen.index < 0) return false;
  const Parameters p = inside_submodel(model, name, elastic_parts().front());
  if (!p.good()) return false;
  soil.b0 = p.real("b0");
  soil.b1 = p.real("b1");
  soil.b2 = p.real("b2");
  soil.b3 = p.real("b3");
  soil.b4 = p.real("b4");
  soil.G0 = p.real("G0");
  soil.nu1 = p.real("nu1");
  soil.nu2 = p.real("nu2");
  if (!(std::max(soil.nu1, soil.nu1 + soil.nu2) < 0.5)) {
    p.error("nu1", "<nu1> and <nu1> + <nu2> must be below 1/2");
    return false;
  }
  if (soil.b1 > 0 && soil.b3 == 0) {
    p.error("b3", "<b3> must be above 0 if <b1> is");
    return false;
  }
  return true;
}

bool is_curve(const LimitNumbers& n) {
  return limit_curve(n.PEAKI1, n.FSLOPE, n.STREN, n.YSLOPE).has_value();
}

bool read_limits(const Parameters& p, ArenaConstants& c) {
  c.sound = {p.real("PEAKI1"), p.real("FSLOPE"), p.real("STREN"), p.real("YSLOPE")};
  const auto given = [&](const char* name, double other) {
    return p.has(name) ? p.real(name) : other;
  };
  c.failed = {p.real("PEAKI1_failed"), given("FSLOPE_failed", 0.5 * c.sound.FSLOPE),
              given("STREN_failed", 0.1 * c.sound.STREN), p.real("YSLOPE_failed")};
  bool curves = is_curve(c.sound);
  for (const double C : {0.0, 0.25, 0.5, 0.75})
    if (c.damage && !is_curve(blended(c.sound, c.failed, C))) curves = false;
  if (!curves)
    p.error("FSLOPE",
            c.damage ? "<PEAKI1>, <FSLOPE>, <STREN>, <YSLOPE> and those of failed soil do not give "
                       "limit curves for every coherence"
                     : "<PEAKI1>, <FSLOPE>, <STREN>, <YSLOPE> do not give a limit curve",
            "linear: FSLOPE alone above 0; constant: STREN alone; curved: FSLOPE > YSLOPE and "
            "STREN > YSLOPE PEAKI1");
  return curves;
}

bool read_yield(const Parameters& model, ArenaConstants& c) {
  const char* name = "plastic_yield_condition";
  const ChosenSubmodel chosen = choose_submodel(model, name, yield_parts());
  if (chosen.index < 0) return false;
  const Parameters p = inside_submodel(model, name, yield_parts().front());
  if (!p.good()) return false;
  bool good = read_limits(p, c);
  for (const char* number : spread)
    if (p.has(std::string("weibullDist_") + number))
      good = refuse(p, std::string("weibullDist_") + number);
  c.beta = p.real("BETA");
  c.cap_share = p.real("CR");
  c.T1 = p.real("T1");
  c.T2 = p.real("T2");
  if ((c.T1 > 0) != (c.T2 > 0)) {
    p.error("T1", "<T1> and <T2> must both be above 0, or both be 0");
    good = false;
  }
  return good;
}

std::shared_ptr<const Material> make_soil(const Parameters& p) {
  ArenaConstants c;
  c.damage = p.flag("do_damage");
  c.fspeed = p.real("fspeed");
  c.t_fail = p.real("time_at_failure");
  const bool supported = nothing_more(p), crush = read_crush(p, c.soil),
             elastic = read_elastic(p, c.soil), yield = read_yield(p, c);
  if (!supported || !crush || !elastic || !yield) return nullptr;
  c.part_size = p.real("yield_surface_radius_scaling_factor");
  c.max_parts = static_cast<int>(std::clamp(p.real("subcycling_characteristic_number"), 1.0, 1e6));
  c.density = p.constants().density;
  return make_arena(c);
}

}  // namespace

MaterialModel ArenaSoil_model() {
  return {"ArenaSoil",
          {"arena"},
          "soil of grains, water and air with pore collapse under a cap",
          arena_tags(),
          make_soil};
}

}  // namespace sluice::mpm
