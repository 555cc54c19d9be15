// DataAnalysis: what is looked at while the run goes on.
#include "framework/deck/format/framework_schema.hpp"

namespace sluice {
namespace {

using Names = std::vector<std::string>;

const Names averages = {"planeAverage", "planeAvgTurbFluxes"};
const Names over_time = {"statistics", "turbulentFluxes"};
const Names of_cells = {"spatialAvg"};
const Names at_samples = {"minMax",       "lineExtract",        "planeExtract", "pointExtract",
                          "planeAverage", "planeAvgTurbFluxes", "statistics",   "turbulentFluxes"};
const Names particle_words = {"particleExtract"};
const Names of_one_volume = {"momentumAnalysis", "firstLawThermo"};

Names joined(Names a, const Names& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}
const Names sampled =
    joined(joined(joined(at_samples, {"controlVolFluxes"}), of_one_volume), particle_words);
const Names with_variables = joined(joined(at_samples, of_cells), particle_words);
const Names with_times = joined(sampled, of_cells);

TagSpec analyze() {
  return tag("analyze", "a variable to be analysed")
      .multiple()
      .with_attributes(
          {attribute("label", "name of the variable").once().text(),
           attribute("matl", "index of its material").integer().at_least(0),
           attribute("level", "indices of its levels").index_set(),
           attribute("computeReynoldsStress", "statistics: also the covariances of its components")
               .boolean(),
           attribute("fluidVelocityLabel", "turbulentFluxes: this is the velocity").text(),
           attribute("weighting",
                     "average over the cells of a plane: sum, mean, mean weighted by <weight>")
               .words({"none", "nCells", "mass"})});
}

TagSpec corner(const char* name, const char* doc) {
  return tag(name, doc).once().vector().unit("length");
}

TagSpec line() {
  return tag("line", "a line along which values are sampled")
      .at_least_once()
      .attribute(attribute("name", "name of the line and its files").once().text())
      .with_children({corner("startingPt", "start of the line"),
                      corner("endingPt", "end of the line"),
                      tag("stepSize", "distance between points; absent: every cell")
                          .real()
                          .above(0)
                          .unit("length")});
}

TagSpec rectangle(const std::string& text) {
  return tag("plane", text)
      .at_least_once()
      .with_children({corner("startingPt", "one corner"),
                      corner("endingPt", "the opposite corner; one coordinate must be equal")});
}

TagSpec plane() {
  return rectangle("a rectangle along two axes, all cells of which are sampled")
      .attribute(attribute("name", "name of the plane and its files").once().text());
}

TagSpec plane_of_heat() {
  return rectangle("a rectangle along two axes through which the heat flux is summed");
}

TagSpec corners_of_box() {
  return tag("box", "a part of the domain; its corners are moved to the nearest faces of level 0")
      .with_children({corner("min", "low corner"), corner("max", "high corner")});
}

// The domain or a box, and the sides through which it exchanges.
TagSpec control_volume() {
  const TagSpec face =
      tag("Face", "a side that counts; without any, all sides count")
          .multiple()
          .with_attributes(
              {attribute("side", "which side").once().words({"x-", "x+", "y-", "y+", "z-", "z+"}),
               attribute("extents", "all of it, or the rectangle between two corners")
                   .once()
                   .words({"entireFace", "partialFace"})})
          .with_children({tag("startPt", "a corner of the rectangle").vector().unit("length"),
                          tag("endPt", "the opposite corner").vector().unit("length")});
  return tag("controlVolume", "the control volume; without a box the whole domain")
      .once()
      .child(corners_of_box())
      .child(face)
      .only_for("name", of_one_volume);
}

// Labels that the format names and nothing needs: fluxes are those of the scheme.
std::vector<TagSpec> unneeded_labels() {
  std::vector<TagSpec> tags;
  for (const char* name : {"uvel_FC", "vvel_FC", "wvel_FC", "vel_CC", "rho_CC"})
    tags.push_back(tag(name, "accepted without effect: fluxes are those of the scheme")
                       .attribute(attribute("label", "name of a variable").once().text())
                       .only_for("name", {"momentumAnalysis"}));
  return tags;
}

// Budgets of control volumes.
std::vector<TagSpec> volume_tags() {
  return {tag("controlVolumes", "the volumes whose fluxes are summed")
              .once()
              .child(corners_of_box().at_least_once().attribute(
                  attribute("label", "name of the volume and its file").once().text()))
              .only_for("name", {"controlVolFluxes"}),
          control_volume(),
          tag("engy_convt_factor", "factor of all energies in the file")
              .real()
              .above(0)
              .by_default("1")
              .only_for("name", {"firstLawThermo"})};
}

// Statistics over time.
std::vector<TagSpec> statistics_tags() {
  return {tag("computeHigherOrderStats", "also skewness and kurtosis")
              .boolean()
              .by_default("false")
              .only_for("name", over_time),
          tag("monitorCell", "accepted without effect").vector().only_for("name", over_time)};
}

// Where modules look.
Names names_of(const char* one) {
  return {one};
}
std::vector<TagSpec> places() {
  return {tag("lines", "position of the point")
              .once()
              .child(line())
              .only_for("name", names_of("lineExtract")),
          tag("points", "position of the point")
              .once()
              .child(tag("point", "a point to which cell values are interpolated")
                         .at_least_once()
                         .attribute(attribute("name", "name of its file").once().text())
                         .child(corner("position", "position of the point")))
              .only_for("name", names_of("pointExtract")),
          tag("planes", "position of the point")
              .once()
              .child(plane())
              .only_for("name", names_of("planeExtract")),
          plane_of_heat().only_for("name", names_of("flatPlate_heatFlux"))};
}

// How planes are averaged.
std::vector<TagSpec> plane_tags() {
  const AttributeSpec label = attribute("label", "name of the variable").once().text();
  return {
      tag("planeOrientation", "the two directions of the planes")
          .once()
          .words({"XY", "XZ", "YZ"})
          .only_for("name", averages),
      tag("weight", "the weight of averages with weighting=\"mass\"")
          .attribute(label)
          .only_for("name", averages),
      tag("velocity", "the velocity that variables are correlated with")
          .once()
          .with_attributes({label, attribute("weighting", "weighting of its averages over planes")
                                       .words({"none", "nCells", "mass"})})
          .only_for("name", names_of("planeAvgTurbFluxes"))};
}

// Averages of boxes of cells.
std::vector<TagSpec> box_tags() {
  return {
      tag("avgBoxCells", "cells along each direction of the box around a cell: odd numbers")
          .once()
          .int_vector()
          .only_for("name", of_cells),
      tag("domain", "which cells have averages: all, those whose box is complete, or the others")
          .words({"everywhere", "interior", "boundaries"})
          .by_default("everywhere")
          .only_for("name", of_cells)};
}

// When samples are taken.
std::vector<TagSpec> times() {
  return {
      tag("samplingFrequency",
          "samples per unit of time; required but for statistics and turbulentFluxes: every step")
          .real()
          .above(0)
          .unit("1/time")
          .only_for("name", sampled),
      tag("timeStart", "start of sampling").once().real().unit("time").only_for("name", with_times),
      tag("timeStop", "end of sampling").once().real().unit("time").only_for("name", with_times)};
}

// How the names of a module's fields begin, before that of a variable.
Names kinds_of_fields(const DeckNode& module, const std::string& name) {
  if (name == "spatialAvg") return {"spatialAvg_", "spatialAvg_variance_"};
  if (name != "statistics" && name != "turbulentFluxes") return {};
  Names kinds = {"sum_", "mean_", "variance_"};
  const DeckNode* higher = module.child("computeHigherOrderStats");
  if (higher != nullptr && higher->text == "true")
    kinds = joined(kinds, {"skewness_", "kurtosis_"});
  if (name == "turbulentFluxes") kinds.emplace_back("covariance_");
  return kinds;
}

// Fields and histories that a module gives.
Names labels_of(const DeckNode& module) {
  const std::string name = module.attribute("name").value_or("");
  if (name == "flatPlate_heatFlux") return {"total_heatRate"};
  const Names kinds = kinds_of_fields(module, name);
  const DeckNode* variables = module.child("Variables");
  Names labels;
  if (variables == nullptr || kinds.empty()) return labels;
  for (const DeckNode* v : variables->all("analyze")) {
    for (const std::string& kind : kinds)
      labels.push_back(kind + v->attribute("label").value_or(""));
    const bool stress = name == "statistics" && v->attribute("computeReynoldsStress") == "true";
    if (name == "turbulentFluxes" || stress) labels.emplace_back("uv_vw_wu_prime");
  }
  return labels;
}

}  // namespace

std::vector<std::string> labels_of_analyses(const DeckNode& root) {
  std::vector<std::string> labels;
  if (const DeckNode* analysis = root.child("DataAnalysis"))
    for (const DeckNode* module : analysis->all("Module"))
      labels = joined(labels, labels_of(*module));
  return labels;
}

void add_analysis_tags(Schema& schema) {
  const TagSpec module =
      tag("Module", "one analysis")
          .multiple()
          .attribute(attribute("name", "which analysis")
                         .once()
                         .words({"minMax", "lineExtract", "planeExtract", "planeAverage",
                                 "planeAvgTurbFluxes", "controlVolFluxes", "momentumAnalysis",
                                 "firstLawThermo", "statistics", "turbulentFluxes", "pointExtract",
                                 "flatPlate_heatFlux", "spatialAvg", "vorticity",
                                 "SGS_ReynoldsStress", "particleExtract"})
                         .not_built({"radiometer"}))
          .not_both({"material", "materialIndex"})
          .with_children({tag("material", "name of the material").text(),
                          tag("materialIndex", "index of the material").integer().at_least(0)})
          .with_children(times())
          .with_children({tag("Variables", "variables to be analysed")
                              .once()
                              .child(analyze())
                              .only_for("name", with_variables)})
          .with_children(places())
          .with_children(plane_tags())
          .with_children(box_tags())
          .with_children({tag("colorThreshold", "particles with p.color above this are followed")
                              .once()
                              .real()
                              .only_for("name", particle_words)})
          .with_children(volume_tags())
          .with_children(unneeded_labels())
          .with_children(statistics_tags());
  schema.rules.emplace_back(check_analyses);
  schema.add(tag("DataAnalysis", "analyses during the run").child(module));
}

void add_framework_tags(Schema& schema, const std::vector<ComponentWord>& components) {
  add_run_tags(schema, components);
  add_geometry_tags(schema);
  add_grid_tags(schema);
  add_output_tags(schema);
  add_refinement_tags(schema);
  add_analysis_tags(schema);
}

}  // namespace sluice
