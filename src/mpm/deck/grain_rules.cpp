// What must hold where <DoGranularMPM> is true, and what its tags say in vain where it is not.
#include <fmt/format.h>

#include <array>

#include "framework/deck/faults.hpp"
#include "framework/deck/rule_tools.hpp"
#include "mpm/deck/bases.hpp"
#include "mpm/deck/schema.hpp"

namespace sluice::mpm {
namespace {

constexpr std::array<std::pair<const char*, double>, 3> stretches = {
    {{"GranularMPMVcrix", 1.04}, {"GranularMPMVcriy", 1.04}, {"GranularMPMVcriz", 1.0}}};

// What particles with velocity fields of their own have no form with.
void check_company(const DeckNode& root, const DeckNode& flags, std::vector<Fault>& faults) {
  const Location& where = flags.child("DoGranularMPM")->where;
  const auto refuse = [&](bool asked, const char* what) {
    if (asked) add_not_built(faults, where, fmt::format("<DoGranularMPM> true {}", what));
  };
  const DeckNode* integrator = flags.child("time_integrator");
  const DeckNode* grid = root.child("Grid");
  refuse(!runs_mpm(root), "with a fluid");
  refuse(runs_single_field(root), "if all materials have one velocity");
  refuse(integrator != nullptr && integrator->text == "implicit", "in implicit steps");
  refuse(is_true(&flags, "total_lagrangian"), "with <total_lagrangian>");
  refuse(is_true(&flags, "use_cohesive_zones"), "with <use_cohesive_zones>");
  refuse(is_true(&flags, "UsePrescribedDeformation"), "with <UsePrescribedDeformation>");
  refuse(basis_of(flags).moving_corners, "with corners that are carried");
  refuse(
      (grid != nullptr && grid->all("Level").size() > 1) || root.find("AMR/Regridder") != nullptr,
      "on several levels");
}

// Grains that touch as they are seeded.
void check_touch(const DeckNode& root, const DeckNode& flags, std::vector<Fault>& faults) {
  double product = 1;
  for (const auto& [name, otherwise] : stretches)
    product *= real_of(&flags, name).value_or(otherwise);
  for (const DeckNode* material : mpm_materials(root)) {
    const auto density = real_of(material, "density"),
               critical = real_of(material, "critical_density");
    if (density && critical && *critical >= *density)
      add_error(faults, material->child("critical_density")->where,
                fmt::format("<critical_density> {:g} is not below <density> {:g}: no two grains "
                            "would be in contact at the start",
                            *critical, *density),
                "give the density at which grains lose contact");
    if (!critical && product <= 1) {
      add_error(faults, material->where,
                fmt::format("no <critical_density>, and GranularMPMVcrix, y and z have the product "
                            "{:g}: no two grains would be in contact at the start",
                            product),
                "give the density at which grains lose contact");
      return;
    }
  }
}

}  // namespace

void check_grains(const DeckNode& root, std::vector<Fault>& faults) {
  const DeckNode* flags = root.child("MPM");
  if (flags == nullptr || !runs_solids(root)) return;
  if (is_true(flags, "DoGranularMPM")) {
    check_company(root, *flags, faults);
    check_touch(root, *flags, faults);
    return;
  }
  for (const auto& [name, otherwise] : stretches)
    if (const auto value = real_of(flags, name); value && *value != otherwise)
      add_warning(faults, flags->child(name)->where,
                  fmt::format("<{}> has no effect without <DoGranularMPM> true", name),
                  "remove it");
}

}  // namespace sluice::mpm
