// What a step holds of each material: volume, mass, momentum.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "framework/archive/archive.hpp"

namespace sluice {

struct MaterialSums {
  int material = 0;
  bool particles = false;              // sums over particles, else over cells
  std::optional<double> volume, mass;  // m^3, kg; none: the labels for it are not saved
  std::optional<Vec3> momentum;        // kg m/s
  std::vector<std::string> missing;    // what to save for those that are not there
};

// Exact sums over cells, each place once, on the finest level there (rho_CC, vel_CC, and
// vol_frac_CC or sp_vol_CC), and over particles (p.volume, p.mass, p.velocity). `alone`: the run
// has this one material, so that it fills the cells. Materials without a label for any of these are
// left out.
std::vector<MaterialSums> material_sums(const ArchiveStep& step, bool alone);

}  // namespace sluice
