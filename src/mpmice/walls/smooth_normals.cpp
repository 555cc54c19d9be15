#include "mpmice/walls/smooth_normals.hpp"

#include <cmath>

namespace sluice::mpmice {

template <int D>
void SmoothNormals<D>::find(const NearCells<D>& near, const SolidGeometry<D>& solid,
                            const OnSurfaces<D>& surface) {
  const Frame<D>& frame = near.frame();
  for (Column& n : n_) n.assign(near.size(), 0.0);
  near.for_each_at_once([&](const Cell<D>& c, std::size_t i) {
    if (!(surface.area[i] > 0)) return;
    constexpr int around = D == 1 ? 3 : D == 2 ? 9 : 27;
    for (int n = 0; n < around; ++n) {
      Cell<D> other = c;
      double weight = 1;
      for (int d = 0, rest = n; d < D; ++d, rest /= 3) {
        const int step = rest % 3 - 1;
        other[static_cast<std::size_t>(d)] += step;
        weight *= step == 0 ? 2 : 1;
      }
      other = frame.wrapped(other);
      if (!frame.in_domain(other)) continue;
      const std::size_t j = frame.cells.index(other);
      if (!solid.wet(j)) continue;
      for (std::size_t d = 0; d < D; ++d)
        n_[d][i] += weight * solid.normal[d][j] *
                    (frame.face_area(static_cast<int>(d)) / frame.largest_face());
    }
  });
}

template <int D>
double SmoothNormals<D>::length(std::size_t i) const {
  double size = 0;
  for (std::size_t d = 0; d < D; ++d) size += n_[d][i] * n_[d][i];
  return std::sqrt(size);
}

template <int D>
double SmoothNormals<D>::cells_along(const Frame<D>& frame, std::size_t i, double size) const {
  double cells = 0;
  for (std::size_t d = 0; d < D; ++d)
    cells += std::fabs(n_[d][i]) / size / frame.spacing[frame.direction[d]];
  return cells;
}

template <int D>
std::size_t SmoothNormals<D>::largest(std::size_t i) const {
  std::size_t along = 0;
  for (std::size_t d = 1; d < D; ++d)
    if (std::fabs(n_[d][i]) > std::fabs(n_[along][i])) along = d;
  return along;
}

template class SmoothNormals<1>;
template class SmoothNormals<2>;
template class SmoothNormals<3>;

}  // namespace sluice::mpmice
