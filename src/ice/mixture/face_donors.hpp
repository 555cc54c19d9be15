// What passes the faces of a row of each material: the shares of the volume, and what they carry.
//
// Values of the low cell (a) and the high cell (b) of each face; the donor is the upwind one. The
// numbered steps are those of remap_fluxes.cpp. Only the materials present around the faces take
// part.
#pragma once
#include "ice/mixture/tasks.hpp"
#include "ice/one_material/remap_flux_rows.hpp"
#include "ice/step/material_runs.hpp"

namespace sluice::ice::mixture {

// A cell variable in both cells of each face, in its unit. Left without values when declared: there
// are many.
struct Pair {
  const double *a, *b;
  // Both are loaded: a choice between addresses would keep rows from vectorising.
  double at(int i, bool left) const {
    const double low = a[i], high = b[i];
    return left ? high : low;
  }
  Pair from(int first) const { return {a + first, b + first}; }
};

inline Pair pair_of(const Row& row, In in, int component, int axis) {
  return {row(in, component, axis, -1), row(in, component)};
}

struct MaterialHandles {
  std::vector<In> mass, volume, energy;  // old state
  In presence, pure;
  In energy_L, specific_energy_L, scale, stretch, base;
  In strain;  // where the materials of a cell relax before the remap
  In alike;   // of a mixed gas
  In blend, blend_density, blend_energy;
};
MaterialHandles read_materials(TaskBuilder& task, const DonorsInput& v, const SchemeOptions& o,
                               int axis);
// Where faces between blends have loops of their own.
void read_blends(TaskBuilder& task, const BlendInput& v, int axis, const SchemeOptions& o,
                 MaterialHandles& h);

// The rows of one material, looked up once for all faces of a row. V: fraction, M: kg/m^3 and E:
// J/m^3 are per volume of the cell, densities and energies of the material itself per its own
// volume. Pairs are the low and the high cell of each face.
struct MaterialFaceRows {
  const double* V[6];         // volume fraction of cells -3 .. 2
  const double *M[4], *E[4];  // state of cells -2 .. 1
  Around r, e;                // density and energy per own volume, of blends alone
  // After the Lagrangian phase: energy per cell and per own volume, the scale (p + pi)/G; J/m^3.
  const double *energy_L[2], *eps_L[2], *scale[2];
  const double *base_V[2], *base_r[2], *base_e[2];  // offered to the remap: fraction, kg/m^3, J/m^3
  const double* alike[2];                           // 0 or 1, of a mixed gas, else null
  // Where the materials of a cell relax before, else null: r_m, 1/(J r_m), without unit.
  const double *strain[2], *iJ[2];
  double *FV, *FM, *FE;  // what passes, per volume of a cell: fraction, kg/m^3, J/m^3
};

class MaterialFaces {
 public:
  // l: dt/dx along the axis, s/m.
  MaterialFaces(const Row& row, const RemapFluxHandles& common, const MaterialHandles& materials,
                Out flux, const SchemeOptions& options, int axis, double l);

  // Fluxes of volume, mass and energy (without the correction of the kinetic energy) of each
  // material through `count` faces, at most `max_faces`. Returns the set of materials that may
  // pass; fluxes of others are zero.
  static constexpr int max_faces = 128;
  std::uint64_t carry(int first, int count);
  double* flux(int m, Carried q) const {
    return q == of_volume ? rows_[m].FV : q == of_mass ? rows_[m].FM : rows_[m].FE;
  }

 private:
  template <bool Second, bool Masked, int Lanes, bool Blend, bool Strained>
  friend class FaceShares;

  void bind(int m);
  std::uint64_t materials_around(int first, int count) const;
  std::uint64_t blend_around(int first, int count) const;
  void nothing_passes(int m, int first, int count) const;

  const Row& row_;
  const MaterialHandles& h_;
  const SchemeOptions& options_;
  Out flux_;
  int axis_, materials_;
  bool based_;
  double l_;
  std::uint64_t bound_ = 0;  // materials whose rows were looked up
  const double* uf_;
  const double* presence_[6];
  RunRow blend_[6];  // likewise
  Pair iJ_, N_, iN_, mask_{}, J_, outlet_;
  MaterialFaceRows rows_[max_materials];
};

}  // namespace sluice::ice::mixture
