// Boundary conditions of an ICE deck: each variable once on every part of the boundary, with a
// value of the right kind.
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "framework/deck/faults.hpp"
#include "framework/deck/nearest_name.hpp"
#include "framework/deck/rule_tools.hpp"
#include "framework/deck/schema.hpp"
#include "ice/deck/schema.hpp"
#include "models/models.hpp"

namespace sluice {
namespace {

const std::vector<std::string> labels = {"Pressure", "Density",     "Temperature",
                                         "Velocity", "SpecificVol", "Symmetric"};
// SpecificVol may be left out: it follows from the density.
constexpr std::array<const char*, 4> needed = {"Pressure", "Velocity", "Temperature", "Density"};

// "side x-", "circle y+": how a face is called in messages.
std::string face_name(const DeckNode& face) {
  for (const std::string_view shape : face_shapes) {
    if (const auto side = face.attribute(shape)) return fmt::format("{} {}", shape, *side);
  }
  return "Face";
}

bool is_label(const std::string& label) {
  return std::find(labels.begin(), labels.end(), label) != labels.end();
}

bool is_scalar(const std::string& name) {
  return name.rfind("scalar-", 0) == 0 || name == models::cumulative_energy;
}

bool is_listed(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

void check_label(const DeckNode& face, const DeckNode& condition,
                 const std::vector<std::string>& scalars, bool all_models_built,
                 std::vector<Fault>& faults) {
  const auto label = condition.attribute("label");
  if (!label || is_label(*label) || is_listed(scalars, *label)) return;
  if (all_models_built && is_scalar(*label)) {
    // Decks keep such conditions when their model is taken out.
    add_warning(faults, condition.where,
                fmt::format("no model of the deck has the scalar of {} on {}: no effect",
                            in_quotes(*label), face_name(face)),
                suggest_name(*label, scalars));
    return;
  }
  const bool of_models = is_scalar(*label) || *label == "Phi";
  if (of_models) {
    add_not_built(faults, condition.where,
                  fmt::format("boundary variable {} on {}", in_quotes(*label), face_name(face)));
    return;
  }
  add_error(
      faults, condition.where,
      fmt::format("there is no boundary variable {} on {}", in_quotes(*label), face_name(face)),
      suggest_name(*label, labels));
}

void check_kind(const DeckNode& face, const DeckNode& condition, std::vector<Fault>& faults) {
  const std::string label = condition.attribute("label").value_or("");
  const std::string kind = condition.attribute("var").value_or("");
  if (kind == "computeFromDensity" && label != "SpecificVol") {
    add_error(faults, condition.where,
              fmt::format("computeFromDensity on {} is for SpecificVol only, not for {}",
                          face_name(face), label));
  }
  const bool symmetric_label = label == "Symmetric";
  const bool built = kind == "symmetry" || kind == "Dirichlet" || kind == "Neumann";
  if (built && symmetric_label != (kind == "symmetry")) {
    add_error(faults, condition.where,
              fmt::format("label {} with var {} on {}: Symmetric and symmetry belong together",
                          label, kind, face_name(face)));
  }
}

bool must_be_positive(const std::string& label) {
  return label == "Pressure" || label == "Density" || label == "Temperature" ||
         label == "SpecificVol";
}

void check_value(const DeckNode& face, const DeckNode& condition,
                 const std::vector<std::string>& scalars, std::vector<Fault>& faults) {
  const std::string label = condition.attribute("label").value_or("");
  const std::string kind = condition.attribute("var").value_or("");
  if (kind != "Dirichlet" && kind != "Neumann") return;
  if (!is_label(label) && !is_listed(scalars, label)) return;  // its value is not known
  const auto [text, where] = condition_value(condition);
  if (!text || text->empty()) {
    add_error(faults, condition.where,
              fmt::format("{} {} on {} needs a <value>", kind, label, face_name(face)));
    return;
  }
  if (label == "Velocity") {
    const auto vector = parse_vector(*text);
    if (!vector) {
      add_error(faults, where,
                fmt::format("{} {} on {}: {}", kind, label, face_name(face), vector.problem),
                "a velocity is a vector, as [0.0, 0.0, 0.0]");
    }
    return;
  }
  const auto number = parse_real(*text);
  if (!number) {
    add_error(faults, where,
              fmt::format("{} {} on {}: {}", kind, label, face_name(face), number.problem));
  } else if (kind == "Dirichlet" && must_be_positive(label) && *number.value <= 0) {
    add_error(faults, where,
              fmt::format("Dirichlet {} on {} is {}; it must be greater than 0", label,
                          face_name(face), *number.value));
  }
}

void check_material(const DeckNode& face, const DeckNode& condition, int materials,
                    bool has_default, std::vector<Fault>& faults) {
  const auto id = condition.attribute("id");
  const auto ids = condition.attribute("ids");
  if (!id && !ids && !has_default) {
    add_error(faults, condition.where,
              fmt::format("<BCType> on {} has no material", face_name(face)),
              "add id=\"0\" or id=\"all\", or <DefaultMaterial> in <BoundaryConditions>");
  }
  std::vector<int> indices;
  if (id && *id != "all") {
    const auto index = parse_integer(*id);
    if (!index) {
      add_error(faults, condition.where,
                fmt::format("id {} on {} is neither a material index nor 'all'", in_quotes(*id),
                            face_name(face)));
      return;
    }
    indices.push_back(*index.value);
  }
  if (ids) {
    const auto list = parse_integers(*ids);
    if (list) indices.insert(indices.end(), list.value->begin(), list.value->end());
  }
  for (const int index : indices) {
    if (index >= 0 && index < materials) continue;
    add_error(faults, condition.where,
              fmt::format("there is no material {} (on {}): the deck has {}, counted from 0", index,
                          face_name(face), materials));
  }
}

}  // namespace

bool applies_to(const DeckNode& condition, int material) {
  const auto id = condition.attribute("id"), ids = condition.attribute("ids");
  if (condition.attribute("label") == "Pressure" || (!id && !ids) || id == "all") return true;
  std::vector<int> list;
  if (id && parse_integer(*id)) list.push_back(*parse_integer(*id).value);
  if (ids && parse_integers(*ids)) list = *parse_integers(*ids).value;
  return std::find(list.begin(), list.end(), material) != list.end();
}

namespace {

// Names of the variables that these faces leave without condition, "Density (material 1)" where
// it is not so for all.
std::string missing_on(const std::vector<const DeckNode*>& faces, int first, int materials,
                       const std::vector<std::string>& scalars) {
  const auto has = [&](std::string_view label, int material) {
    for (const DeckNode* face : faces)
      for (const DeckNode* condition : face->all("BCType"))
        if (condition->attribute("label") == label && applies_to(*condition, material)) return true;
    return false;
  };
  std::vector<std::string> missing;
  for (const char* label : needed) {
    std::vector<int> without;
    for (int m = first; m < first + std::max(materials, 1); ++m)
      if (!has("Symmetric", m) && !has(label, m)) without.push_back(m);
    if (without.empty()) continue;
    if (static_cast<int>(without.size()) >= materials)
      missing.emplace_back(label);
    else
      missing.push_back(fmt::format("{} (material {})", label, fmt::join(without, ", ")));
  }
  for (const std::string& scalar : scalars) {
    if (scalar == models::cumulative_energy) continue;  // boundary/scalar_ghosts.hpp
    bool found = false;
    for (int m = first; m < first + std::max(materials, 1); ++m)
      found = found || has("Symmetric", m) || has(scalar, m);
    if (!found) missing.push_back(scalar);
  }
  return fmt::format("{}", fmt::join(missing, ", "));
}

}  // namespace

void check_ice_conditions(const DeckNode& root, std::vector<Fault>& faults) {
  const DeckNode* conditions = root.find("Grid/BoundaryConditions");
  if (!runs_ice(root) || conditions == nullptr) return;
  const auto materials = static_cast<int>(ice_materials(root).size());
  const std::vector<std::string> scalars = models::scalar_variables(root);
  const bool has_default = conditions->child("DefaultMaterial") != nullptr;
  for (const DeckNode* face : conditions->all("Face")) {
    for (const DeckNode* condition : face->all("BCType")) {
      check_label(*face, *condition, scalars, models::all_built(root), faults);
      check_kind(*face, *condition, faults);
      check_value(*face, *condition, scalars, faults);
      if (materials > 0)
        check_material(*face, *condition, solid_material_count(root) + materials, has_default,
                       faults);
    }
  }
}

void check_ice_coverage(const DeckNode& root, std::vector<Fault>& faults) {
  const DeckNode* grid = root.child("Grid");
  if (!runs_ice(root) || grid == nullptr) return;
  const DeckNode* conditions = grid->child("BoundaryConditions");
  const auto materials = static_cast<int>(ice_materials(root).size());
  const int first = solid_material_count(root);
  const auto periodic = periodic_directions(*grid);
  const std::vector<std::string> scalars = models::scalar_variables(root);
  for (std::size_t s = 0; s < 6; ++s) {
    if (periodic[s / 2]) continue;
    std::vector<const DeckNode*> whole;
    if (conditions != nullptr) {
      for (const DeckNode* face : conditions->all("Face")) {
        if (face->attribute("side") == side_names[s]) whole.push_back(face);
      }
    }
    if (whole.empty()) {
      add_error(
          faults, (conditions == nullptr ? *grid : *conditions).where,
          fmt::format("side {} has no boundary conditions", side_names[s]),
          fmt::format("add <Face side=\"{}\"> with Pressure, Velocity, Temperature, Density, or "
                      "with Symmetric, or make {} periodic",
                      side_names[s], direction_names[s / 2]));
      continue;
    }
    const std::string missing = missing_on(whole, first, materials, scalars);
    if (!missing.empty()) {
      add_error(faults, whole.front()->where,
                fmt::format("side {} has no condition for {}", side_names[s], missing),
                "every variable needs one, unless the side is Symmetric");
    }
  }
  if (conditions == nullptr) return;
  for (const DeckNode* face : conditions->all("Face")) {
    if (face->attribute("side")) continue;
    const std::string missing = missing_on({face}, first, materials, scalars);
    if (!missing.empty()) {
      add_error(faults, face->where,
                fmt::format("{} has no condition for {}", face_name(*face), missing),
                "every variable needs one, unless the side is Symmetric");
    }
  }
}

}  // namespace sluice
