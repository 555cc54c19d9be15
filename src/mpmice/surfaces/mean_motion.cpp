#include "mpmice/surfaces/mean_motion.hpp"

#include "mpmice/surfaces/surface_pieces.hpp"

namespace sluice::mpmice {

// Cells in which the middles of particles lie whose parts cells with fluid may ask for, or their
// neighbours.
template <int D>
CellMask MeanMotion<D>::cells_beside_fluid(const NearCells<D>& near,
                                           const SolidGeometry<D>& solid) const {
  if (looks_far_) return CellMask(near.size(), 1);
  CellMask mask(near.size(), 0);
  near.for_each([&](const Cell<D>&, std::size_t i) { mask[i] = solid.has_solid(i) ? 1 : 0; });
  dilate(near.frame(), 1, mask);
  near.for_each([&](const Cell<D>&, std::size_t i) {
    if (solid.theta[i] >= 1 && solid.theta_next[i] >= 1) mask[i] = 0;
  });
  dilate(near.frame(), 2, mask);  // the cell beside, and the middle of a part in it
  return mask;
}

// Mass of the heaviest particle of all, kg.
template <int D>
double MeanMotion<D>::heaviest() const {
  double most = 1e-300;
  for (int k = 0; k < static_cast<int>(solids_->kinds().size()); ++k)
    most = std::max(most, solids_->heaviest(k));
  return most;
}

// What any of them covers in the step along a direction, m/s.
template <int D>
double MeanMotion<D>::fastest_way(const Frame<D>& frame, double dt) const {
  double width = 0;
  for (const int d : frame.direction) width = std::max(width, frame.spacing[d]);
  return std::max(solids_->farthest_way() * width / dt, 1e-300);
}

template <int D>
void MeanMotion<D>::add(const Frame<D>& frame, const SolidSet<D>& s, const CellMask& beside,
                        double dt, const Scales& most, std::size_t begin, std::size_t end,
                        CellSums<D>& sums) const {
  const auto speed = [&](std::size_t p, int d) {
    return (s.next->coordinate(d)[p] - s.set->coordinate(d)[p]) / dt;
  };
  const CornerColumns<D> x = corner_columns<D>(frame, *s.columns, *s.set);
  const double* m = s.set->column(static_cast<std::size_t>(s.columns->mass));
  for (std::size_t p = begin; p < end; ++p) {
    if (beside[frame.cells.index(cell_of_middle(frame, *s.set, p))] == 0) continue;
    const std::uint64_t share = to_sum(m[p] / most.mass / most_parts<D>);
    std::array<std::uint64_t, D> moving;
    for (std::size_t a = 0; a < D; ++a)
      moving[a] =
          to_sum(m[p] / most.mass / most_parts<D> * (speed(p, frame.direction[a]) / most.speed));
    for_each_part<D>(frame, x, *s.set, p, [&](std::size_t cell) {
      sums.lane(0)[cell] += share;
      for (std::size_t a = 0; a < D; ++a) sums.lane(1 + static_cast<int>(a))[cell] += moving[a];
    });
  }
}

template <int D>
void MeanMotion<D>::find(const NearCells<D>& near, const SolidGeometry<D>& solid,
                         const SolidSets<D>& sets, double dt, Communicator& ranks) {
  const Frame<D>& frame = near.frame();
  const Scales most{heaviest(), fastest_way(frame, dt)};
  sums_.begin(frame.cells, 1 + D);
  const CellMask beside = cells_beside_fluid(near, solid);
  for (const SolidSet<D>& s : sets.all())
    add_in_ranges<D>(near.team(), s.set->size(), sums_,
                     [&](std::size_t begin, std::size_t end, std::size_t, CellSums<D>& sums) {
                       add(frame, s, beside, dt, most, begin, end, sums);
                     });
  sums_.sum_over_ranks(ranks);
  sums_.values(0, mass_);
  for (std::size_t a = 0; a < D; ++a) {
    Column& v = velocity_[a];
    sums_.values(1 + static_cast<int>(a), v);
    for (std::size_t i = 0; i < v.size(); ++i)
      v[i] = mass_[i] > 0 ? v[i] / mass_[i] * most.speed : 0.0;
  }
  for (double& mass : mass_) mass *= most.mass * (most_parts<D> / (1 << D)) / frame.cell_volume;
}

template <int D>
Column MeanMotion<D>::at_faces(std::size_t n, const NearCells<D>& near,
                               const SolidGeometry<D>& solid) const {
  const Frame<D>& frame = near.frame();
  const CellBlocks<D>& cells = frame.cells;
  const Column& v = velocity_[n];
  const auto fluid = [&](std::size_t c) { return solid.theta[c] < 1 && solid.theta_next[c] < 1; };
  Column to(cells.size(), 0.0);
  const auto find = [&](const Cell<D>& face, std::size_t at) {
    Cell<D> below = face;
    --below[n];
    // Most lie in one block with the cell below, inside of the domain.
    const bool beside = (face[n] & (CellBlocks<D>::edge - 1)) != 0 && frame.in_domain(below);
    const std::size_t j = frame.in_domain(face) ? at : cells.index(frame.inside(face)),
                      i = beside ? at - CellBlocks<D>::stride(static_cast<int>(n))
                                 : cells.index(frame.inside(below));
    if (fluid(i) && fluid(j)) return;
    const double M = mass_[i] + mass_[j];
    if (M > 0) to[at] = (mass_[i] * v[i] + mass_[j] * v[j]) / M;
  };
  for_each_range(near.team(), cells.block_count(),
                 [&](std::size_t begin, std::size_t end, std::size_t, int) {
                   for (std::size_t b = begin + 1; b <= end; ++b)
                     cells.for_each_cell_of_block(b, frame.held(), find);
                 });
  return to;
}

template class MeanMotion<1>;
template class MeanMotion<2>;
template class MeanMotion<3>;

}  // namespace sluice::mpmice
