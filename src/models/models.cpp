// What the models of a deck ask of it, and what they bring.
#include "models/models.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "framework/deck/nearest_name.hpp"
#include "framework/deck/rule_tools.hpp"
#include "framework/deck/schema.hpp"
#include "framework/scene/deck_values.hpp"
#include "models/burn/light_time.hpp"
#include "models/deck/material_name.hpp"
#include "models/gases/combustion.hpp"
#include "models/model_table.hpp"
#include "models/scalars/transported_scalar.hpp"

namespace sluice::models {
namespace {

// Known to the format, and not supported.
const std::vector<std::string> not_supported = {"ConstantSources", "DDT0",
                                                "IandG",           "MesoBurn",
                                                "Radiation",       "SolidReactionModel",
                                                "ZeroOrder",       "ethyleneDetonation"};

// Calls f(entry, parameters) for every model of the deck that is built and has its element.
template <class F>
void for_each_model(const DeckNode& root, F&& f) {
  const DeckNode* models = root.child("Models");
  if (models == nullptr) return;
  for (const DeckNode* model : models->all("Model")) {
    const ModelRow* entry = find_model(model->attribute("type").value_or(""));
    const DeckNode* parameters = entry == nullptr ? nullptr : model->child(entry->parameters.name);
    if (parameters != nullptr) f(*entry, *parameters);
  }
}

}  // namespace

bool mixes_gas(const std::string& type) {
  const ModelRow* entry = find_model(type);
  return entry != nullptr && entry->mixes_gas;
}

bool transports_scalar(const DeckNode& model) {
  const ModelRow* entry = find_model(model.attribute("type").value_or(""));
  return entry != nullptr && entry->transports_scalar;
}

std::optional<double> own_coefficient(const DeckNode& model, Coefficient coefficient) {
  const ModelRow* entry = find_model(model.attribute("type").value_or(""));
  if (entry == nullptr || entry->coefficient == nullptr) return std::nullopt;
  const DeckNode* parameters = model.child(entry->parameters.name);
  if (parameters == nullptr) return std::nullopt;
  return entry->coefficient(*parameters, coefficient);
}

TagSpec models_tag() {
  std::vector<std::string> types;
  TagSpec model = tag("Model", "one model; there may be several of one type").multiple();
  std::vector<TagSpec> elements;
  for (const ModelRow& entry : model_rows()) {
    types.emplace_back(entry.type);
    elements.push_back(entry.parameters.once().only_for("type", {entry.type}));
  }
  return tag("Models", "sources and exchange in addition to the flow")
      .child(
          model
              .attribute(
                  attribute("type",
                            "type of the model; its parameters are in an element of the same name")
                      .once()
                      .words(types)
                      .not_built(not_supported))
              .with_children(elements));
}

namespace {

// Parameters beside the element of their model, as older decks have them.
void put_into_element(DeckNode& model, const std::string& element_name,
                      std::vector<Fault>& faults) {
  auto element = std::make_unique<DeckNode>();
  element->name = element_name;
  element->where = model.where;
  element->children.swap(model.children);
  model.children.push_back(std::move(element));
  add_warning(faults, model.where,
              fmt::format("<Model>: parameters outside <{0}> are obsolete; read as inside it",
                          element_name),
              fmt::format("write <{}> around them", element_name));
}

}  // namespace

void move_parameters(DeckNode& root, std::vector<Fault>& faults) {
  for (const auto& models : root.children) {
    if (models->name != "Models") continue;
    for (const auto& model : models->children) {
      const ModelRow* entry = find_model(model->attribute("type").value_or(""));
      if (entry == nullptr) continue;
      const std::string& element = entry->parameters.name;
      const bool of_another = std::any_of(
          model_rows().begin(), model_rows().end(),
          [&](const ModelRow& other) { return model->child(other.parameters.name) != nullptr; });
      if (!of_another && !model->children.empty()) put_into_element(*model, element, faults);
      DeckNode* parameters = model->child(element);
      if (parameters != nullptr && entry->update != nullptr) entry->update(*parameters, faults);
    }
  }
}

void check_models(const DeckNode& root, const MaterialNames& materials,
                  std::vector<Fault>& faults) {
  std::set<std::string> labels;
  std::set<std::pair<std::string, int>> written;
  const auto& of_all_particles = particle_variables();
  for_each_model(root, [&](const ModelRow& entry, const DeckNode& parameters) {
    entry.check(parameters, materials, faults);
    // What burns is a solid or a fluid, all else is a fluid.
    const std::vector<std::string> names =
        entry.burn != nullptr ? materials.all() : materials.fluids;
    if (entry.once_for != nullptr &&
        !written.insert({entry.type, read_material(parameters, entry.once_for, names)}).second)
      return add_error(faults, parameters.where,
                       fmt::format("two <{}> of the same material", parameters.name),
                       entry.once_reason);
    if (entry.labels == nullptr) return;
    for (const std::string& label : entry.labels(parameters))
      if (std::find(of_all_particles.begin(), of_all_particles.end(), label) ==
              of_all_particles.end() &&
          !labels.insert(label).second)
        return add_error(faults, parameters.where,
                         fmt::format("two models define the variable {}", label),
                         "give each scalar a different name");
  });
  const std::vector<std::string> scalars = scalar_variables(root);
  for_each_model(root, [&](const ModelRow& /*entry*/, const DeckNode& parameters) {
    const DeckNode* clones = parameters.child("cloneVariables");
    if (clones == nullptr) return;
    for (const DeckNode* clone : clones->all("CCVarLabel")) {
      const std::string label = clone->attribute("label").value_or("");
      if (!label.starts_with("scalar-") ||
          std::find(scalars.begin(), scalars.end(), label) == scalars.end())
        add_error(faults, clone->where,
                  fmt::format("<CCVarLabel label=\"{}\">: particles can have copies only of "
                              "scalars of the deck's models",
                              label),
                  suggest_name(label, scalars));
    }
  });
}

ModelList read_models(const DeckNode& root, const MaterialNames& materials,
                      const GeometryReader& geometry, std::vector<Fault>& faults) {
  ModelList list;
  if (const DeckNode* models = root.child("Models")) list.where = models->where;
  for_each_model(root, [&](const ModelRow& entry, const DeckNode& parameters) {
    if (entry.read != nullptr)
      entry.read(parameters, {materials.fluids, materials, geometry, list, faults});
  });
  return list;
}

std::vector<SolidBurn> read_burns(const DeckNode& root, const MaterialNames& materials) {
  std::vector<SolidBurn> burns;
  for_each_model(root, [&](const ModelRow& entry, const DeckNode& parameters) {
    if (entry.burn == nullptr) return;
    const Reactant reactant = read_reactant(parameters, materials);
    if (reactant.solid)
      burns.push_back(
          {reactant.from, reactant.to, entry.burn(parameters, materials), parameters.where});
  });
  return burns;
}

void declare_labels() {
  TransportedScalar scalar;
  scalar.name = "NAME";
  scalar.declare_labels();
  front_gradient_label();
  reaction_labels();
  TracerScalar of_tracers;
  of_tracers.name = "p.NAME";
  of_tracers.label();
}

bool all_built(const DeckNode& root) {
  const DeckNode* models = root.child("Models");
  if (models == nullptr) return true;
  const auto entries = models->all("Model");
  return std::all_of(entries.begin(), entries.end(), [](const DeckNode* model) {
    return find_model(model->attribute("type").value_or("")) != nullptr;
  });
}

std::vector<std::string> save_labels(const DeckNode& root) {
  std::vector<std::string> labels;
  for_each_model(root, [&](const ModelRow& entry, const DeckNode& parameters) {
    if (entry.labels == nullptr) return;
    for (std::string& label : entry.labels(parameters)) labels.push_back(std::move(label));
  });
  return labels;
}

std::vector<std::string> scalar_variables(const DeckNode& root) {
  std::vector<std::string> labels = save_labels(root);
  const std::set<std::string> all(labels.begin(), labels.end());
  std::erase_if(labels,
                [&](const std::string& label) { return !all.contains("totalSum_" + label); });
  return labels;
}

}  // namespace sluice::models
