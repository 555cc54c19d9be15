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

// Errors against the motions whose options are given.
std::vector<ClassicOption> puda_motion_options();
void puda_motions(const Archive& archive, const ClassicArguments& arguments,
                  const PudaRequest& request);

void puda_particles_in_cell(const Archive& archive, const PudaRequest& request, IntVec3 cell);
// Cells along an axis, at two indices across it.
struct ParticleLine {
  int axis = 0, first = 0, second = 0;
  bool average = true;        // over the particles of a cell; else its first particle
  bool split_stress = false;  // pressure and equivalent stress in place of nine components
};
void puda_particles_on_line(const Archive& archive, const PudaRequest& request,
                            const ParticleLine& line);

}  // namespace sluice
