#include "mpmice/amounts/redistribute.hpp"

#include <algorithm>
#include <cmath>

namespace sluice::mpmice {
namespace {

constexpr double small_volume = 0.5;
constexpr double margin = 1e-9;        // by which a neighbour must be larger: ties are none
constexpr double enough = 1e-3;        // room for what is no state
constexpr double near_largest = 0.99;  // of the largest component of a normal

template <int D>
class Neighbourhoods {
 public:
  Neighbourhoods(const NearCells<D>& near, const SolidGeometry<D>& solid,
                 const SmoothNormals<D>& normals, const CellAmounts<D>& a)
      : near_(near), frame_(near.frame()), solid_(solid), normals_(normals), amounts_(a) {}

  // `trapped`: the first of this rank's cells without volume that has no neighbour to go to.
  void find(std::optional<Cell<D>>& trapped) {
    holds_.clear();
    begin_.clear();
    cells_.clear();
    near_.for_each([&](const Cell<D>& c, std::size_t i) {
      if (!small(i)) return;
      if (!add(c, i) && near_.owns(i) && !trapped) trapped = c;
    });
    begin_.push_back(holds_.size());
  }
  bool any() const { return !cells_.empty(); }

  // One pass of one amount. `count`: N_j.
  void share(Column& amount, const KeptArray<std::uint16_t>& count) const {
    KeptArray<double> Q(cells_.size());
    for (std::size_t s = 0; s < cells_.size(); ++s) {
      double A = 0, V = 0;
      for (std::size_t h = begin_[s]; h < begin_[s + 1]; ++h) {
        const std::size_t j = holds_[h];
        A += amount[j] / count[j];
        V += amounts_.volume[j] / count[j];
      }
      Q[s] = A / V;
    }
    // Neighbourhoods of their own keep theirs; the sum over those that share goes in their order.
    for (const std::size_t j : touched_) {
      const int own = count[j] - shared_[j];
      amount[j] = own > 0 ? amount[j] / count[j] * own : 0.0;
    }
    for (std::size_t s = 0; s < cells_.size(); ++s)
      for (std::size_t h = begin_[s]; h < begin_[s + 1]; ++h) {
        const std::size_t j = holds_[h];
        amount[j] += amounts_.volume[j] / count[j] * Q[s];
      }
  }

  // N_j: of small cells those that hold them; of others one more, their own.
  KeptArray<std::uint16_t> count() {
    KeptArray<std::uint16_t> n(amounts_.volume.size(), 0);
    shared_.assign(n.size(), 0);
    touched_.clear();
    for (const std::size_t j : holds_) {
      if (shared_[j]++ == 0) touched_.push_back(j);
    }
    for (const std::size_t j : touched_)
      n[j] = static_cast<std::uint16_t>(shared_[j] + (is_small_[j] ? 0 : 1));
    return n;
  }

