// Solids that part. A particle whose corners its neighbours have drawn out lets them go and goes on
// as a block of its own; one whose middle has left the domain lets them go too, and is dropped.
//
// The block has the particle's volume, middle, stress and motion; faces that it shared are outer
// faces from then on, its own and its neighbours'. No mass, momentum or energy changes.
#include <cmath>

#include "framework/base/reduction.hpp"
#include "framework/particle/particle_map.hpp"
#include "framework/run/component/event_ledger.hpp"
#include "mpm/transfer/corner_volume.hpp"
#include "mpmice/burn/vanished_faces.hpp"
#include "mpmice/step/level_coupling.hpp"

namespace sluice::mpmice {
namespace {

// Of a corner from its middle along a direction, cells: well before mpm::farthest_corner ends a
// run, well beyond what bodies that hold together reach.
constexpr double torn_corner = 1.2;
// Blocks are smaller than what is torn.
constexpr double largest_block = 2.3;

template <int D>
mpm::CornerVolume<D> volume_of(const CornerColumns<D>& x, std::size_t p) {
  mpm::CornerVolume<D> v;
  for (std::size_t k = 0; k < x.size(); ++k)
    for (std::size_t a = 0; a < D; ++a) v.x[k][a] = x[k][a][p];
  v.find();
  return v;
}

}  // namespace

// Can a corner be far from the middle at all; most particles are not asked for more.
template <int D>
bool LevelCoupling<D>::is_drawn_out(const CornerColumns<D>& x, std::size_t p) const {
  bool out = false;
  for (std::size_t a = 0; a < D; ++a) {
    double low = x[0][a][p], high = low;
    for (std::size_t k = 1; k < x.size(); ++k) {
      low = std::min(low, x[k][a][p]);
      high = std::max(high, x[k][a][p]);
    }
    out |= high - low > torn_corner * frame_.spacing[frame_.direction[a]];
  }
  return out;
}

// Does the particle let its neighbours go; it must be better off as a block.
template <int D>
bool LevelCoupling<D>::tears(const mpm::CornerVolume<D>& v) const {
  const double edge = std::pow(v.volume, 1.0 / D);
  bool drawn = false;
  for (std::size_t a = 0; a < D; ++a) {
    const double width = frame_.spacing[frame_.direction[a]];
    if (!(edge < largest_block * width)) return false;
    for (int k = 0; k < v.count; ++k) drawn |= std::fabs(v.x[k][a]) > torn_corner * width;
  }
  return drawn;
}

// The corners of a block around the middle, inside of the domain.
template <int D>
void LevelCoupling<D>::become_block(const SolidSet<D>& s, std::size_t p,
                                    const mpm::CornerVolume<D>& v) const {
  const double half = 0.5 * std::pow(v.volume, 1.0 / D);
  for (std::size_t a = 0; a < D; ++a) {
    const int d = frame_.direction[a];
    const auto column = [&](int k) {
      return s.next->column(static_cast<std::size_t>(s.columns->corners + 3 * k + d));
    };
    double middle = v.middle[a];
    if (!frame_.periodic[a]) {
      const double width = frame_.spacing[d],
                   low = frame_.anchor[d] + width * frame_.domain.lower[a],
                   high = frame_.anchor[d] + width * frame_.domain.upper[a];
      middle = std::max(low + half, std::min(high - half, middle));
    }
    double ends[2] = {axes_[a].rounded(middle - half), axes_[a].rounded(middle + half)};
    for (int k = 0; k < v.count; ++k) column(k)[p] = ends[k >> a & 1];
    s.next->coordinate(d)[p] = ends[0] + 0.5 * (ends[1] - ends[0]);
  }
}

template <int D>
void LevelCoupling<D>::tell_torn(const StageScope& scope, const SolidSet<D>& s,
                                 std::size_t p) const {
  EventPlace place;
  place.level = scope.levels.front()->level().index;
  place.cell = cell_at(scope.levels.front()->level(), s.next->position(p));
  place.material = s.kind;
  place.task = "torn particles part";
  place.value = static_cast<double>(s.set->id(p));
  scope.events->record("particle torn from its neighbours", place);
}

// Will the particle be dropped: its middle has left the domain.
template <int D>
bool LevelCoupling<D>::leaves(const SolidSet<D>& s, std::size_t p) const {
  bool out = false;
  for (std::size_t a = 0; a < D; ++a) {
    const int cell = frame_.cell_at(s.next->coordinate(frame_.direction[a])[p], a);
    out |= !frame_.periodic[a] && (cell < frame_.domain.lower[a] || cell >= frame_.domain.upper[a]);
  }
  return out;
}

// Of the corners of particles.
template <int D>
Periods<D> LevelCoupling<D>::periods() const {
  Periods<D> to;
  for (std::size_t a = 0; a < D; ++a) {
    if (!frame_.periodic[a]) continue;
    const int d = frame_.direction[a], cells = frame_.domain.upper[a] - frame_.domain.lower[a];
    to.low[a] = axes_[a].rounded(frame_.anchor[d] + frame_.domain.lower[a] * frame_.spacing[d]);
    to.length[a] = axes_[a].rounded(cells * frame_.spacing[d]);
  }
  return to;
}

// Behind the sweep, before amounts of cells become a state: the fluid of a cell keeps what it has,
// in what the parted solids leave of it.
template <int D>
void LevelCoupling<D>::part_torn(const StageScope& scope) {
  constexpr auto all_faces = static_cast<std::uint8_t>((1u << (2 * D)) - 1);
  struct Torn {
    SolidSet<D>* set;
    std::size_t p;
    mpm::CornerVolume<D> corners;
  };
  std::vector<Torn> torn, leaving;
  for (SolidSet<D>& s : sets_) {
    const bool rigid = solids_->scene().materials[static_cast<std::size_t>(s.kind)].rigid;
    const CornerColumns<D> x = corner_columns<D>(frame_, *s.columns, *s.next);
    for (std::size_t p = 0; p < s.set->size(); ++p) {
      if (leaves(s, p)) {
        leaving.push_back({&s, p, {}});
        continue;
      }
      if (rigid || !is_drawn_out(x, p)) continue;
      const mpm::CornerVolume<D> v = volume_of<D>(x, p);
      if (tears(v)) torn.push_back({&s, p, v});
    }
  }
  // Most steps show without a question that nothing parts on any rank.
  const mpm::SolidStep& solids = step_->level(step_->count() - 1);
  bool may_part = solids.outcome().left;
  for (std::size_t k = 0; k < solids.bodies().size(); ++k)
    may_part |=
        mpm::KindRates::from(std::span(solids.outcome().rates)
                                 .subspan(1 + k * static_cast<std::size_t>(mpm::KindRates::count)))
            .extent > 0.5 * torn_corner;  // else none is drawn out
  if (!may_part || !on_any(scope, !torn.empty() || !leaving.empty())) return;
  VanishedFaces<D> parted(periods());
  for (const auto* parting : {&torn, &leaving})
    for (const Torn& t : *parting)
      parted.add(t.set->kind, corner_columns<D>(frame_, *t.set->columns, *t.set->next), t.p);
  parted.tell_neighbours(sharers_.get());
  for (SolidSet<D>& s : sets_) {
    const CornerColumns<D> x = corner_columns<D>(frame_, *s.columns, *s.next);
    s.parted.resize(s.set->size());
    for (std::size_t p = 0; p < s.parted.size(); ++p)
      s.parted[p] = parted.exposed(s.kind, x, p).faces;
  }
  for (const Torn& t : torn) {
    t.set->parted[t.p] = all_faces;
    tell_torn(scope, *t.set, t.p);
    become_block(*t.set, t.p, t.corners);
  }
  for (const Torn& t : leaving) {
    t.set->dropped.resize(t.set->set->size());
    t.set->dropped[t.p] = 1;
  }
  find_all_faces(scope, true);
  SolidInCells<D> found;
  geometry_.find_at_end(frame_, sets_, *scope.ranks, found);
  take_geometry(found, fields_.theta_next, fields_.covered_next);
  keep_pockets();
  close_cells_at_sides();
  scope.journal->at_acceptance([this] {
    for (SolidSet<D>& s : sets_) {
      double* outer = s.present->column(static_cast<std::size_t>(s.columns->outer));
      for (std::size_t p = 0; p < s.parted.size(); ++p)
        outer[p] = static_cast<std::uint8_t>(outer[p]) | s.parted[p];
    }
  });
}

template Periods<1> LevelCoupling<1>::periods() const;
template void LevelCoupling<1>::part_torn(const StageScope&);
template Periods<2> LevelCoupling<2>::periods() const;
template void LevelCoupling<2>::part_torn(const StageScope&);
template Periods<3> LevelCoupling<3>::periods() const;
template void LevelCoupling<3>::part_torn(const StageScope&);

}  // namespace sluice::mpmice
