#include "mpmice/surfaces/surface_geometry.hpp"

#include "mpmice/fields/thread_ranges.hpp"

namespace sluice::mpmice {

template <int D>
void SurfaceGeometry<D>::begin(const Frame<D>& frame, const std::vector<SolidSet<D>>& sets,
                               When when, bool moved) {
  free_.begin(frame.cells, frame.sides());
  sums_.begin(frame.cells);
  for (const SolidSet<D>& s : sets) {
    const SolidParticles<D> particles = particles_of(frame, s, moved);
    if (team_ == nullptr) {
      free_.add(particles, when);
      continue;
    }
    add_in_ranges<D>(*team_, particles.count, free_.sums(),
                     [&](std::size_t from, std::size_t to, std::size_t, CellSums<D>& sums) {
                       free_.add(particles, when, from, to, sums);
                     });
  }
}

template <int D>
const std::uint64_t* SurfaceGeometry<D>::find_references(const Frame<D>& frame,
                                                         const std::vector<SolidSet<D>>& sets,
                                                         Communicator* ranks, When when) {
  if (!free_.any_without()) return nullptr;
  references_.begin(free_);
  for (const SolidSet<D>& s : sets) {
    const bool moved = when == When::end;
    references_.add(particles_of(frame, s, moved), when);
  }
  if (ranks != nullptr) references_.sum_over_ranks(*ranks);
  return references_.values();
}

// From sums of all ranks.
template <int D>
void SurfaceGeometry<D>::finish(const Frame<D>& frame, const std::vector<SolidSet<D>>& sets,
                                Communicator* ranks, When when, SolidInCells<D>& found) {
  free_.finish();
  sums_.finish(free_, find_references(frame, sets, ranks, when), found);
}

template <int D>
void SurfaceGeometry<D>::begin_at_start(const Frame<D>& frame,
                                        const std::vector<SolidSet<D>>& sets) {
  begin(frame, sets, When::start, false);
  for (const SolidSet<D>& s : sets) sums_.add(s.faces, s.pieces, free_);
}

template <int D>
void SurfaceGeometry<D>::finish_at_start(const Frame<D>& frame,
                                         const std::vector<SolidSet<D>>& sets, Communicator* ranks,
                                         SolidInCells<D>& found) {
  finish(frame, sets, ranks, When::start, found);
}

template <int D>
void SurfaceGeometry<D>::find_at_end(const Frame<D>& frame, const std::vector<SolidSet<D>>& sets,
                                     Communicator& ranks, SolidInCells<D>& found) {
  begin(frame, sets, When::end, true);
  for (const SolidSet<D>& s : sets) sums_.add(s.faces, When::end, 0, s.faces.size(), &free_);
  share_sums<D>({&free_.sums(), &sums_.sums()}, ranks);
  finish(frame, sets, &ranks, When::end, found);
}

template <int D>
void SurfaceGeometry<D>::find_moved(const Frame<D>& frame, const std::vector<SolidSet<D>>& sets,
                                    Communicator& ranks, SolidInCells<D>& at_end,
                                    SweptVolumes<D>& swept) {
  begin(frame, sets, When::end, true);
  swept_.begin(frame.cells);
  for (const SolidSet<D>& s : sets) moving_.add(s.faces, sums_, swept_, free_);
  share_sums<D>({&free_.sums(), &sums_.sums(), &swept_.sums()}, ranks);
  finish(frame, sets, &ranks, When::end, at_end);
  const std::uint64_t* references = nullptr;
  if (free_.any_without()) {
    references_.begin(free_);
    for (const SolidSet<D>& s : sets) references_.add_mean(particles_of(frame, s, true));
    references_.sum_over_ranks(ranks);
    references = references_.values();
  }
  swept_.finish(free_, references, swept);
}

template class SurfaceGeometry<1>;
template class SurfaceGeometry<2>;
template class SurfaceGeometry<3>;

}  // namespace sluice::mpmice
