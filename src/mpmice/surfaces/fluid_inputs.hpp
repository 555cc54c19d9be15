// What solids do to cells and faces, into the work slots of the sweep of the fluid: ghost cells
// too, beyond the sides of the domain as in a mirror.
#pragma once
#include "framework/field/warehouse.hpp"
#include "mpmice/surfaces/mean_motion.hpp"

namespace sluice::mpmice {

// A cell of a box, or its low face along a direction, and the place in the arrays that it sees;
// `flipped`: a face in a mirror, along which velocities turn.
struct SeenPlace {
  IntVec3 cell;
  std::size_t at = 0;
  bool flipped = false;
};

// Those of a box with its ghosts, and parts of it in which all of them are.
struct SeenPlaces {
  KeptArray<SeenPlace> places;
  std::vector<IndexBox> parts;
};

template <int D>
class FluidInputs {
 public:
  // Into a state; `place`: of the first fluid's material. `wall_pressure`: by cell, Pa.
  FluidInputs(const NearCells<D>& near, const SolidGeometry<D>& solid, const MeanMotion<D>& motion,
              const Column& wall_pressure)
      : near_(near), solid_(solid), motion_(motion), wall_pressure_(wall_pressure) {}
  void write(Warehouse& state, int place) const;

 private:
  KeptArray<std::uint8_t> blocks_to_write() const;
  bool sees_any(const CellBox<D>& part, const KeptArray<std::uint8_t>& blocks) const;
  SeenPlaces places_seen(const IndexBox& box, int along,
                         const KeptArray<std::uint8_t>& blocks) const;

  const NearCells<D>& near_;
  const SolidGeometry<D>& solid_;
  const MeanMotion<D>& motion_;
  const Column& wall_pressure_;
};

}  // namespace sluice::mpmice
