#include "kinetics/read_reaction.hpp"

#include <fmt/format.h>

#include <cmath>
#include <optional>
#include <string>

#include "framework/deck/value_text.hpp"
#include "kinetics/rate_units.hpp"

namespace sluice::kinetics {
namespace {

double energy_unit(const DeckNode& node, const std::string& name) {
  if (name == "cal/mol") return calorie;
  if (name == "kcal/mol") return 1e3 * calorie;
  if (name == "J/mol") return 1;
  if (name == "kJ/mol") return 1e3;
  if (name == "J/kmol") return 1e-3;
  if (name == "K") return molar_gas_constant;
  refuse(node, fmt::format("unit of energy {} is not known (known: cal/mol, kcal/mol, J/mol, "
                           "kJ/mol, J/kmol, K)",
                           in_quotes(name)));
}

Arrhenius read_arrhenius(const DeckNode& node, int order, const RateUnits& units) {
  only_children(node, {"A", "b", "E"});
  const DeckNode& E = needed(node, "E");
  const std::optional<std::string> unit = E.attribute("units");
  Arrhenius rate;
  rate.A = frequency_factor(real(needed(node, "A")), order, units.volume);
  rate.b = real(needed(node, "b"));
  rate.E = real(E) * (unit ? energy_unit(E, *unit) : units.energy);
  if (!(rate.A > 0)) refuse(needed(node, "A"), "<A> must be positive");
  return rate;
}

std::vector<Participant> participants(const DeckNode& node, const SpeciesIndices& places) {
  std::vector<Participant> all;
  for (const auto& [name, count] : name_and_count(node))
    all.push_back({place_of(places, name, node), count});
  if (all.empty()) refuse(node, fmt::format("<{}> is empty", node.name));
  return all;
}

int molecules(const std::vector<Participant>& side) {
  int sum = 0;
  for (const Participant& p : side) sum += p.count;
  return sum;
}

void check_balance(const DeckNode& node, const Reaction& reaction,
                   const std::vector<Species>& species) {
  std::vector<int> excess(species.front().atoms.size(), 0);
  const auto add = [&](const std::vector<Participant>& side, int sign) {
    for (const Participant& p : side)
      for (std::size_t e = 0; e < excess.size(); ++e)
        excess[e] += sign * p.count * species[p.species].atoms[e];
  };
  add(reaction.products, 1);
  add(reaction.reactants, -1);
  for (const int atoms : excess)
    if (atoms != 0)
      refuse(node,
             fmt::format("reaction {} makes or destroys atoms", in_quotes(reaction.equation)));
}

void read_troe(const DeckNode& node, Falloff& falloff) {
  const std::vector<double> numbers = reals(node, node.text);
  if (numbers.size() != 3 && numbers.size() != 4)
    refuse(node, fmt::format("Troe's form has 3 or 4 numbers, not {}", numbers.size()));
  falloff.troe = true;
  falloff.a = numbers[0];
  falloff.T3 = numbers[1];
  falloff.T1 = numbers[2];
  if (!(falloff.T3 > 0 && falloff.T1 > 0))
    refuse(node, "the temperatures T*** and T* of Troe's form must be positive");
  if (numbers.size() == 4) falloff.T2 = numbers[3];
}

// The two limits, named k0 and kInf, and how the rate goes from one to the other.
void read_falloff(const DeckNode& node, int order, const RateUnits& units, Reaction& reaction) {
  Falloff falloff;
  bool low = false, high = false;
  for (const DeckNode* limit : node.all("Arrhenius")) {
    const std::string name = needed_attribute(*limit, "name");
    if (name == "k0") {
      falloff.low = read_arrhenius(*limit, order + 1, units);
      low = true;
    } else if (name == "kInf") {
      reaction.rate = read_arrhenius(*limit, order, units);
      high = true;
    } else {
      refuse(*limit, fmt::format("name {}: a falloff reaction has k0 and kInf", in_quotes(name)));
    }
  }
  if (!low || !high) refuse(node, "a falloff reaction needs both Arrhenius laws, k0 and kInf");
  const DeckNode& form = needed(node, "falloff");
  const std::string type = needed_attribute(form, "type");
  if (type == "Troe")
    read_troe(form, falloff);
  else if (type != "Lindemann")
    refuse(form, fmt::format("falloff of type {} is not supported (supported: Lindemann, Troe)",
                             in_quotes(type)));
  reaction.falloff = falloff;
}

void read_efficiencies(const DeckNode& reaction_node, const SpeciesIndices& places,
                       Reaction& reaction) {
  const DeckNode* node = reaction_node.child("efficiencies");
  double common = 1;
  if (node != nullptr && node->attribute("default"))
    common = real(*node, *node->attribute("default"));
  reaction.efficiency.assign(places.size(), common);
  if (node == nullptr) return;
  for (const auto& [name, text] : name_and_text(*node)) {
    const double value = real(*node, text);
    if (!(value >= 0)) refuse(*node, fmt::format("the efficiency of {} is negative", name));
    reaction.efficiency[place_of(places, name, *node)] = value;
  }
}

}  // namespace

RateUnits read_rate_units(const DeckNode& node) {
  const auto named = [&](const char* name, const char* otherwise) {
    return node.attribute(name).value_or(otherwise);
  };
  const std::string length = named("length", "m"), quantity = named("quantity", "mol");
  if (length != "cm" && length != "m")
    refuse(node, fmt::format("length {}: cm and m are known", in_quotes(length)));
  if (quantity != "mol" && quantity != "kmol")
    refuse(node, fmt::format("quantity {}: mol and kmol are known", in_quotes(quantity)));
  if (named("time", "s") != "s") refuse(node, "time: s is known");
  RateUnits units;
  units.volume = (length == "cm" ? 1e-6 : 1.0) / (quantity == "kmol" ? 1e3 : 1.0);
  units.energy = energy_unit(node, named("activation-energy", "J/mol"));
  return units;
}

Reaction read_reaction(const DeckNode& node, const SpeciesIndices& places,
                       const std::vector<Species>& species, const RateUnits& units) {
  only_children(node, {"equation", "reactants", "products", "rateCoeff", "efficiencies"});
  Reaction reaction;
  reaction.equation = needed(node, "equation").text;
  reaction.reactants = participants(needed(node, "reactants"), places);
  reaction.products = participants(needed(node, "products"), places);
  const std::string reversible = node.attribute("reversible").value_or("yes");
  if (reversible != "yes" && reversible != "no")
    refuse(node, fmt::format("reversible {}: yes or no", in_quotes(reversible)));
  reaction.reversible = reversible == "yes";
  const std::string type = node.attribute("type").value_or("elementary");
  const DeckNode& rate = needed(node, "rateCoeff");
  const int order = molecules(reaction.reactants);
  if (type == "falloff") {
    only_children(rate, {"Arrhenius", "falloff"});
    read_falloff(rate, order, units, reaction);
  } else if (type == "elementary" || type == "three-body") {
    only_children(rate, {"Arrhenius"});
    if (rate.children.size() != 1) refuse(rate, "one Arrhenius law is expected");
    reaction.third_body = type == "three-body";
    reaction.rate =
        read_arrhenius(needed(rate, "Arrhenius"), order + (reaction.third_body ? 1 : 0), units);
  } else {
    refuse(node, fmt::format("a reaction of type {} is not supported (supported: elementary, "
                             "three-body, falloff)",
                             in_quotes(type)));
  }
  if (type == "elementary") {
    if (const DeckNode* extra = node.child("efficiencies"))
      refuse(*extra, "an elementary reaction has no third body");
  } else {
    read_efficiencies(node, places, reaction);
  }
  check_balance(node, reaction, species);
  return reaction;
}

}  // namespace sluice::kinetics
