// Drawing scenes.
#include "properties/random_scene.hpp"

#include <algorithm>
#include <random>

namespace sluice::properties {
namespace {

constexpr double most_work = 60000;  // cells of the finest level, if everywhere, times substeps

class Pick {
 public:
  explicit Pick(unsigned long seed) : random_(static_cast<unsigned>(seed)) {}
  int operator()(int n) const {  // 0 .. n - 1
    return static_cast<int>(random_() % static_cast<unsigned>(n));
  }

 private:
  mutable std::mt19937 random_;
};

SkewCase draw(unsigned long seed, const Pick& pick) {
  SkewCase c;
  c.name = "scene" + std::to_string(seed);
  const int dimensions = 1 + pick(3);
  c.cells = IntVec3::all(1);
  const int first = pick(3);
  for (int n = 0; n < dimensions; ++n) {
    const int most = dimensions == 1 ? 60 : dimensions == 2 ? 20 : 9;
    c.cells[(first + n) % 3] = 5 + pick(most);
  }
  c.cross_flow = pick(3) == 0;
  for (int d = 0; d < 3; ++d) {
    const auto low = static_cast<std::size_t>(2 * d);
    if (c.cells[d] == 1) {
      c.sides[low] = c.sides[low + 1] = c.cross_flow ? SideKind::open : SideKind::symmetry;
    } else if (pick(4) == 0) {
      c.sides[low] = c.sides[low + 1] = SideKind::periodic;
    } else {
      c.sides[low] = static_cast<SideKind>(pick(5));
      c.sides[low + 1] = static_cast<SideKind>(pick(5));
    }
  }
  // A moving wall drags the gas along an inactive direction: between symmetric faces that would be
  // a cavity whose pressure on the faces, not its momentum, sets the round-off.
  for (int d = 0; d < 3; ++d)
    if (std::count(c.sides.begin(), c.sides.end(), SideKind::moving_wall) > 0 && c.cells[d] == 1)
      c.sides[static_cast<std::size_t>(2 * d)] = c.sides[static_cast<std::size_t>(2 * d + 1)] =
          SideKind::open;
  if (pick(3) == 0) c.gravity = {0.01 * pick(4), -0.01 * pick(4), 0.01 * pick(4)};
  if (pick(3) == 0) c.viscosity = 0.001 * (1 + pick(9));
  c.second_order = pick(4) != 0;
  c.internal_energy_form = pick(4) == 0;
  // Not another draw: the scenes of a seed stay what they were.
  if (c.viscosity > 0 && !c.internal_energy_form) c.conductivity = 1.5 * c.viscosity;
  return c;
}

double work(const SkewCase& c) {
  double cells = 1, substeps = 1;
  const IntVec3 n = c.cells_of(c.levels.most - 1);
  for (int d = 0; d < 3; ++d) cells *= n[d];
  for (int l = 1; l < c.levels.most; ++l) {
    int most = 1;
    for (int d = 0; d < 3; ++d)
      if (c.cells[d] > 1) most = std::max(most, c.levels.ratio(l)[d]);
    substeps *= most;
  }
  return cells * substeps;
}

// A ratio that refines at least one direction, and a tile of whole coarse cells.
void draw_level(const SkewCase& c, const Pick& pick, SkewLevels& levels) {
  constexpr int ratios[] = {1, 2, 2, 2, 4};
  IntVec3 ratio, tile;
  bool refines = false;
  while (!refines)
    for (int d = 0; d < 3; ++d) {
      ratio[d] = ratios[pick(5)];
      refines = refines || (c.active(d) && c.cells[d] > 1 && ratio[d] > 1);
    }
  for (int d = 0; d < 3; ++d) tile[d] = std::max(4, ratio[d] * (1 + pick(5)));
  for (int d = 0; d < 3; ++d) tile[d] += (ratio[d] - tile[d] % ratio[d]) % ratio[d];
  levels.ratios.push_back(ratio);
  levels.tiles.push_back(tile);
}

SkewLevels draw_levels(const SkewCase& c, const Pick& pick) {
  SkewLevels levels;
  levels.most = 2 + pick(3);
  levels.ratios.clear();
  levels.tiles.clear();
  for (int l = 1; l < levels.most; ++l) draw_level(c, pick, levels);
  levels.threshold = 1 << pick(7);
  const auto dilation = [&](int least, int n) {
    return IntVec3{least + pick(n), least + pick(n), least + pick(n)};
  };
  levels.stability = dilation(0, 3);
  levels.regrid = dilation(0, 2);
  levels.deletion = dilation(0, 3);
  levels.margin = dilation(1, 2);
  levels.interval = pick(8);
  levels.order = pick(3);
  levels.lock_step = pick(4) == 0;
  return levels;
}

}  // namespace

SkewCase draw_scene(unsigned long seed) {
  return draw(seed, Pick(seed));
}

SkewCase draw_scene_on_levels(unsigned long seed) {
  const Pick pick(seed);
  SkewCase c = draw(seed, pick);
  do {
    c.levels = draw_levels(c, pick);
  } while (work(c) > most_work);
  return c;
}

}  // namespace sluice::properties
