// Values at a point from those at cell centres, linear along each direction between the two
// nearest: second order. Uniform fields are met exactly, mirrored ones give mirrored bits.
#pragma once
#include <cmath>

#include "framework/particle/particle_map.hpp"

namespace sluice {

struct PointStencil {
  IntVec3 cell{};   // that holds the point
  IntVec3 aside{};  // to the neighbour on the point's side of the centre; 0: direction not active
  Vec3 share{};     // weight of the neighbour, 0 to 1/2

  IndexBox cells() const {
    return {min(cell, cell + aside), max(cell, cell + aside) + IntVec3::all(1)};
  }
};

// `point`: m.
inline PointStencil stencil_at(const Level& level, Vec3 point) {
  PointStencil s;
  s.cell = cell_at(level, point);
  const Vec3 centre = level.centre(s.cell);
  for (int d = 0; d < 3; ++d) {
    if (!level.active[d]) continue;
    const double offset = (point[d] - centre[d]) / level.spacing[d];
    s.aside[d] = offset < 0 ? -1 : 1;
    s.share[d] = std::fabs(offset);
  }
  return s;
}

// `at`: the value of a cell, a number or a triple.
template <class At>
auto interpolate(const PointStencil& s, At&& at) {
  const auto between = [](auto a, auto b, double share) { return a + share * (b - a); };
  const auto along_x = [&](IntVec3 c) {
    const auto here = at(c);
    return s.aside.x == 0 ? here : between(here, at(c + IntVec3{s.aside.x, 0, 0}), s.share.x);
  };
  const auto along_y = [&](IntVec3 c) {
    const auto here = along_x(c);
    return s.aside.y == 0 ? here : between(here, along_x(c + IntVec3{0, s.aside.y, 0}), s.share.y);
  };
  const auto here = along_y(s.cell);
  return s.aside.z == 0 ? here
                        : between(here, along_y(s.cell + IntVec3{0, 0, s.aside.z}), s.share.z);
}

}  // namespace sluice
