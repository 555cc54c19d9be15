#include "mpmice/exchange/solid_behind.hpp"

#include <algorithm>
#include <cmath>

namespace sluice::mpmice {
namespace {

constexpr int mass_lane = 0, heat_lane = 1, velocity_lane = 2;

// Of the heaviest particles, so many have room in the sums of a node.
constexpr double most_particles = 1024;

}  // namespace

template <int D>
void SolidBehind<D>::include(const Frame<D>& frame, const std::vector<SolidSet<D>>& sets, int kind,
                             ExchangeScales& most) {
  for (const SolidSet<D>& s : sets) {
    if (s.kind != kind) continue;
    const double* m = s.set->column(static_cast<std::size_t>(s.columns->mass));
    const double* T = s.next->column(static_cast<std::size_t>(s.columns->temperature));
    for (std::size_t p = 0; p < s.set->size(); ++p) {
      most.mass = std::max(most.mass, m[p]);
      most.temperature = std::max(most.temperature, std::fabs(T[p]));
    }
    for (const int d : frame.direction) {
      const double* v = s.next->column(static_cast<std::size_t>(s.columns->velocity + d));
      for (std::size_t p = 0; p < s.set->size(); ++p)
        most.speed = std::max(most.speed, std::fabs(v[p]));
    }
  }
}

template <int D>
void SolidBehind<D>::add(const Frame<D>& frame, const CellMask& exchanging, const SolidSet<D>& s,
                         const ExchangeScales& most, std::size_t begin, std::size_t end,
                         Counted& counted, CellSums<D>& sums) {
  const double* m = s.set->column(static_cast<std::size_t>(s.columns->mass));
  const double* T = s.next->column(static_cast<std::size_t>(s.columns->temperature));
  std::array<const double*, D> v;
  for (std::size_t d = 0; d < D; ++d)
    v[d] = s.next->column(static_cast<std::size_t>(s.columns->velocity + frame.direction[d]));
  for (std::size_t p = begin; p < end; ++p) {
    if (exchanging[frame.cells.index(cell_of_middle<D>(frame, *s.next, p))] == 0) continue;
    const Nodes& nodes =
        counted.emplace_back(static_cast<std::uint32_t>(p), nodes_around<D>(frame, *s.next, p))
            .second;
    for (const NodeShare<D>& at : nodes) {
      const double share = at.weight * (m[p] / most.mass / most_particles);
      sums.lane(mass_lane)[at.node] += to_sum(share);
      sums.lane(heat_lane)[at.node] += to_sum(share * (T[p] / most.temperature));
      for (std::size_t d = 0; d < D; ++d)
        sums.lane(velocity_lane + static_cast<int>(d))[at.node] +=
            to_sum(share * (v[d][p] / most.speed));
    }
  }
}

template <int D>
void SolidBehind<D>::find(const NearCells<D>& near, const CellMask& exchanging,
                          const std::vector<SolidSet<D>>& sets, int kind,
                          const ExchangeScales& most, Communicator& ranks) {
  sums_.begin(near.frame().cells, velocity_lane + D);
  counted_.clear();
  for (const SolidSet<D>& s : sets) {
    if (s.kind != kind) continue;
    std::vector<Counted>& counted = counted_.emplace_back(range_count(near.team(), s.set->size()));
    add_in_ranges<D>(near.team(), s.set->size(), sums_,
                     [&](std::size_t begin, std::size_t end, std::size_t range, CellSums<D>& sums) {
                       add(near.frame(), exchanging, s, most, begin, end, counted[range], sums);
                     });
  }
  sums_.sum_over_ranks(ranks);
  sums_.values(mass_lane, mass_);
  const auto mean = [&](int lane, double scale, Column& to) {
    sums_.values(lane, to);
    for (std::size_t i = 0; i < to.size(); ++i)
      to[i] = mass_[i] > 0 ? to[i] / mass_[i] * scale : 0.0;
  };
  mean(heat_lane, most.temperature, temperature_);
  for (int d = 0; d < D; ++d)
    mean(velocity_lane + d, most.speed, velocity_[static_cast<std::size_t>(d)]);
  for (double& mass : mass_) mass *= most.mass * most_particles / near.frame().cell_volume;
}

template <int D>
double SolidBehind<D>::resistance(const Frame<D>& frame, const std::vector<SolidSet<D>>& sets,
                                  const SurfaceContact<D>& c, double time) const {
  const double k = solid_->conductivity;
  if (!(k > 0) || !(solid_->specific_heat > 0)) return 0;
  const SolidSet<D>& s = sets[c.set];
  double depth = 0;
  for (std::size_t d = 0; d < D; ++d) {
    const int of = frame.direction[d];
    depth += c.normal[d] * (frame.anchor[of] + frame.spacing[of] * c.place[d] -
                            s.next->coordinate(of)[c.particle]);
  }
  const double m = s.set->column(static_cast<std::size_t>(s.columns->mass))[c.particle],
               V = s.next->column(static_cast<std::size_t>(s.columns->volume))[c.particle];
  const double reach = reach_of_heat(k, m / V * solid_->specific_heat, time);
  return std::min(std::max(depth, 0.0), reach) / k;
}

template class SolidBehind<1>;
template class SolidBehind<2>;
template class SolidBehind<3>;

}  // namespace sluice::mpmice
