#include "mpmice/surfaces/separation.hpp"

#include <cmath>

#include "framework/particle/particle_map.hpp"
#include "framework/run/levels/level_solver.hpp"
#include "mpmice/fields/agreement.hpp"

namespace sluice::mpmice {
namespace {

// Of a corner from its middle along a direction, cells: well before solids::farthest_corner ends a
// run, well beyond what bodies that hold together reach.
constexpr double torn_corner = 1.2;
// Blocks are smaller than what is torn.
constexpr double largest_block = 2.3;

template <int D>
solids::CornerVolume<D> volume_of(const CornerColumns<D>& x, std::size_t p) {
  solids::CornerVolume<D> v;
  for (std::size_t k = 0; k < x.size(); ++k)
    for (std::size_t a = 0; a < D; ++a) v.x[k][a] = x[k][a][p];
  v.find();
  return v;
}

// Can a corner be far from the middle at all; most particles are not asked for more.
template <int D>
bool is_drawn_out(const Frame<D>& frame, const CornerColumns<D>& x, std::size_t p) {
  bool out = false;
  for (std::size_t a = 0; a < D; ++a) {
    double low = x[0][a][p], high = low;
    for (std::size_t k = 1; k < x.size(); ++k) {
      low = std::min(low, x[k][a][p]);
      high = std::max(high, x[k][a][p]);
    }
    out |= high - low > torn_corner * frame.spacing[frame.direction[a]];
  }
  return out;
}

// Does the particle let its neighbours go; it must be better off as a block.
template <int D>
bool tears(const Frame<D>& frame, const solids::CornerVolume<D>& v) {
  const double edge = std::pow(v.volume, 1.0 / D);
  bool drawn = false;
  for (std::size_t a = 0; a < D; ++a) {
    const double width = frame.spacing[frame.direction[a]];
    if (!(edge < largest_block * width)) return false;
    for (int k = 0; k < v.count; ++k) drawn |= std::fabs(v.x[k][a]) > torn_corner * width;
  }
  return drawn;
}

// Will the particle be dropped: its middle has left the domain.
template <int D>
bool leaves(const Frame<D>& frame, const SolidSet<D>& s, std::size_t p) {
  bool out = false;
  for (std::size_t a = 0; a < D; ++a) {
    const int cell = frame.cell_at(s.next->coordinate(frame.direction[a])[p], a);
    out |= !frame.periodic[a] && (cell < frame.domain.lower[a] || cell >= frame.domain.upper[a]);
  }
  return out;
}

template <int D>
void record_torn(const StageScope& scope, const SolidSet<D>& s, std::size_t p) {
  EventPlace place;
  place.level = scope.levels.front()->level().index;
  place.cell = cell_at(scope.levels.front()->level(), s.next->position(p));
  place.material = s.kind;
  place.task = "separation of particles";
  place.value = static_cast<double>(s.set->id(p));
  scope.events->record("particle torn from its neighbours", place);
}

// A length as a multiple of the unit of places.
double rounded(double x, double unit) {
  return std::nearbyint(x * (1 / unit)) * unit;
}

// What solids share no longer, on all ranks nearby.
template <int D>
void mark_parted(const Frame<D>& frame, const VanishedFaces<D>& parted, SolidSets<D>& sets) {
  for (SolidSet<D>& s : sets.all()) {
    const CornerColumns<D> x = corner_columns<D>(frame, *s.columns, *s.next);
    s.parted.resize(s.set->size());
    for (std::size_t p = 0; p < s.parted.size(); ++p)
      s.parted[p] = parted.exposed(s.kind, x, p).faces;
  }
}

}  // namespace

template <int D>
Periods<D> periods_of(const Frame<D>& frame, const solids::CoupledSolids& solids) {
  Periods<D> to;
  for (std::size_t a = 0; a < D; ++a) {
    if (!frame.periodic[a]) continue;
    const int d = frame.direction[a], cells = frame.domain.upper[a] - frame.domain.lower[a];
    const double unit = solids.unit_of_places(d);
    to.low[a] = rounded(frame.anchor[d] + frame.domain.lower[a] * frame.spacing[d], unit);
    to.length[a] = rounded(cells * frame.spacing[d], unit);
  }
  return to;
}

// The corners of a block around the middle, inside of the domain.
template <int D>
void Separation<D>::become_block(const Frame<D>& frame, const Parting& torn) const {
  const SolidSet<D>& s = *torn.set;
  const solids::CornerVolume<D>& v = torn.corners;
  const double half = 0.5 * std::pow(v.volume, 1.0 / D);
  for (std::size_t a = 0; a < D; ++a) {
    const int d = frame.direction[a];
    const double unit = solids_->unit_of_places(d);
    const auto column = [&](int k) {
      return s.next->column(static_cast<std::size_t>(s.columns->corners + 3 * k + d));
    };
    double middle = v.middle[a];
    if (!frame.periodic[a]) {
      const double width = frame.spacing[d], low = frame.anchor[d] + width * frame.domain.lower[a],
                   high = frame.anchor[d] + width * frame.domain.upper[a];
      middle = std::max(low + half, std::min(high - half, middle));
    }
    const double ends[2] = {rounded(middle - half, unit), rounded(middle + half, unit)};
    for (int k = 0; k < v.count; ++k) column(k)[torn.p] = ends[k >> a & 1];
    s.next->coordinate(d)[torn.p] = ends[0] + 0.5 * (ends[1] - ends[0]);
  }
}

// Most steps show without a question that nothing parts on any rank.
template <int D>
bool Separation<D>::may_part() const {
  bool may = solids_->any_left();
  for (int k = 0; k < static_cast<int>(solids_->kinds().size()); ++k)
    may |= solids_->largest_extent(k) > 0.5 * torn_corner;  // else none is drawn out
  return may;
}

template <int D>
void Separation<D>::find(const Frame<D>& frame, SolidSets<D>& sets, std::vector<Parting>& torn,
                         std::vector<Parting>& leaving) const {
  for (SolidSet<D>& s : sets.all()) {
    const bool rigid = sets.kind_of(s).rigid;
    const CornerColumns<D> x = corner_columns<D>(frame, *s.columns, *s.next);
    for (std::size_t p = 0; p < s.set->size(); ++p) {
      if (leaves(frame, s, p)) {
        leaving.push_back({&s, p, {}});
        continue;
      }
      if (rigid || !is_drawn_out<D>(frame, x, p)) continue;
      const solids::CornerVolume<D> v = volume_of<D>(x, p);
      if (tears(frame, v)) torn.push_back({&s, p, v});
    }
  }
}

template <int D>
bool Separation<D>::part(const StageScope& scope, const NearCells<D>& near,
                         SolidSets<D>& sets) const {
  constexpr auto all_faces = static_cast<std::uint8_t>((1u << (2 * D)) - 1);
  if (!may_part()) return false;
  const Frame<D>& frame = near.frame();
  std::vector<Parting> torn, leaving;
  find(frame, sets, torn, leaving);
  if (!on_any(*scope.ranks, !torn.empty() || !leaving.empty())) return false;
  VanishedFaces<D> parted(periods_of(frame, *solids_));
  for (const auto* parting : {&torn, &leaving})
    for (const Parting& t : *parting)
      parted.add(t.set->kind, corner_columns<D>(frame, *t.set->columns, *t.set->next), t.p);
  parted.tell_neighbours(near.sharers());
  mark_parted(frame, parted, sets);
  for (const Parting& t : torn) {
    t.set->parted[t.p] = all_faces;
    record_torn(scope, *t.set, t.p);
    become_block(frame, t);
  }
  for (const Parting& t : leaving) {
    t.set->dropped.resize(t.set->set->size());
    t.set->dropped[t.p] = 1;
  }
  scope.journal->at_acceptance([&sets] {
    for (SolidSet<D>& s : sets.all()) {
      double* outer = s.present->column(static_cast<std::size_t>(s.columns->outer));
      for (std::size_t p = 0; p < s.parted.size(); ++p)
        outer[p] = static_cast<std::uint8_t>(outer[p]) | s.parted[p];
    }
  });
  return true;
}

template Periods<1> periods_of(const Frame<1>&, const solids::CoupledSolids&);
template Periods<2> periods_of(const Frame<2>&, const solids::CoupledSolids&);
template Periods<3> periods_of(const Frame<3>&, const solids::CoupledSolids&);
template class Separation<1>;
template class Separation<2>;
template class Separation<3>;

}  // namespace sluice::mpmice
