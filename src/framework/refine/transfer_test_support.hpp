// Levels, states and operators with an obvious reference, for the tests of transfers. Numbers have
// no unit.
//
// States hold numbers that depend on the cell alone, with all bits of the mantissa in use: a value
// from a wrong cell, or one that was summed in another order, is not equal.
#pragma once
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "framework/base/communicator.hpp"
#include "framework/field/warehouse.hpp"
#include "framework/grid/box_list.hpp"
#include "framework/refine/transfer_operators.hpp"

namespace sluice::transfer_test {

constexpr double untouched = -7;

inline IntVec3 unit(int d) {
  return {d == 0, d == 1, d == 2};
}

// A number in (0, 1) that belongs to a cell.
inline double number_of(IntVec3 c, int salt) {
  std::uint64_t h = 0x9e3779b97f4a7c15ull * static_cast<std::uint64_t>(salt + 1);
  for (int d = 0; d < 3; ++d) {
    h ^= static_cast<std::uint64_t>(c[d] + 1000);
    h *= 0xbf58476d1ce4e5b9ull;
    h ^= h >> 29;
  }
  return static_cast<double>(h >> 11) * 0x1p-53;
}

inline IntVec3 wrapped(const Level& level, IntVec3 c) {
  for (int d = 0; d < 3; ++d) {
    if (!level.periodic[d]) continue;
    const int n = level.domain.size()[d], low = level.domain.lower[d];
    c[d] = low + ((c[d] - low) % n + n) % n;
  }
  return c;
}

inline bool holds(const Level& level, IntVec3 cell) {
  for (const GridBox& b : level.boxes)
    if (b.cells.contains(cell)) return true;
  return false;
}

inline void set_boxes(Level& level, const std::vector<IndexBox>& regions, IntVec3 pieces) {
  level.boxes.clear();
  for (const IndexBox& region : regions)
    for (const IndexBox& cells : split(region, pieces))
      level.boxes.push_back({cells, 0, static_cast<int>(level.boxes.size())});
  assign_owners(level.boxes, world().size());
}

// Two levels: the coarse one over all of its domain unless it is given regions, the fine one over
// the given regions of coarse cells.
struct Shape {
  IndexBox domain;  // of the coarse level
  std::array<bool, 3> periodic;
  IntVec3 ratio;
  std::vector<IndexBox> fine;
  IntVec3 coarse_pieces{1, 1, 1}, fine_pieces{1, 1, 1};
  std::vector<IndexBox> coarse{};
};

struct Levels {
  explicit Levels(const Shape& s) {
    coarse.index = 1;
    fine.index = 2;
    coarse.domain = s.domain;
    fine.domain = refine(s.domain, s.ratio);
    coarse.periodic = fine.periodic = s.periodic;
    for (int d = 0; d < 3; ++d) coarse.active[d] = s.domain.size()[d] > 1;
    fine.active = coarse.active;
    fine.ratio = s.ratio;
    set_boxes(coarse, s.coarse.empty() ? std::vector<IndexBox>{s.domain} : s.coarse,
              s.coarse_pieces);
    std::vector<IndexBox> regions;
    for (const IndexBox& r : s.fine) regions.push_back(refine(r, s.ratio));
    set_boxes(fine, regions, s.fine_pieces);
  }
  Level coarse, fine;
};

// Two slots, three components.
class State {
 public:
  State(const Level& level, int ghosts) : warehouse(level, world().rank()) {
    for (int n = 0; n < 2; ++n) {
      const Label label = declare_label(
          {"transfer_" + std::to_string(n), ValueType::real, Centring::cell, "1", "for tests"});
      slots.push_back(warehouse.add({label, 0, 2 - n, ghosts}));
    }
  }
  // f(view, component number, interior cells) for all arrays of this rank.
  template <class F>
  void each(F&& f) const {
    for (int b = 0; b < static_cast<int>(warehouse.local_boxes().size()); ++b) {
      int component = 0;
      for (const int s : slots)
        for (int c = 0; c < warehouse.info(s).components; ++c)
          f(warehouse.view(s, c, b), component++, warehouse.local_boxes()[b].cells);
    }
  }
  template <class F>
  void fill(F&& value) const {
    each([&](const RealView& v, int component, const IndexBox& cells) {
      for_each_cell(v.box, [&](IntVec3 c) { v(c) = value(c, component, cells); });
    });
  }
  template <class F>
  void expect(F&& value) const {
    each([&](const RealView& v, int component, const IndexBox& cells) {
      for_each_cell(v.box, [&](IntVec3 c) {
        ASSERT_EQ(v(c), value(c, component, cells))
            << "component " << component << " at " << c.x << ' ' << c.y << ' ' << c.z;
      });
    });
  }
  // Numbers of cells in the interior and `ghosts` layers; what lies beyond must not be read.
  void fill_with_numbers(int ghosts, int salt) const {
    const Level& level = warehouse.level();
    fill([&](IntVec3 c, int component, const IndexBox& cells) {
      return cells.grown(level.ghosts(ghosts)).contains(c)
                 ? number_of(wrapped(level, c), salt + component)
                 : std::numeric_limits<double>::quiet_NaN();
    });
  }
  Warehouse warehouse;
  std::vector<int> slots;
};

// One cell of the mock prolongation: constant, or with central slopes.
template <class F>
double prolonged(IntVec3 cell, const TransferGeometry& g, int order, F&& coarse) {
  const IntVec3 below = coarsen(cell, g.ratio);
  double value = coarse(below);
  for (int d = 0; d < 3 && order > 0; ++d) {
    if (!g.active[d]) continue;
    const double slope = 0.5 * (coarse(below + unit(d)) - coarse(below - unit(d)));
    value += slope * ((cell[d] - below[d] * g.ratio[d] + 0.5) / g.ratio[d] - 0.5);
  }
  return value;
}

template <class F>
double restricted(IntVec3 cell, const TransferGeometry& g, F&& fine) {
  double sum = 0;
  for_each_cell(refine(IndexBox{cell, cell + IntVec3::all(1)}, g.ratio),
                [&](IntVec3 c) { sum += fine(c); });
  return sum / (g.ratio.x * g.ratio.y * g.ratio.z);
}

class MockOperators : public TransferOperators {
 public:
  void prolong(const StateViews& coarse, const StateViews& fine, const IndexBox& cells,
               const TransferGeometry& g, int order) const override {
    const IntVec3 layer{g.active[0], g.active[1], g.active[2]};
    const IndexBox needed = coarsen(cells, g.ratio).grown(layer);
    const int row = g.active[0] ? 0 : g.active[1] ? 1 : 2;
    ASSERT_EQ(coarse.size(), fine.size());
    for (std::size_t n = 0; n < fine.size(); ++n) {
      ASSERT_TRUE(coarse[n].box.contains(needed));
      ASSERT_TRUE(fine[n].box.contains(cells));
      ASSERT_EQ(coarse[n].stride[row], 1);
      ASSERT_EQ(fine[n].stride[row], 1);
      for_each_cell(cells, [&](IntVec3 c) { fine[n](c) = prolonged(c, g, order, coarse[n]); });
    }
  }
  void restrict_to(const StateViews& fine, const StateViews& coarse, const IndexBox& cells,
                   const TransferGeometry& g) const override {
    ASSERT_EQ(coarse.size(), fine.size());
    for (std::size_t n = 0; n < fine.size(); ++n) {
      ASSERT_TRUE(coarse[n].box.contains(cells));
      ASSERT_TRUE(fine[n].box.contains(refine(cells, g.ratio)));
      for_each_cell(cells, [&](IntVec3 c) { coarse[n](c) = restricted(c, g, fine[n]); });
    }
  }
  int flux_quantities() const override { return 1; }
  void correct(const StateViews&, const ConservedChange&, std::span<double>) const override {
    FAIL() << "no transfer corrects";
  }
};

// Shapes in all dimensions.
inline std::vector<Shape> whole_shapes() {
  const std::array<bool, 3> open{}, all{true, true, true};
  return {
      {{{0, 0, 0}, {20, 1, 1}}, open, {2, 1, 1}, {{{5, 0, 0}, {9, 1, 1}}}},
      {{{-3, 0, 0}, {17, 1, 1}},
       open,
       {4, 1, 1},
       {{{-3, 0, 0}, {2, 1, 1}}, {{8, 0, 0}, {12, 1, 1}}}},
      {{{0, 0, 0}, {20, 1, 1}}, all, {2, 1, 1}, {{{0, 0, 0}, {4, 1, 1}}, {{19, 0, 0}, {20, 1, 1}}}},
      {{{0, 0, 2}, {1, 1, 22}}, all, {1, 1, 4}, {{{0, 0, 3}, {1, 1, 9}}}},
      {{{0, 0, 0}, {16, 12, 1}},
       open,
       {2, 2, 1},
       {{{3, 3, 0}, {9, 7, 1}}, {{9, 5, 0}, {13, 9, 1}}}},
      {{{0, 0, 0}, {16, 12, 1}},
       {true, false, false},
       {4, 4, 1},
       {{{0, 0, 0}, {4, 12, 1}}, {{14, 4, 0}, {16, 8, 1}}}},
      {{{2, -4, 0}, {18, 8, 1}},
       all,
       {4, 2, 1},
       {{{2, -4, 0}, {6, 0, 1}}, {{14, 4, 0}, {18, 8, 1}}, {{8, 0, 0}, {12, 4, 1}}}},
      {{{0, 0, 0}, {1, 12, 10}}, {false, true, false}, {1, 2, 4}, {{{0, 8, 2}, {1, 12, 6}}}},
      {{{0, 0, 0}, {10, 8, 8}}, open, {2, 2, 2}, {{{2, 2, 2}, {6, 6, 4}}, {{6, 2, 2}, {8, 4, 6}}}},
      {{{0, 0, 0}, {10, 8, 8}}, all, {4, 2, 1}, {{{0, 4, 0}, {4, 8, 4}}, {{8, 0, 4}, {10, 2, 8}}}},
      // the coarse level is itself a refined part of its domain
      {{{0, 0, 0}, {24, 20, 1}},
       open,
       {2, 2, 1},
       {{{6, 6, 0}, {10, 8, 1}}, {{10, 6, 0}, {14, 12, 1}}},
       {1, 1, 1},
       {1, 1, 1},
       {{{4, 4, 0}, {12, 14, 1}}, {{12, 4, 0}, {18, 14, 1}}}},
      {{{0, 0, 0}, {12, 12, 1}},
       all,
       {4, 4, 1},
       {{{0, 0, 0}, {3, 12, 1}}},
       {1, 1, 1},
       {1, 1, 1},
       {{{0, 0, 0}, {5, 12, 1}}, {{10, 0, 0}, {12, 12, 1}}}}};
}

// A shape cut into boxes in several ways.
inline std::vector<Shape> cuts(const Shape& whole) {
  std::vector<Shape> cut;
  for (const auto& [coarse, fine] : {std::pair{1, 1}, {2, 1}, {1, 2}, {2, 2}, {4, 2}}) {
    Shape s = whole;
    for (int d = 0; d < 3; ++d) {
      if (s.domain.size()[d] == 1) continue;
      s.coarse_pieces[d] = s.coarse.empty() ? coarse : std::min(coarse, 2);
      bool halves = true;
      for (const IndexBox& f : s.fine) halves = halves && f.size()[d] % fine == 0;
      s.fine_pieces[d] = halves ? fine : 1;
    }
    cut.push_back(s);
  }
  return cut;
}

inline std::vector<Shape> all_shapes() {
  std::vector<Shape> all;
  for (const Shape& whole : whole_shapes())
    for (const Shape& s : cuts(whole)) all.push_back(s);
  return all;
}

}  // namespace sluice::transfer_test
