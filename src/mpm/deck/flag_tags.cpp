// <MPM>: the method's flags; <AMR><MPM>.
#include <fmt/format.h>

#include "mpm/deck/bases.hpp"
#include "mpm/deck/implicit.hpp"
#include "mpm/deck/pore_water.hpp"

namespace sluice::mpm {
namespace {

TagSpec flag(const std::string& name, const std::string& doc, const std::string& standard) {
  return tag(name, doc).boolean().by_default(standard);
}

TagSpec ignored(const std::string& name, const std::string& reason) {
  return tag(name, "accepted without effect: " + reason);
}

TagSpec interpolator_tag() {
  TagSpec spec =
      tag("interpolator",
          "shape functions: 3rdorderBS (also quadraticBS) is the quadratic B-spline, 4thorderBS "
          "(also cubicBS) the cubic one; carried_corners: particles are intervals, quadrilaterals "
          "or hexahedra whose corners move with the grid and are shared by neighbours; at the "
          "start outer corners are moved onto the surface of the piece")
          .words(basis_words())
          .by_default("linear");
  for (const BasisRow& row : basis_rows())
    if (!row.spelling.empty())
      spec = spec.spelling(std::string(row.spelling), std::string(row.word));
  return spec;
}

// How particles and grid exchange. Table: a row for each tag.
std::vector<TagSpec> scheme_tags() {
  return {
      tag("time_integrator", "time integration")
          .words({"explicit", "implicit"})
          .by_default("explicit"),
      interpolator_tag(),
      tag("cpdi_lcrit", "cpdi: half diagonals of a particle are limited to this length")
          .real()
          .above(0)
          .unit("cells"),
      tag("transfer",
          "transfer of velocities from the grid to particles: flip (changes of the grid are "
          "added), pic (the velocity of the grid is used), xpic (pic of a higher order), apic "
          "(affine; angular momentum exact), affine (affine, damped by a rate), midpoint (flip of "
          "velocity and spin; velocity gradients are those of new velocities at the middle of the "
          "step). Default if the deck has neither this nor <musl> or another choice of a transfer: "
          "midpoint; flip with the interpolator linear, in implicit and total Lagrangian steps, "
          "with a fluid, with pore water and with prescribed deformation")
          .words({"flip", "pic", "xpic", "apic", "affine", "midpoint"}),
      tag("xpic_order", "order of the transfer xpic; 1 is pic")
          .integer()
          .at_least(1)
          .at_most(20)
          .by_default("2"),
      tag("affine_damping",
          "transfer affine: rate kappa; every step replaces the fraction kappa dt c/h of a "
          "particle's velocity by that of the grid (c: speed of sound, h: spacing); 0: no damping")
          .real()
          .at_least(0)
          .by_default("1"),
      flag("XPIC2", "transfer xpic of order 2 as in the format: it also acts on positions",
           "false"),
      flag("UseGradientEnhancedVelocityProjection",
           "particle velocities mapped to the grid vary within the particle: transfer affine "
           "without damping",
           "false"),
      tag("musl",
          "new particle velocities are mapped to the grid before the velocity gradient is "
          "computed; absent: true with the interpolator linear, determined by <transfer> with all "
          "others")
          .boolean(),
      flag("total_lagrangian",
           "shape functions are those of the initial positions: for bodies that neither break nor "
           "touch",
           "false"),
      tag("minimum_subcycles_for_F",
          "positive: minimum number of equal parts in which a step deforms a particle; negative: "
          "terms of the exponential series of the velocity gradient, -2: up to the square")
          .integer()
          .at_least(-20)
          .at_most(10000)
          .by_default("1"),
      flag("DoPressureStabilization", "all particles of a cell get the same dilatation", "false"),
      flag("axisymmetric", "x is the radius, y the axis, z the angle, one radian", "false"),
      tag("minimum_particle_mass", "lighter particles are removed, and counted")
          .real()
          .at_least(0)
          .by_default("3e-15")
          .unit("mass"),
      flag("full_first_kick",
           "the first step changes velocities by a full step, not by half a step", "false"),
  };
}

// What acts beside the stress.
std::vector<TagSpec> physics_tags() {
  return {
      tag("artificial_damping_coeff", "damping: deceleration divided by velocity")
          .real()
          .at_least(0)
          .by_default("0")
          .unit("1/time"),
      flag("artificial_viscosity", "artificial viscosity: pressure in fast compression", "false"),
      tag("artificial_viscosity_heating",
          "the work of the artificial viscosity becomes heat; absent: the value of "
          "artificial_viscosity")
          .boolean(),
      tag("artificial_viscosity_coeff1", "linear coefficient of the artificial viscosity")
          .real()
          .at_least(0)
          .by_default("0.2"),
      tag("artificial_viscosity_coeff2", "quadratic coefficient of the artificial viscosity")
          .real()
          .at_least(0)
          .by_default("2.0"),
      flag("DoExplicitHeatConduction", "heat is conducted on the grid", "true"),
      tag("lost_energy",
          "heat: the kinetic energy lost in transfer, integration and contact becomes heat where "
          "it is lost; none: it is only counted; absent: heat in materials with a specific heat "
          "and a shock equation of state, and in all with a specific heat if artificial_viscosity "
          "is true")
          .words({"heat", "none"}),
      flag("do_contact_friction_heating", "the work of friction becomes heat", "false"),
      flag("computeColinearNormals", "contact: both materials use one normal", "true"),
      flag("use_load_curves", "the loads of <PhysicalBC> act", "false"),
      flag("keepPressBCNormalToSurface", "pressures rotate with the particles", "false"),
      flag("use_CBDI_boundary_condition", "pressures act on the corners of particles", "false"),
      flag("use_cohesive_zones", "the <cohesive_zone> blocks are used", "false"),
      tag("boundary_traction_faces", "faces whose forces are recorded, as [xminus,zplus]").text(),
      tag("RunMMSProblem", "body force of a manufactured solution")
          .words({"AxisAligned", "AxisAligned3L", "GeneralizedVortex", "ExpandingRing"}),
      tag("manufactured_amplitude",
          "amplitude A of the motion of RunMMSProblem: of positions along the axes (0.05) and of "
          "the ring (0.1) in metres, of the vortex (1) in radians")
          .real()
          .at_least(0),
      flag("withColor", "particles carry the colour of their geometry object", "false"),
      flag("refine_particles",
           "particles selected by a criterion of <AMR><MPM> are split, once each", "false"),
  };
}

// What files prescribe.
std::vector<TagSpec> file_tags() {
  return {
      flag("UsePrescribedDeformation", "the deformation of all particles is read from a file",
           "false"),
      tag("PrescribedDeformationFile",
          "rows of time, deformation gradient (nine numbers), angle in degrees, axis")
          .file()
          .by_default("time_defgrad_rotation"),
      flag("exactDeformation", "steps end at the times of that file, positions follow it exactly",
           "false"),
      flag("InsertParticles", "particles of a colour are moved at times given in a file", "false"),
      tag("InsertParticlesFile",
          "rows of time, colour, displacement, velocity; or of time, material, colour, "
          "displacement, velocity")
          .file(),
  };
}

// Clusters of grains.
std::vector<TagSpec> grain_tags() {
  const auto stretch = [](const char* name, const char* axis, const char* by_default) {
    return tag(name,
               fmt::format("DoGranularMPM: the product of x, y and z is the largest J at which "
                           "grains are in contact, if a material has no critical_density: along {}",
                           axis))
        .real()
        .at_least(1)
        .by_default(by_default);
  };
  return {flag("DoGranularMPM",
               "particles that have lost contact get a separate material: clusters of grains "
               "interact by contact",
               "false"),
          stretch("GranularMPMVcrix", "x", "1.04"), stretch("GranularMPMVcriy", "y", "1.04"),
          stretch("GranularMPMVcriz", "z", "1.0")};
}

// Flags of the format that change nothing here, or may only have one value.
std::vector<TagSpec> idle_tags() {
  return {
      ignored("minimum_mass_for_acc", "every node with mass is accelerated by its own mass")
          .real()
          .at_least(0),
      ignored("restartOnLargeNodalVelocity",
              "steps with too large displacements are always repeated")
          .boolean(),
      ignored("AMR", "the block AMR decides").boolean(),
      ignored("with_gauss_solver", "no such solver runs with solids").boolean(),
      ignored("DeleteGeometryObjects", "geometry objects are always kept").boolean(),
      ignored("use_particle_normals", "normals of files are used where a load asks for them")
          .boolean(),
      ignored("d_ndim", "determined by the grid").integer(),
      tag("do_grid_reset",
          "the grid is reset after each step; false, only in implicit steps: shape functions are "
          "those of the initial positions, as with total_lagrangian")
          .boolean()
          .by_default("true"),
      flag("do_scalar_diffusion",
           "a concentration diffuses through materials with a <diffusion_model>", "false"),
  };
}

}  // namespace

TagSpec flags_tag() {
  return tag("MPM", "the material point method for solids")
      .with_children(scheme_tags())
      .with_children(implicit_tags())
      .with_children(pore_water_flags())
      .with_children(physics_tags())
      .with_children(file_tags())
      .with_children(grain_tags())
      .with_children(idle_tags());
}

TagSpec refinement_tag() {
  return tag("MPM", "refinement of solids: particles are on the finest level that covers them")
      .with_children(
          {ignored("min_grid_level", "solids are on every level").integer(),
           ignored("max_grid_level", "solids are on every level").integer(),
           ignored("CFI_interpolator", "solids have one basis over all levels")
               .words({"linear", "gimp"}),
           ignored("manualGrid", "the levels of the deck are kept if no regridder is named")
               .boolean(),
           tag("Refinement_Criteria_Thresholds",
               "criteria by which refine_particles splits particles")
               .child(tag("Variable", "one criterion")
                          .multiple()
                          .with_attributes(
                              {attribute("name",
                                         "stressNorm: the norm of the stress exceeds the value; "
                                         "stretchRatio: the ratio of the longest to the shortest "
                                         "edge of a particle leaves [1/value, value]")
                                   .once()
                                   .words({"stressNorm", "stretchRatio"}),
                               attribute("value", "the threshold").once().real().above(0),
                               attribute("matl", "material index or all")
                                   .text()
                                   .by_default("all")}))});
}

}  // namespace sluice::mpm
