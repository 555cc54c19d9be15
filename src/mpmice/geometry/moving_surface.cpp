#include "mpmice/geometry/moving_surface.hpp"

namespace sluice::mpmice {
namespace {

// From numbers beside each other to lanes.
void give(const KeptArray<std::uint64_t>& numbers, CellSums<3>& end, CellSums<3>& swept,
          std::uint64_t* marks) {
  const auto take = [&](std::size_t number, std::uint64_t* lane) {
    const std::uint64_t* from = numbers.data() + number;
    for (std::size_t i = 0, n = numbers.size() / numbers_of_cell; i < n; ++i)
      lane[i] += from[numbers_of_cell * i];
  };
  using Swept = SweptSums<3>;
  for (int d = 0; d < 3; ++d) {
    const auto a = static_cast<std::size_t>(d);
    take(number_of_cell::mean_N + a, swept.lane(Swept::lane_of_N(d)));
    take(number_of_cell::mean_T + a, swept.lane(Swept::lane_of_T(d)));
    take(number_of_cell::C[a], swept.lane(Swept::lane_of_C(d)));
    take(number_of_cell::end_N + a, end.lane(d));
    take(number_of_cell::end_T + a, end.lane(3 + d));
  }
  take(number_of_cell::mark, marks);
}

}  // namespace

template <int D>
void MovingSurface<D>::add(const OuterFaces<D>& faces, SolidSums<D>& end, SweptSums<D>& swept,
                           FreeCells<D>& free) {
  if (faces.size() == 0) return;
  if constexpr (D == 3) {
    const CellBlocks<3>& cells = end.sums().cells();
    numbers_.assign(numbers_of_cell * cells.size(), 0);
    groups_.add(faces, cells, numbers_.data(), left_);
    give(numbers_, end.sums(), swept.sums(), free.marks());
    for (const std::uint32_t n : left_) {
      end.add_facet(faces, When::end, n / 4, static_cast<int>(n % 4), nullptr);
      swept.add_facet(faces, n / 4, static_cast<int>(n % 4), free);
    }
  } else {
    end.add(faces, When::end, 0, faces.size(), nullptr);
    swept.add(faces, 0, faces.size(), free);
  }
}

template class MovingSurface<1>;
template class MovingSurface<2>;
template class MovingSurface<3>;

}  // namespace sluice::mpmice
