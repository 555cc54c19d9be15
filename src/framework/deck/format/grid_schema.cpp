// Grid: levels, their boxes, and the conditions on the faces of the domain.
#include "framework/deck/format/framework_schema.hpp"

namespace sluice {
namespace {

const std::vector<std::string> sides = {"x-", "x+", "y-", "y+", "z-", "z+"};

AttributeSpec face_point(const std::string& name, const std::string& doc) {
  return attribute(name, doc).reals().unit("length");
}
AttributeSpec face_length(const std::string& name, const std::string& doc) {
  return attribute(name, doc).real().at_least(0).unit("length");
}
AttributeSpec shape(const std::string& name, const std::string& doc) {
  return attribute(name, doc).words(sides);
}

TagSpec condition() {
  return tag("BCType", "condition on one variable")
      .multiple()
      .with_attributes(
          {attribute("id", "material index or all; absent: DefaultMaterial").text(),
           attribute("ids", "list of material indices").integers().at_least(0),
           attribute("label", "the variable").once().text(),
           attribute("var", "kind of condition")
               .once()
               .words({"Dirichlet", "Neumann", "symmetry", "computeFromDensity", "FreeSlipWall"})
               .spelling("zeroNeumann", "symmetry")
               .not_built({"Custom", "VelocityInlet", "StABL", "PressureBC", "WallBC", "OutletBC",
                           "NOutletBC", "VelocityFileInput", "MassFlowInlet", "PartMassFlowInlet",
                           "Swirl", "ScalarSwirl", "FromFile", "ForcedDirichlet", "TurbulentInlet",
                           "Tabulated"}),
           attribute("type", "int: the value is an integer")
               .words({"int"})
               .not_built(
                   {"velocity", "handoff", "MMS_almgren", "PressureOutlet", "subgrid_injector"}),
           attribute("value", "the value, in place of the tag <value>").text()})
      .child(tag("value", "number or vector at the boundary, or gradient along the inward normal")
                 .text());
}

TagSpec face() {
  return tag("Face", "a side of the domain, or a part of one, with its conditions")
      .multiple()
      .with_attributes(
          {shape("side", "the whole side, except the parts given by other faces"),
           shape("circle", "side with a disc: origin, radius"),
           shape("annulus", "side with a ring: origin, inner_radius, outer_radius"),
           shape("ellipse", "side with an ellipse: origin, major_radius, minor_radius, angle"),
           shape("rectangle", "side with a rectangle: lower, upper"),
           shape("rectangulus",
                 "side with a rectangular ring: inner_lower, inner_upper, outer_lower, "
                 "outer_upper"),
           face_point("origin", "centre of the shape"),
           face_length("radius", "radius of the disc"),
           face_length("inner_radius", "inner radius of the ring"),
           face_length("outer_radius", "outer radius of the ring"),
           face_length("major_radius", "larger half axis"),
           face_length("minor_radius", "smaller half axis"),
           attribute("angle", "rotation of the larger half axis").real().unit("degree"),
           face_point("lower", "low corner"),
           face_point("upper", "high corner"),
           face_point("inner_lower", "low corner of the hole"),
           face_point("inner_upper", "high corner of the hole"),
           face_point("outer_lower", "low corner of the ring"),
           face_point("outer_upper", "high corner of the ring"),
           attribute("name", "name of the face").text(),
           attribute("type", "accepted without effect").text()})
      .child(condition());
}

TagSpec box() {
  return tag("Box", "a box of cells of this level")
      .at_least_once()
      .attribute(attribute("label", "name of the box").text())
      .with_children(
          {tag("lower", "low corner").once().vector().unit("length"),
           tag("upper", "high corner").once().vector().unit("length"),
           tag("resolution", "cells per direction, unless the level has spacing")
               .int_vector()
               .at_least(1)
               .unit("cells"),
           tag("extraCells", "layers of boundary cells; the layers used follow from the scheme")
               .int_vector()
               .at_least(0)
               .by_default("[0,0,0]"),
           tag("patches", "pieces per direction; results do not depend on it")
               .int_vector()
               .at_least(1),
           tag("autoPatch", "pieces per rank, in place of patches")
               .integer()
               .at_least(1)
               .attribute(attribute("flatten", "directions that are not divided").text())})
      .not_both({"patches", "autoPatch"});
}

TagSpec level() {
  return tag("Level", "cells of one spacing; levels follow from coarse to fine")
      .at_least_once()
      .with_children({box(),
                      tag("spacing", "size of a cell, in place of the boxes' resolution")
                          .vector()
                          .above(0)
                          .unit("length"),
                      tag("periodic", "1: the direction is periodic")
                          .int_vector()
                          .at_least(0)
                          .at_most(1)
                          .by_default("[0,0,0]")});
}

}  // namespace

void add_grid_tags(Schema& schema) {
  schema.add(
      tag("Grid", "the domain, its cells and its boundary")
          .once()
          .attribute(
              attribute("doAMR", "accepted without effect: the block AMR determines it").boolean())
          .with_children(
              {level(),
               tag("BoundaryConditions", "conditions on the sides that are not periodic")
                   .with_children(
                       {tag("DefaultMaterial", "material of conditions without id: an index or all")
                            .text(),
                        face()})}));
  schema.completions.emplace_back(settle_faces);
  schema.rules.emplace_back(check_boxes);
  schema.rules.emplace_back(check_periodicity);
  schema.rules.emplace_back(check_faces);
}

}  // namespace sluice
