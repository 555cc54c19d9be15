// Fields of a refined level whose values, without unit, tell their cell, and samples of them as if
// on many ranks.
#pragma once
#include "framework/analysis/sampler.hpp"

namespace sluice::analysis_test {

struct Labels {
  Label value = declare_label({"sampled", ValueType::real, Centring::cell, "1", "for tests"});
  Label flux = declare_label({"sampled_flux", ValueType::real, Centring::x_face, "1", "for tests"});
  Label wind = declare_label({"sampled_wind", ValueType::vector, Centring::cell, "1", "tests"});
};
inline const Labels& labels() {
  static const Labels all;
  return all;
}

// Level 1 of a plane: 16 x 8 cells of size 1/8, of which boxes hold a part.
inline Level fine_level(const std::vector<GridBox>& boxes) {
  Level level;
  level.index = 1;
  level.spacing = {0.125, 0.125, 1};
  level.domain = {{0, 0, 0}, {16, 8, 1}};
  level.active = {true, true, false};
  level.ratio = {2, 2, 1};
  level.boxes = boxes;
  return level;
}
inline IndexBox columns(int from, int to) {
  return {{from, 0, 0}, {to, 8, 1}};
}
// Columns 2 to 10 in boxes of three ranks.
inline Level cut_level() {
  return fine_level({{columns(6, 8), 1, 0},
                     {columns(2, 4), 2, 1},
                     {columns(8, 10), 0, 2},
                     {columns(4, 6), 1, 3}});
}

inline double value_at(IntVec3 c, int component) {
  return c.x + 100 * c.y - 1000 * component;
}

// What this rank holds of the three labels.
inline Warehouse fields(const Level& level, int rank) {
  Warehouse w(level, rank);
  for (const SlotInfo& s : {SlotInfo{labels().value, 0, 1, 0}, SlotInfo{labels().flux, 0, 1, 1},
                            SlotInfo{labels().wind, 0, 3, 0}}) {
    const int slot = w.add(s);
    for (int b = 0; b < static_cast<int>(w.local_boxes().size()); ++b)
      for (int c = 0; c < s.components; ++c) {
        const RealView v = w.view(slot, c, b);
        for_each_cell(v.box, [&](IntVec3 i) { v(i) = value_at(i, c); });
      }
  }
  return w;
}

// One sample, as if on so many ranks. A step takes 1/8.
inline void take(LevelSampler& sampler, const Level& level, int ranks, int step) {
  std::vector<std::string> packed;
  for (int r = 0; r < ranks; ++r) {
    std::vector<double> numbers;
    sampler.pack(fields(level, r), r, numbers);
    packed.emplace_back(reinterpret_cast<const char*>(numbers.data()),
                        numbers.size() * sizeof(double));
  }
  RankNumbers numbers(packed);
  sampler.write(numbers, step, 0.125 * step);
}

}  // namespace sluice::analysis_test
