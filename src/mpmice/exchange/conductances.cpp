#include "mpmice/exchange/conductances.hpp"

#include <algorithm>

namespace sluice::mpmice {
namespace {

// Sums of conductances in a cell have room for so many of the largest.
constexpr double most_contacts = 1024;

}  // namespace

template <int D>
void Conductances<D>::find(const NearCells<D>& near, const std::vector<SolidSet<D>>& sets,
                           const KeptArray<SurfaceContact<D>>& contacts,
                           const CellAmounts<D>& amounts, const FluidInFront<D>& front,
                           const SolidBehind<D>& behind, const FilmCoefficients& films, double time,
                           Communicator& ranks) {
  fluids_ = front.fluids();
  const Sides sides{front, behind, films};
  std::vector<Joined> parts(range_count(near.team(), contacts.size()));
  for_each_range(near.team(), contacts.size(),
                 [&](std::size_t begin, std::size_t end, std::size_t range, int) {
                   for (std::size_t n = begin; n < end; ++n) {
                     const SurfaceContact<D>& c = contacts[n];
                     const double resistance = behind.resistance(near.frame(), sets, c, time);
                     pair_up(near.frame(), sets[c.set], c, n, amounts.volume[c.fluid], sides,
                             resistance, time, parts[range]);
                   }
                 });
  pairs_ = std::move(parts.front().pairs);
  heat_ = std::move(parts.front().heat);
  for (std::size_t k = 1; k < parts.size(); ++k) {
    pairs_.insert(pairs_.end(), parts[k].pairs.begin(), parts[k].pairs.end());
    heat_.insert(heat_.end(), parts[k].heat.begin(), parts[k].heat.end());
  }
  sum(near.frame().cells, contacts, ranks);
}

// A contact with the nodes behind it; `volume`: left to the fluids of the cell in front.
template <int D>
void Conductances<D>::pair_up(const Frame<D>& frame, const SolidSet<D>& s,
                              const SurfaceContact<D>& c, std::size_t contact, double volume,
                              const Sides& sides, double resistance, double time,
                              Joined& to) const {
  const auto& [front, behind, films] = sides;
  const bool warms = behind.solid().specific_heat > 0;
  for (const NodeShare<D>& at : nodes_around<D>(frame, *s.next, c.particle)) {
    if (!(at.weight > 0) || !(behind.mass(at.node) > 0)) continue;
    Pair pair{static_cast<std::uint32_t>(contact), at.node, 0};
    for (std::size_t m = 0; m < fluids_; ++m) {
      const double f = front.share(contact, m), part = at.weight * c.area, K = films.heat[m];
      pair.drag += part * f * films.drag[m] * (c.width / 4);
      double h = 0;  // per area
      if (f > 0 && K > 0 && warms)
        h = 1 /
            (4 / (f * K * c.width) + front.resistance(c, contact, m, volume, time) + resistance);
      to.heat.push_back(f > 0 ? part * h : 0.0);
    }
    to.pairs.push_back(pair);
  }
}

// As integers, so that the sums hold each of them to the bit.
template <int D>
void Conductances<D>::sum(const CellBlocks<D>& cells, const KeptArray<SurfaceContact<D>>& contacts,
                          Communicator& ranks) {
  double most_drag = 1e-300, most_heat = 1e-300;
  for (const Pair& pair : pairs_) most_drag = std::max(most_drag, pair.drag);
  for (const double G : heat_) most_heat = std::max(most_heat, G);
  Reduction all;
  const auto of_drag = all.add_maximum(most_drag), of_heat = all.add_maximum(most_heat);
  ranks.reduce(all);
  most_drag = all.maximum(of_drag) * most_contacts;
  most_heat = all.maximum(of_heat) * most_contacts;

  const int fluids = static_cast<int>(fluids_), drag = fluids, behind = fluids + 1;
  sums_.begin(cells, fluids + 3);
  const auto add = [&](int in_front, int back, const Pair& pair, double& G, double scale) {
    const std::uint64_t whole = to_sum(G / scale);
    G = from_sum(whole) * scale;
    sums_.lane(in_front)[contacts[pair.contact].fluid] += whole;
    sums_.lane(back)[pair.node] += whole;
  };
  for (std::size_t n = 0; n < pairs_.size(); ++n) {
    add(drag, behind, pairs_[n], pairs_[n].drag, most_drag);
    for (int m = 0; m < fluids; ++m)
      add(m, behind + 1, pairs_[n], heat_[n * fluids_ + static_cast<std::size_t>(m)], most_heat);
  }
  sums_.sum_over_ranks(ranks);
  const auto take = [&](int lane, double scale, Column& to) {
    sums_.values(lane, to);
    for (double& G : to) G *= scale;
  };
  heat_in_front_.resize(fluids_);
  for (int m = 0; m < fluids; ++m) take(m, most_heat, heat_in_front_[static_cast<std::size_t>(m)]);
  take(drag, most_drag, drag_in_front_);
  take(behind, most_drag, drag_behind_);
  take(behind + 1, most_heat, heat_behind_);
}

template class Conductances<1>;
template class Conductances<2>;
template class Conductances<3>;

}  // namespace sluice::mpmice
