// What puda's options print, one file each.
#pragma once
#include "app/classic/classic_archive.hpp"

namespace sluice {

struct PudaRequest {
  OutputRange outputs;
  int material = -1;  // all
  bool brief = false, extra_cells = true;
  std::string particle_variable;
};

void puda_grid_stats(const Archive& archive, const PudaRequest& request);
void puda_particle_variable(const Archive& archive, const PudaRequest& request);
void puda_summary(const Archive& archive, const PudaRequest& request);

}  // namespace sluice
