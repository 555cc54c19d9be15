// A plate with one corrugated edge.
#include "framework/geometry/corrugated.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "framework/base/error.hpp"

namespace sluice {

CorrugatedPiece::CorrugatedPiece(const CorrugatedPlate& plate) : plate_(plate) {
  for (int d = 0; d < 2; ++d)
    if (!(plate.xymin[d] < plate.xymax[d]))
      throw InputError(fmt::format("corrugated: xymin {} is not below xymax {} in direction {}",
                                   plate.xymin[d], plate.xymax[d], "xy"[d]));
  if (!(plate.thickness > 0) || !(plate.wavelength > 0))
    throw InputError(
        fmt::format("corrugated: thickness {} and wavelength {}; both must be greater than 0",
                    plate.thickness, plate.wavelength));
  const int e = plate.edge_direction;
  const double width = plate.xymax[e] - plate.xymin[e];
  if (!(plate.amplitude > 0 && plate.amplitude < width))
    throw InputError(fmt::format(
        "corrugated: amplitude is {}; it must be greater than 0 and below the plate's width {}",
        plate.amplitude, width));
  bounds_ = {plate.xymin, {plate.xymax.x, plate.xymax.y, plate.xymin.z + plate.thickness}};
  if (plate.edge_plus)
    bounds_.upper[e] += plate.amplitude;
  else
    bounds_.lower[e] -= plate.amplitude;
  bounds_ = with_margin(bounds_);
}

bool CorrugatedPiece::inside(Vec3 p) const {
  const int e = plate_.edge_direction, along = 1 - e;
  if (p.z < plate_.xymin.z || p.z > plate_.xymin.z + plate_.thickness) return false;
  if (p[along] < plate_.xymin[along] || p[along] > plate_.xymax[along]) return false;
  const double phase = 2 * std::numbers::pi * p[along] / plate_.wavelength;
  const double wave = plate_.amplitude * (plate_.cosine ? std::cos(phase) : std::sin(phase));
  const double width = plate_.xymax[e] - plate_.xymin[e];
  // Distance from the opposite, straight edge: v = width - u is stretched by 1 +- wave / width.
  if (plate_.edge_plus) {
    const double v = p[e] - plate_.xymin[e];
    return v >= 0 && v <= width + wave;
  }
  const double v = plate_.xymax[e] - p[e];
  return v >= 0 && v <= width - wave;
}

}  // namespace sluice
