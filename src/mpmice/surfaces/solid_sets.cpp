#include "mpmice/surfaces/solid_sets.hpp"

#include <algorithm>

#include "mpmice/surfaces/partly_burned.hpp"

namespace sluice::mpmice {

template <int D>
void SolidSets<D>::list(ParticleCloud& cloud, int level) {
  std::size_t n = 0;
  for (int k = 0; k < static_cast<int>(kinds_->size()); ++k) {
    ParticleStore& store = cloud.store(k);
    for (int b = 0; b < store.box_count(level); ++b, ++n) {
      if (n == sets_.size()) sets_.emplace_back();
      SolidSet<D>& s = sets_[n];
      s.kind = k;
      s.columns = &(*kinds_)[static_cast<std::size_t>(k)].columns;
      s.present = &store.set(level, b);
      s.set = s.present;
      s.next = &store.next(level, b);
      s.parted.clear();
      s.dropped.clear();
      s.outer.clear();
      read_filled<D>(s);
    }
  }
  sets_.resize(n);
}

template <int D>
void SolidSets<D>::add_cells(const Frame<D>& frame, double dt, OccupiedCells<D>& to) {
  for (SolidSet<D>& s : sets_) {
    s.moves = moves_of<D>(frame, *s.columns, *s.set, dt);
    const CornerColumns<D> corners = corner_columns<D>(frame, *s.columns, *s.set);
    add_cells_of<D>(frame, corners, s.set->size(), s.moves, to);
  }
}

// With inner faces where particles have burned in part.
template <int D>
void SolidSets<D>::find_faces(const Frame<D>& frame, bool moved, Communicator& ranks) {
  if (!burn_) {
    for (SolidSet<D>& s : sets_) {
      mpmice::find_faces<D>(frame, s, moved, outer_faces_of<D>(s));
      if (!moved) s.pieces.cut(s.faces);  // they stay the same until the end
    }
    return;
  }
  PartlyBurned<D> burned;
  burned.find(frame, sets_, moved, ranks);
  for (SolidSet<D>& s : sets_) {
    mpmice::find_faces<D>(frame, s, moved, burned.faces_in_sums(frame, s));
    s.pieces.cut(s.faces);
  }
}

template <int D>
bool SolidSets<D>::stay_near(const Frame<D>& frame) const {
  for (const SolidSet<D>& s : sets_) {
    const CornerColumns<D> from = corner_columns<D>(frame, *s.columns, *s.set),
                           to = corner_columns<D>(frame, *s.columns, *s.next);
    for (std::size_t a = 0; a < D; ++a) {
      const double width = frame.spacing[frame.direction[a]];
      int far = 0;
      for (std::size_t k = 0; k < from.size(); ++k) {
        const double *x = from[k][a], *y = to[k][a];
        for (std::size_t p = 0; p < s.set->size(); ++p)
          far |= std::fabs(y[p] - x[p]) <= s.moves[p] * width ? 0 : 1;
      }
      if (far != 0) return false;
    }
  }
  return true;
}

template <int D>
bool SolidSets<D>::all_rigid() const {
  return std::all_of(kinds_->begin(), kinds_->end(), [](const auto& kind) { return kind.rigid; });
}

template class SolidSets<1>;
template class SolidSets<2>;
template class SolidSets<3>;

}  // namespace sluice::mpmice
