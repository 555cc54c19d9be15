#include "ice/pressure/interface_ghosts.hpp"

namespace sluice::ice::pressure {
namespace {

constexpr int max_layers = 4;

IntVec3 parent_of(IntVec3 c, IntVec3 ratio) {
  const auto floor_of = [](int a, int b) { return a >= 0 ? a / b : -((b - 1 - a) / b); };
  return {floor_of(c.x, ratio.x), floor_of(c.y, ratio.y), floor_of(c.z, ratio.z)};
}

}  // namespace

InterfaceGhosts::InterfaceGhosts(const Level& coarse, const Level& fine,
                                 const solve::ConstBoxViews& of_coarse,
                                 const solve::ConstBoxViews& of_fine)
    : fine_(fine),
      coarse_map_(coarse),
      fine_map_(fine),
      coarse_numbers_(coarse, of_coarse),
      fine_numbers_(fine, of_fine) {}

void InterfaceGhosts::fill(const RealView& d, const IndexBox& cells) const {
  for_each_cell(d.box, [&](IntVec3 ghost) {
    if (cells.contains(ghost) || fine_map_.has(ghost) || !fine_map_.in_domain(ghost)) return;
    d(ghost) = value(ghost);
  });
}

double InterfaceGhosts::value(IntVec3 ghost) const {
  for (int away = 1; away <= max_layers; ++away)
    for (int d = 0; d < 3; ++d) {
      if (!fine_.active[d]) continue;
      for (const int inward : {1, -1}) {
        IntVec3 f1 = ghost;
        f1[d] += inward * away;
        if (fine_map_.has(f1)) return beside(f1, d, inward, away);
      }
    }
  return coarse(parent_of(fine_map_.image(ghost), fine_.ratio));
}

double InterfaceGhosts::beside(IntVec3 f1, int d, int inward, int away) const {
  IntVec3 f2 = f1, g = f1;
  f2[d] += inward;
  g[d] -= inward;
  const double r = fine_.ratio[d], c = around(g, d);
  const double first = fine(f1), second = fine_map_.has(f2) ? fine(f2) : first;
  const double ghost =
      8.0 / ((r + 1) * (r + 3)) * c + 2.0 * (r - 1) / (r + 1) * first - (r - 1) / (r + 3) * second;
  if (away == 1) return ghost;
  // Further out: the line through the first ghost and c*.
  const double per_cell = r > 1 ? (c - ghost) / (0.5 * r - 0.5) : 0.0;
  return ghost + per_cell * (away - 1);
}

double InterfaceGhosts::around(IntVec3 g, int d) const {
  const IntVec3 image = fine_map_.image(g), parent = parent_of(image, fine_.ratio);
  const double c = coarse(parent);
  double sum = c;
  for (int t = 0; t < 3; ++t) {
    if (t == d || !fine_.active[t]) continue;
    const double o = (image[t] - parent[t] * fine_.ratio[t] + 0.5) / fine_.ratio[t] - 0.5;
    IntVec3 low = parent, high = parent;
    --low[t];
    ++high[t];
    const double below = coarse_or(low, c), above = coarse_or(high, c);
    sum += o * (above - below) / 2 + o * o / 2 * (above - 2 * c + below);
  }
  return sum;
}

}  // namespace sluice::ice::pressure
