// What passes a row of faces of each material: the shares of the volume, and what they carry.
//
// Values of the low cell (a) and the high cell (b) of each face; the donor is the upwind one. The
// numbered steps are those of remap_fluxes.cpp. Only the materials present around the faces take
// part. Cells of pure neighbourhood keep no arrays of their own by material: there the mixture's
// are the material's.
#pragma once
#include "ice/conservative/remap_flux_rows.hpp"
#include "ice/mixture/variables.hpp"

namespace sluice::ice::mixture {

// A cell variable in both cells of each face.
struct Pair {
  const double *a = nullptr, *b = nullptr;
  double at(int i, bool left) const { return left ? b[i] : a[i]; }
};

inline Pair pair_of(const Row& row, In in, int component, int axis) {
  return {row(in, component, axis, -1), row(in, component)};
}

struct MaterialHandles {
  std::vector<In> mass, volume;  // old state
  In presence, pure;
  In density, specific_energy;  // old, per own volume
  In energy_L, specific_energy_L, scale, lagrangian, base;
  // The same of the mixture, for cells of pure neighbourhood.
  In mixture_density, mixture_energy, mixture_energy_star, mixture_energy_L, mixture_scale;
  In mixture_base;
};
MaterialHandles read_materials(TaskBuilder& task, const Variables& v, const SchemeOptions& o,
                               int axis);

// Fluxes of volume, mass and energy (without the correction of the kinetic energy) of each material
// through the faces of a row, at most `most_faces`.
constexpr int most_faces = 64;
void carry_materials(const Row& row, const RemapFluxHandles& common,
                     const MaterialHandles& materials, Out flux, const SchemeOptions& options,
                     int axis, double l);

}  // namespace sluice::ice::mixture
