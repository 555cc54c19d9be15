// Arenisca, Arenisca3, Arenisca4: the tags of the three, held against what the law supports.
#include <algorithm>
#include <cmath>
#include <optional>

#include "framework/deck/faults.hpp"
#include "mpm/material/base/material_model.hpp"
#include "mpm/material/geologic/arenisca.hpp"

namespace sluice::mpm {
namespace {

// Tags that all three read.
Tags common_tags() {
  return {
      positive("B0", "bulk modulus at rest, Pa"),
      positive("G0", "shear modulus, Pa"),
      tag("PEAKI1", "largest trace of the stress, in tension, Pa").once().real().at_least(0),
      tag("FSLOPE", "slope of J2^(1/2) over the trace of the stress at PEAKI1")
          .once()
          .real()
          .at_least(0),
      positive("CR", "shape of the cap"),
      number("p0_crush_curve", "trace of the stress at the onset of pore collapse, negative, Pa"),
      number("p1_crush_curve",
             "1/Pa: hardening of the cap, X = p0 + ln(1 + e/p3)/p1; a large negative number fixes "
             "the cap"),
      positive("p3_crush_curve", "the porosity is 1 - exp(-p3)"),
      number("fluid_B0", "bulk modulus of the fluid in the pores, Pa; 0: dry", 0).at_least(0),
      number("fluid_pressure_initial", "initial pressure of fluid and body, Pa", 0).at_least(0),
      number("T1_rate_dependence", "tau = T1 |D|^T2, s^(1 + T2); 0: no rate dependence", 0)
          .at_least(0),
      number("T2_rate_dependence", "exponent T2 of the rate dependence", 0),
      number("subcycling_characteristic_number", "largest number of parts of a step; at least 1",
             256),
      number("gruneisen_parameter", "must be 0", 0),
      choice("Use_Disaggregation_Algorithm", "must be false", false)};
}

bool only_zero(const Parameters& p, const std::vector<const char*>& names) {
  bool good = true;
  for (const char* name : names)
    if (p.real(name) != 0) {
      add_not_built(p.faults(), p.block(name)->where, p.owner() + ": <" + name + ">");
      good = false;
    }
  return good;
}

// What all three read; nothing where it cannot be.
std::optional<AreniscaConstants> common(const Parameters& p, double STREN, double YSLOPE) {
  bool good = true;
  if (p.flag("Use_Disaggregation_Algorithm")) {
    add_not_built(p.faults(), p.block("Use_Disaggregation_Algorithm")->where,
                  p.owner() + ": <Use_Disaggregation_Algorithm>");
    good = false;
  }
  AreniscaConstants c;
  const auto limit = limit_curve(p.real("PEAKI1"), p.real("FSLOPE"), STREN, YSLOPE);
  if (!limit) {
    p.error("FSLOPE", "<PEAKI1>, <FSLOPE>, <STREN>, <YSLOPE> do not give a limit curve",
            "linear: FSLOPE alone above 0; constant: STREN alone; curved: FSLOPE > YSLOPE and "
            "STREN > YSLOPE PEAKI1");
    good = false;
  } else {
    c.limit = *limit;
  }
  c.rock.B0 = p.real("B0");
  c.G = p.real("G0");
  c.rock.p0 = p.real("p0_crush_curve");
  c.rock.p1 = p.real("p1_crush_curve");
  c.rock.p3 = p.real("p3_crush_curve");
  if (!(c.rock.p0 < 0)) {
    p.error("p0_crush_curve", "<p0_crush_curve> must be negative: it is in compression");
    good = false;
  }
  if (c.rock.p1 == 0) {
    p.error("p1_crush_curve", "<p1_crush_curve> is 0: the cap would harden without limit");
    good = false;
  }
  c.rock.fluid = p.real("fluid_B0");
  c.rock.fluid_pressure = c.rock.fluid > 0 ? p.real("fluid_pressure_initial") : 0;
  c.T1 = p.real("T1_rate_dependence");
  c.T2 = p.real("T2_rate_dependence");
  c.max_parts = static_cast<int>(std::clamp(p.real("subcycling_characteristic_number"), 1.0, 1e6));
  c.density = p.constants().density;
  if (!good) return std::nullopt;
  return c;
}

std::shared_ptr<const Material> make(const Parameters& p) {
  const bool zeros = only_zero(p, {"G1", "G2", "G3", "G4", "p2_crush_curve"});
  auto c = common(p, p.real("STREN"), p.real("YSLOPE"));
  if (!c || !zeros) return nullptr;
  c->rock.B1 = p.real("B1");
  c->rock.B2 = p.real("B2");
  c->rock.B3 = p.real("B3");
  c->rock.B4 = p.real("B4");
  if (!(c->rock.fluid < c->rock.B0 + c->rock.B1)) {
    p.error("fluid_B0", "<fluid_B0> must be less than the modulus <B0> + <B1> of the matrix");
    return nullptr;
  }
  if (!(c->rock.B0 > c->rock.B3)) {
    p.error("B3", "<B3> must be less than <B0>: a crushed body would have no stiffness");
    return nullptr;
  }
  c->cap_share = p.real("CR");
  c->beta = p.real("BETA_nonassociativity");
  return make_arenisca(*c);
}

std::shared_ptr<const Material> make_4(const Parameters& p) {
  if (!only_zero(p, {"J3_type", "J3_psi", "principal_stress_cutoff"})) return nullptr;
  return make(p);
}

// CR of the cap as an axis ratio: kappa - X = CR F_f(kappa).
std::shared_ptr<const Material> make_linear(const Parameters& p) {
  const bool zero = only_zero(p, {"gruneisen_parameter"});
  auto c = common(p, 0, 0);
  if (!c || !zero) return nullptr;
  const double FSLOPE = p.real("FSLOPE"), flow = p.real("FSLOPE_p");
  if (!(flow > 0 && flow <= FSLOPE)) {
    p.error("FSLOPE_p", "<FSLOPE_p> must be above 0 and not above <FSLOPE>");
    return nullptr;
  }
  if (c->rock.fluid > 0 && p.real("p4_fluid_effect") != 0)
    add_warning(p.faults(), p.block("p4_fluid_effect")->where,
                "Arenisca: <p4_fluid_effect> has no effect: pores and fluid are compressed "
                "together, as in Arenisca3",
                "remove it");
  if (!(c->rock.fluid < c->rock.B0)) {
    p.error("fluid_B0", "<fluid_B0> must be less than the modulus <B0> of the matrix");
    return nullptr;
  }
  c->cap_share = 1 / (1 + p.real("CR") * FSLOPE);
  c->beta = std::sqrt(flow / FSLOPE);
  c->hardening = p.real("hardening_modulus");
  c->kinematic = p.real("kinematic_hardening_constant");
  return make_arenisca(*c);
}

Tags tags_of_3() {
  Tags tags = common_tags();
  for (const TagSpec& t :
       {number("STREN", "largest J2^(1/2), Pa; 0: the curve is linear", 0).at_least(0),
        number("YSLOPE", "slope of the limit curve far in compression", 0).at_least(0),
        number("BETA_nonassociativity", "1: associated flow; less: less dilatancy", 1)
            .above(0)
            .at_most(1),
        number("B1", "stiffening by pressure, Pa", 0).at_least(0),
        number("B2", "pressure scale of the stiffening B1, Pa", 0).at_least(0),
        number("B3", "softening by pore collapse, Pa", 0).at_least(0),
        number("B4", "scale of the softening B3", 0).at_least(0)})
    tags.push_back(t);
  for (const char* name : {"G1", "G2", "G3", "G4", "p2_crush_curve"})
    tags.push_back(number(name, "must be 0", 0));
  return tags;
}

// Some decks give the numbers of the cap twice.
TagSpec copy_of_the_cap() {
  TagSpec copy =
      tag("internal_variable_model", "accepted without effect: repeats the numbers of the cap")
          .attribute(attribute("type", "name of the model").text());
  for (const char* name : {"arenisca_fSlope", "arenisca_peakI1", "arenisca_Cr", "arenisca_B0",
                           "arenisca_p0", "arenisca_p1", "arenisca_p3", "arenisca_p4"})
    copy = copy.child(tag(name, "accepted without effect").real());
  return copy;
}

}  // namespace

MaterialModel Arenisca_model() {
  Tags tags = common_tags();
  tags.push_back(positive("FSLOPE_p", "slope of the plastic flow, at most FSLOPE"));
  tags.push_back(number("hardening_modulus", "H of J2^(1/2) = F + H e_q, Pa", 0).at_least(0));
  tags.push_back(number("kinematic_hardening_constant", "c of d xi = c d e^p, Pa", 0).at_least(0));
  tags.push_back(number("p4_fluid_effect", "accepted without effect", 0));
  tags.push_back(number("gruneisen_parameter", "must be 0", 0));
  tags.push_back(copy_of_the_cap());
  return {"Arenisca",
          {"arenisca"},
          "rock with a linear limit curve, a cap that hardens with pore collapse, and hardening in "
          "shear",
          tags,
          make_linear};
}

MaterialModel Arenisca3_model() {
  return {"Arenisca3",
          {},
          "rock with a limit curve and a cap that hardens with pore collapse and pore fluid",
          tags_of_3(),
          make};
}

MaterialModel Arenisca4_model() {
  Tags tags = tags_of_3();
  for (const char* name : {"J3_type", "J3_psi", "principal_stress_cutoff"})
    tags.push_back(number(name, "must be 0", 0));
  return {"Arenisca4", {}, "as Arenisca3", tags, make_4};
}

}  // namespace sluice::mpm
