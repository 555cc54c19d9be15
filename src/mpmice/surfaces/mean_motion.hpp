// Mass of the solids in cells beside fluid, and their velocity there.
//
// From a 2^D-th of each particle half way between its middle and each corner; velocities are those
// of the step, (x' - x)/dt.
#pragma once
#include "mpmice/surfaces/solid_geometry.hpp"
#include "mpmice/surfaces/solid_sets.hpp"

namespace sluice::mpmice {

template <int D>
class MeanMotion {
 public:
  // `looks_far`: somebody asks farther from fluid than the cells beside it (solves, and tracers,
  // which move with solids that overtake them).
  MeanMotion(const solids::CoupledSolids& solids, bool looks_far)
      : solids_(&solids), looks_far_(looks_far) {}

  // Of a step of dt that solids have taken. Collective.
  void find(const NearCells<D>& near, const SolidGeometry<D>& solid, const SolidSets<D>& sets,
            double dt, Communicator& ranks);
  // By cell: kg/m^3, m/s.
  const Column& mass() const { return mass_; }
  const Column& velocity(std::size_t a) const { return velocity_[a]; }
  // The velocity at the low faces of the cells along the n-th direction: the mean of both cells by
  // mass. Between cells that keep fluid faces have its velocity: 0 here.
  Column at_faces(std::size_t n, const NearCells<D>& near, const SolidGeometry<D>& solid) const;

  static constexpr int columns = 1 + D;

 private:
  CellMask cells_beside_fluid(const NearCells<D>& near, const SolidGeometry<D>& solid) const;
  double heaviest() const;
  double fastest_way(const Frame<D>& frame, double dt) const;
  // Particles begin to end - 1.
  struct Scales {
    double mass, speed;  // the largest, kg, m/s
  };
  void add(const Frame<D>& frame, const SolidSet<D>& s, const CellMask& beside, double dt,
           const Scales& most, std::size_t begin, std::size_t end, CellSums<D>& sums) const;

  const solids::CoupledSolids* solids_;
  bool looks_far_;
  CellSums<D> sums_;
  Column mass_;
  std::array<Column, D> velocity_;
};

}  // namespace sluice::mpmice
