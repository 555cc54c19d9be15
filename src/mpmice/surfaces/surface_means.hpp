// Means over the surface of solids in each cell: velocity, pressure -n.sigma.n, compliance
// 1/(rho c) and 1/rho of the particles behind it, by area; where it lies. Rigid bodies have neither
// compliance nor 1/rho.
#pragma once
#include "mpmice/surfaces/solid_sets.hpp"
#include "mpmice/surfaces/surface_pieces.hpp"

namespace sluice::mpmice {

// Arrays over the cells near solids.
template <int D>
struct OnSurfaces {
  Column area;                                   // largest faces of a cell
  Column pressure, compliance, inverse_density;  // Pa, m^2 s/kg, m^3/kg
  std::array<Column, D> velocity;                // m/s
  std::array<Column, D> place;                   // cells from the low corner; if fluids rub

  static constexpr int columns = 4 + 2 * D;
};

template <int D>
class SurfaceMeans {
 public:
  // `viscous`: somebody asks for the place of the surface.
  SurfaceMeans(const solids::CoupledSolids& solids, bool viscous)
      : solids_(&solids), viscous_(viscous) {}

  // Collective. `impedance`: the largest rho c of the fluid in this rank's cells, kg/(m^2 s). The
  // largest of all ranks over the density of the lightest surface, m/s (0: all are rigid).
  double find_scales(const Frame<D>& frame, const SolidSets<D>& sets, double impedance,
                     Communicator& ranks);
  // Of this rank's pieces; then from the sums of all ranks.
  void add(const NearCells<D>& near, const SolidSets<D>& sets);
  CellSums<D>& sums() { return sums_; }
  void finish(const Frame<D>& frame, OnSurfaces<D>& to);
  static constexpr int lane_count(bool viscous) { return viscous ? place + D : place; }

 private:
  // The largest values of surfaces in a step: velocity (m/s), stress (Pa), 1/(rho c), 1/rho.
  struct Scales {
    double velocity = 0, pressure = 0, compliance = 0, inverse_density = 0;
  };
  static constexpr int area = 0, pressure = 1, soft = 2, light = 3, velocity = 4,
                       place = velocity + D;
  void find_wave_speeds(const Frame<D>& frame);
  Scales largest_of(const Frame<D>& frame, const SolidSets<D>& sets) const;
  double compliance(const SolidSet<D>& s, std::size_t p) const;
  double inverse_density(const SolidSet<D>& s, std::size_t p) const;
  void add_pieces(const Frame<D>& frame, const SolidSet<D>& s, std::size_t begin, std::size_t end,
                  CellSums<D>& sums) const;

  const solids::CoupledSolids* solids_;
  bool viscous_;
  KeptArray<double> wave_;  // by kind: speed of waves, m/s
  CellSums<D> sums_;        // by area, in units of the scales
  Scales scales_;
};

}  // namespace sluice::mpmice
