#include "models/gases/gas_combustion.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <memory>

#include "framework/deck/faults.hpp"
#include "framework/deck/nearest_name.hpp"
#include "framework/deck/rule_tools.hpp"
#include "framework/deck/schema.hpp"
#include "framework/scene/deck_values.hpp"
#include "kinetics/hydrogen_burke.hpp"
#include "kinetics/read_mechanism.hpp"
#include "models/deck/material_name.hpp"
#include "models/gases/flame_start.hpp"

namespace sluice::models {
namespace {

constexpr const char* built_in_closure = "N2";

bool built_in(const DeckNode& parameters) {
  return parameters.name == "hydrogenBurke";
}

// What both models have.
std::vector<TagSpec> common_tags() {
  const auto tolerance = [](const char* name, const char* doc, const char* value) {
    return tag(name, doc).real().above(0).by_default(value);
  };
  const auto without_effect = [](const char* name) {
    return tag(name, "accepted without effect: the integration controls its own steps")
        .real()
        .above(0);
  };
  return {
      tag("material", "the gas: name or index").once().text(),
      tag("doChemistry", "whether the species react").boolean().by_default("true"),
      tag("doDiffusion",
          "whether viscosity, conductivity and diffusion of species follow from the mechanism; "
          "false: the material's viscosity and conductivity are used, species do not diffuse")
          .boolean()
          .by_default("false"),
      tag("debug", "accepted without effect").boolean().by_default("false"),
      tolerance("rtol", "relative tolerance of the integration of reactions", "1e-8"),
      tolerance("atol_T", "absolute tolerance of the temperature", "1e-6").unit("temperature"),
      tolerance("atol_Y", "absolute tolerance of mass fractions", "1e-14"),
      without_effect("safety"),
      without_effect("max_grow"),
      without_effect("max_shrink"),
      tag("geom_object", "a region and the mass fractions in it; later ones overwrite earlier ones")
          .multiple()
          .attribute(attribute("name", "name of the region").text())
          .group("geometry_piece")
          .with_children({tag("Y",
                              "mass fractions of all species but the closure, in the mechanism's "
                              "order")
                              .once()
                              .reals()}),
      tag("initProfile", "an initial state along an axis, in place of the material's regions")
          .with_children(
              {tag("filename", "file with lines x T u rho p Y_1 ... Y_N").once().file(),
               tag("axis", "along which").once().words({"x", "X", "y", "Y", "z", "Z"})})};
}

// The gas of a model; null where it cannot be had, with a fault if there is a list of them.
std::shared_ptr<const kinetics::SpeciesGas> find_gas(const DeckNode& parameters,
                                                     std::vector<Fault>* faults) {
  const auto fault = [&](const DeckNode& where, const std::string& text,
                         const std::string& advice) {
    if (faults != nullptr) add_error(*faults, where.where, text, advice);
    return nullptr;
  };
  const DeckNode* file = parameters.child("mechanismFile");
  const DeckNode* closure = parameters.child("closureSpecies");
  if (!built_in(parameters) && (file == nullptr || closure == nullptr)) return nullptr;
  try {
    kinetics::Mechanism mechanism =
        built_in(parameters) ? kinetics::burke_hydrogen() : kinetics::read_mechanism(file->text);
    const std::string name = built_in(parameters) ? built_in_closure : closure->text;
    std::vector<std::string> names;
    for (const kinetics::Species& s : mechanism.species) names.push_back(s.name);
    const auto found = std::find(names.begin(), names.end(), name);
    if (found == names.end())
      return fault(*closure,
                   fmt::format("<closureSpecies>: the mechanism has no species '{}'", name),
                   suggest_name(name, names));
    if (names.size() < 2 || names.size() > max_species + 1)
      return fault(*file,
                   fmt::format("<mechanismFile>: {} species; 2 to {} are supported", names.size(),
                               max_species + 1),
                   "a reduced mechanism");
    return std::make_shared<const kinetics::SpeciesGas>(std::move(mechanism),
                                                        found - names.begin());
  } catch (const Error& e) {
    return fault(
        file != nullptr ? *file : parameters,
        fmt::format("<{}>: {}", file != nullptr ? "mechanismFile" : "hydrogenBurke", e.what()), "");
  }
}

// x or X.
int axis_of(const DeckNode& profile) {
  return std::clamp((profile.string("axis").front() | 0x20) - 'x', 0, 2);
}

// Mass fractions of the carried species that a list of the deck gives.
void check_fractions(const DeckNode& list, const kinetics::SpeciesGas& gas,
                     std::vector<Fault>& faults) {
  const std::vector<double> Y = list.as_reals();
  if (Y.size() != gas.carried()) {
    std::string names;
    for (std::size_t k = 0; k < gas.carried(); ++k) names += (k == 0 ? "" : ", ") + gas.name_of(k);
    return add_error(faults, list.where,
                     fmt::format("<{}> has {} mass fractions; the species without the closure are "
                                 "{}: {}",
                                 list.name, Y.size(), gas.carried(), names),
                     "one for each, in this order");
  }
  double sum = 0;
  for (const double y : Y) sum += y;
  const bool inside = std::all_of(Y.begin(), Y.end(), [](double y) { return y >= 0 && y <= 1; });
  if (!inside || sum > 1 + 1e-9)
    add_error(faults, list.where,
              fmt::format("<{}>: mass fractions lie in [0, 1] and sum to 1 at most; these sum to "
                          "{:.10g}",
                          list.name, sum),
              "the closure species completes the sum to 1");
}

void check_units(const DeckNode& parameters, std::vector<Fault>& faults) {
  const DeckNode* units = parameters.child("units");
  if (units == nullptr) return;
  const std::map<std::string, std::string> si = {
      {"length", "m"}, {"mass", "kg"}, {"time", "s"}, {"temperature", "K"}};
  for (const auto& [quantity, unit] : si) {
    const DeckNode* node = units->child(quantity);
    if (node != nullptr && node->text != unit)
      add_not_built(faults, node->where, fmt::format("<{}> '{}' of <units>", quantity, node->text),
                    fmt::format("write the deck in SI units, here {}", unit));
  }
}

std::vector<double> start_fractions(const DeckNode& parameters, const kinetics::SpeciesGas& gas) {
  if (!built_in(parameters)) return parameters.child("Y_init")->as_reals();
  std::vector<double> Y(gas.carried(), 0.0);
  for (std::size_t k = 0; k < Y.size(); ++k) {
    if (gas.name_of(k) == "H2") Y[k] = parameters.real("YH2_init");
    if (gas.name_of(k) == "O2") Y[k] = parameters.real("YO2_init");
  }
  return Y;
}

TransportedScalar species(const kinetics::SpeciesGas& gas, std::size_t k) {
  TransportedScalar s;
  s.name = "Y" + gas.name_of(k);
  s.of_species = s.by_volume = true;
  return s;
}

}  // namespace

TagSpec gas_combustion_tag() {
  const auto unit = [](const char* name, const std::vector<std::string>& words) {
    return tag(name, "unit of the deck; only SI is supported").words(words);
  };
  return tag("gasCombustion",
             "a gas of reacting and diffusing species, with a mechanism from a file")
      .with_children(common_tags())
      .with_children(
          {tag("mechanismFile",
               "XML file with species, reactions and fits of transport coefficients")
               .once()
               .file(),
           tag("closureSpecies", "the species that completes the sum to 1").once().text(),
           tag("Y_init", "initial mass fractions of the other species, in the mechanism's order")
               .once()
               .reals(),
           tag("units", "units of the deck")
               .with_children({unit("length", {"m", "cm", "mm", "ft", "in"}),
                               unit("mass", {"kg", "g", "lbm", "slug"}),
                               unit("time", {"s", "ms", "us"}), unit("temperature", {"K", "R"})})});
}

TagSpec hydrogen_burke_tag() {
  const auto fraction = [](const char* name, const char* doc) {
    return tag(name, doc).once().real().at_least(0).at_most(1);
  };
  return tag("hydrogenBurke", "reacting hydrogen, oxygen and nitrogen: 9 species, 23 reactions")
      .with_children(common_tags())
      .with_children({fraction("YH2_init", "initial mass fraction of H2"),
                      fraction("YO2_init", "initial mass fraction of O2; the rest is N2")});
}

void check_gas_combustion(const DeckNode& parameters, const std::vector<std::string>& materials,
                          std::vector<Fault>& faults) {
  check_material(parameters, "material", materials, faults);
  if (materials.size() > 1)
    add_not_built(faults, parameters.where,
                  fmt::format("<{}> with several materials", parameters.name),
                  "remove the other materials");
  check_units(parameters, faults);
  for (const char* name : {"safety", "max_grow", "max_shrink"})
    if (const DeckNode* node = parameters.child(name))
      add_warning(faults, node->where,
                  fmt::format("<{}> has no effect: the integration of reactions controls its own "
                              "steps",
                              name),
                  "remove it; <rtol>, <atol_T>, <atol_Y> are its tolerances");
  const auto gas = find_gas(parameters, &faults);
  if (gas == nullptr) return;
  if (is_true(&parameters, "doDiffusion") && gas->mechanism().diffusion.empty())
    add_error(faults, parameters.child("doDiffusion")->where,
              "<doDiffusion> true: the mechanism has no fits of transport coefficients",
              "write false, or use a mechanism with <binaryDiffusionFits>");
  if (const DeckNode* start = parameters.child("Y_init")) check_fractions(*start, *gas, faults);
  if (const DeckNode* profile = parameters.child("initProfile")) {
    const DeckNode *file = profile->child("filename"), *axis = profile->child("axis");
    if (file != nullptr && axis != nullptr)
      collect(faults, file->where, [&] { read_flame(file->text, axis_of(*profile), *gas); });
  }
  if (built_in(parameters)) {
    const double H2 = real_of(&parameters, "YH2_init").value_or(0);
    const double O2 = real_of(&parameters, "YO2_init").value_or(0);
    if (H2 + O2 > 1 + 1e-9)
      add_error(faults, parameters.child("YO2_init")->where,
                fmt::format("<YH2_init> and <YO2_init> sum to {:.10g}, above 1", H2 + O2),
                "the remainder to 1 is N2");
  }
  for (const DeckNode* object : parameters.all("geom_object"))
    if (const DeckNode* Y = object->child("Y")) check_fractions(*Y, *gas, faults);
}

MixedGas read_gas_combustion(const DeckNode& parameters,
                             const std::vector<std::string>& materials) {
  MixedGas gas;
  gas.type = parameters.name;
  gas.material = read_material(parameters, "material", materials);
  gas.where = parameters.where;
  gas.own_heat_capacity = true;
  gas.set_nodes({{0}, {1}});
  Combustion model;
  model.gas = find_gas(parameters, nullptr);
  if (model.gas == nullptr) return gas;
  model.reacts = parameters.boolean("doChemistry");
  model.diffuses = parameters.boolean("doDiffusion");
  gas.own_viscosity = gas.own_conductivity = model.diffuses;
  model.relative_tolerance = parameters.real("rtol");
  model.temperature_tolerance = parameters.real("atol_T");
  model.fraction_tolerance = parameters.real("atol_Y");
  for (std::size_t k = 0; k < model.gas->carried(); ++k)
    gas.fractions.push_back(species(*model.gas, k).name);
  if (const DeckNode* profile = parameters.child("initProfile")) {
    // A file that cannot be read has been told.
    std::vector<Fault> known;
    const DeckNode& file = *profile->child("filename");
    collect(known, file.where,
            [&] { model.start = read_flame(file.text, axis_of(*profile), *model.gas).state; });
  }
  gas.species = std::move(model);
  return gas;
}

std::vector<TransportedScalar> read_species(const MixedGas& gas, const DeckNode& parameters,
                                            const GeometryReader& geometry,
                                            std::vector<Fault>& faults) {
  std::vector<TransportedScalar> all;
  if (!gas.species) return all;
  const kinetics::SpeciesGas& species_gas = *gas.species->gas;
  const std::vector<double> start = start_fractions(parameters, species_gas);
  std::vector<StartLine> lines;
  if (const DeckNode* profile = gas.species->start ? parameters.child("initProfile") : nullptr)
    lines = read_flame(profile->child("filename")->text, axis_of(*profile), species_gas).fractions;
  for (std::size_t k = 0; k < species_gas.carried(); ++k) {
    TransportedScalar s = species(species_gas, k);
    s.material = gas.material;
    s.where = gas.where;
    s.everywhere = start[k];
    s.spreads_by_law = gas.species->diffuses;
    if (!lines.empty()) s.line = std::make_shared<const StartLine>(std::move(lines[k]));
    for (const DeckNode* object : parameters.all("geom_object")) {
      ScalarRegion region;
      region.piece = geometry.object(*object, faults).piece;
      region.value = object->child("Y")->as_reals()[k];
      s.start.push_back(region);
    }
    all.push_back(std::move(s));
  }
  return all;
}

std::vector<std::string> species_labels(const DeckNode& parameters) {
  std::vector<std::string> labels;
  const auto gas = find_gas(parameters, nullptr);
  if (gas == nullptr) return labels;
  for (std::size_t k = 0; k < gas->carried(); ++k) {
    TransportedScalar s = species(*gas, k);
    s.spreads_by_law = is_true(&parameters, "doDiffusion");
    for (std::string& label : labels_of(s)) labels.push_back(std::move(label));
  }
  const DeckNode* reacts = parameters.child("doChemistry");
  if (reacts != nullptr && reacts->text == "false") return labels;
  const ReactionLabels of_reactions = reaction_labels();
  for (const Label label :
       {of_reactions.heat_release, of_reactions.last_step, of_reactions.limiter})
    labels.push_back(label.name());
  return labels;
}

}  // namespace sluice::models
