// DataAnalysis: what is looked at while the run goes on.
#include "framework/deck/framework_schema.hpp"

namespace sluice {
namespace {

using Names = std::vector<std::string>;

const Names averages = {"planeAverage", "planeAvgTurbFluxes"};
const Names sampled = {"minMax", "lineExtract", "planeExtract", "planeAverage",
                       "planeAvgTurbFluxes"};
const Names with_variables = sampled;

TagSpec analyze() {
  return tag("analyze", "a variable that is looked at")
      .multiple()
      .with_attributes(
          {attribute("label", "name of the variable").once().text(),
           attribute("matl", "index of its material").integer().at_least(0),
           attribute("level", "indices of its levels").index_set(),
           attribute("computeReynoldsStress", "statistics: also the covariances of its components")
               .boolean(),
           attribute("fluidVelocityLabel", "turbulentFluxes: this is the velocity").text(),
           attribute("weighting", "how cells of a plane count: sum, mean, mean by <weight>")
               .words({"none", "nCells", "mass"})});
}

TagSpec corner(const char* name, const char* doc) {
  return tag(name, doc).once().vector().unit("length");
}

TagSpec line() {
  return tag("line", "a line along which values are taken")
      .at_least_once()
      .attribute(attribute("name", "name of the line and its files").once().text())
      .with_children({corner("startingPt", "begin of the line"),
                      corner("endingPt", "end of the line"),
                      tag("stepSize", "distance of the points; absent: every cell")
                          .real()
                          .above(0)
                          .unit("length")});
}

TagSpec plane() {
  return tag("plane", "a rectangle along two axes of which all cells are taken")
      .at_least_once()
      .attribute(attribute("name", "name of the plane and its files").once().text())
      .with_children({corner("startingPt", "one corner"),
                      corner("endingPt", "the opposite corner; one coordinate is the same")});
}

// Where modules look.
Names names_of(const char* one) {
  return {one};
}
std::vector<TagSpec> places() {
  return {tag("lines", "where it is looked at")
              .once()
              .child(line())
              .only_for("name", names_of("lineExtract")),
          tag("planes", "where it is looked at")
              .once()
              .child(plane())
              .only_for("name", names_of("planeExtract"))};
}

// How planes are averaged.
std::vector<TagSpec> plane_tags() {
  const AttributeSpec label = attribute("label", "name of the variable").once().text();
  return {tag("planeOrientation", "the two directions in which planes extend")
              .once()
              .words({"XY", "XZ", "YZ"})
              .only_for("name", averages),
          tag("weight", "the weight of averages with weighting=\"mass\"")
              .attribute(label)
              .only_for("name", averages),
          tag("velocity", "the velocity that variables are correlated with")
              .once()
              .with_attributes({label, attribute("weighting", "of its averages over planes")
                                           .words({"none", "nCells", "mass"})})
              .only_for("name", names_of("planeAvgTurbFluxes"))};
}

// When samples are taken.
std::vector<TagSpec> times() {
  return {
      tag("samplingFrequency", "samples per unit of time")
          .once()
          .real()
          .above(0)
          .unit("1/time")
          .only_for("name", sampled),
      tag("timeStart", "begin of sampling").once().real().unit("time").only_for("name", sampled),
      tag("timeStop", "end of sampling").once().real().unit("time").only_for("name", sampled)};
}

}  // namespace

void add_analysis_tags(Schema& schema) {
  const TagSpec module =
      tag("Module", "one analysis")
          .multiple()
          .attribute(
              attribute("name", "which analysis")
                  .once()
                  .words({"minMax", "lineExtract", "planeExtract", "planeAverage",
                          "planeAvgTurbFluxes", "vorticity"})
                  .not_built({"controlVolFluxes", "firstLawThermo", "flatPlate_heatFlux",
                              "momentumAnalysis", "particleExtract", "radiometer", "spatialAvg",
                              "statistics", "SGS_ReynoldsStress", "turbulentFluxes"}))
          .not_both({"material", "materialIndex"})
          .with_children({tag("material", "name of the material").text(),
                          tag("materialIndex", "index of the material").integer().at_least(0)})
          .with_children(times())
          .with_children({tag("Variables", "what is looked at")
                              .once()
                              .child(analyze())
                              .only_for("name", with_variables)})
          .with_children(places())
          .with_children(plane_tags());
  schema.add(tag("DataAnalysis", "what is looked at while the run goes on").child(module));
}

void add_framework_tags(Schema& schema) {
  add_run_tags(schema);
  add_geometry_tags(schema);
  add_grid_tags(schema);
  add_output_tags(schema);
  add_refinement_tags(schema);
  add_analysis_tags(schema);
}

}  // namespace sluice
