#include "kinetics/read_mechanism.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "framework/base/error.hpp"
#include "framework/deck/value_text.hpp"
#include "framework/deck/xml_reader.hpp"
#include "kinetics/atoms.hpp"
#include "kinetics/mechanism_nodes.hpp"
#include "kinetics/read_reaction.hpp"

namespace sluice::kinetics {
namespace {

// Fits that have another form than the one of mechanism.hpp would be read wrongly.
Fit read_fit(const DeckNode& node, const std::string& text) {
  const std::vector<double> numbers = reals(node, text);
  Fit fit{};
  if (numbers.size() != fit.size())
    refuse(node, fmt::format("a fit has {} numbers, not {}", fit.size(), numbers.size()));
  std::copy(numbers.begin(), numbers.end(), fit.begin());
  return fit;
}

void expect_form(const DeckNode& node, const char* attribute, const std::string& expected) {
  const std::string found = needed_attribute(node, attribute);
  if (found != expected)
    refuse(node, fmt::format("{} {} is not supported (supported: {})", attribute, in_quotes(found),
                             expected));
}

std::optional<Fit> read_species_fit(const DeckNode& species, const char* name, const char* form) {
  const DeckNode* node = species.child(name);
  if (node == nullptr) return std::nullopt;
  expect_form(*node, "form", form);
  return read_fit(*node, node->text);
}

Nasa7 read_thermo(const DeckNode& node) {
  only_children(node, {"NASA7"});
  std::vector<const DeckNode*> ranges = node.all("NASA7");
  if (ranges.size() != 2)
    refuse(node, fmt::format("two ranges <NASA7> are expected, not {}", ranges.size()));
  const auto bound = [](const DeckNode* range, const char* name) {
    return real(*range, needed_attribute(*range, name));
  };
  if (bound(ranges[1], "Tmin") < bound(ranges[0], "Tmin")) std::swap(ranges[0], ranges[1]);
  Nasa7 thermo;
  thermo.T_low = bound(ranges[0], "Tmin");
  thermo.T_mid = bound(ranges[0], "Tmax");
  thermo.T_high = bound(ranges[1], "Tmax");
  if (!(0 < thermo.T_low && thermo.T_low < thermo.T_mid && thermo.T_mid < thermo.T_high) ||
      bound(ranges[1], "Tmin") != thermo.T_mid)
    refuse(node, "the two ranges of temperature do not follow each other");
  for (std::size_t n = 0; n < 2; ++n) {
    const DeckNode& node_of_numbers = needed(*ranges[n], "floatArray");
    const std::vector<double> numbers = reals(node_of_numbers, node_of_numbers.text);
    std::array<double, 7>& to = n == 0 ? thermo.low : thermo.high;
    if (numbers.size() != to.size())
      refuse(node_of_numbers, fmt::format("7 numbers are expected, not {}", numbers.size()));
    std::copy(numbers.begin(), numbers.end(), to.begin());
  }
  return thermo;
}

Species read_species(const DeckNode& node, std::vector<std::string>& elements) {
  Species species;
  species.name = needed_attribute(node, "name");
  const DeckNode& atoms = needed(node, "atomArray");
  species.atoms.assign(elements.size(), 0);
  for (const auto& [symbol, count] : name_and_count(atoms)) {
    const std::optional<double> mass = atomic_mass(symbol);
    if (!mass) refuse(atoms, fmt::format("the mass of element {} is not known", in_quotes(symbol)));
    const auto found = std::find(elements.begin(), elements.end(), symbol);
    if (found == elements.end())
      refuse(atoms, fmt::format("element {} is not in <elementArray>", in_quotes(symbol)));
    species.atoms[found - elements.begin()] += count;
    species.molar_mass += count * *mass;
  }
  if (!(species.molar_mass > 0)) refuse(atoms, "a species has atoms");
  species.thermo = read_thermo(needed(node, "thermo"));
  species.viscosity = read_species_fit(node, "viscosityFit", "sqrt(mu)=T^0.25*poly(lnT)");
  species.conductivity = read_species_fit(node, "conductivityFit", "lambda=sqrt(T)*poly(lnT)");
  return species;
}

std::vector<Fit> read_diffusion(const DeckNode* node, const SpeciesIndices& places) {
  if (node == nullptr) return {};
  expect_form(*node, "form", "P*D=T^1.5*poly(lnT)");
  expect_form(*node, "units", "Pa-m2/s");
  const std::size_t count = places.size();
  std::vector<std::optional<Fit>> found(count * count);
  for (const DeckNode* pair : node->all("pair")) {
    const std::size_t j = place_of(places, needed_attribute(*pair, "s1"), *pair);
    const std::size_t k = place_of(places, needed_attribute(*pair, "s2"), *pair);
    found[j * count + k] = found[k * count + j] =
        read_fit(*pair, needed_attribute(*pair, "coeffs"));
  }
  std::vector<Fit> fits;
  for (const auto& [one, j] : places)
    for (const auto& [other, k] : places)
      if (!found[j * count + k]) refuse(*node, fmt::format("no pair of {} and {}", one, other));
  for (const std::optional<Fit>& fit : found) fits.push_back(*fit);
  return fits;
}

Mechanism mechanism_from(const DeckNode& root) {
  if (root.name != "mechanism")
    refuse(root, fmt::format("the root element is <{}>, not <mechanism>", root.name));
  Mechanism mechanism;
  mechanism.name = root.attribute("name").value_or("");
  const DeckNode& phase = needed(root, "phase");
  mechanism.elements = words(needed(phase, "elementArray"));
  const DeckNode& data = needed(root, "speciesData");
  const DeckNode& listed = needed(phase, "speciesArray");
  SpeciesIndices places;
  for (const std::string& name : words(listed)) {
    if (!places.emplace(name, mechanism.species.size()).second)
      refuse(listed, fmt::format("species {} is listed twice", in_quotes(name)));
    const auto& all = data.children;
    const auto found = std::find_if(all.begin(), all.end(), [&](const auto& node) {
      return node->name == "species" && node->attribute("name") == name;
    });
    if (found == all.end())
      refuse(listed, fmt::format("species {} has no <species> in <speciesData>", in_quotes(name)));
    mechanism.species.push_back(read_species(**found, mechanism.elements));
  }
  if (mechanism.species.empty()) refuse(listed, "no species");
  if (const DeckNode* reactions = root.child("reactionData")) {
    const RateUnits units = read_rate_units(needed(root, "units"));
    only_children(*reactions, {"reaction"});
    for (const auto& node : reactions->children)
      mechanism.reactions.push_back(read_reaction(*node, places, mechanism.species, units));
  }
  mechanism.diffusion = read_diffusion(root.child("binaryDiffusionFits"), places);
  return mechanism;
}

}  // namespace

Mechanism read_mechanism(const std::string& file) {
  ReadBudget budget;
  const XmlTree tree = read_xml_file(file, file, budget);
  for (const Fault& fault : tree.faults)
    if (fault.severity == Severity::error) throw InputError(to_string(fault));
  return mechanism_from(*tree.root);
}

}  // namespace sluice::kinetics
