// Area of a particle that faces the fluid, from its exposed faces.
//
// Where a lattice of particles makes stairs of a surface, corners count too much: what counts is
// the length of the sum of area vectors, |N_x + N_y + N_z|, where a particle exposed on both sides
// of an axis has the difference of the two. Flat surfaces, stairs under 45 degrees and thin sheets
// are exact, stairs of other slopes within 8 %; faces that curve with the body count as they are.
// Areas in m^2, flows in kg/s.
#pragma once
#include <array>
#include <cmath>

#include "models/burn/burn_law.hpp"
#include "mpmice/geometry/corner_table.hpp"

namespace sluice::mpmice {

template <int D>
class ExposedArea {
 public:
  using Surface = models::BurningSurface;
  // A piece of face 2 axis + side with this area vector, and what burns there.
  void add(int face, const std::array<double, D>& area, const Surface& surface) {
    double size = 0;
    for (std::size_t d = 0; d < D; ++d) {
      sums_[face][d] += area[d];
      size += area[d] * area[d];
    }
    size = std::sqrt(size);
    all_ += size;
    flow_ += size * surface.flux;
    if (!(surface.flux > 0)) return;
    burning_ += size;
    heat_ += size * surface.temperature;
  }
  // Mean over the pieces that burn; no flux: none does.
  Surface burning() const {
    return burning_ > 0 ? Surface{heat_ / burning_, flow_ / burning_} : Surface{};
  }
  // Mass per time.
  double flow() const {
    if (!(all_ > 0)) return 0.0;
    std::array<double, D> sum{};
    for (std::size_t a = 0; a < D; ++a)
      for (std::size_t d = 0; d < D; ++d) {
        const double low = sums_[2 * a][d], high = sums_[2 * a + 1][d];
        sum[d] += opposite(a) ? high - low : high + low;
      }
    double size = 0;
    for (const double s : sum) size += s * s;
    return flow_ / all_ * std::sqrt(size);
  }

 private:
  // Do the two sides of an axis look away from each other.
  bool opposite(std::size_t a) const {
    double product = 0;
    for (std::size_t d = 0; d < D; ++d) product += sums_[2 * a][d] * sums_[2 * a + 1][d];
    return product < 0;
  }
  std::array<std::array<double, D>, 2 * D> sums_{};
  double all_ = 0, flow_ = 0, burning_ = 0, heat_ = 0;
};

}  // namespace sluice::mpmice
