#include "mpm/effects.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "mpm/deck/bases.hpp"
#include "mpm/deck/readers.hpp"

namespace sluice::mpm {
namespace {

constexpr double never = 1e8;  // deactivation_time of decks that are silent, s

std::string_view name_of(Transfer t) {
  constexpr std::string_view names[] = {"FLIP", "PIC", "XPIC", "APIC", "affine", "midpoint"};
  return names[static_cast<int>(t)];
}

void add_of_implicit(const ImplicitSettings& s, EffectList& list) {
  list.add({"deformation",
            s.mechanics,
            !s.mechanics ? "DoMechanics is false"
            : s.direct   ? "Newton's method for the nodes, linear systems solved directly"
                         : "Newton's method for the nodes, large linear systems by conjugate "
                           "gradients with multigrid",
            {}});
  list.add({"inertia",
            s.mechanics && s.dynamic,
            s.dynamic ? "trapezoidal rule" : "<dynamic> false: a step ends in equilibrium",
            {}});
  list.add({"heat conduction",
            s.conducts,
            s.conducts ? "a linear system in each step" : "no DoImplicitHeatConduction",
            {}});
}

// Linear and smooth bases alike lock, and pressures alternate, from about this ratio on.
constexpr double nearly_incompressible = 0.48;

void add_pressure_stabilisation(const MpmScene& s, EffectList& list) {
  std::string reason = s.pressure_stabilised ? "DoPressureStabilization is true"
                                             : "DoPressureStabilization is not true";
  for (const SolidMaterial& m : s.materials) {
    if (s.pressure_stabilised || m.rigid) continue;
    const double K = m.law->bulk_modulus(), G = m.law->shear_modulus();
    const double ratio = G > 0 ? (3 * K - 2 * G) / (2 * (3 * K + G)) : 0;  // Poisson's
    if (!(ratio > nearly_incompressible)) continue;
    reason += fmt::format(
        "; '{}' is nearly incompressible (Poisson's ratio {:.5g}): without it pressures oscillate "
        "from cell to cell; <DoPressureStabilization>true</DoPressureStabilization> prevents this",
        m.name, ratio);
    break;
  }
  list.add({"pressure stabilisation", s.pressure_stabilised, reason, {}});
}

}  // namespace

// Choices of the deck that change how solids are solved, each with a comma before it.
static std::string choices_of(const MpmScene& s) {
  std::string text;
  const auto add = [&](bool chosen, const char* name) {
    if (chosen) text += std::string(", ") + name;
  };
  add(s.implicit.has_value(), "implicit steps");
  add(s.axisymmetric, "axisymmetric");
  add(s.total_lagrangian, "total Lagrangian");
  add(s.gradient_enhanced, "gradient-enhanced velocities");
  add(s.viscous(), s.viscosity_heats ? "heating by artificial viscosity" : "artificial viscosity");
  add(s.artificial_viscosity && !s.viscous(), "artificial viscosity of coefficients 0: none");
  add(s.friction_heats, "heating by friction");
  add(s.granular, "grains with separate velocity fields (DoGranularMPM)");
  add(s.filters_pore_pressure, "filtered pore pressure");
  add(s.loads_on_corners, "loads on corners of particles (use_CBDI_boundary_condition)");
  add(s.refine_particles, "splitting of particles");
  add(!s.prescribed_file.empty(), "prescribed deformation");
  return text;
}

// What transfer, integration and contact take from motion.
static Effect lost_energy_of(const MpmScene& s) {
  const auto count = std::count_if(s.materials.begin(), s.materials.end(),
                                   [](const SolidMaterial& m) { return m.lost_energy_heats; });
  const std::string hindrance = without_losses(s);
  std::string reason;
  if (count > 0)
    reason = fmt::format(
        "the energy lost in transfer, integration and contact heats {} of {} materials, which have "
        "a specific heat and also a shock equation of state, artificial_viscosity or <lost_energy> "
        "heat",
        count, s.materials.size());
  else if (!hindrance.empty())
    reason = "not supported with " + hindrance;
  else
    reason =
        "no material has a specific heat and a shock equation of state or artificial_viscosity, or "
        "<lost_energy> is none";
  return {"heat of lost energy", count > 0, reason, {}};
}

static Effect activation_of(const MpmScene& s) {
  const auto sleeps = [](const SolidMaterial& m) {
    return !m.active_at_start || m.deactivation_time < never;
  };
  const auto some = std::find_if(s.materials.begin(), s.materials.end(), sleeps);
  return {"activation of materials", some != s.materials.end(),
          some == s.materials.end()
              ? "all are active from start to end"
              : fmt::format("{} of {} materials are active only for a part of the run",
                            std::count_if(s.materials.begin(), s.materials.end(), sleeps),
                            s.materials.size()),
          some == s.materials.end() ? Location{} : some->where};
}

EffectList effects_of(const Scene& scene, const MpmScene& s) {
  EffectList list;
  list.add({"solids",
            true,
            fmt::format("{} material{}, {} shape functions, {} transfer{}", s.materials.size(),
                        s.materials.size() == 1 ? "" : "s", row_of(s.basis).name,
                        name_of(s.transfer), choices_of(s)),
            {}});
  if (s.implicit) add_of_implicit(*s.implicit, list);
  const std::vector<ContactRule>& rules = s.implicit ? s.rigid_contacts : s.contacts;
  const bool contact = s.materials.size() > 1 && !rules.empty();
  list.add({"contact", contact,
            s.materials.size() < 2 ? "one material"
            : contact              ? fmt::format("{} {}rule{}", rules.size(),
                                    s.implicit ? "rigid contact " : "contact ",
                                    rules.size() == 1 ? "" : "s")
            : s.implicit           ? "all deforming materials have one velocity at a node"
                                   : "no <contact>: separate velocity fields",
            rules.empty() ? Location{} : rules.front().where});
  std::size_t points = 0;
  for (const CohesiveZone& zone : s.cohesive_zones) points += zone.points.size();
  list.add({"cohesive zones", points > 0,
            points > 0
                ? fmt::format("{} points in {} <cohesive_zone>", points, s.cohesive_zones.size())
                : "no <cohesive_zone> is used (use_cohesive_zones)",
            s.cohesive_zones.empty() ? Location{} : s.cohesive_zones.front().where});
  const auto diffuses = [](const SolidMaterial& m) { return m.diffusion.has_value(); };
  const auto through = std::find_if(s.materials.begin(), s.materials.end(), diffuses);
  const bool any = through != s.materials.end();
  const auto count = std::count_if(s.materials.begin(), s.materials.end(), diffuses);
  list.add({"scalar diffusion", s.scalar_diffusion && any,
            !s.scalar_diffusion
                ? "do_scalar_diffusion is false"
                : fmt::format("<diffusion_model> in {} of {} materials", count, s.materials.size()),
            any ? through->where : Location{}});
  const auto holds_water = [](const SolidMaterial& m) { return m.water.has_value(); };
  const auto wet = std::find_if(s.materials.begin(), s.materials.end(), holds_water);
  list.add({"water in pores", s.any_water(),
            s.any_water()
                ? fmt::format("coupled_flow_analysis, <porosity> in {} of {} materials",
                              std::count_if(s.materials.begin(), s.materials.end(), holds_water),
                              s.materials.size())
                : "no material of component shmpm contains water",
            s.any_water() ? wet->where : Location{}});
  const Vec3 g = scene.constants.gravity;
  list.add({"gravity", g != Vec3{}, fmt::format("gravity is [{:g}, {:g}, {:g}]", g.x, g.y, g.z),
            scene.constants.gravity_where});
  if (!s.implicit) add_pressure_stabilisation(s, list);
  if (!s.implicit) list.add(lost_energy_of(s));
  list.add(
      {"damping", s.damping > 0, fmt::format("artificial_damping_coeff is {:g}", s.damping), {}});
  list.add(activation_of(s));
  return list;
}

}  // namespace sluice::mpm
