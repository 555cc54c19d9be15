// Solids that part. A particle whose corners its neighbours have drawn out lets them go and goes on
// as a block of its own; one whose middle has left the domain lets them go too, and is dropped.
//
// The block has the particle's volume, middle, stress and motion; faces that it shared are outer
// faces from then on, its own and its neighbours'. No mass, momentum or energy changes.
#pragma once
#include "framework/run/component/event_ledger.hpp"
#include "mpmice/surfaces/solid_geometry.hpp"
#include "mpmice/surfaces/solid_sets.hpp"
#include "mpmice/surfaces/vanished_faces.hpp"
#include "solids/corner_volume.hpp"

namespace sluice::mpmice {

// Periods of the corners of particles near these cells.
template <int D>
Periods<D> periods_of(const Frame<D>& frame, const solids::CoupledSolids& solids);

template <int D>
class Separation {
 public:
  explicit Separation(const solids::CoupledSolids& solids) : solids_(&solids) {}

  // Behind the motion of the solids. What parts: its faces are in SolidSet::parted, its block has
  // the corners of the end of the step; what leaves is in SolidSet::dropped. All becomes the
  // particles' own when the step is accepted. False: nothing parts on any rank. Collective.
  bool part(const StageScope& scope, const NearCells<D>& near, SolidSets<D>& sets) const;

 private:
  struct Parting {
    SolidSet<D>* set;
    std::size_t p;
    solids::CornerVolume<D> corners;
  };
  bool may_part() const;
  void find(const Frame<D>& frame, SolidSets<D>& sets, std::vector<Parting>& torn,
            std::vector<Parting>& leaving) const;
  void become_block(const Frame<D>& frame, const Parting& torn) const;

  const solids::CoupledSolids* solids_;
};

}  // namespace sluice::mpmice
