// Particles as closed bodies with corners at the start and at the end of a step.
#pragma once
#include <cstddef>
#include <cstdint>

#include "mpmice/geometry/outer_faces.hpp"

namespace sluice::mpmice {

template <int D>
struct SolidParticles {
  CornerColumns<D> start, end;  // lengths; alike where the particles do not move
  CellUnits<D> units = CellUnits<D>::none();
  std::size_t count = 0;
  const double* filled = nullptr;         // the part of each that is solid; null: all of it
  const std::uint8_t* dropped = nullptr;  // 1: the particle is no longer there; null: all are

  const CornerColumns<D>& corners(When when) const { return when == When::start ? start : end; }
  double part(std::size_t p) const { return filled == nullptr ? 1.0 : filled[p]; }
  bool is_there(std::size_t p) const { return dropped == nullptr || dropped[p] == 0; }
};

}  // namespace sluice::mpmice
