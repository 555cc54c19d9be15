// The geometry of test bodies in cells, as the coupling finds it.
#pragma once
#include "mpmice/geometry/bodies_test_support.hpp"
#include "mpmice/geometry/mean_pieces.hpp"
#include "mpmice/geometry/reference_cells.hpp"
#include "mpmice/geometry/solid_in_cells.hpp"
#include "mpmice/geometry/swept_volumes.hpp"

namespace sluice::mpmice {

template <int D>
SolidParticles<D> particles_of(const Body<D>& body, const KeptArray<double>* parts = nullptr) {
  SolidParticles<D> to;
  to.start = Body<D>::columns(body.start);
  to.end = Body<D>::columns(body.end);
  to.count = body.size();
  if (parts != nullptr) to.filled = parts->data();
  return to;
}

// `parts`: what of each particle is solid; `sides`: periodic ones.
template <int D>
struct GeometryOf {
  const CellBlocks<D>& blocks = test_cells<D>().blocks;
  const KeptArray<double>* parts = nullptr;
  PeriodicSides<D> sides = {};

  SolidInCells<D> at(When when, const Body<D>& body, const OuterFaces<D>& faces) const {
    FreeCells<D> free;
    free.begin(blocks, sides);
    SolidSums<D> sums;
    sums.begin(blocks);
    sums.add(faces, when, 0, faces.size(), &free);
    const SolidParticles<D> particles = particles_of(body, parts);
    free.add(particles, when);
    free.finish();
    ReferenceCells<D> references;
    references.begin(free);
    references.add(particles, when);
    SolidInCells<D> to;
    sums.finish(free, references.values(), to);
    return to;
  }
  SolidInCells<D> at(When when, const Body<D>& body) const { return at(when, body, body.faces()); }
  SweptVolumes<D> swept(const Body<D>& body, const OuterFaces<D>& faces) const {
    FreeCells<D> free;
    free.begin(blocks, sides);
    SweptSums<D> sums;
    sums.begin(blocks);
    sums.add(faces, 0, faces.size(), free);
    const SolidParticles<D> particles = particles_of(body, parts);
    free.add(particles, When::end);
    free.finish();
    ReferenceCells<D> references;
    references.begin(free);
    references.add_mean(particles);
    SweptVolumes<D> to;
    sums.finish(free, references.values(), to);
    return to;
  }
  SweptVolumes<D> swept(const Body<D>& body) const { return swept(body, body.faces()); }
};

// q: the volume that the surface in a cell adds to the solid in a step (swept_volumes.hpp).
template <int D>
KeptArray<double> added_by_surface(const OuterFaces<D>& faces) {
  KeptArray<double> q(test_cells<D>().size(), 0.0);
  for (std::size_t i = 0; i < faces.size(); ++i)
    for (int t = 0; t < facets_of_face<D>; ++t) {
      const MixedFacet<D> f(facet_nodes<D>(faces.start, i, t), facet_nodes<D>(faces.end, i, t),
                            faces.face[i]);
      for_each_mean_piece<D>(f, faces.weight_of(i), false,
                             [&](const auto&, const MeanArea<D>& area, const MeanPiece<D>& piece) {
                               Cell<D> cell = piece.cell;
                               for (std::size_t d = 0; d < D; ++d) cell[d] += f.base[d];
                               double& sum = q[test_cells<D>().index(cell)];
                               for (std::size_t d = 0; d < D; ++d)
                                 for (std::size_t k = 0; k < D; ++k)
                                   sum += area.N[d] * piece.m[k] * f.move[d][k];
                             });
    }
  return q;
}

}  // namespace sluice::mpmice
