// What the donors of a row of faces hold of each material, and the shares that pass.
//
// Values of the low cell (a) and the high cell (b) of each face; the donor is the upwind one. The
// numbered steps are those of remap_fluxes.cpp. The rows of fluxes hold what is not yet a flux
// between the steps: theta of volume, then what is carried.
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
  In density, specific_energy;   // old, per own volume
  In energy_L, specific_energy_L, scale, lagrangian, base;
};
MaterialHandles read_materials(TaskBuilder& task, const Variables& v, const SchemeOptions& o,
                               int axis);

class FaceShares {
 public:
  // `row` must outlive it.
  FaceShares(const Row& row, const RemapFluxHandles& common, const MaterialHandles& materials,
             Out flux, const SchemeOptions& options, int axis, double l);

  void propose_volumes();        // step 1
  void close_volumes();          // step 2
  void keep_traces_together();   // step 3
  void carry_mass_and_energy();  // steps 4, 5: fluxes of volume, mass and energy (without K)

 private:
  void propose(int m);
  void trace_rules(int m);
  void carry(int m);
  double* theta(int m) const { return (*row_)(flux_, component(m, of_volume)); }
  double* mass(int m) const { return (*row_)(flux_, component(m, of_mass)); }
  double* energy(int m) const { return (*row_)(flux_, component(m, of_energy)); }
  Pair cells(In in, int component = 0) const { return pair_of(*row_, in, component, axis_); }
  Pair volume_of(int m) const { return cells(materials_->volume[static_cast<std::size_t>(m)]); }

  const Row* row_;
  const RemapFluxHandles* common_;
  const MaterialHandles* materials_;
  const SchemeOptions* options_;
  Out flux_;
  int axis_, n_, count_;
  bool based_;
  double l_;
  const double* uf_;
  Pair iJ_, N_, iN_, mask_, J_, outlets_;
};

}  // namespace sluice::ice::mixture
