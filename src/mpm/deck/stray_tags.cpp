// What decks of solids carry and no solid reads: dropped before the deck is checked, each with one
// warning that names its line.
#include <fmt/format.h>

#include <algorithm>

#include "framework/deck/faults.hpp"
#include "mpm/deck/implicit.hpp"

namespace sluice::mpm {
namespace {

struct Stray {
  const char* name;
  const char* reason;
};

constexpr const char* implicit = "only the implicit method reads it";
constexpr const char* no_limit = "velocities are not limited: steps are limited";

// Of implicit steps, in decks of explicit ones.
constexpr Stray stray_flags_of_explicit[] = {
    {"dynamic", implicit},
    {"solver", implicit},
    {"convergence_criteria_disp", implicit},
    {"convergence_criteria_energy", implicit},
    {"DoImplicitHeatConduction", implicit},
    {"DoTransientImplicitHeatConduction", implicit},
    {"DoMechanics", implicit},
    {"temperature_solve", implicit},
    {"interpolateParticleTempToGridEveryStep", implicit},
    {"delT_decrease_factor", implicit},
    {"delT_increase_factor", implicit},
    {"num_iters_to_decrease_delT", implicit},
    {"num_iters_to_increase_delT", implicit},
    {"iters_before_timestep_restart", implicit},
    {"extra_solver_flushes", implicit},
};
constexpr Stray stray_flags[] = {
    {"maximum_particle_velocity", no_limit},
    {"DoCapDensity", "no method uses it"},
    {"DoDefGradAveraging", "no method uses it"},
    {"computeNodalHeatFlux", "save g.HeatFlux: it is computed where it is saved"},
    {"use_volume_integral", "no method uses it"},
    {"testForNegTemps_mpm", "an inadmissible state ends the run in any case"},
};
// Of fluids with solids, and of methods that are refused by the flag that turns them on.
constexpr Stray stray_flags_alone[] = {
    {"do_auto_cycle_bc", "only do_scalar_diffusion reads it"},
    {"auto_cycle_use_minmax", "only do_scalar_diffusion reads it"},
    {"auto_cycle_max", "only do_scalar_diffusion reads it"},
    {"auto_cycle_min", "only do_scalar_diffusion reads it"},
};
constexpr Stray stray_contact[] = {
    {"vel_fields", "materials have separate velocity fields"},
};
constexpr Stray stray_state[] = {
    {"density", "a solid's density is that of its material"},
    {"pressure", "a solid's pressure follows from its law"},
};
constexpr Stray stray_concentration[] = {
    {"concentration", "only do_scalar_diffusion reads it"},
};
constexpr Stray stray_diffusion[] = {
    {"diffusion_model", "only do_scalar_diffusion reads it"},
    {"diffusion_interface", "only do_scalar_diffusion reads it"},
};

template <class Table>
void drop(DeckNode& parent, const Table& table, std::vector<Fault>& faults) {
  std::erase_if(parent.children, [&](const std::unique_ptr<DeckNode>& child) {
    const auto row = std::find_if(std::begin(table), std::end(table),
                                  [&](const Stray& s) { return child->name == s.name; });
    if (row == std::end(table)) return false;
    add_warning(faults, child->where,
                fmt::format("<{}> in <{}> has no effect; dropped", child->name, parent.name),
                row->reason);
    return true;
  });
}

// Calls f for every <MPM> in <MaterialProperties>.
template <class F>
void for_blocks_of_materials(DeckNode& root, F&& f) {
  for (const auto& properties : root.children) {
    if (properties->name != "MaterialProperties") continue;
    if (DeckNode* mpm = properties->child("MPM")) f(*mpm);
  }
}

}  // namespace

void drop_stray_blocks(DeckNode& root, std::vector<Fault>& faults) {
  constexpr Stray blocks[] = {{"CFD", "only solids run here, without a fluid"},
                              {"Models", "models act on fluids; no fluid runs here"}};
  constexpr Stray in_materials[] = {{"ICE", "only solids run here, without a fluid"},
                                    {"exchange_properties", "no fluid runs here to exchange with"}};
  constexpr Stray in_refinement[] = {{"ICE", "only solids run here, without a fluid"}};
  if (!runs_mpm(root)) return;
  drop(root, blocks, faults);
  for (const auto& block : root.children) {
    if (block->name == "MaterialProperties") drop(*block, in_materials, faults);
    if (block->name == "AMR") drop(*block, in_refinement, faults);
  }
}

void drop_stray_flags(DeckNode& root, std::vector<Fault>& faults) {
  if (!runs_solids(root)) return;
  if (DeckNode* flags = root.child("MPM")) {
    drop(*flags, stray_flags, faults);
    if (!runs_implicit(root)) drop(*flags, stray_flags_of_explicit, faults);
    const auto on = [&](const char* name) {
      const DeckNode* node = flags->child(name);
      return node != nullptr && node->text == "true";
    };
    const bool more = on("coupled_flow_analysis") || on("do_scalar_diffusion");
    if (runs_mpm(root) && !more) drop(*flags, stray_flags_alone, faults);
  }
  for_blocks_of_materials(root, [&](DeckNode& mpm) {
    for (const auto& child : mpm.children)
      if (child->name == "contact") drop(*child, stray_contact, faults);
  });
}

void drop_stray_state(DeckNode& root, std::vector<Fault>& faults) {
  if (!runs_solids(root)) return;
  const DeckNode* flags = root.child("MPM");
  const DeckNode* diffuses = flags == nullptr ? nullptr : flags->child("do_scalar_diffusion");
  const bool spreads = diffuses != nullptr && diffuses->text != "false";
  for_blocks_of_materials(root, [&](DeckNode& mpm) {
    if (!spreads) drop(mpm, stray_diffusion, faults);
    for (const auto& material : mpm.children) {
      if (!spreads) drop(*material, stray_diffusion, faults);
      for (const auto& object : material->children)
        if (object->name == "geom_object") {
          drop(*object, stray_state, faults);
          if (!spreads) drop(*object, stray_concentration, faults);
        }
    }
  });
}

void rename_new_labels(DeckNode& root, std::vector<Fault>& faults) {
  DeckNode* archiver = root.child("DataArchiver");
  if (archiver == nullptr || !runs_solids(root)) return;
  for (const auto& save : archiver->children)
    for (auto& [name, value] : save->attributes) {
      if (name != "label" || !value.starts_with("p.") || !value.ends_with("+")) continue;
      value.pop_back();
      add_warning(faults, save->where,
                  fmt::format("<save label=\"{}+\">: {} is saved, which is its value after a step",
                              value, value));
    }
}

}  // namespace sluice::mpm
