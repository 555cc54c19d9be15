// The tags of viscosity models, turbulence and wall shear, and their values.
#include "ice/deck/read_transport.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "framework/deck/rule_tools.hpp"
#include "framework/deck/schema.hpp"
#include "framework/scene/deck_values.hpp"
#include "ice/conditions/face_conditions.hpp"
#include "ice/deck/schema.hpp"
#include "ice/deck/scheme.hpp"

namespace sluice::ice {
namespace {

const std::vector<std::string> names_of_sides(std::begin(side_names), std::end(side_names));

TagSpec sponge_box() {
  return tag("box", "axis-parallel box; cells whose centre lies in it belong to the layer")
      .multiple()
      .attribute(attribute("label", "name of the box").text())
      .only_for("name", {"SpongeLayer"})
      .with_children({tag("min", "lower corner").once().vector().unit("length"),
                      tag("max", "upper corner").once().vector().unit("length")});
}

void check_models(const DeckNode& models, std::vector<Fault>& faults) {
  int laws = 0;
  for (const DeckNode* model : models.all("Model")) {
    const std::string name = model->attribute("name").value_or("");
    const auto need = [&](const char* child) {
      if (model->child(child) == nullptr)
        add_error(faults, model->where, fmt::format("<Model name=\"{}\"> needs <{}>", name, child));
    };
    if (name == "Sutherland") {
      need("a");
      need("b");
      if (++laws > 1)
        add_error(faults, model->where, "there is a Model \"Sutherland\" already",
                  "remove one of them");
    } else if (name == "SpongeLayer") {
      need("maxDynamicViscosity");
      need("box");
    }
  }
}

void check_turbulence(const DeckNode& turbulence, std::vector<Fault>& faults) {
  const bool dynamic = turbulence.attribute("model") == "Germano";
  const DeckNode* constant = turbulence.child("model_constant");
  if (!dynamic && constant == nullptr)
    add_error(faults, turbulence.where, "<turbulence model=\"Smagorinsky\"> needs <model_constant>",
              "0.1 in shear flow, 0.17 in isotropic turbulence");
  if (dynamic && constant != nullptr)
    add_warning(faults, constant->where,
                "<model_constant> has no effect: the dynamic model computes it from the flow",
                "remove it");
}

// Slip takes <dynamic_viscosity> for the free path of molecules.
void check_slip(const DeckNode& root, const DeckNode& model, std::vector<Fault>& faults) {
  const DeckNode* conditions = root.find("Grid/BoundaryConditions");
  if (conditions == nullptr) return;
  for (const DeckNode* face : conditions->all("Face"))
    for (const DeckNode* condition : face->all("BCType")) {
      const std::string kind = condition->attribute("var").value_or("");
      const FaceCondition* row = face_condition(kind);
      if (row == nullptr || !row->rarefied) continue;
      add_error(faults, condition->where,
                fmt::format("{} needs a constant <dynamic_viscosity>; this deck has <{}>", kind,
                            model.name),
                fmt::format("remove <{}>", model.name));
    }
}

// The analysis that saves what a turbulence model takes for subgrid motion.
void check_subgrid_analysis(const DeckNode& root, std::vector<Fault>& faults) {
  const DeckNode* analysis = root.child("DataAnalysis");
  if (analysis == nullptr || root.find("CFD/ICE/turbulence") != nullptr) return;
  for (const DeckNode* module : analysis->all("Module"))
    if (module->attribute("name") == "SGS_ReynoldsStress")
      add_error(faults, module->where,
                "<Module name=\"SGS_ReynoldsStress\"> needs a turbulence model",
                "write <turbulence> in <CFD><ICE>, or remove the module");
}

}  // namespace

TagSpec viscosity_models_tag() {
  return tag("dynamicViscosityModels", "variable viscosity; absent: <dynamic_viscosity>")
      .child(
          tag("Model", "a law that replaces <dynamic_viscosity>, or a sponge layer")
              .at_least_once()
              .attribute(attribute("name", "which one").once().words({"Sutherland", "SpongeLayer"}))
              .with_children({tag("a", "constant a of mu = a sqrt(T)/(1 + b/T), kg/(m s K^1/2)")
                                  .real()
                                  .above(0)
                                  .only_for("name", {"Sutherland"}),
                              tag("b", "constant b of the law")
                                  .real()
                                  .at_least(0)
                                  .unit("temperature")
                                  .only_for("name", {"Sutherland"}),
                              tag("maxDynamicViscosity", "the minimum viscosity in the layer")
                                  .real()
                                  .at_least(0)
                                  .unit("pressure time")
                                  .only_for("name", {"SpongeLayer"}),
                              sponge_box()}));
}

std::vector<TagSpec> transport_tags() {
  return {
      tag("turbulence", "subgrid viscosity rho C Delta^2 |S|, |S| = sqrt(2 S:S)")
          .attribute(attribute("model", "Smagorinsky: C = model_constant^2; Germano: from the flow")
                         .once()
                         .words({"Smagorinsky", "Germano"})
                         .spelling("DynamicSmagorinsky", "Germano"))
          .with_children(
              {tag("model_constant", "C_s of Smagorinsky").real().at_least(0),
               tag("filter_width",
                   "Delta in units of the cell, the geometric mean of its active spacings")
                   .real()
                   .above(0)
                   .by_default("1"),
               tag("test_filter_width", "width of Germano's test filter in units of Delta")
                   .real()
                   .above(1)
                   .by_default("2")
                   .only_for("model", {"Germano"}),
               tag("turb_Pr", "Prandtl number of the subgrid heat flux: k_t = cp mu_t/turb_Pr")
                   .real()
                   .above(0)
                   .by_default("0.9")}),
      tag("wallShearStress", "friction at a side from the velocity of the adjacent cell")
          .multiple()
          .attribute(attribute("model", "logLawModel: rough wall; smoothWall")
                         .once()
                         .words({"logLawModel", "smoothWall"})
                         .spelling("smoothwall", "smoothWall"))
          .with_children({tag("domainFace", "the side").once().text(),
                          tag("roughnessConstant", "roughness z0 of the wall")
                              .real()
                              .above(0)
                              .unit("length")
                              .only_for("model", {"logLawModel"}),
                          tag("vonKarmanConstant", "kappa of the logarithmic law")
                              .real()
                              .above(0)
                              .by_default("0.4")})};
}

ViscosityModels read_viscosity_models(const DeckNode& material) {
  ViscosityModels models;
  const DeckNode* node = material.child("dynamicViscosityModels");
  if (node == nullptr) return models;
  models.where = node->where;
  for (const DeckNode* model : node->all("Model")) {
    if (model->attribute("name") == "Sutherland") {
      models.sutherland = Sutherland{real_or(*model, "a", 0), real_or(*model, "b", 0)};
      continue;
    }
    SpongeLayer layer;
    layer.viscosity = real_or(*model, "maxDynamicViscosity", 0);
    for (const DeckNode* box : model->all("box"))
      layer.boxes.push_back({vector_or(*box, "min", {}), vector_or(*box, "max", {})});
    models.sponges.push_back(layer);
  }
  return models;
}

std::optional<Turbulence> read_turbulence(const DeckNode& ice) {
  const DeckNode* node = ice.child("turbulence");
  if (node == nullptr) return std::nullopt;
  Turbulence t;
  t.where = node->where;
  t.dynamic = node->attribute("model") == "Germano";
  t.constant = real_or(*node, "model_constant", 0);
  t.filter_width = real_or(*node, "filter_width", t.filter_width);
  t.test_filter_width = real_or(*node, "test_filter_width", t.test_filter_width);
  t.prandtl = real_or(*node, "turb_Pr", t.prandtl);
  return t;
}

std::vector<WallShear> read_wall_shear(const DeckNode& ice, const Scene& scene,
                                       std::vector<Fault>& faults) {
  std::vector<WallShear> walls;
  for (const DeckNode* node : ice.all("wallShearStress")) {
    WallShear w;
    w.where = node->where;
    w.smooth = node->attribute("model") == "smoothWall";
    w.roughness = real_or(*node, "roughnessConstant", 0);
    w.von_karman = real_or(*node, "vonKarmanConstant", w.von_karman);
    const std::string face = text_or(*node, "domainFace", "");
    const auto found = std::find(names_of_sides.begin(), names_of_sides.end(), face);
    if (found == names_of_sides.end()) continue;  // told by the rules
    w.side = all_sides[found - names_of_sides.begin()];
    const int d = direction_of(w.side);
    const auto& regions = scene.boundary.side(w.side).regions;
    const bool wall = std::any_of(regions.begin(), regions.end(), [&](const BoundaryRegion& r) {
      const Condition* u = r.find("Velocity", 0);
      return u != nullptr && u->kind == ConditionKind::dirichlet && u->vector[d] == 0;
    });
    if (!wall)
      add_error(faults, node->where,
                fmt::format("<wallShearStress> on side {}, which is not a wall", face),
                "give the side a Dirichlet velocity without a component across it");
    for (const Level& level : scene.grid.levels)
      if (!w.smooth && 0.5 * level.spacing[d] <= w.roughness)
        add_error(
            faults, node->where,
            fmt::format("<roughnessConstant> {:g} is not below half the spacing {:g} of level {}: "
                        "the centre of the cell at the wall is within the roughness",
                        w.roughness, level.spacing[d], level.index),
            "make it smaller, or the cells larger");
    walls.push_back(w);
  }
  return walls;
}

void check_transport(const DeckNode& root, std::vector<Fault>& faults) {
  if (!runs_ice(root)) return;
  check_subgrid_analysis(root, faults);
  const auto materials = ice_materials(root);
  const DeckNode* ice = root.find("CFD/ICE");
  const SchemeRow& scheme = scheme_of(root);
  const auto check = [&](const DeckNode& node, const std::string& what) {
    check_slip(root, node, faults);
    if (!scheme.transport_models)
      add_error(faults, node.where, fmt::format("<scheme> {} has no {}", scheme.word, what),
                "remove <scheme>");
  };
  for (const DeckNode* material : materials)
    if (const DeckNode* models = material->child("dynamicViscosityModels")) {
      check(*models, "<dynamicViscosityModels>");
      check_models(*models, faults);
    }
  if (ice == nullptr) return;
  if (const DeckNode* turbulence = ice->child("turbulence")) {
    check(*turbulence, "<turbulence>");
    check_turbulence(*turbulence, faults);
  }
  for (const DeckNode* wall : ice->all("wallShearStress")) {
    check(*wall, "<wallShearStress>");
    const DeckNode* face = wall->child("domainFace");
    if (face != nullptr &&
        std::find(names_of_sides.begin(), names_of_sides.end(), face->text) == names_of_sides.end())
      add_error(faults, face->where,
                fmt::format("<domainFace>: there is no side {}", in_quotes(face->text)),
                "allowed are x-, x+, y-, y+, z- and z+");
    if (wall->attribute("model") == "logLawModel" && wall->child("roughnessConstant") == nullptr)
      add_error(faults, wall->where,
                "<wallShearStress model=\"logLawModel\"> needs <roughnessConstant>");
  }
}

}  // namespace sluice::ice
