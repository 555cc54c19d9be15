// <PhysicalBC>: loads that follow a curve, on the particles of a surface.
#include "mpm/deck/schema.hpp"

namespace sluice::mpm {
namespace {

TagSpec load_curve(const std::string& unit) {
  return tag("load_curve", "the load over time: linear between points, constant after the last")
      .once()
      .with_children(
          {tag("id", "number by which p.loadCurveID in point files refers to this curve")
               .once()
               .integer()
               .at_least(0),
           tag("material", "index of the material it acts on; absent: all").integer().at_least(-99),
           tag("time_point", "one point of the curve")
               .at_least_once()
               .with_children({tag("time", "time").once().real().unit("time"),
                               tag("load", "load").once().real().unit(unit)})});
}

TagSpec surface() {
  return tag("geom_object", "the surface; for a box its thin sides")
      .once()
      .attribute(attribute("name", "name of the surface").text())
      .group("geometry_piece");
}

// A load on particles at the surface of a piece.
TagSpec on_surface(const std::string& name, const std::string& doc, const std::string& unit) {
  return tag(name, doc).multiple().with_children(
      {surface(), load_curve(unit),
       tag("outward_normal",
           "with use_CBDI_boundary_condition: the face of the body is oriented outward from the "
           "piece, otherwise inward")
           .boolean(),
       tag("res", "particles per cell near the surface; absent: unchanged").vector().above(0)});
}

}  // namespace

TagSpec loads_tag() {
  const TagSpec on_points =
      tag("pressure_pts", "pressure on particles whose point file names the curve")
          .multiple()
          .with_children(
              {load_curve("pressure"),
               tag("SurfaceArea", "area that the pressure acts on")
                   .once()
                   .real()
                   .above(0)
                   .unit("length^2"),
               tag("res", "accepted without effect: the file gives the particles").vector()});
  const TagSpec force =
      tag("force", "a constant force on all particles of a box")
          .multiple()
          .with_children({tag("lower", "low corner").once().vector().unit("length"),
                          tag("upper", "high corner").once().vector().unit("length"),
                          tag("force_density", "the force, distributed over the particles")
                              .once()
                              .vector()
                              .unit("force")});
  return tag("PhysicalBC", "loads on solids")
      .child(tag("MPM", "loads; they act if use_load_curves is true")
                 .with_children(
                     {on_surface("pressure", "pressure on a surface", "pressure"), on_points,
                      on_surface("torque", "torque about the axis of a cylinder", "force length"),
                      on_surface("heat_flux", "heat through a surface", "power/length^2"), force}));
}

}  // namespace sluice::mpm
