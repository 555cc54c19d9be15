#include "mpmice/surfaces/solid_sets.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>

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

// The pieces of its faces, by all threads.
template <int D>
void SolidSets<D>::cut(const ThreadTeam& team, SolidSet<D>& s) const {
  std::vector<CutSurface<D>> parts(range_count(team, s.faces.size()));
  if (parts.size() == 1) return s.pieces.cut(s.faces);
  for_each_range(team, s.faces.size(),
                 [&](std::size_t begin, std::size_t end, std::size_t range, int) {
                   parts[range].add(s.faces, begin, end);
                 });
  s.pieces.clear();
  for (const CutSurface<D>& part : parts) s.pieces.append(part);
}

// With inner faces where particles have burned in part.
template <int D>
void SolidSets<D>::find_faces(const NearCells<D>& near, bool moved, Communicator& ranks) {
  const Frame<D>& frame = near.frame();
  strayed_ = moved && !stay_near(near);
  if (strayed_) moved = false;
  if (!burn_) {
    for (SolidSet<D>& s : sets_) {
      const bool same = moved && s.parted.empty() && s.dropped.empty();
      if (same)
        s.faces.move(corner_columns<D>(frame, *s.columns, *s.next), cell_units(frame));
      else
        mpmice::find_faces<D>(frame, s, moved, outer_faces_of<D>(s));
      if (!moved) cut(near.team(), s);  // they stay the same until the end
    }
    return;
  }
  PartlyBurned<D> burned;
  burned.find(frame, sets_, moved, ranks);
  for (SolidSet<D>& s : sets_) {
    mpmice::find_faces<D>(frame, s, moved, burned.faces_in_sums(frame, s));
    cut(near.team(), s);
  }
}

template <int D>
std::string SolidSets<D>::stray_reason() {
  return fmt::format(
      "a solid moves by more than {} cells, or by more than {} though it began slowly",
      Frame<D>::most_move, Frame<D>::slow_move);
}

// Do those of this rank end where the arrays have room for them.
template <int D>
bool SolidSets<D>::stay_near(const NearCells<D>& near) const {
  const Frame<D>& frame = near.frame();
  std::atomic<bool> far = false;
  for (const SolidSet<D>& s : sets_) {
    const CornerColumns<D> from = corner_columns<D>(frame, *s.columns, *s.set),
                           to = corner_columns<D>(frame, *s.columns, *s.next);
    for_each_range(near.team(), s.set->size(),
                   [&](std::size_t begin, std::size_t end, std::size_t, int) {
                     int any = 0;
                     for (std::size_t a = 0; a < D; ++a) {
                       const double width = frame.spacing[frame.direction[a]];
                       for (std::size_t k = 0; k < from.size(); ++k) {
                         const double *x = from[k][a], *y = to[k][a];
                         for (std::size_t p = begin; p < end; ++p)
                           any |= std::fabs(y[p] - x[p]) <= s.moves[p] * width ? 0 : 1;
                       }
                     }
                     if (any != 0) far = true;
                   });
  }
  return !far;
}

template <int D>
bool SolidSets<D>::all_rigid() const {
  return std::all_of(kinds_->begin(), kinds_->end(), [](const auto& kind) { return kind.rigid; });
}

template class SolidSets<1>;
template class SolidSets<2>;
template class SolidSets<3>;

}  // namespace sluice::mpmice
