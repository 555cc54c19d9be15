// The tags of ICE.
#include "ice/deck/schema.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "framework/deck/faults.hpp"
#include "framework/deck/schema.hpp"
#include "framework/field/label.hpp"
#include "ice/conditions/face_conditions.hpp"
#include "ice/deck/body_sources.hpp"
#include "ice/deck/custom_start.hpp"
#include "ice/deck/exchange_settings.hpp"
#include "ice/deck/fluid_laws.hpp"
#include "ice/deck/implicit_settings.hpp"
#include "ice/deck/read_fluid.hpp"
#include "ice/deck/read_transport.hpp"
#include "ice/deck/scheme.hpp"
#include "ice/deck/third_order.hpp"
#include "ice/fluid/labels.hpp"
#include "models/gases/adiabatic_table.hpp"
#include "models/gases/gas_combustion.hpp"
#include "models/models.hpp"

namespace sluice {
namespace {

TagSpec advection() {
  return tag("advection", "order of the scheme in space and time")
      .once()
      .with_attributes(
          {attribute("type",
                     "the order; ThirdOrder (also PPM): parabolas with characteristic tracing, for "
                     "one material and explicit steps of the conservative scheme")
               .once()
               .words({"FirstOrder", "SecondOrder", "ThirdOrder", "PPM"})
               .not_built({"FirstOrderGPU"}),
           attribute("useCompatibleFluxes", "classic scheme: fluxes of q/m weighted with mass")
               .boolean()
               .alias("compatibleFluxes")
               .by_default("true"),
           attribute("shearAlongShocks",
                     "faces whose normals lie in the plane of a strong shock exchange tangential "
                     "momentum, so that the shock stays straight; not in the classic form or with "
                     "<ImplicitSolver>")
               .boolean()
               .by_default("true")});
}

TagSpec time_step_control() {
  return tag("TimeStepControl", "the deck's own rule for the time step")
      .fill()
      .with_children({tag("Scheme_for_delT_calc", "which rule")
                          .words({"aggressive", "conservative"})
                          .by_default("aggressive"),
                      tag("knob_for_speedSound", "factor of the sound speed in the rule")
                          .real()
                          .at_least(0)
                          .at_most(1)
                          .by_default("1"),
                      tag("knob_for_diffusion", "factor of diffusion in the rule")
                          .real()
                          .at_least(0)
                          .at_most(1)
                          .by_default("1")});
}

TagSpec formula_of(const std::string& name, const std::string& unit) {
  return tag(name, "formula of x, y, z; absent: the value of the geometry objects")
      .text()
      .unit(unit);
}

TagSpec custom_initialization() {
  return tag("customInitialization",
             "initial state that geometry objects cannot describe; if there are several, the last "
             "is applied first, and a formula after all others")
      .with_children(ice::custom_start_tags())
      .child(
          tag("formula", "initial state as formulas of x, y, z")
              .attribute(
                  attribute("over",
                            "centre: values at the centre of each cell; cell: what the cell holds, "
                            "from the means of density, momentum and energy over it (Gauss's rule "
                            "with 4 points along each direction)")
                      .words({"centre", "cell"})
                      .by_default("centre"))
              .with_children(
                  {formula_of("density", "density"), formula_of("velocity_x", "velocity"),
                   formula_of("velocity_y", "velocity"), formula_of("velocity_z", "velocity"),
                   formula_of("pressure", "pressure"), formula_of("temperature", "temperature")}));
}

TagSpec ice_block() {
  return tag("ICE", "the multi-material finite-volume method")
      .with_children(
          {tag("scheme",
               "conservative: total energy conserved, second order in space "
               "and time; classic: internal energy, one stage")
               .words(ice::scheme_words())
               .by_default("conservative"),
           advection(), time_step_control(), custom_initialization(), ice::implicit_solver_tag(),
           tag("max_iteration_equilibration",
               "accepted without effect: the search for the common pressure always ends")
               .integer()
               .at_least(1),
           tag("ClampSpecificVolume", "accepted without effect: there are no clamps")
               .boolean()
               .by_default("false"),
           tag("applyHydrostaticPressure", "with gravity: the initial pressure is hydrostatic")
               .boolean()
               .by_default("true")})
      .with_children(ice::transport_tags())
      .with_children(ice::body_source_tags());
}

TagSpec fluid_dynamics() {
  return tag("CFD", "the fluid")
      .with_children(
          {tag("cfl",
               "Courant number: fraction of the stable time step; absent: 0.8 in explicit steps of "
               "one inviscid fluid in one row of cells on one level without models, 0.4 otherwise")
               .real()
               .above(0)
               .at_most(1),
           ice_block()});
}

TagSpec geom_object() {
  return tag("geom_object",
             "a region and the state in it; later objects overwrite earlier ones of the same "
             "material")
      .at_least_once()
      .attribute(attribute("name", "name of the object").text())
      .group("geometry_piece")
      .with_children(
          {tag("res", "sample points per cell and direction")
               .int_vector()
               .at_least(1)
               .by_default("[2,2,2]"),
           tag("velocity", "velocity").once().vector().unit("velocity"),
           tag("temperature", "temperature").once().real().above(0).unit("temperature"),
           tag("density", "density of the material itself").once().real().above(0).unit("density"),
           tag("volumeFraction", "volume fraction of this material in the object; absent: 1")
               .real()
               .at_least(0)
               .at_most(1),
           tag("pressure", "read but not used: the pressure follows from density and temperature")
               .real()
               .unit("pressure")});
}

TagSpec material() {
  return tag("material", "a material of ICE")
      .at_least_once()
      .with_attributes(
          {attribute("name", "name of the material").text(),
           attribute("index", "accepted without effect: the index follows from the order")
               .integer()
               .at_least(0)})
      .with_children(
          {ice::equation_of_state_tag(), ice::specific_heat_tag(),
           tag("gamma",
               fmt::format("ratio of specific heats; above 1 for {}, without effect for the others",
                           ice::laws_with_gamma()))
               .once()
               .real()
               .above(0),
           tag("specific_heat", "at constant volume; replaced by <SpecificHeatModel>")
               .once()
               .real()
               .above(0)
               .unit("energy/(mass temperature)"),
           tag("dynamic_viscosity", "dynamic viscosity")
               .once()
               .real()
               .at_least(0)
               .unit("pressure time"),
           ice::viscosity_models_tag(),
           tag("thermal_conductivity", "thermal conductivity").once().real().at_least(0),
           tag("tiny_rho", "accepted without effect: no mass is added")
               .real()
               .above(0)
               .unit("density"),
           tag("isSurroundingMatl",
               "surrounding material: at heights where it is present, the cell in which it has the "
               "largest fraction determines the hydrostatic pressure; with one material this may "
               "be omitted")
               .boolean()
               .by_default("false"),
           tag("includeFlowWork",
               "accepted without effect: the work of the pressure always changes the energy")
               .boolean()
               .by_default("true"),
           geom_object()});
}

TagSpec refinement() {
  return tag("ICE", "refinement of ICE")
      .with_children(
          {tag("orderOfInterpolation", "order of interpolation onto finer levels")
               .once()
               .integer()
               .at_least(0)
               .at_most(2),
           tag("orderOf_CFI_Interpolation", "order at the faces between levels; absent: the same")
               .integer()
               .at_least(0)
               .at_most(2),
           tag("do_Refluxing", "fluxes are matched between levels").boolean().by_default("true"),
           tag("ClampSpecificVolume", "accepted without effect: there are no clamps").boolean(),
           tag("Refinement_Criteria_Thresholds", "gradient criteria")
               .child(tag("Variable", "one criterion")
                          .multiple()
                          .with_attributes(
                              {attribute("name", "a cell variable of the state that can be saved")
                                   .once()
                                   .text(),
                               attribute("value", "cells with a larger gradient are flagged")
                                   .once()
                                   .real()
                                   .at_least(0),
                               attribute("matl", "material index or all").once().text()}))});
}

}  // namespace

bool runs_ice(const DeckNode& root) {
  const DeckNode* component = root.child("SimulationComponent");
  if (component == nullptr) return false;
  const std::string type = component->attribute("type").value_or("");
  return type == "ice" || type == "mpmice" || type == "rmpmice" || type == "rigidmpmice";
}

std::vector<std::string> names_of_solids(const DeckNode& root) {
  const DeckNode* component = root.child("SimulationComponent");
  std::vector<std::string> names;
  if (component == nullptr || component->attribute("type") == "ice") return names;
  for (const DeckNode* properties : root.all("MaterialProperties"))
    if (const DeckNode* solids = properties->child("MPM"))
      for (const DeckNode* material : solids->all("material"))
        names.push_back(material->attribute("name").value_or(""));
  return names;
}

int solid_material_count(const DeckNode& root) {
  return static_cast<int>(names_of_solids(root).size());
}

std::vector<const DeckNode*> ice_materials(const DeckNode& root) {
  std::vector<const DeckNode*> materials;
  for (const DeckNode* properties : root.all("MaterialProperties")) {
    const DeckNode* ice = properties->child("ICE");
    if (ice == nullptr) continue;
    for (const DeckNode* node : ice->all("material")) materials.push_back(node);
  }
  return materials;
}

// What ICE declares (ice/fluid/labels.cpp) is built; names with a point are the state's own.
FieldLabels ice_field_labels() {
  FieldLabels fields;
  for (const Label label : ice::own_labels())
    if (label.name().find('.') == std::string::npos) fields.built.push_back(label.name());
  fields.not_built = {
      "matrix",          "max_RHS",      "TMV_CC",           "delT", "cumulativeEnergyReleased",
      "HeatReleaseRate", "dt_chemistry", "totalMassExchange"};
  return fields;
}

// What is zero by construction, of the fields that hold errors of the format's own scheme; else
// empty.
std::string why_zero(const std::string& label) {
  if (label.ends_with("_FC_flux") || label.ends_with("_FC_corr"))
    return "flux registers match the fluxes between levels";
  if (label == "mom_exch_error" || label == "eng_exch_error")
    return "momentum and energy are exchanged in equal amounts";
  return "";
}

void drop_labels_of_errors(DeckNode& root, std::vector<Fault>& faults) {
  DeckNode* archiver = root.child("DataArchiver");
  if (archiver == nullptr || !runs_ice(root)) return;
  std::erase_if(archiver->children, [&](const std::unique_ptr<DeckNode>& save) {
    const std::string label = save->attribute("label").value_or("");
    const std::string why = save->name == "save" ? why_zero(label) : "";
    if (why.empty()) return false;
    add_warning(faults, save->where,
                fmt::format("variable '{}' is not a field: {}; dropped", label, why),
                "remove the line");
    return true;
  });
}

// Models bring variables of their own.
void check_ice_labels(const DeckNode& root, std::vector<Fault>& faults) {
  // With solids the run knows their labels too, and checks all of them.
  if (!runs_ice(root) || solid_material_count(root) > 0 || !models::all_built(root)) return;
  FieldLabels fields = ice_field_labels();
  for (std::string& label : models::save_labels(root)) fields.built.push_back(std::move(label));
  check_analysed_labels(std::move(fields))(root, faults);
}

namespace {

// The kinds of conditions that fluids have in addition to those of the framework.
void add_kinds(AttributeSpec& kind) {
  std::vector<std::string> words;
  for (const ice::FaceCondition& c : ice::face_conditions()) {
    const auto& known = kind.value.words;
    if (std::find(known.begin(), known.end(), c.word) == known.end()) words.emplace_back(c.word);
  }
  kind = kind.more_words(words);
}

// These kinds, then the blocks that they need: a block that is added moves its neighbours.
void add_face_conditions(Schema& schema) {
  add_kinds(*schema.at("Grid/BoundaryConditions/Face/BCType")->attribute_of("var"));
  TagSpec& conditions = *schema.at("Grid/BoundaryConditions");
  for (const ice::FaceCondition& c : ice::face_conditions())
    if (c.block && schema.child(conditions, c.block->name) == nullptr)
      conditions.children.push_back(*c.block);
}

}  // namespace

void add_ice_tags(Schema& schema) {
  add_face_conditions(schema);
  schema.add(fluid_dynamics());
  schema.add(tag("AMR", "").child(refinement()));
  schema.add(
      tag("MaterialProperties", "the materials and their interaction")
          .multiple()
          .attribute(attribute("add", "accepted without effect").boolean())
          .with_children({tag("ICE", "materials of ICE").child(material()), ice::exchange_tag()}));
  schema.add(models::models_tag());
  schema.rewrites.emplace_back(drop_foreign_eos_tags);
  schema.rewrites.emplace_back(models::move_parameters);
  schema.rewrites.emplace_back(models::rename_scalar_totals);
  schema.rewrites.emplace_back(models::rename_clones);
  schema.rewrites.emplace_back(drop_labels_of_errors);
  schema.rules.emplace_back(check_ice_blocks);
  schema.rules.emplace_back(check_ice_materials);
  schema.rules.emplace_back(check_ice_fluids);
  schema.rules.emplace_back(ice::check_ice_exchange);
  schema.rules.emplace_back(ice::check_transport);
  schema.rules.emplace_back(ice::check_implicit);
  schema.rules.emplace_back(ice::check_third_order);
  schema.rules.emplace_back(check_ice_fill);
  schema.rules.emplace_back(check_ice_conditions);
  schema.rules.emplace_back(check_ice_coverage);
  schema.rules.emplace_back(check_ice_states);
  schema.rules.emplace_back(check_face_conditions);
  schema.rules.emplace_back(check_slip_conditions);
  schema.rules.emplace_back(check_criteria);
  schema.rules.emplace_back(check_ice_models);
  schema.rules.emplace_back(ice::check_body_sources);
  schema.rules.emplace_back(check_ice_labels);
}

}  // namespace sluice
