#include "mpmice/geometry/reference_cells.hpp"

#include <bit>
#include <cmath>

#include "framework/base/communicator.hpp"
#include "mpmice/geometry/mean_pieces.hpp"

namespace sluice::mpmice {

template <int D>
void ReferenceCells<D>::begin(const FreeCells<D>& free) {
  free_ = &free;
  values_.assign(1 + free.cells().block_count(), 0);
}

// The particles that reach a cell at which a block begins.
template <int D>
void ReferenceCells<D>::list(const SolidParticles<D>& particles, bool both_ends) {
  reaching_.clear();
  first_.clear();
  places_.clear();
  const auto include = [&](const CornerColumns<D>& x, std::size_t p, CellBox<D>& box) {
    for (std::size_t d = 0; d < D; ++d)
      for (const auto& corner : x) {
        const double place =
            on_planes((corner[d][p] - particles.units.origin[d]) * particles.units.inverse[d]);
        // A face in a plane of the grid may count in the cell on either side.
        box.lower[d] = std::min(box.lower[d], static_cast<int>(std::ceil(place)) - 1);
        box.upper[d] = std::max(box.upper[d], static_cast<int>(std::floor(place)) + 1);
      }
  };
  for (std::size_t p = 0; p < particles.count; ++p) {
    if (!particles.is_there(p)) continue;
    CellBox<D> box;
    box.lower.fill(1 << 30);
    box.upper.fill(-(1 << 30));
    include(particles.start, p, box);
    if (both_ends) include(particles.end, p, box);
    const std::size_t before = places_.size();
    for_each_cell_of<D>(box, [&](const Cell<D>& c) {
      const Cell<D> image = free_->sides().image(c);
      const std::size_t i = free_->cells().index(image);
      const std::size_t block = i / CellBlocks<D>::block_cells;
      if (block == 0 || free_->begins_free(block)) return;
      if (image == free_->own_cells(block).lower) places_.push_back({c, block});
    });
    if (places_.size() == before) continue;
    reaching_.push_back(static_cast<std::uint32_t>(p));
    first_.push_back(before);
  }
  first_.push_back(places_.size());
}

// Particle n of the list has a piece in a cell.
template <int D>
void ReferenceCells<D>::add_piece(std::size_t n, const Cell<D>& cell, double N, double T) {
  for (std::size_t i = first_[n]; i < first_[n + 1]; ++i) {
    const Place& place = places_[i];
    bool same_row = true;
    for (std::size_t d = 1; d < D; ++d) same_row = same_row && cell[d] == place.cell[d];
    if (!same_row || cell[0] < place.cell[0]) continue;
    values_[place.block] += to_sum(cell[0] == place.cell[0] ? T : N);
  }
}

// for_each_piece(faces, i, act(cell, N_x, T_x)) for face i of them.
template <int D>
template <class ForEachPiece>
void ReferenceCells<D>::add_faces(const SolidParticles<D>& particles,
                                  ForEachPiece&& for_each_piece) {
  std::array<KeptArray<double>, corners_of_particle<D> * D> from, to;
  CornerColumns<D> start, end;
  for (std::size_t k = 0; k < start.size(); ++k)
    for (std::size_t d = 0; d < D; ++d) {
      for (const std::uint32_t p : reaching_) {
        from[k * D + d].push_back(particles.start[k][d][p]);
        to[k * D + d].push_back(particles.end[k][d][p]);
      }
      start[k][d] = from[k * D + d].data();
      end[k][d] = to[k * D + d].data();
    }
  const KeptArray<std::uint8_t> every_face(reaching_.size(), (1u << faces_of_particle<D>)-1);
  faces_.clear();
  faces_.add(start, &end, every_face.data(), reaching_.size(), particles.units);
  for (std::size_t i = 0; i < faces_.size(); ++i) {
    const std::size_t n = faces_.particle[i];
    const double part = particles.part(reaching_[n]);
    for_each_piece(faces_, i, [&](const Cell<D>& cell, double N, double T) {
      add_piece(n, cell, part * N, part * T);
    });
  }
}

template <int D>
void ReferenceCells<D>::add(const SolidParticles<D>& particles, When when) {
  list(particles, when == When::end);
  add_faces(particles, [&](const OuterFaces<D>& faces, std::size_t i, auto&& act) {
    for (int t = 0; t < facets_of_face<D>; ++t)
      for_each_piece_of<D>(faces, when, i, t, [&](std::size_t, int, const Piece<D>& piece) {
        act(piece.cell, piece.area[0], piece.n[0] * piece.arm[0]);
      });
  });
}

template <int D>
void ReferenceCells<D>::add_mean(const SolidParticles<D>& particles) {
  list(particles, true);
  add_faces(particles, [&](const OuterFaces<D>& faces, std::size_t i, auto&& act) {
    for (int t = 0; t < facets_of_face<D>; ++t) {
      const MixedFacet<D> f(facet_nodes<D>(faces.start, i, t), facet_nodes<D>(faces.end, i, t),
                            faces.face[i]);
      for_each_mean_piece<D>(
          f, 1, false,
          [&](const std::array<Slots, D>&, const MeanArea<D>& area, const MeanPiece<D>& piece) {
            Cell<D> cell = piece.cell;
            for (std::size_t d = 0; d < D; ++d) cell[d] += f.base[d];
            act(cell, area.N[0] * piece.s, piece.T[0]);
          });
    }
  });
}

// All ranks that have a block know that it begins at its lowest cell: messages go between those
// alone that share such blocks.
template <int D>
void ReferenceCells<D>::sum_over_ranks(Communicator& ranks) {
  if (ranks.size() == 1) return;
  const auto& shared = free_->cells().shared();
  typename BlockSharers<D>::Buffers out(shared.size()), in(shared.size());
  const auto for_each_shared = [&](std::size_t n, auto&& act) {
    for (const std::uint32_t block : shared[n])
      if (!free_->begins_free(block)) act(block);
  };
  for (std::size_t n = 0; n < shared.size(); ++n) {
    for_each_shared(
        n, [&](std::size_t block) { out[n].push_back(std::bit_cast<double>(values_[block])); });
    in[n].resize(out[n].size());
  }
  free_->cells().sharers()->swap_alike(out, in);
  for (std::size_t n = 0; n < shared.size(); ++n) {
    const double* from = in[n].data();
    for_each_shared(
        n, [&](std::size_t block) { values_[block] += std::bit_cast<std::uint64_t>(*from++); });
  }
}

template class ReferenceCells<1>;
template class ReferenceCells<2>;
template class ReferenceCells<3>;

}  // namespace sluice::mpmice