 private:
  bool inadmissible(std::size_t i) const {
    return !amounts_.inadmissible.empty() && amounts_.inadmissible[i] != 0;
  }
  bool left(std::size_t i) const {
    bool any = amounts_.kinetic[i] != 0;
    for (const auto* columns : {&amounts_.mass, &amounts_.energy, &amounts_.momentum})
      for (const Column& column : *columns) any |= column[i] != 0;
    return any;
  }
  bool small(std::size_t i) {
    if (is_small_.empty()) is_small_.assign(amounts_.volume.size(), 0);
    is_small_[i] = (amounts_.near[i] != 0 && solid_.theta_next[i] > 0 &&
                    amounts_.volume[i] < small_volume && (amounts_.volume[i] > 0 || left(i))) ||
                   inadmissible(i);
    return is_small_[i] != 0;
  }
  bool add(const Cell<D>& c, std::size_t i) {
    begin_.push_back(holds_.size());
    cells_.push_back(i);
    holds_.push_back(i);
    const bool closed = !(amounts_.volume[i] > 0);
    for (int rule = closed ? 1 : inadmissible(i) ? 2 : 0; rule < 3; ++rule) {
      if (rule == 2 && !closed && !inadmissible(i)) return true;
      bool found = false;
      for (std::size_t d = 0; d < D; ++d) {
        if (rule == 0 && !along(i, d)) continue;
        for (const int side : {0, 1}) found |= take(c, i, d, side, rule == 2);
      }
      if (found && (closed || !inadmissible(i))) return true;
    }
    if (closed) return take_farther(c, margin);
    // What is no state beside slivers alone is none together with them.
    if (inadmissible(i) && room_of_last() < enough) take_farther(c, enough);
    return true;
  }
  // Of the cells that the last one shares with.
  double room_of_last() const {
    double room = 0;
    for (std::size_t n = begin_.back() + 1; n < holds_.size(); ++n)
      room += amounts_.volume[holds_[n]];
    return room;
  }
  // Is a cell among those that the last one shares with, itself too.
  bool held(std::size_t j) const {
    const auto begin = holds_.begin() + static_cast<std::ptrdiff_t>(begin_.back());
    return std::find(begin, holds_.end(), j) != holds_.end();
  }
  // Of cells in rings around: the nearest that have that much room.
  bool take_farther(const Cell<D>& c, double least) {
    constexpr int farthest = 6;
    for (int reach = 1; reach <= farthest; ++reach) {
      bool found = false;
      near_.for_each_around(c, reach, [&](std::size_t j) {
        if (amounts_.near[j] == 0 || !(amounts_.volume[j] > least) || held(j)) return;
        holds_.push_back(j);
        found = true;
      });
      if (found) return true;
    }
    return false;
  }
  // Is the direction one of the largest components of the normal.
  bool along(std::size_t i, std::size_t d) const {
    double most = 0;
    for (std::size_t e = 0; e < D; ++e) most = std::max(most, std::fabs(normals_.along(e, i)));
    return std::fabs(normals_.along(d, i)) >= near_largest * most;
  }
  bool take(const Cell<D>& c, std::size_t i, std::size_t d, int side, bool covered_too) {
    Cell<D> other = c;
    other[d] += side == 0 ? -1 : 1;
    const std::size_t face = side == 0 ? i : frame_.cells.cell_above(i, static_cast<int>(d));
    if (!frame_.in_domain(other)) {
      if (!frame_.periodic[d]) return false;
      other = frame_.inside(other);
    }
    const std::size_t j = frame_.cells.index(other);
    if (amounts_.near[j] == 0) return false;  // what it holds was not gathered
    const bool larger = amounts_.volume[j] > amounts_.volume[i] + margin;
    if (!larger && !(inadmissible(i) && amounts_.volume[j] > 0)) return false;
    if (!covered_too && solid_.covered[d][face] >= 1 && solid_.covered_next[d][face] >= 1)
      return false;
    holds_.push_back(j);
    return true;
  }

  const NearCells<D>& near_;
  const Frame<D>& frame_;
  const SolidGeometry<D>& solid_;
  const SmoothNormals<D>& normals_;
  const CellAmounts<D>& amounts_;
  KeptArray<std::size_t> cells_, begin_, holds_, touched_;
  KeptArray<std::uint16_t> shared_;
  KeptArray<std::uint8_t> is_small_;
};

}  // namespace

template <int D>
void redistribute(const NearCells<D>& near, const SolidGeometry<D>& solid,
                  const SmoothNormals<D>& normals, CellAmounts<D>& amounts,
                  std::optional<Cell<D>>& trapped) {
  constexpr int passes = 2;
  for (int pass = 0; pass < passes; ++pass) {
    Neighbourhoods<D> around(near, solid, normals, amounts);
    around.find(trapped);
    if (trapped || !around.any()) return;
    const KeptArray<std::uint16_t> count = around.count();
    amounts.for_each_amount([&](Column& amount) { around.share(amount, count); });
    for (std::size_t i = 0; i < count.size(); ++i)
      if (count[i] > 0) amounts.touched[i] = 1;
  }
}

template void redistribute<1>(const NearCells<1>&, const SolidGeometry<1>&, const SmoothNormals<1>&,
                              CellAmounts<1>&, std::optional<Cell<1>>&);
template void redistribute<2>(const NearCells<2>&, const SolidGeometry<2>&, const SmoothNormals<2>&,
                              CellAmounts<2>&, std::optional<Cell<2>>&);
template void redistribute<3>(const NearCells<3>&, const SolidGeometry<3>&, const SmoothNormals<3>&,
                              CellAmounts<3>&, std::optional<Cell<3>>&);

}  // namespace sluice::mpmice
