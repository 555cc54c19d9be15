// Model "AdiabaticTable": how a deck says it, and what its table means.
#include "models/gases/adiabatic_table.hpp"

#include <fmt/format.h>

#include <cmath>

#include "framework/deck/rule_tools.hpp"
#include "framework/deck/schema.hpp"
#include "framework/scene/deck_values.hpp"
#include "models/gases/mixture_scalar.hpp"
#include "models/scalars/transported_scalar.hpp"

namespace sluice::models {
namespace {

TagSpec named_value(const char* name, const char* doc) {
  return tag(name, doc).multiple().attribute(attribute("name", "name of the column").once().text());
}

TagSpec table_tag() {
  return tag("table", "the table")
      .once()
      .attribute(attribute("name", "name of the table").once().text())
      .attribute(attribute("type", "format of the table").once().words({"Arches"}))
      .with_children(
          {tag("filename",
               "file of the table, compressed with gzip or not, relative to the working folder or "
               "the folder of the deck")
               .once()
               .file(),
           named_value("defaultValue", "value of a further axis of the table").real(),
           named_value("constantValue", "a column of one value").real(),
           named_value(
               "derivedValue",
               "a column computed from others: [column], {mixture_fraction}, numbers, + - * / ( )")
               .text()});
}

PropertyTable::Additions read_additions(const DeckNode& table) {
  PropertyTable::Additions additions;
  const auto numbers = [&](const char* name, std::map<std::string, double>& to) {
    for (const DeckNode* node : table.all(name))
      to[node->attribute("name").value_or("")] = parse_real(node->text).value.value_or(0);
  };
  numbers("defaultValue", additions.defaults);
  numbers("constantValue", additions.constants);
  for (const DeckNode* node : table.all("derivedValue"))
    additions.derived[node->attribute("name").value_or("")] = node->text;
  return additions;
}

}  // namespace

std::vector<MixedGas::Node> adiabatic_nodes(const PropertyTable& table) {
  const auto gamma = table.column("gamma"), cv = table.column("heat_capac_Cv"),
             mu = table.column("viscosity"), k = table.column("thermal_conductivity"),
             T = table.column("Temp"), T_r = table.column("reference_Temp"),
             gamma_r = table.column("reference_gamma"),
             cv_r = table.column("reference_heat_capac_Cv");
  std::vector<MixedGas::Node> nodes(table.fractions().size());
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    MixedGas::Node& node = nodes[n];
    node.f = table.fractions()[n];
    node.cv = cv[n];
    node.R = (gamma[n] - 1.0) * cv[n];
    node.viscosity = mu[n];
    node.conductivity = k[n];
    node.heat = T[n] * (gamma[n] * cv[n]) - T_r[n] * (gamma_r[n] * cv_r[n]);
    if (!(node.cv > 0 && node.R > 0 && mu[n] >= 0 && k[n] >= 0 && std::isfinite(node.heat)))
      throw InputError(fmt::format(
          "property table, mixture fraction {:g}: heat_capac_Cv {:g} must be above 0, gamma {:g} "
          "above 1, viscosity {:g} and thermal_conductivity {:g} at least 0, Temp {:g} finite",
          node.f, cv[n], gamma[n], mu[n], k[n], T[n]));
  }
  return nodes;
}

TagSpec adiabatic_table_tag() {
  const TagSpec test =
      tag("doTableTest", "accepted without effect: the table is checked when it is read")
          .boolean()
          .by_default("false");
  const TagSpec constants =
      tag("constants", "constants of the mixture fraction").with_children(diffusion_tags());
  std::vector<TagSpec> of_mixture = mixture_tags("the mixture fraction", {test, constants});
  of_mixture.insert(of_mixture.begin() + 1, table_tag());
  return tag("AdiabaticTable",
             "an ideal gas with properties and heat of mixing from a table over mixture fraction")
      .with_children(of_mixture)
      .with_children({tag("varianceScale",
                          "must be 0: the table is evaluated at the default of its second axis")
                          .real()
                          .at_least(0)
                          .by_default("0"),
                      tag("varianceMax", "without effect if varianceScale is 0").real().at_least(0),
                      tag("tableValue", "further columns to save").multiple().text()});
}

void check_adiabatic_table(const DeckNode& parameters, const std::vector<std::string>& materials,
                           std::vector<Fault>& faults) {
  const DeckNode* scalar = check_mixture(parameters, materials, faults);
  check_alone(parameters, materials, faults);
  if (real_of(&parameters, "varianceScale").value_or(0) > 0)
    add_not_built(faults, parameters.child("varianceScale")->where, "<varianceScale> above 0",
                  "write 0");
  if (const DeckNode* value = parameters.child("tableValue"))
    add_not_built(faults, value->where, "<tableValue>", "remove it");
  if (is_true(scalar, "doTableTest"))
    add_warning(faults, scalar->child("doTableTest")->where,
                "<doTableTest> true has no effect: the table is checked when it is read",
                "write false");
}

MixedGas read_adiabatic_table(const DeckNode& parameters, const std::vector<std::string>& materials,
                              std::vector<Fault>& faults) {
  MixedGas gas = read_mixture(parameters, materials);
  gas.released = cumulative_energy;
  gas.own_heat_capacity = gas.own_viscosity = gas.own_conductivity = true;
  gas.set_nodes({{0}, {1}});
  const DeckNode& table = *parameters.child("table");
  const DeckNode& filename = *table.child("filename");
  collect(faults, filename.where, [&] {
    gas.set_nodes(adiabatic_nodes(PropertyTable(filename.text, read_additions(table))));
  });
  return gas;
}

}  // namespace sluice::models
