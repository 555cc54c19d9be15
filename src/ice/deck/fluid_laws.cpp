// The table of equations of state. Formulas and references stand in the files of src/eos.
#include "ice/deck/fluid_laws.hpp"

#include <algorithm>
#include <map>

#include "framework/deck/schema.hpp"

namespace sluice::ice {
namespace {

Range any() {
  return {};
}

Range above(double low) {
  Range range;
  range.low = low;
  range.low_open = true;
  return range;
}

Range at_least(double low) {
  Range range;
  range.low = low;
  return range;
}

template <class Law, class Owner>
LawTag number(const char* name, const char* meaning, double Owner::*value, Range range) {
  return {name, meaning, range, false,
          [value](eos::EquationOfState& law, double x) { std::get<Law>(law).*value = x; }};
}

LawTag optional(LawTag tag) {
  tag.optional = true;
  return tag;
}

std::vector<LawEntry> gases() {
  using eos::HardSphereGas;
  using eos::StiffenedGas;
  using eos::TstGas;
  return {{"ideal_gas", eos::IdealGas{}, {}, true},
          {"StiffenedGas",
           StiffenedGas{},
           {number<StiffenedGas>("pinf", "constant extra pressure, Pa", &StiffenedGas::pinf,
                                 at_least(0)),
            optional(number<StiffenedGas>("q", "energy at 0 K, J/kg; absent: 0", &StiffenedGas::q,
                                          any()))},
           true},
          {"hard_sphere_gas",
           HardSphereGas{},
           {number<HardSphereGas>("b", "covolume, m^3/kg", &HardSphereGas::b, at_least(0))},
           true},
          {"TST",
           TstGas{},
           {number<TstGas>("a", "attraction, Pa m^6/kg^2", &TstGas::a, any()),
            number<TstGas>("b", "covolume, m^3/kg", &TstGas::b, above(0)),
            number<TstGas>("u", "first number of the attraction", &TstGas::u, above(-1)),
            number<TstGas>("w", "second number of the attraction", &TstGas::w, above(-1)),
            number<TstGas>("Gamma", "ratio of specific heats", &TstGas::Gamma, above(1))}}};
}

template <class Law>
std::vector<LawTag> jwl_tags() {
  return {number<Law>("A", "pressure of the first exponential, Pa", &Law::A, above(0)),
          number<Law>("B", "pressure of the second exponential, Pa", &Law::B, any()),
          number<Law>("R1", "first exponent", &Law::R1, above(0)),
          number<Law>("R2", "second exponent", &Law::R2, above(0)),
          number<Law>("om", "Grueneisen coefficient", &Law::om, above(0)),
          number<Law>("rho0", "density of the explosive, kg/m^3", &Law::rho0, above(0))};
}

template <class Law>
std::vector<LawTag> murnaghan_tags() {
  return {
      number<Law>("n", "derivative of the bulk modulus by pressure", &Law::n, above(0)),
      number<Law>("K", "compressibility, 1/Pa (not the bulk modulus)", &Law::K, above(0)),
      number<Law>("rho0", "density of reference, kg/m^3", &Law::rho0, above(0)),
      number<Law>("P0", "pressure at that density, Pa", &Law::P0, above(0)),
  };
}

std::vector<LawEntry> explosives_and_solids() {
  using eos::Jwlc;
  using eos::LinearGruneisen;
  using eos::MieGruneisen;
  std::vector<LawTag> jwlc = jwl_tags<Jwlc>();
  jwlc.push_back(number<Jwlc>("C", "pressure of the power of density, Pa", &Jwlc::C, any()));
  return {
      {"JWL", eos::Jwl{}, jwl_tags<eos::Jwl>()},
      {"JWLC", Jwlc{}, jwlc},
      {"Murnaghan", eos::Murnaghan{}, murnaghan_tags<eos::Murnaghan>()},
      {"BirchMurnaghan", eos::BirchMurnaghan{}, murnaghan_tags<eos::BirchMurnaghan>()},
      {"MieGruneisen",
       MieGruneisen{},
       {number<MieGruneisen>("C0", "sound speed of weak shocks, m/s", &MieGruneisen::C0, above(0)),
        number<MieGruneisen>("S", "slope of shock speed against particle speed", &MieGruneisen::S,
                             at_least(0)),
        number<MieGruneisen>("Gamma0", "Grueneisen coefficient", &MieGruneisen::Gamma0, above(0)),
        number<MieGruneisen>("rho0", "density of reference, kg/m^3", &MieGruneisen::rho0, above(0)),
        number<MieGruneisen>("T0", "temperature of reference, K", &MieGruneisen::T0, above(0))}},
      {"Gruneisen",
       LinearGruneisen{},
       {number<LinearGruneisen>("A", "pressure for each share of density, Pa", &LinearGruneisen::A,
                                above(0)),
        number<LinearGruneisen>("B", "pressure for each kelvin, Pa/K", &LinearGruneisen::B,
                                above(0)),
        number<LinearGruneisen>("rho0", "density of reference, kg/m^3", &LinearGruneisen::rho0,
                                above(0)),
        number<LinearGruneisen>("T0", "temperature of reference, K", &LinearGruneisen::T0,
                                above(0)),
        number<LinearGruneisen>("P0", "pressure of reference, Pa", &LinearGruneisen::P0, any())}},
  };
}

LawEntry tillotson() {
  using T = eos::Tillotson;
  return {"Tillotson",
          T{},
          {number<T>("a", "Grueneisen coefficient of the vapour", &T::a, above(0)),
           number<T>("b", "what the condensed body adds to it", &T::b, at_least(0)),
           number<T>("A", "bulk modulus, Pa", &T::A, above(0)),
           number<T>("B", "its growth with compression, Pa", &T::B, any()),
           number<T>("E0", "energy at which b has halved, J/kg", &T::E0, above(0)),
           number<T>("Es", "energy of incipient vaporisation, J/kg", &T::Es, above(0)),
           number<T>("Esp", "energy of complete vaporisation, J/kg", &T::Esp, above(0)),
           number<T>("alpha", "decay of the pressure in expansion", &T::alpha, above(0)),
           number<T>("beta", "decay of the tension in expansion", &T::beta, above(0)),
           number<T>("rho0", "density of reference, kg/m^3", &T::rho0, above(0))}};
}

std::vector<LawEntry> waters() {
  using H = eos::ThomsenHartkaWater;
  using K = eos::KnaussSeaWater;
  return {
      {"Thomsen_Hartka_water",
       H{},
       {number<H>("a", "shift of the density maximum with pressure, K/Pa", &H::a, above(0)),
        number<H>("b", "fall of the specific heat with temperature, J/(kg K^2)", &H::b,
                  at_least(0)),
        number<H>("co", "specific heat at constant pressure at To, J/(kg K)", &H::co, above(0)),
        number<H>("ko", "compressibility, 1/Pa", &H::ko, above(0)),
        number<H>("To", "temperature of largest density, K", &H::To, above(0)),
        number<H>("L", "growth of volume with temperature squared, 1/K^2", &H::L, above(0)),
        number<H>("vo", "volume at To and zero pressure, m^3/kg", &H::vo, above(0))}},
      {"KnaussSeaWater",
       K{},
       {optional(number<K>("a", "density for each kelvin, kg/(m^3 K), not 0; absent: -0.15", &K::a,
                           any())),
        optional(
            number<K>("b", "density for each unit of salinity, kg/m^3; absent: 0", &K::b, any())),
        optional(
            number<K>("K", "density for each pascal, s^2/m^2; absent: 4.5e-7", &K::K, above(0))),
        optional(number<K>("T0", "temperature of reference, K; absent: 283.15", &K::T0, above(0))),
        optional(number<K>("P0", "pressure of reference, Pa; absent: 101325", &K::P0, any())),
        optional(number<K>("S", "salinity, parts per thousand; absent: 35", &K::S, at_least(0))),
        optional(number<K>("S0", "salinity of reference; absent: 35", &K::S0, at_least(0))),
        optional(
            number<K>("rho0", "density of reference, kg/m^3; absent: 1027", &K::rho0, above(0)))}},
  };
}

std::vector<LawEntry> make_table() {
  std::vector<LawEntry> table = gases();
  for (const auto& part : {explosives_and_solids(), {tillotson()}, waters()})
    table.insert(table.end(), part.begin(), part.end());
  return table;
}

}  // namespace

const std::vector<LawEntry>& law_table() {
  static const std::vector<LawEntry> table = make_table();
  return table;
}

const LawEntry* find_law(std::string_view type) {
  for (const LawEntry& law : law_table())
    if (law.type == type) return &law;
  return nullptr;
}

bool has_tag(const LawEntry& law, std::string_view name) {
  return std::any_of(law.tags.begin(), law.tags.end(),
                     [&](const LawTag& tag) { return tag.name == name; });
}

bool tag_of_any_law(std::string_view name) {
  return std::any_of(law_table().begin(), law_table().end(),
                     [&](const LawEntry& law) { return has_tag(law, name); });
}

TagSpec equation_of_state_tag() {
  std::vector<std::string> types;
  std::vector<std::string> order;               // tags as they come
  std::map<std::string, std::string> meanings;  // of all laws
  for (const LawEntry& law : law_table()) {
    types.push_back(law.type);
    for (const LawTag& tag : law.tags) {
      std::string& meaning = meanings[tag.name];
      if (meaning.empty()) order.push_back(tag.name);
      meaning += (meaning.empty() ? "" : "; ") + law.type + ": " + tag.meaning;
      if (tag.range.limited()) meaning += " (" + tag.range.text() + ")";
    }
  }
  TagSpec eos =
      tag("EOS", "equation of state; docs/theory_eos.md has the formulas")
          .once()
          .attribute(attribute("type", "which one").once().words(types).not_built({"KumariDass"}))
          .child(tag("gas_constant", "accepted without effect").real());
  for (const std::string& name : order) eos = eos.child(tag(name, meanings.at(name)).real());
  return eos;
}

}  // namespace sluice::ice
