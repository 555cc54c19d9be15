// DataAnalysis: what is looked at while the run goes on.
#include "framework/deck/framework_schema.hpp"

namespace sluice {
namespace {

const std::vector<std::string> sampled = {"minMax", "lineExtract"};

TagSpec analyze() {
  return tag("analyze", "a variable that is looked at")
      .multiple()
      .with_attributes(
          {attribute("label", "name of the variable").once().text(),
           attribute("matl", "index of its material").integer().at_least(0),
           attribute("level", "indices of its levels").index_set(),
           attribute("computeReynoldsStress", "accepted without effect").text(),
           attribute("fluidVelocityLabel", "accepted without effect").text(),
           attribute("weighting", "accepted without effect").words({"none", "nCells", "mass"})});
}

TagSpec line() {
  return tag("line", "a line along which values are taken")
      .at_least_once()
      .attribute(attribute("name", "name of the line and its files").once().text())
      .with_children({tag("startingPt", "begin of the line").once().vector().unit("length"),
                      tag("endingPt", "end of the line").once().vector().unit("length"),
                      tag("stepSize", "distance of the points; absent: every cell")
                          .real()
                          .above(0)
                          .unit("length")});
}

}  // namespace

void add_analysis_tags(Schema& schema) {
  const TagSpec module =
      tag("Module", "one analysis")
          .multiple()
          .attribute(
              attribute("name", "which analysis")
                  .once()
                  .words({"minMax", "lineExtract", "vorticity"})
                  .not_built({"controlVolFluxes", "firstLawThermo", "flatPlate_heatFlux",
                              "momentumAnalysis", "particleExtract", "planeAverage",
                              "planeAvgTurbFluxes", "planeExtract", "radiometer", "spatialAvg",
                              "statistics", "SGS_ReynoldsStress", "turbulentFluxes"}))
          .not_both({"material", "materialIndex"})
          .with_children({tag("material", "name of the material").text(),
                          tag("materialIndex", "index of the material").integer().at_least(0),
                          tag("samplingFrequency", "samples per unit of time")
                              .once()
                              .real()
                              .above(0)
                              .unit("1/time")
                              .only_for("name", sampled),
                          tag("timeStart", "begin of sampling")
                              .once()
                              .real()
                              .unit("time")
                              .only_for("name", sampled),
                          tag("timeStop", "end of sampling")
                              .once()
                              .real()
                              .unit("time")
                              .only_for("name", sampled),
                          tag("Variables", "what is looked at")
                              .once()
                              .child(analyze())
                              .only_for("name", sampled),
                          tag("lines", "where it is looked at")
                              .once()
                              .child(line())
                              .only_for("name", {"lineExtract"})});
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
