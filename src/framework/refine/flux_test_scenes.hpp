// Scenes of two levels, states and fluxes for the tests of the flux register. Numbers have no unit.
#pragma once
#include <gtest/gtest.h>

#include <array>
#include <map>
#include <string>
#include <vector>

#include "framework/refine/flux_test_support.hpp"

namespace sluice::flux_test {

// Numbers of few binary digits (exact sums), and any.
inline double exact_flux(int q, int d, IntVec3 cell, int level, int step) {
  return short_number(0.25 * hashed(static_cast<std::uint64_t>(10 * q + d),
                                    static_cast<std::uint64_t>(10 * level + step), cell));
}
inline double any_flux(int q, int d, IntVec3 cell, int level, int step) {
  return 0.2 * hashed(static_cast<std::uint64_t>(10 * q + d),
                      static_cast<std::uint64_t>(10 * level + step), cell);
}
inline double exact_start(int q, IntVec3 cell, int level) {
  return 40 + short_number(hashed(static_cast<std::uint64_t>(5 + q),
                                  static_cast<std::uint64_t>(level), cell));
}
inline double any_start(int q, IntVec3 cell, int level) {
  return 2 + hashed(static_cast<std::uint64_t>(5 + q), static_cast<std::uint64_t>(level), cell);
}
// Coarse cells that bear next to nothing.
inline double poor_start(int q, IntVec3 cell, int level) {
  return level == 0 && q == 0 ? 0.0625 + 0.03125 * (cell.x % 2) : exact_start(q, cell, level);
}

// Interior values of this rank by quantity and cell (z, y, x).
inline std::map<std::array<int, 4>, double> values_of(TwoLevels& t, Warehouse& w) {
  std::map<std::array<int, 4>, double> values;
  t.each(w, [&](int q, IntVec3 c, double& v) { values[{q, c.z, c.y, c.x}] = v; });
  return values;
}

struct Case {
  const char* name;
  Scene scene;
};

inline const std::vector<Case>& cases() {
  static const std::vector<Case> all = {
      {"line", {{16, 1, 1}, {2, 1, 1}, {}, {{{5, 0, 0}, {9, 1, 1}}}}},
      {"line_along_y", {{1, 16, 1}, {1, 4, 1}, {}, {{{0, 5, 0}, {1, 9, 1}}}}},
      {"line_ends", {{16, 1, 1}, {4, 1, 1}, {}, {{{0, 0, 0}, {4, 1, 1}}}}},
      {"line_round", {{16, 1, 1}, {2, 1, 1}, {true, false, false}, {{{12, 0, 0}, {16, 1, 1}}}}},
      // one coarse cell between the two ends of the same fine region
      {"line_nearly_round", {{6, 1, 1}, {2, 1, 1}, {true, false, false}, {{{1, 0, 0}, {6, 1, 1}}}}},
      {"plane", {{12, 10, 1}, {2, 2, 1}, {}, {{{4, 3, 0}, {8, 7, 1}}}}},
      {"plane_four", {{12, 10, 1}, {4, 4, 1}, {}, {{{4, 3, 0}, {8, 7, 1}}}}},
      {"plane_uneven", {{12, 10, 1}, {4, 2, 1}, {}, {{{0, 3, 0}, {8, 7, 1}}}}},
      {"plane_xz", {{12, 1, 10}, {2, 1, 4}, {}, {{{4, 0, 3}, {8, 1, 7}}}}},
      {"plane_yz", {{1, 12, 10}, {1, 2, 2}, {true, true, true}, {{{0, 0, 3}, {1, 8, 7}}}}},
      // coarse cells with fine ones on two and three sides
      {"notches",
       {{12, 12, 1},
        {2, 2, 1},
        {},
        {{{2, 2, 0}, {10, 5, 1}}, {{2, 5, 0}, {5, 9, 1}}, {{6, 5, 0}, {8, 9, 1}}}}},
      // a coarse cell with fine ones all around
      {"hole",
       {{11, 12, 1},
        {2, 2, 1},
        {},
        {{{3, 3, 0}, {8, 5, 1}},
         {{3, 6, 0}, {8, 8, 1}},
         {{3, 5, 0}, {5, 6, 1}},
         {{6, 5, 0}, {8, 6, 1}}}}},
      {"plane_round",
       {{12, 10, 1},
        {2, 2, 1},
        {true, true, false},
        {{{0, 0, 0}, {3, 4, 1}}, {{9, 7, 0}, {12, 10, 1}}, {{4, 8, 0}, {6, 10, 1}}}}},
      {"space", {{8, 8, 8}, {2, 2, 2}, {}, {{{2, 3, 2}, {6, 6, 5}}}}},
      {"space_four", {{8, 6, 6}, {4, 4, 4}, {}, {{{2, 2, 2}, {5, 4, 4}}}}},
      {"space_uneven", {{8, 6, 6}, {4, 2, 1}, {true, false, true}, {{{2, 2, 3}, {8, 4, 6}}}}},
      {"space_corner",
       {{8, 8, 8},
        {2, 2, 2},
        {true, true, true},
        {{{0, 0, 0}, {6, 6, 3}}, {{0, 0, 3}, {3, 6, 6}}, {{3, 0, 3}, {6, 3, 6}}}}},
  };
  return all;
}

class FluxRegisters : public testing::TestWithParam<std::size_t> {
 protected:
  const Scene& scene() const { return cases()[GetParam()].scene; }
  // Cut in many boxes, dealt out to all ranks.
  static Cut many(const Scene& s) {
    Cut cut;
    cut.all_here = false;
    for (int d = 0; d < 3; ++d) {
      cut.coarse[d] = s.cells[d] > 1 ? 3 : 1;
      cut.fine[d] = s.cells[d] > 1 ? 2 : 1;
    }
    return cut;
  }
};

inline std::string name_of_case(const testing::TestParamInfo<std::size_t>& which) {
  return cases()[which.param].name;
}

}  // namespace sluice::flux_test
