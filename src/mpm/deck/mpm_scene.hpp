// What a deck says of solids, as plain data. SI units; numbers without a word of it below are
// places and lengths in m, normals of any length, times in s, velocities in m/s.
#pragma once
#include <algorithm>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "framework/base/vec3.hpp"
#include "framework/geometry/piece.hpp"
#include "framework/scene/scene.hpp"
#include "mpm/material/base/material.hpp"

namespace sluice::mpm {

// carried: particles carry their corners, which move with the grid
// (solids/corner_volume.hpp).
enum class Basis { linear, gimp, cpgimp, quadratic, cubic, cpdi, fast_cpdi, cpti, carried };
// How velocities come back to particles: see mpm/transfer.
enum class Transfer { flip, pic, xpic, apic, affine, midpoint };

// A <geom_object>: particles that fill a piece of space.
struct SeedObject {
  PiecePtr piece;
  IntVec3 per_cell{2, 2, 2};  // res: particles per cell and direction
  // Affine map of the seeded places: A x + b. Identity: nothing is mapped.
  std::array<double, 9> map{1, 0, 0, 0, 1, 0, 0, 0, 1};
  Vec3 shift{};
  bool mapped = false;
  double temperature = 0, concentration = 0;  // K; per mass
  Vec3 velocity{};
  std::optional<double> volume_fraction;  // share of the mass that a particle has
  int filling_levels = 1;                 // numLevelsParticleFilling
  bool cut_cells = false;  // particles that the surface cuts have volume and centroid of their part
  double colour = 0;       // without unit
  Location where;
};

// What diffuses through a material, as a concentration per mass.
struct Diffusion {
  double diffusivity = 0;                                            // D, m^2/s
  double least = 0, most = std::numeric_limits<double>::infinity();  // its bounds
};

// Water that fills the pores of a material, see mpm/step/pore_water.hpp.
struct PoreWaterConstants {
  double density = 1000;        // rho_w, kg/m^3
  double porosity = 0;          // n at the start
  double conductivity = 0;      // k, hydraulic, m/s
  double bulk_modulus = 2.2e9;  // K_w, Pa
  double initial_pressure = 0;  // p, Pa
  double drag_of_velocity = 0;  // g/k: of the drag over n rho_w, 1/s
};

struct SolidMaterial {
  std::string name;
  int index = 0;  // of the scene's materials
  MaterialConstants constants;
  std::shared_ptr<const Material> law;
  std::vector<SeedObject> objects;
  bool force_transmitting = false;
  bool rigid = false;            // is_rigid, or a rigid law
  bool may_give_normals = true;  // possible_alpha_material
  double specific_heat_p = 0;    // C_p, J/(kg K)
  std::optional<Diffusion> diffusion;
  std::optional<PoreWaterConstants> water;  // none: it is dry, or what it holds moves with it
  double activation_time = 0, deactivation_time = 1e300;
  bool active_at_start = true;
  // Does what contact takes from motion become heat of it.
  bool warms_by_contact(const struct MpmScene& solids) const;
  // Others rest as they are: no part of them reaches a node, no force reaches them.
  bool takes_part(double time) const {
    return (active_at_start || time >= activation_time) && time < deactivation_time;
  }
  bool burns = false;                // its particles lose mass in place
  bool lost_energy_heats = false;    // what transfer and integration take becomes heat of it
  bool has_surface_history = false;  // at a rate that depends on what has burned before
  bool awaits_flames = false;        // that take time to come along
  // With DoGranularMPM: J beyond which grains have lost touch (0: without), and whether they then
  // have no stress.
  double loosest = 0;
  bool loose_have_no_stress = false;
  // The objects of all materials whose particles may come to this one; empty: its own alone.
  std::vector<SeedObject> guests;
  const std::vector<SeedObject>& forms() const { return guests.empty() ? objects : guests; }
  Location where;
};

enum class ContactKind { none, single_velocity, friction, specified, specified_friction };

// One <contact>; several act one after the other.
struct ContactRule {
  ContactKind kind = ContactKind::none;
  std::vector<int> materials;  // local numbers of SolidMaterial; all when the deck names none
  double friction = 0;         // mu
  // Share of the cells that materials fill; cells, without effect.
  double volume_constraint = 0, separation_factor = 1e300;
  bool applied_before_and_after_integration =
      true;                    // OneOrTwoStep 2: before and after the integration
  std::optional<int> exclude;  // ExcludeMaterial
  std::string type;            // as the deck says: friction_bard, friction_LR, approach, ...
  std::vector<std::pair<double, double>> friction_of_colour;  // friction_LRVar: colour, mu
  // specified
  int master = 0;
  std::string profile_file;
  std::vector<std::array<double, 10>> profile;  // t, v, origin, angular velocity (1/s)
  bool rotates = false, normal_only = false;
  IntVec3 directions{0, 0, 1};
  std::optional<double> stop_time;
  Vec3 velocity_after_stop{};
  Location where;
  bool takes(int material) const {
    return materials.empty() ||
           std::find(materials.begin(), materials.end(), material) != materials.end();
  }
};

// A <PhysicalBC>: a load that follows a curve, on the particles of a surface.
struct LoadCurve {
  enum class Kind { pressure, torque, heat_flux, force } kind = Kind::pressure;
  PiecePtr piece;
  std::string shape;                              // tag of the piece: box, cylinder, sphere
  std::vector<std::pair<double, double>> points;  // time; load: Pa, N m, W/m^2, factor of force
  std::optional<int> material;
  bool whole_face = false, ends = false, axisymmetric_end = false, axisymmetric_side = false;
  Vec3 outward_normal{};
  int id = 0;                   // what p.loadCurveID of point files names
  bool on_points = false;       // pressure_pts: acts on the particles that name it
  double area = 0;              // pressure_pts: SurfaceArea, m^2
  bool along_outward = false;   // tag outward_normal
  std::optional<Vec3> spacing;  // res: particles per cell near the surface
  Vec3 force{};                 // of Kind::force, N, shared by the particles in the piece
  Location where;
};

// One row of the file of a cohesive zone: materials below and above, local numbers.
struct CohesivePoint {
  Vec3 place{}, normal{}, tangent{};
  double area = 0;  // m^2
  int below = 0, above = 0;
};

// Points that hold two materials together.
struct CohesiveZone {
  std::vector<CohesivePoint> points;
  double sig_max = 0, tau_max = 0, delta_n = 0, delta_t = 0;  // Pa, Pa, m, m
  double delta_n_fail = 0, delta_t_fail = 0;
  Location where;
};

// Particles that are split, once each.
struct SplitCriterion {
  enum class Kind { stress_norm, stretch_ratio } kind = Kind::stress_norm;
  double value = 0;   // Pa, or a ratio
  int material = -1;  // -1: all
  Location where{};
};

// Materials whose particles go from one to the other: a velocity field for each cluster of grains.
struct GrainFamily {
  std::vector<int> members;    // local numbers: those that some contact takes first, then by number
  std::size_t in_contact = 0;  // how many of them
};

// A condition of a face of the domain, of one material or of all (-1).
struct SolidBoundary {
  enum class Kind {
    symmetric,
    velocity,
    temperature,
    temperature_gradient,
    concentration,
    concentration_gradient
  } kind = Kind::symmetric;
  Side side;
  int material = -1;  // local number
  int region = -1;    // of scene.boundary, where the condition covers a part of the face; -1: all
  // By kind: m/s; a number, in every component: K, K/m, per mass, per mass and m.
  Vec3 value{};
};

// Of implicit steps: <MPM> of the component impm.
struct ImplicitSettings {
  bool dynamic = true;    // nodes have inertia
  bool mechanics = true;  // DoMechanics
  // Shares: squares of displacements of the largest, energy of that of the first iteration.
  double displacement_criterion = 1e-10, energy_criterion = 4e-10;
  int iterations_to_shrink = 12, iterations_to_grow = 4, max_iterations = 25;
  double shrink = 0.6, grow = 2;                 // factors of the step
  bool conducts = false, heat_is_stored = true;  // by implicit steps
  bool direct = false;                           // linear systems, whatever their size
};

struct MpmScene {
  Basis basis = Basis::linear;
  Transfer transfer = Transfer::flip;
  int xpic_order = 2;
  double affine_damping = 1;  // kappa, a factor
  bool musl = true;           // new velocities are mapped back at the places of the start (MUSL)
  // Particles carry a spin, gradients are those of the middle of a step (mpm_transfers.md).
  bool midpoint() const { return transfer == Transfer::midpoint; }
  // Velocity gradients are those of new velocities, which particles give to nodes once more. Where
  // the deformation is prescribed nodes have it, and velocities of particles do not.
  bool maps_back() const { return midpoint() || (musl && prescribed_file.empty()); }
  bool carries_corners() const { return basis == Basis::carried; }
  // For those who need corners whatever the deck's basis is. Before the scene is used; what
  // corners have no form of gives way. Along directions of one cell a particle has no corners: it
  // fills the cell, and is one whatever <res> says.
  void carry_corners(const std::array<bool, 3>& active) {
    basis = Basis::carried;
    total_lagrangian = false;
    if (transfer == Transfer::apic) transfer = Transfer::affine;
    musl = false;
    for (SolidMaterial& m : materials)
      for (SeedObject& o : m.objects)
        for (int d = 0; d < 3; ++d)
          if (!active[d]) o.per_cell[d] = 1;
  }
  bool total_lagrangian = false;
  double cpdi_limit = 1e300;  // cells
  bool axisymmetric = false;
  bool gradient_enhanced = false;
  double damping = 0;  // artificial_damping_coeff, 1/s
  bool artificial_viscosity = false, viscosity_heats = false;
  double viscosity_1 = 0.2, viscosity_2 = 2.0;  // of artificial viscosity, without unit
  // Does artificial viscosity act.
  bool viscous() const { return artificial_viscosity && (viscosity_1 != 0 || viscosity_2 != 0); }
  bool use_loads = false, normal_to_surface = false, loads_on_corners = false;
  bool heat_conduction = true;         // DoExplicitHeatConduction
  bool scalar_diffusion = false;       // do_scalar_diffusion
  bool filters_pore_pressure = false;  // PorePressureFilter
  bool any_water() const {
    return std::any_of(materials.begin(), materials.end(),
                       [](const SolidMaterial& m) { return m.water.has_value(); });
  }
  bool thermal_contact = false, friction_heats = false;
  bool pressure_stabilised = false;
  int subcycles_of_F = 1;  // minimum_subcycles_for_F; negative: terms of the exponential series
  double min_particle_mass = 3e-15;  // kg
  bool with_colour = false;
  bool full_first_kick = false;
  // Velocities stand at the time of the places, and each step changes them by its own length: what
  // a fluid gives to solids in a step is then what they get.
  bool whole_kicks = false;
  std::string manufactured;           // RunMMSProblem
  double manufactured_amplitude = 0;  // ManufacturedConstants::amplitude; 0: that of the problem
  std::vector<std::string> traction_faces;
  std::string prescribed_file, insert_file;  // resolved paths; empty: off
  bool exact_deformation = false;
  bool refine_particles = false;
  std::vector<SolidMaterial> materials;
  std::vector<ContactRule> contacts;
  std::vector<ContactRule> rigid_contacts;  // of implicit steps, which have no others
  std::vector<LoadCurve> loads;
  std::array<bool, 3> moves_along{true, true, true};  // directions of more than one cell
  std::vector<SolidBoundary> boundaries;
  std::vector<CohesiveZone> cohesive_zones;  // empty where use_cohesive_zones is not true
  std::vector<SplitCriterion> splits;
  bool granular = false;            // DoGranularMPM
  std::vector<GrainFamily> grains;  // of two materials or more
  bool colinear_normals = true;
  std::optional<ImplicitSettings> implicit;  // none: explicit steps
  bool xpic2_of_format = false;  // tag XPIC2: places move with the filtered velocity too
  // Does what contact takes from motion become heat of any solid.
  bool contact_heats() const {
    return std::any_of(materials.begin(), materials.end(),
                       [&](const SolidMaterial& m) { return m.warms_by_contact(*this); });
  }
};

inline bool SolidMaterial::warms_by_contact(const MpmScene& solids) const {
  return !rigid && (solids.friction_heats || (lost_energy_heats && !solids.contacts.empty()));
}

}  // namespace sluice::mpm
