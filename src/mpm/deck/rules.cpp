// What must hold between the flags of a deck of solids.
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "framework/deck/faults.hpp"
#include "framework/deck/rule_tools.hpp"
#include "mpm/deck/bases.hpp"
#include "mpm/deck/implicit.hpp"

namespace sluice::mpm {
namespace {

std::string text_of(const DeckNode& parent, std::string_view name) {
  const DeckNode* child = parent.child(name);
  return child == nullptr ? "" : child->text;
}

// Does the deck write a flag, other than its default: an archive's deck writes all defaults too.
bool says(const DeckNode& flags, std::string_view name) {
  if (!flags.has(name)) return false;
  static const TagSpec all = flags_tag();
  const auto flag = std::find_if(all.children.begin(), all.children.end(),
                                 [&](const TagSpec& t) { return t.name == name; });
  return flag == all.children.end() || flag->value.default_text != text_of(flags, name);
}

void warn_of_idle(const DeckNode& flags, const char* name, const std::string& needs,
                  std::vector<Fault>& faults) {
  if (!says(flags, name)) return;
  add_warning(faults, flags.child(name)->where,
              fmt::format("<{}> has no effect without {}", name, needs), "remove it");
}

// Flags that turn on what is not built.
void check_not_built(const DeckNode& flags, bool implicit, std::vector<Fault>& faults) {
  if (!implicit && text_of(flags, "do_grid_reset") == "false")
    add_not_built(faults, flags.child("do_grid_reset")->where, "<do_grid_reset> false");
  if (implicit && is_true(&flags, "do_scalar_diffusion"))
    add_not_built(faults, flags.child("do_scalar_diffusion")->where,
                  "<do_scalar_diffusion> in implicit steps");
}

// The axisymmetric form: one cell along the angle, radii from 0 on.
void check_axisymmetric(const DeckNode& root, const DeckNode& flags, std::vector<Fault>& faults) {
  if (!is_true(&flags, "axisymmetric")) return;
  const Location& where = flags.child("axisymmetric")->where;
  if (!basis_of(flags).axisymmetric)
    add_error(faults, where,
              fmt::format("<axisymmetric> is not supported with the interpolator {}",
                          basis_of(flags).word),
              "valid: " + bases_with(&BasisRow::axisymmetric));
  const DeckNode* level = root.find("Grid/Level");
  if (level == nullptr) return;
  for (const DeckNode* box : level->all("Box")) {
    const auto cells = int_vector_of(box, "resolution");
    if (cells && cells->z != 1)
      add_error(faults, where,
                fmt::format("<axisymmetric> needs one cell along z, the angle; the box at {} has "
                            "{}",
                            to_string(box->where), cells->z));
    const auto lower = vector_of(box, "lower");
    if (lower && lower->x < 0)
      add_error(faults, where,
                fmt::format("<axisymmetric>: x is the radius; the box at {} begins at x = {:g}",
                            to_string(box->where), lower->x),
                "begin at x = 0 or above");
  }
}

void check_files(const DeckNode& flags, std::vector<Fault>& faults) {
  const bool prescribed = is_true(&flags, "UsePrescribedDeformation");
  if (!prescribed) {
    warn_of_idle(flags, "PrescribedDeformationFile", "<UsePrescribedDeformation> true", faults);
    if (is_true(&flags, "exactDeformation"))
      warn_of_idle(flags, "exactDeformation", "<UsePrescribedDeformation> true", faults);
  }
  const DeckNode* file = flags.child("InsertParticlesFile");
  if (is_true(&flags, "InsertParticles") && (file == nullptr || file->text.empty()))
    add_error(faults, flags.child("InsertParticles")->where,
              "<InsertParticles> needs <InsertParticlesFile>");
  if (is_true(&flags, "InsertParticles") && !is_true(&flags, "withColor"))
    add_error(faults, flags.child("InsertParticles")->where,
              "<InsertParticles> moves particles of a colour, but the particles of this deck have "
              "no colour",
              "write <withColor>true</withColor>");
}

void check_viscosity(const DeckNode& flags, std::vector<Fault>& faults) {
  if (is_true(&flags, "artificial_viscosity")) return;
  if (is_true(&flags, "artificial_viscosity_heating"))
    add_error(faults, flags.child("artificial_viscosity_heating")->where,
              "<artificial_viscosity_heating> without <artificial_viscosity>",
              "write <artificial_viscosity>true</artificial_viscosity>, or remove it");
  for (const char* name : {"artificial_viscosity_coeff1", "artificial_viscosity_coeff2"})
    warn_of_idle(flags, name, "<artificial_viscosity> true", faults);
}

}  // namespace

void check_solid_blocks(const DeckNode& root, std::vector<Fault>& faults) {
  const DeckNode* component = root.child("SimulationComponent");
  const std::string type =
      component == nullptr ? "" : component->attribute("type").value_or("none");
  if (!runs_solids(root)) {
    if (component == nullptr) return;
    for (const char* name : {"MPM", "PhysicalBC"})
      if (const DeckNode* block = root.child(name))
        add_warning(faults, block->where,
                    fmt::format("<{}> has no effect: the component {} has no solids", name, type),
                    "remove it, or write <SimulationComponent type=\"mpm\"/>");
    // Its materials would come first in every list of materials.
    for (const DeckNode* properties : root.all("MaterialProperties"))
      if (const DeckNode* block = properties->child("MPM"))
        add_error(faults, block->where,
                  fmt::format("materials of solids, and the component {} has none", type),
                  "remove them, or write <SimulationComponent type=\"mpm\"/>");
    return;
  }
  // The materials of a switcher stand in the decks that it names.
  if (mpm_materials(root).empty() && type != "switcher")
    add_error(faults, component->where,
              "no <MaterialProperties><MPM><material>: there are no solids");
}

void check_flags(const DeckNode& root, std::vector<Fault>& faults) {
  const DeckNode* flags = root.child("MPM");
  if (flags == nullptr || !runs_solids(root)) return;
  check_not_built(*flags, runs_implicit(root), faults);
  check_axisymmetric(root, *flags, faults);
  check_files(*flags, faults);
  check_viscosity(*flags, faults);
  const auto subcycles = integer_of(flags, "minimum_subcycles_for_F");
  if (subcycles && *subcycles == 0)
    add_error(faults, flags->child("minimum_subcycles_for_F")->where,
              "<minimum_subcycles_for_F> 0: particles would never be deformed",
              "1: first order; -2: up to the quadratic term");
  const BasisRow& basis = basis_of(*flags);
  if (!basis.cut_by_length) warn_of_idle(*flags, "cpdi_lcrit", "<interpolator> cpdi", faults);
  const DeckNode* grid = root.child("Grid");
  const bool levels =
      (grid != nullptr && grid->all("Level").size() > 1) || root.find("AMR/Regridder") != nullptr;
  if (basis.corners && levels)
    add_not_built(faults, flags->child("interpolator")->where,
                  fmt::format("<interpolator> {} on several levels", basis.word));
  if (basis.needs_three_directions && grid != nullptr)
    for (const DeckNode* level : grid->all("Level"))
      for (const DeckNode* box : level->all("Box")) {
        const auto cells = int_vector_of(box, "resolution");
        if (cells && (cells->x == 1 || cells->y == 1 || cells->z == 1))
          add_error(faults, box->where,
                    fmt::format("<interpolator> {}: tetrahedra need three directions of more than "
                                "one cell",
                                basis.word),
                    "all other interpolators also work with fewer");
      }
  if (is_true(flags, "refine_particles") && is_true(flags, "total_lagrangian"))
    add_not_built(faults, flags->child("refine_particles")->where,
                  "<refine_particles> with <total_lagrangian>");
  if (is_true(flags, "DoPressureStabilization") && is_true(flags, "total_lagrangian"))
    add_not_built(faults, flags->child("DoPressureStabilization")->where,
                  "<DoPressureStabilization> with <total_lagrangian>");
  if (is_true(flags, "total_lagrangian")) {
    const Location& where = flags->child("total_lagrangian")->where;
    if (!basis.total_lagrangian)
      add_error(faults, where,
                fmt::format("<total_lagrangian>: shape functions are those of the initial "
                            "positions, but those of {} follow the particles",
                            basis.word),
                "valid: " + bases_with(&BasisRow::total_lagrangian));
    if (levels) add_not_built(faults, where, "<total_lagrangian> on several levels");
  }
}

void check_cohesive_zones(const DeckNode& root, std::vector<Fault>& faults) {
  const DeckNode* flags = root.child("MPM");
  if (!runs_solids(root)) return;
  const bool act = is_true(flags, "use_cohesive_zones");
  const DeckNode* grid = root.child("Grid");
  if (act && ((grid != nullptr && grid->all("Level").size() > 1) || root.has("AMR")))
    add_not_built(faults, flags->child("use_cohesive_zones")->where,
                  "<use_cohesive_zones> on several levels");
  for (const DeckNode* properties : root.all("MaterialProperties")) {
    const DeckNode* block = properties->child("MPM");
    if (block == nullptr) continue;
    const std::vector<const DeckNode*> zones = block->all("cohesive_zone");
    if (!act && !zones.empty())
      add_warning(faults, zones.front()->where,
                  "<cohesive_zone> has no effect without <use_cohesive_zones> true in <MPM>: the "
                  "materials are not connected there",
                  "write <use_cohesive_zones>true</use_cohesive_zones>, or remove the zone");
    for (const DeckNode* zone : zones)
      if (act && is_true(zone, "do_rotation"))
        add_not_built(faults, zone->child("do_rotation")->where, "<do_rotation> true");
  }
}

// What the midpoint transfer has no form of.
static void check_midpoint(const DeckNode& flags, std::vector<Fault>& faults) {
  const DeckNode& transfer = *flags.child("transfer");
  if (basis_of(flags).points)
    add_error(faults, transfer.where,
              "<transfer> midpoint needs particles with a width, or splines; those of the "
              "interpolator linear are points",
              "write <interpolator>gimp</interpolator>, or remove <transfer>");
  const auto refuse = [&](const char* name) {
    if (is_true(&flags, name))
      add_error(faults, transfer.where,
                fmt::format("<transfer> midpoint and <{}> exclude each other", name),
                "remove one of them");
  };
  for (const char* name : without_midpoint) refuse(name);
  refuse("musl");
}

void check_transfer(const DeckNode& root, std::vector<Fault>& faults) {
  const DeckNode* flags = root.child("MPM");
  if (flags == nullptr || !runs_solids(root)) return;
  const std::string transfer = text_of(*flags, "transfer");
  if (transfer != "xpic") warn_of_idle(*flags, "xpic_order", "<transfer> xpic", faults);
  if (transfer != "affine") warn_of_idle(*flags, "affine_damping", "<transfer> affine", faults);
  const BasisRow& basis = basis_of(*flags);
  if (transfer == "apic" && !basis.one_second_moment)
    add_error(
        faults, flags->child("transfer")->where,
        fmt::format(
            "<transfer> apic needs a basis with a constant second moment, which {} does not have",
            basis.word),
        "write <interpolator>3rdorderBS</interpolator>, or <transfer>affine</transfer>");
  if (transfer == "midpoint" && runs_mpm(root)) check_midpoint(*flags, faults);
  if (is_true(flags, "musl") && (basis.moving_corners || !runs_mpm(root)))
    add_error(faults, flags->child("musl")->where,
              "<musl> true is not supported for corners that move with the grid, which particles "
              "have with a fluid and with the interpolator carried_corners",
              "remove it");
  // Tags of the format that choose a transfer too.
  for (const char* name : {"XPIC2", "UseGradientEnhancedVelocityProjection"})
    if (is_true(flags, name) && says(*flags, "transfer"))
      add_error(faults, flags->child(name)->where,
                fmt::format("<{}> and <transfer> both select the transfer of velocities", name),
                "remove one of them");
  if (is_true(flags, "XPIC2") && is_true(flags, "UseGradientEnhancedVelocityProjection"))
    add_error(faults, flags->child("XPIC2")->where,
              "<XPIC2> and <UseGradientEnhancedVelocityProjection> exclude each other",
              "remove one of them");
}

void check_solid_faces(const DeckNode& root, std::vector<Fault>& faults) {
  const DeckNode* grid = root.child("Grid");
  if (grid == nullptr || !runs_mpm(root)) return;
  // A deformation that a file prescribes asks for no face.
  if (is_true(root.child("MPM"), "UsePrescribedDeformation")) return;
  const DeckNode* conditions = grid->child("BoundaryConditions");
  const auto periodic = periodic_directions(*grid);
  std::array<bool, 6> given{};
  if (conditions != nullptr)
    for (const DeckNode* face : conditions->all("Face")) {
      if (face->child("BCType") == nullptr) continue;
      for (const auto& [name, value] : face->attributes) {
        const auto side = std::find(std::begin(side_names), std::end(side_names), value);
        if (side != std::end(side_names)) given[side - std::begin(side_names)] = true;
      }
    }
  std::string open;
  for (std::size_t side = 0; side < given.size(); ++side)
    if (!given[side] && !periodic[side / 2])
      open += fmt::format("{}{}", open.empty() ? "" : ", ", side_names[side]);
  if (open.empty()) return;
  add_warning(faults, conditions != nullptr ? conditions->where : grid->where,
              fmt::format("{} without conditions: particles leave through it",
                          open.size() == 2 ? "side " + open : "sides " + open),
              "write <Face side=\"x-\"> with <BCType id=\"all\" label=\"Symmetric\" "
              "var=\"symmetry\"/>, or with a velocity");
}

}  // namespace sluice::mpm
