// Reading <EOS> by the table of laws, <SpecificHeatModel>, <gamma> and <specific_heat>.
#include "ice/deck/read_fluid.hpp"

#include <fmt/format.h>

#include <cmath>

#include "eos/component_heat.hpp"
#include "framework/base/error.hpp"
#include "framework/deck/rule_tools.hpp"
#include "framework/deck/schema.hpp"
#include "framework/scene/deck_values.hpp"
#include "ice/deck/fluid_laws.hpp"

namespace sluice::ice {
namespace {

// threshold: relative difference of the gas constant of a mixture from (gamma - 1) cv up to which
//   there is no warning; unit: 1; test: IceSchema.WarnsOfAMixtureWithAnotherGasConstant
constexpr double gas_constant_tolerance = 0.01;

struct Species {
  const char* tag;
  double eos::MoleFractions::*fraction;
};
constexpr Species all_species[] = {
    {"XCO2", &eos::MoleFractions::CO2}, {"XCO", &eos::MoleFractions::CO},
    {"XH2O", &eos::MoleFractions::H2O}, {"XO2", &eos::MoleFractions::O2},
    {"XN2", &eos::MoleFractions::N2},   {"XOH", &eos::MoleFractions::OH},
    {"XNO", &eos::MoleFractions::NO},   {"XO", &eos::MoleFractions::O},
    {"XH", &eos::MoleFractions::H},     {"XH2", &eos::MoleFractions::H2},
};

std::string expected(const Range& range) {
  return "expected real number" + (range.limited() ? ' ' + range.text() : std::string{});
}

// The numbers of one law into `law`.
void read_numbers(const DeckNode& eos, const LawEntry& entry, eos::EquationOfState& law,
                  std::vector<Fault>& faults) {
  for (const LawTag& tag : entry.tags) {
    const DeckNode* node = eos.child(tag.name);
    if (node == nullptr) {
      if (tag.optional) continue;
      add_error(faults, eos.where,
                fmt::format("<EOS type=\"{}\"> needs <{}>: {}", entry.type, tag.name, tag.meaning));
      continue;
    }
    const auto value = parse_real(node->text);
    if (!value) continue;  // told by the schema
    if (tag.range.contains(*value.value))
      tag.set(law, *value.value);
    else
      add_error(faults, node->where,
                fmt::format("<{}>: {} is out of range for {}", tag.name, node->text, entry.type),
                expected(tag.range));
  }
}

// "<Esp> must be greater ..." with the number behind each name: "<Esp> 2e+06 must be greater ...".
template <class Law>
std::string with_numbers(const Law& law, std::string_view what) {
  std::string text(what);
  for (const auto& number : Law::parameters()) {
    const std::string name = fmt::format("<{}>", number.name);
    if (const auto at = text.find(name); at != text.npos)
      text.insert(at + name.size(), fmt::format(" {:g}", law.*number.member));
  }
  return text;
}

// What must hold between the numbers of one law.
void check_numbers(const eos::EquationOfState& law, const DeckNode& eos,
                   std::vector<Fault>& faults) {
  std::visit(
      [&](const auto& l) {
        if constexpr (requires { l.contradiction(); })
          if (const std::string_view what = l.contradiction(); !what.empty())
            add_error(faults, eos.where,
                      fmt::format("<EOS type=\"{}\">: {}", l.name, with_numbers(l, what)));
      },
      law);
}

// Nothing where the schema has told what is wrong with a number.
std::optional<eos::SpecificHeat> read_component(const DeckNode& node) {
  eos::MoleFractions x;
  for (const Species& s : all_species) {
    const double part = real_of(&node, s.tag).value_or(0.0);
    if (!(part >= 0 && part <= 1)) return std::nullopt;
    x.*s.fraction = part;
  }
  return eos::component_heat(x);
}

std::optional<eos::SpecificHeat> read_polynomial(const DeckNode& node) {
  const eos::PolynomialHeat usual;
  const auto list = parsed_child<std::vector<double>>(&node, "coefficient", parse_reals);
  const auto order = integer_of(&node, "MaxOrder");
  if (!list || !order || *order < 0 || *order > eos::PolynomialHeat::max_order) return std::nullopt;
  return eos::polynomial_heat(*list, *order, real_of(&node, "Tmin").value_or(usual.T_min),
                              real_of(&node, "Tmax").value_or(usual.T_max));
}

// InputError when the numbers make no specific heat.
std::optional<eos::SpecificHeat> read_heat(const DeckNode& node, double gas_constant) {
  const std::string type = node.attribute("type").value_or("");
  if (type == "airNasa") return eos::air_heat(gas_constant);
  if (type == "Component") return read_component(node);
  if (type == "Polynomial") return read_polynomial(node);
  if (type == "Debye") {
    const auto atoms = real_of(&node, "Atoms"), theta = real_of(&node, "DebyeTemperature");
    if (atoms && theta) return eos::DebyeHeat{*atoms, *theta};
  }
  return std::nullopt;
}

void warn_of_gas_constants(const DeckNode& node, double mixture, double deck,
                           std::vector<Fault>& faults) {
  if (std::abs(mixture - deck) <= gas_constant_tolerance * deck) return;
  add_warning(faults, node.where,
              fmt::format("the mixture of <SpecificHeatModel> has a gas constant of {:.6g} J/(kg "
                          "K), (gamma - 1) specific_heat is {:.6g}; the pressure uses the latter",
                          mixture, deck),
              fmt::format("write specific_heat {:.6g} with the same gamma", mixture));
}

// A gas whose specific heat varies is a law of its own.
void make_perfect_gas(const DeckNode& node, const eos::SpecificHeat& heat, Fluid& fluid,
                      std::vector<Fault>& faults) {
  const double R = (fluid.gamma - 1.0) * fluid.specific_heat;
  if (const auto* nasa = std::get_if<eos::Nasa7Heat>(&heat)) {
    warn_of_gas_constants(node, nasa->gas_constant, R, faults);
    fluid.law = eos::PerfectGas<eos::Nasa7Heat>{R, *nasa};
  } else if (const auto* polynomial = std::get_if<eos::PolynomialHeat>(&heat)) {
    fluid.law = eos::PerfectGas<eos::PolynomialHeat>{R, *polynomial};
  } else {
    add_error(faults, node.where,
              "<SpecificHeatModel type=\"Debye\"> is the specific heat of a crystal; it cannot be "
              "used with ideal_gas",
              "use Component, Polynomial or airNasa, or another EOS");
  }
}

std::string laws_that_take_any_heat() {
  std::string list;
  for (const LawEntry& entry : law_table())
    if (std::visit([](const auto& l) { return std::decay_t<decltype(l)>::takes_any_heat; },
                   entry.start))
      list += (list.empty() ? "" : ", ") + entry.type;
  return list;
}

void add_heat(const DeckNode& node, const std::string& type, Fluid& fluid,
              std::vector<Fault>& faults) {
  std::optional<eos::SpecificHeat> heat;
  collect(faults, node.where,
          [&] { heat = read_heat(node, (fluid.gamma - 1.0) * fluid.specific_heat); });
  if (!heat) return;
  if (fluid.gamma_law() != nullptr) {
    make_perfect_gas(node, *heat, fluid, faults);
  } else if (std::visit([](const auto& l) { return std::decay_t<decltype(l)>::takes_any_heat; },
                        fluid.law)) {
    fluid.heat = heat;
  } else {
    add_error(faults, node.where,
              fmt::format("<SpecificHeatModel> cannot be used with {}: its pressure depends on its "
                          "own specific heat",
                          type),
              "equations of state that take any specific heat: " + laws_that_take_any_heat());
  }
}

// <specific_heat> and, where the law has it, <gamma>.
void set_heat_numbers(Fluid& fluid) {
  std::visit(
      [&](auto& law) {
        if constexpr (requires { law.specific_heat; }) law.specific_heat = fluid.specific_heat;
        if constexpr (requires { law.gamma = 1.4; }) law.gamma = fluid.gamma;
      },
      fluid.law);
}

}  // namespace

Fluid read_fluid(const DeckNode& material, std::vector<Fault>& faults) {
  Fluid fluid;
  const auto gamma = real_of(&material, "gamma"), cv = real_of(&material, "specific_heat");
  const DeckNode* eos = material.child("EOS");
  const std::string type = eos == nullptr ? "" : eos->attribute("type").value_or("");
  const LawEntry* entry = find_law(type);
  if (entry == nullptr) return fluid;  // told by the schema
  fluid.law = entry->start;
  read_numbers(*eos, *entry, fluid.law, faults);
  check_numbers(fluid.law, *eos, faults);
  if (!gamma || !cv || !(*gamma > 0) || !(*cv > 0)) return fluid;
  fluid.gamma = *gamma;
  fluid.specific_heat = *cv;
  if (entry->gamma_above_one && !(*gamma > 1)) {
    add_error(faults, material.child("gamma")->where,
              fmt::format("<gamma> {} is out of range for {}", *gamma, type),
              "expected real number greater than 1");
    return fluid;
  }
  set_heat_numbers(fluid);
  if (const DeckNode* heat = material.child("SpecificHeatModel"))
    add_heat(*heat, type, fluid, faults);
  return fluid;
}

std::optional<Fluid> readable_fluid(const DeckNode& material) {
  std::vector<Fault> faults;
  const DeckNode* eos = material.child("EOS");
  if (eos == nullptr || find_law(eos->attribute("type").value_or("")) == nullptr)
    return std::nullopt;
  for (const auto& child : eos->children)
    if (!parse_real(child->text)) return std::nullopt;
  const auto gamma = real_of(&material, "gamma"), cv = real_of(&material, "specific_heat");
  if (!gamma || !cv || !(*gamma > 0) || !(*cv > 0)) return std::nullopt;
  Fluid fluid = read_fluid(material, faults);
  return any_error(faults) ? std::nullopt : std::optional(fluid);
}

TagSpec specific_heat_tag() {
  TagSpec heat =
      tag("SpecificHeatModel", "specific heat that depends on temperature; absent: constant")
          .attribute(attribute("type", "which one")
                         .once()
                         .words({"Debye", "Component", "Polynomial", "airNasa"}))
          .with_children({tag("Atoms", "atoms in a kilogram (not a count of atoms alone)")
                              .once()
                              .real()
                              .above(0)
                              .only_for("type", {"Debye"}),
                          tag("DebyeTemperature", "Debye temperature")
                              .once()
                              .real()
                              .above(0)
                              .unit("temperature")
                              .only_for("type", {"Debye"})});
  for (const Species& s : all_species)
    heat = heat.child(tag(s.tag, fmt::format("mole fraction of {}; absent: 0", s.tag + 1))
                          .real()
                          .at_least(0)
                          .at_most(1)
                          .only_for("type", {"Component"}));
  return heat.with_children(
      {tag("MaxOrder", "highest power n of cv = (a_0 + a_1 T + ... + a_n T^n)/T^n")
           .once()
           .integer()
           .at_least(0)
           .at_most(eos::PolynomialHeat::max_order)
           .only_for("type", {"Polynomial"}),
       tag("Tmin", "below it the specific heat is constant; absent: 1")
           .real()
           .above(0)
           .unit("temperature")
           .only_for("type", {"Polynomial"}),
       tag("Tmax", "above it the specific heat is constant; absent: 1e6")
           .real()
           .above(0)
           .unit("temperature")
           .only_for("type", {"Polynomial"}),
       tag("coefficient", "a_0 ... a_n, J/(kg K) times a power of K")
           .once()
           .reals()
           .only_for("type", {"Polynomial"})});
}

}  // namespace sluice::ice
