// Walls of solids that are light beside the fluid (the added mass of explicit steps).
//
//   b = max(0, 1 - rho_s h/(z dt)),  h = 1/sum_d |nhat_d|/dx_d,  z = rho c
// tells how light a wall is: 0 where a layer of the solid one cell thick is heavier than the fluid
// that sound crosses in a step, near 1 where it is next to nothing. In p_w of light walls
// (wall_pressure.cpp)
//   - the solid's side of the Riemann problem counts whole, however little surface lies in the
//     cell: |n| + (1 - |n|) b for |n|. Of the fluid's own pressure, which answers at once to what
//     the wall gives way, 1 - |n| would act on that mass, and grow step by step;
//   - p_s becomes, by its share b, that of the mean stress in the cells around. A light solid is
//     thrown back by heavy fluid as by a rigid wall. There the stress of its outermost particles is
//     larger than the mean over the layer that the nodes feel, by (k h)^2/6 of a wave, which gains
//     energy then. The mean over cells on both sides of that layer loses a little.
// Where b = 0 no bit is another.
#pragma once
#include "mpmice/walls/smooth_normals.hpp"

namespace sluice::mpmice {

template <int D>
class LightWalls {
 public:
  explicit LightWalls(bool implicit) : implicit_(implicit) {}

  // `impedance`: the largest z/rho_s of all walls on all ranks, m/s; walls are light only where it
  // crosses a cell in dt. Of semi-implicit steps any may be.
  void begin(const Frame<D>& frame, double impedance, double dt) {
    may_be_light_ = implicit_ || impedance * dt * most_cells_in_a_length(frame) > 1;
  }
  // `z`: what the fluid of a cell resists with, by cell, kg/(m^2 s); 0 where no wall is. Collective
  // where walls may be light.
  void find(const NearCells<D>& near, const SolidSets<D>& sets, const OnSurfaces<D>& surface,
            const SmoothNormals<D>& normals, const Column& z, double dt, Communicator& ranks);
  bool may_be_light() const { return may_be_light_; }
  // Of a wall: b; the pressure in the solid behind it where b > 0, Pa.
  double lightness(std::size_t i) const { return may_be_light_ ? lightness_[i] : 0.0; }
  double pressure_behind(std::size_t i) const { return behind_[i]; }

  static constexpr int columns = 2;

 private:
  static constexpr int stresses = D * (D + 1) / 2;  // components of a symmetric tensor
  using InCells = std::array<Column, 1 + stresses>;
  struct Scales {
    double volume = 0, stress = 0;
  };
  Scales largest_of(const Frame<D>& frame, const SolidSets<D>& sets, Communicator& ranks) const;
  void add(const Frame<D>& frame, const SolidSet<D>& s, const Scales& most,
           CellSums<D>& sums) const;
  void find_behind(const NearCells<D>& near, const SolidSets<D>& sets, const OnSurfaces<D>& surface,
                   const SmoothNormals<D>& normals, Communicator& ranks);

  bool implicit_;
  bool may_be_light_ = false;
  Column lightness_, behind_;
};

}  // namespace sluice::mpmice
