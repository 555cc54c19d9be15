// Model "TracerParticles": how a deck says it.
#include "models/scalars/tracer_particles.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "framework/deck/format/framework_schema.hpp"
#include "framework/deck/rule_tools.hpp"
#include "framework/deck/schema.hpp"
#include "framework/scene/deck_values.hpp"
#include "models/deck/material_name.hpp"
#include "models/scalars/exponential_decay.hpp"

namespace sluice::models {
namespace {

constexpr double max_in_a_cell = 1e6;      // at the start
constexpr std::string_view prefix = "p.";  // of the names of particle variables

TagSpec region(const char* text, const TagSpec& number) {
  return tag("geom_object", text).at_least_once().group("geometry_piece").child(number.once());
}

void check_region(const DeckNode& object, std::vector<Fault>& faults) {
  if (std::none_of(object.children.begin(), object.children.end(),
                   [](const auto& child) { return is_geometry_piece(child->name); }))
    add_error(faults, object.where, "<geom_object> has no geometry piece",
              "add a <box>, <sphere>, ...; see sluice help geom_object");
}

void check_regions(const DeckNode* regions, std::vector<Fault>& faults) {
  if (regions == nullptr) return;
  for (const DeckNode* object : regions->all("geom_object")) check_region(*object, faults);
}

std::vector<TracerRegion> read_regions(const DeckNode* regions, const char* number,
                                       const GeometryReader& geometry, std::vector<Fault>& faults) {
  std::vector<TracerRegion> list;
  if (regions == nullptr) return list;
  for (const DeckNode* object : regions->all("geom_object"))
    list.push_back({geometry.object(*object, faults).piece, object->real(number)});
  return list;
}

void refuse_if_true(const DeckNode& parameters, const char* child, std::vector<Fault>& faults) {
  if (!is_true(&parameters, child)) return;
  add_not_built(faults, parameters.child(child)->where, fmt::format("<{}> true", child),
                "start a new run");
}

}  // namespace

TagSpec tracer_particles_tag() {
  const TagSpec tracer =
      tag("tracer", "regions of particles and of sources")
          .once()
          .attribute(attribute("name", "name of these particles in the run report").once().text())
          .with_children(
              {tag("initialization", "particles at the start")
                   .once()
                   .child(region("a region that holds particles at the start",
                                 tag("particlesPerCell", "how many per cell of the region")
                                     .real()
                                     .at_least(0)
                                     .at_most(max_in_a_cell))),
               tag("interiorSources", "regions in which particles appear")
                   .child(region("a region in which particles appear",
                                 tag("particlesPerCellPerSecond", "how many per cell and second")
                                     .real()
                                     .at_least(0)
                                     .unit("1/time")))});
  return tag("TracerParticles", "points that move with a material without acting on it")
      .with_children(
          {tag("material", "name of the material; absent: the only one").text(),
           tag("timeStart", "sources begin").real().at_least(0).by_default("0").unit("time"),
           tag("timeStop", "sources end; absent: never").real().at_least(0).unit("time"),
           tag("modelPreviouslyInitialized", "false, or absent").boolean(),
           tag("reinitializeDomain", "reset at a restart").boolean(),
           tag("refine_distance",
               "cells closer than this to a particle are flagged for refinement; absent: no cells")
               .real()
               .at_least(0)
               .unit("length"),
           tag("cloneVariables", "scalars of which particles have copies, called p.clone-NAME")
               .child(tag("CCVarLabel", "a scalar of the deck's models, of the particle's cell")
                          .multiple()
                          .attribute(attribute("label", "name of the scalar").once().text())),
           tag("scalar", "a variable of each particle")
               .attribute(attribute("name", "name of the variable, begins with p.").once().text())
               .with_children(
                   {tag("initialValue", "initial value when the particle appears").once().real(),
                    exponential_decay_tag()}),
           tracer});
}

void check_tracer_particles(const DeckNode& parameters, const std::vector<std::string>& materials,
                            std::vector<Fault>& faults) {
  check_material(parameters, "material", materials, faults);
  if (parameters.child("material") == nullptr && materials.size() > 1)
    add_error(faults, parameters.where, "<TracerParticles> needs <material>: there are several");
  refuse_if_true(parameters, "modelPreviouslyInitialized", faults);
  refuse_if_true(parameters, "reinitializeDomain", faults);
  if (const DeckNode* scalar = parameters.child("scalar")) {
    const std::string name = scalar->attribute("name").value_or("p.");
    const auto& taken = particle_variables();
    if (!name.starts_with(prefix))
      add_error(faults, scalar->where,
                fmt::format("<scalar name=\"{}\">: variables of particles begin with p.", name),
                fmt::format("write p.{}", name));
    else if (std::find(taken.begin(), taken.end(), name) != taken.end())
      add_error(faults, scalar->where,
                fmt::format("<scalar name=\"{}\">: every particle has this variable already", name),
                "choose another name");
  }
  const DeckNode* tracer = parameters.child("tracer");
  if (tracer == nullptr) return;
  check_regions(tracer->child("initialization"), faults);
  check_regions(tracer->child("interiorSources"), faults);
}

TracerParticles read_tracer_particles(const DeckNode& parameters,
                                      const std::vector<std::string>& materials,
                                      const GeometryReader& geometry, std::vector<Fault>& faults) {
  TracerParticles t;
  const DeckNode& tracer = *parameters.child("tracer");
  t.where = parameters.where;
  t.name = tracer.attribute("name").value_or("");
  t.material = read_material(parameters, "material", materials);
  t.window.start = real_or(parameters, "timeStart", 0);
  t.window.stop = real_or(parameters, "timeStop", t.window.stop);
  t.refine_distance = real_or(parameters, "refine_distance", t.refine_distance);
  if (const DeckNode* scalar = parameters.child("scalar"))
    t.scalar = TracerScalar{scalar->attribute("name").value_or(""), scalar->real("initialValue"),
                            read_decay(*scalar)};
  if (const DeckNode* clones = parameters.child("cloneVariables"))
    for (const DeckNode* clone : clones->all("CCVarLabel"))
      t.clones.push_back(clone->attribute("label").value_or(""));
  t.start = read_regions(tracer.child("initialization"), "particlesPerCell", geometry, faults);
  t.sources =
      read_regions(tracer.child("interiorSources"), "particlesPerCellPerSecond", geometry, faults);
  return t;
}

Label TracerScalar::label() const {
  return declare_label(
      {name, ValueType::real, Centring::particle, "1", "Variable of tracer particles."});
}

Label TracerScalar::coefficient() const {
  return declare_label({name + "_expDecayCoef", ValueType::real, Centring::particle, "1",
                        "Coefficient c2 of the decay of " + name + ", where the particle is."});
}

Label TracerScalar::total() const {
  return declare_label({name + "_totalDecay", ValueType::real, Centring::particle, "1",
                        "(c1 c2 + c3) dt summed since the particle appeared."});
}

Label clone_label(const std::string& variable) {
  return declare_label({"p.clone-" + variable, ValueType::real, Centring::particle, "1",
                        "The value of " + variable + " in the particle's cell."});
}

const std::vector<std::string>& particle_variables() {
  static const std::vector<std::string> names = {"p.x", "p.particleID"};
  return names;
}

std::vector<std::string> tracer_labels(const DeckNode& parameters) {
  const DeckNode* scalar = parameters.child("scalar");
  std::vector<std::string> labels = particle_variables();
  if (scalar != nullptr) {
    const std::string name = scalar->attribute("name").value_or("");
    labels.push_back(name);
    if (scalar->child("exponentialDecay") != nullptr)
      labels.insert(labels.end(), {name + "_expDecayCoef", name + "_totalDecay"});
  }
  if (const DeckNode* clones = parameters.child("cloneVariables"))
    for (const DeckNode* clone : clones->all("CCVarLabel"))
      labels.push_back("p.clone-" + clone->attribute("label").value_or(""));
  return labels;
}

void rename_clones(DeckNode& root, std::vector<Fault>& faults) {
  DeckNode* archiver = root.child("DataArchiver");
  const DeckNode* models = root.child("Models");
  if (archiver == nullptr || models == nullptr) return;
  std::vector<std::string> known;
  for (const DeckNode* model : models->all("Model"))
    if (const DeckNode* tracers = model->child("TracerParticles"))
      for (std::string& label : tracer_labels(*tracers)) known.push_back(std::move(label));
  const auto is_known = [&](const std::string& label) {
    return std::find(known.begin(), known.end(), label) != known.end();
  };
  for (const auto& save : archiver->children)
    for (auto& [name, value] : save->attributes) {
      if (save->name != "save" || name != "label" || !value.starts_with(prefix) || is_known(value))
        continue;
      const std::string now = "p.clone-" + value.substr(prefix.size());
      if (!is_known(now)) continue;
      add_warning(faults, save->where, fmt::format("variable {} is now {}", value, now),
                  fmt::format("write {}", now));
      value = now;
    }
}

}  // namespace sluice::models
