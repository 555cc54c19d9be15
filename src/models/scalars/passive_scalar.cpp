// Model "PassiveScalar": how a deck says it.
#include "models/scalars/passive_scalar.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "framework/deck/format/framework_schema.hpp"
#include "framework/deck/rule_tools.hpp"
#include "framework/deck/schema.hpp"
#include "framework/scene/deck_values.hpp"
#include "models/deck/material_name.hpp"
#include "models/scalars/exponential_decay.hpp"

namespace sluice::models {
namespace {

struct ProfileTag {
  const char* name;
  ScalarProfile profile;
  const char* weight;  // tag of its weights by direction
  const char* doc;
};

// x: position in the bounding box of the region, 0 to 1 along each direction.
constexpr std::array profiles = {
    ProfileTag{"linearInitialize", ScalarProfile::linear, "slope", "sum of slope x"},
    ProfileTag{"sinusoidalInitialize", ScalarProfile::sinusoidal, "freq",
               "sum of sin(2 pi freq x)"},
    ProfileTag{"triangularInitialize", ScalarProfile::triangular, "coeff",
               "sum of coeff min(x, 1 - x)"},
    ProfileTag{"quadraticInitialize", ScalarProfile::quadratic, "coeff", "sum of coeff x (x - 1)"},
    ProfileTag{"cubicInitialize", ScalarProfile::cubic, "coeff",
               "sum of coeff y^2 (1 - 4 y/3), y = min(x, 1 - x)"},
    ProfileTag{"exponentialInitialize_1D", ScalarProfile::exponential_1d, "coeff",
               "sum of coeff exp(-1/(x (1 - x)))"},
    ProfileTag{"exponentialInitialize_2D", ScalarProfile::exponential_2d, "coeff",
               "product over x and y of coeff exp(-1/(x (1 - x)))"}};

TagSpec constants() {
  return tag("constants", "constants of the scalar")
      .with_children(
          {tag("diffusivity", "coefficient D of the flux rho D grad q")
               .real()
               .at_least(0)
               .by_default("0")
               .unit("length^2/time"),
           tag("AMR_Refinement_Criteria", "cells with a larger gradient of the scalar are flagged")
               .real()
               .at_least(0)
               .unit("1/length"),
           tag("rateOfChange0", "constant growth").real().by_default("0").unit("1/time"),
           tag("rateOfChange1", "growth in proportion to the scalar")
               .real()
               .by_default("0")
               .unit("1/time")});
}

}  // namespace

TagSpec scalar_region_tag() {
  TagSpec region =
      tag("geom_object", "a region and the scalar in it; later ones overwrite earlier ones")
          .at_least_once()
          .attribute(attribute("name", "name of the region").text())
          .group("geometry_piece")
          .with_children({tag("scalar", "the scalar in it, if no profile is chosen").once().real(),
                          tag("slope", "slope of the linear profile").vector(),
                          tag("freq", "periods of the sinusoidal profile").vector(),
                          tag("coeff", "coefficients of the other profiles").vector()});
  for (const ProfileTag& p : profiles)
    region = region.child(
        tag(p.name, std::string("profile ") + p.doc + ", x from 0 to 1 across the region")
            .boolean()
            .by_default("false"));
  return region;
}

TagSpec passive_scalar_tag() {
  const TagSpec source =
      tag("geom_object", "a region in which the scalar grows")
          .at_least_once()
          .group("geometry_piece")
          .with_children({tag("scalar", "growth if rateOfChange is absent").real().unit("1/time"),
                          tag("rateOfChange", "growth").real().unit("1/time"),
                          tag("maxScalar", "growth stops at this value").real()});
  return tag("PassiveScalar", "a scalar that is advected with the mass of a material")
      .with_children(
          {tag("material", "name of the material; absent: the only one").text(),
           tag("scalar", "the scalar")
               .once()
               .attribute(attribute("name", "name of the scalar; variables are called scalar-NAME")
                              .once()
                              .text())
               .with_children({tag("test_conservation",
                                   "the total of the scalar is written as totalSum_scalar-NAME")
                                   .boolean()
                                   .by_default("false"),
                               tag("reinitializeDomain", "reset at a restart").boolean(),
                               constants(), exponential_decay_tag(),
                               tag("initialization", "the scalar at the start; nothing: 0")
                                   .once()
                                   .child(scalar_region_tag()),
                               tag("interiorSources", "regions with sources").child(source)})});
}

namespace {

bool has_piece(const DeckNode& object) {
  return std::any_of(object.children.begin(), object.children.end(),
                     [](const auto& child) { return is_geometry_piece(child->name); });
}

}  // namespace

void check_scalar_region(const DeckNode& object, std::vector<Fault>& faults) {
  if (!has_piece(object))
    add_error(faults, object.where, "<geom_object> has no geometry piece",
              "add a <box>, <sphere>, ...; see sluice help geom_object");
  const ProfileTag* chosen = nullptr;
  for (const ProfileTag& p : profiles) {
    if (!is_true(&object, p.name)) continue;
    const DeckNode& here = *object.child(p.name);
    if (chosen != nullptr)
      add_error(faults, here.where,
                fmt::format("<{}> and <{}> are both true; a region has one profile", chosen->name,
                            p.name),
                "write false for the others");
    if (object.child(p.weight) == nullptr)
      add_error(faults, here.where,
                fmt::format("<{}> needs <{}>, a vector as [1, 0, 0]", p.name, p.weight));
    chosen = &p;
  }
}

namespace {

void check_source(const DeckNode& object, std::vector<Fault>& faults) {
  if (!has_piece(object))
    add_error(faults, object.where, "<geom_object> has no geometry piece",
              "add a <box>, <sphere>, ...; see sluice help geom_object");
  if (object.child("scalar") == nullptr && object.child("rateOfChange") == nullptr)
    add_error(faults, object.where, "<geom_object> of <interiorSources> needs <rateOfChange>",
              "growth of the scalar per unit of time");
}

ScalarRegion read_region(const DeckNode& object, const GeometryReader& geometry,
                         std::vector<Fault>& faults) {
  ScalarRegion r;
  r.piece = geometry.object(object, faults).piece;
  r.value = object.real("scalar");
  for (const ProfileTag& p : profiles)
    if (is_true(&object, p.name)) {
      r.profile = p.profile;
      r.weight = vector_or(object, p.weight, {});
    }
  return r;
}

// The material that is named, or the only one.
const DeckNode* unnamed_material(const DeckNode& parameters, std::size_t materials) {
  return parameters.child("material") == nullptr && materials > 1 ? &parameters : nullptr;
}

}  // namespace

std::vector<ScalarRegion> read_scalar_regions(const DeckNode& parent,
                                              const GeometryReader& geometry,
                                              std::vector<Fault>& faults) {
  std::vector<ScalarRegion> regions;
  for (const DeckNode* object : parent.all("geom_object"))
    regions.push_back(read_region(*object, geometry, faults));
  return regions;
}

void check_passive_scalar(const DeckNode& parameters, const std::vector<std::string>& materials,
                          std::vector<Fault>& faults) {
  check_material(parameters, "material", materials, faults);
  if (unnamed_material(parameters, materials.size()) != nullptr)
    add_error(faults, parameters.where,
              fmt::format("<{}> needs <material>: there are several", parameters.name));
  const DeckNode* scalar = parameters.child("scalar");
  if (scalar == nullptr) return;
  if (is_true(scalar, "reinitializeDomain"))
    add_not_built(faults, scalar->child("reinitializeDomain")->where, "<reinitializeDomain> true",
                  "start a new run");
  if (const DeckNode* start = scalar->child("initialization"))
    for (const DeckNode* object : start->all("geom_object")) check_scalar_region(*object, faults);
  if (const DeckNode* sources = scalar->child("interiorSources"))
    for (const DeckNode* object : sources->all("geom_object")) check_source(*object, faults);
}

void read_scalar_constants(const DeckNode& scalar, TransportedScalar& s, const char* element) {
  s.where = scalar.where;
  s.name = scalar.attribute("name").value_or("");
  s.totalled = is_true(&scalar, "test_conservation");
  const DeckNode* constants = scalar.child(element);
  if (constants == nullptr) return;
  s.diffusivity = real_or(*constants, "diffusivity", 0);
  if (const DeckNode* d = constants->child("diffusivity")) s.diffusivity_where = d->where;
  s.constant_rate = real_or(*constants, "rateOfChange0", 0);
  s.own_rate = real_or(*constants, "rateOfChange1", 0);
  s.refine_above = real_or(*constants, "AMR_Refinement_Criteria", s.refine_above);
}

TransportedScalar read_passive_scalar(const DeckNode& parameters,
                                      const std::vector<std::string>& materials,
                                      const GeometryReader& geometry, std::vector<Fault>& faults) {
  const DeckNode& scalar = *parameters.child("scalar");
  TransportedScalar s;
  s.material = read_material(parameters, "material", materials);
  read_scalar_constants(scalar, s);
  s.decay = read_decay(scalar);
  s.start = read_scalar_regions(*scalar.child("initialization"), geometry, faults);
  if (const DeckNode* sources = scalar.child("interiorSources"))
    for (const DeckNode* object : sources->all("geom_object")) {
      ScalarSource source;
      source.piece = geometry.object(*object, faults).piece;
      source.rate = real_or(*object, "rateOfChange", real_or(*object, "scalar", 0));
      source.most = real_or(*object, "maxScalar", source.most);
      s.sources.push_back(source);
    }
  return s;
}

std::vector<std::string> scalar_labels(const DeckNode& parameters) {
  const DeckNode* scalar = parameters.child("scalar");
  TransportedScalar named;
  named.name = scalar == nullptr ? "" : scalar->attribute("name").value_or("");
  named.decay.any = scalar != nullptr && scalar->child("exponentialDecay") != nullptr;
  return named.name.empty() ? std::vector<std::string>{} : labels_of(named);
}

void rename_scalar_totals(DeckNode& root, std::vector<Fault>& faults) {
  constexpr std::string_view old = "sum_scalar-";
  const std::vector<std::string> analysed = labels_of_analyses(root);
  DeckNode* archiver = root.child("DataArchiver");
  if (archiver == nullptr || root.child("Models") == nullptr) return;
  for (const auto& save : archiver->children)
    for (auto& [name, value] : save->attributes) {
      if (save->name != "save" || name != "label") continue;
      // Older decks write sum_scalar_f.
      const bool underlined = value.rfind("sum_scalar_", 0) == 0;
      if (value.rfind(old, 0) != 0 && !underlined) continue;
      if (std::find(analysed.begin(), analysed.end(), value) != analysed.end()) continue;
      const std::string now = "totalSum_scalar-" + value.substr(old.size());
      add_warning(faults, save->where, fmt::format("variable {} is now {}", value, now),
                  fmt::format("write {}", now));
      value = now;
    }
}

}  // namespace sluice::models
