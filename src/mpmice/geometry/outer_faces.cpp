#include "mpmice/geometry/outer_faces.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

namespace sluice::mpmice {
namespace {

// The corners of faces begin to end - 1, one column after the other.
template <int D>
void put(typename OuterFaces<D>::Places& to, const OuterFaces<D>& faces, std::size_t begin,
         const CornerColumns<D>& x, const CellUnits<D>& units, std::uint32_t first) {
  const std::size_t end = faces.size();
  for (std::size_t k = 0; k < corners_of_face<D>; ++k)
    for (std::size_t d = 0; d < D; ++d) {
      KeptArray<double>& column = to[k][d];
      column.resize(end);
      for (std::size_t i = begin; i < end; ++i) {
        const double* corner = x[face_corners<D>[faces.face[i]][k]][d];
        column[i] =
            on_planes((corner[faces.particle[i] - first] - units.origin[d]) * units.inverse[d]);
      }
    }
}

}  // namespace

template <int D>
void OuterFaces<D>::clear() {
  for (Places* places : {&start, &end})
    for (auto& corner_places : *places)
      for (KeptArray<double>& column : corner_places) column.clear();
  particle.clear();
  face.clear();
  weight.clear();
  inner.clear();
}

template <int D>
void OuterFaces<D>::add(const CornerColumns<D>& from, const CornerColumns<D>* to,
                        const std::uint8_t* outer, std::size_t n, const CellUnits<D>& units,
                        std::uint32_t first) {
  const std::size_t begin = size();
  for (std::size_t p = 0; p < n; ++p)
    for (unsigned bits = outer[p]; bits != 0; bits &= bits - 1) {
      particle.push_back(first + static_cast<std::uint32_t>(p));
      face.push_back(static_cast<std::uint8_t>(std::countr_zero(bits)));
    }
  put<D>(start, *this, begin, from, units, first);
  if (to != nullptr) return put<D>(end, *this, begin, *to, units, first);
  for (std::size_t k = 0; k < corners_of_face<D>; ++k)
    for (std::size_t d = 0; d < D; ++d)
      end[k][d].insert(end[k][d].end(), start[k][d].begin() + static_cast<std::ptrdiff_t>(begin),
                       start[k][d].end());
}

template <int D>
void OuterFaces<D>::move(const CornerColumns<D>& to, const CellUnits<D>& units) {
  put<D>(end, *this, 0, to, units, 0);
}

template struct OuterFaces<1>;
template struct OuterFaces<2>;
template struct OuterFaces<3>;

}  // namespace sluice::mpmice
