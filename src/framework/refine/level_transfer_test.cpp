// Transfers against direct evaluation, cell by cell and bit by bit, whatever the boxes and ranks.
//
// Registered once more on three ranks (CMakeLists.txt).
#include "framework/refine/level_transfer.hpp"

#include "framework/base/close_ranks_test_support.hpp"
#include "framework/base/reduction.hpp"
#include "framework/refine/transfer_test_support.hpp"

namespace sluice::level_transfer_test {
namespace {

using namespace transfer_test;

constexpr int coarse_ghosts = 3, fine_ghosts = 4, old_salt = 10, new_salt = 20;

double coarse_number(const Level& coarse, IntVec3 cell, int component, double share) {
  const IntVec3 c = wrapped(coarse, cell);
  const double a = number_of(c, old_salt + component), b = number_of(c, new_salt + component);
  return share == 0 ? a : share == 1 ? b : (1 - share) * a + share * b;
}

// What holds for one shape that is cut into boxes in one way.
class Transfers {
 public:
  explicit Transfers(const Shape& shape) : levels(shape) {}
  void fill_ghosts();
  void fill_new_cells();
  void restrict_covered_cells();
  void copy_to_another_layout();

 private:
  double wanted(IntVec3 cell, int component, double share, int order) const {
    return prolonged(cell, geometry(), order,
                     [&](IntVec3 c) { return coarse_number(levels.coarse, c, component, share); });
  }
  TransferGeometry geometry() const { return {levels.fine.ratio, levels.fine.active}; }

  Levels levels;
  MockOperators operators;
  ThreadTeam team{2};
  int rank = world().rank();
};

void Transfers::fill_ghosts() {
  State before(levels.coarse, coarse_ghosts + 1), after(levels.coarse, coarse_ghosts + 1);
  before.fill_with_numbers(coarse_ghosts, old_salt);
  after.fill_with_numbers(coarse_ghosts, new_salt);
  State fine(levels.fine, fine_ghosts);
  for (const int width : {1, 3}) {
    Interpolation ghosts =
        Interpolation::for_ghosts(levels.coarse, coarse_ghosts, levels.fine, width, rank);
    const auto is_target = [&](IntVec3 c, const IndexBox& cells) {
      const IntVec3 inside = wrapped(levels.fine, c);
      return cells.grown(levels.fine.ghosts(width)).contains(c) &&
             levels.fine.domain.contains(inside) && !holds(levels.fine, inside);
    };
    for (const double share : {0.0, 0.3, 1.0})
      for (const int order : {0, 1}) {
        fine.fill([](IntVec3, int, const IndexBox&) { return untouched; });
        ghosts.run(share < 1 ? &before.warehouse : nullptr, share > 0 ? &after.warehouse : nullptr,
                   share, fine.warehouse, fine.slots, operators, order,
                   order == 0 ? nullptr : &team);
        std::int64_t cells = 0;
        fine.expect([&](IntVec3 c, int component, const IndexBox& interior) {
          if (!is_target(c, interior)) return untouched;
          cells += component == 0;
          return wanted(c, component, share, order);
        });
        EXPECT_EQ(ghosts.cells(), cells);
      }
  }
}

void Transfers::fill_new_cells() {
  State before(levels.coarse, coarse_ghosts + 1);
  before.fill_with_numbers(coarse_ghosts, old_salt);
  State fine(levels.fine, fine_ghosts);
  // Earlier, the level held less at one end and more at the other.
  Level earlier = levels.fine;
  IntVec3 shift;
  for (int d = 0; d < 3; ++d)
    if (levels.fine.active[d]) shift[d] = 2 * levels.fine.ratio[d];
  for (GridBox& b : earlier.boxes) b.cells = b.cells.shifted(shift);
  for (const bool first : {true, false}) {
    fine.fill([](IntVec3, int, const IndexBox&) { return untouched; });
    const std::vector<GridBox> held = first ? std::vector<GridBox>{} : earlier.boxes;
    Interpolation made =
        Interpolation::for_new_cells(levels.coarse, coarse_ghosts, levels.fine, held, rank);
    made.run(&before.warehouse, nullptr, 0, fine.warehouse, fine.slots, operators, 1);
    fine.expect([&](IntVec3 c, int component, const IndexBox& interior) {
      const bool is_new = interior.contains(c) && (first || !holds(earlier, c));
      return is_new ? wanted(c, component, 0, 1) : untouched;
    });
  }
}

void Transfers::restrict_covered_cells() {
  State fine(levels.fine, fine_ghosts), coarse(levels.coarse, coarse_ghosts);
  fine.fill_with_numbers(0, old_salt);
  coarse.fill([](IntVec3, int, const IndexBox&) { return untouched; });
  Restriction restriction(levels.coarse, levels.fine, rank);
  for (int again = 0; again < 2; ++again)
    restriction.run(fine.warehouse, coarse.warehouse, fine.slots, operators);
  coarse.expect([&](IntVec3 c, int component, const IndexBox& interior) {
    if (!interior.contains(c) || !holds(levels.fine, c * levels.fine.ratio)) return untouched;
    return restricted(c, geometry(), [&](IntVec3 f) { return number_of(f, old_salt + component); });
  });
}

void Transfers::copy_to_another_layout() {
  // Every layout of the coarse level, to boxes that are cut elsewhere and owned by other ranks.
  Level other = levels.coarse;
  const IndexBox whole = levels.coarse.domain;
  IndexBox part = whole;
  for (int d = 0; d < 3; ++d)
    if (whole.size()[d] > 1) part.lower[d] += 3;
  set_boxes(other, {part}, {1 + 2 * levels.coarse.active[0], 1, 1 + levels.coarse.active[2]});
  for (GridBox& b : other.boxes) b.owner = world().size() - 1 - b.owner;
  State from(levels.coarse, coarse_ghosts), to(other, fine_ghosts);
  from.fill_with_numbers(0, old_salt);
  to.fill([](IntVec3, int, const IndexBox&) { return untouched; });
  LevelCopy copy(levels.coarse, other, rank);
  for (int again = 0; again < 2; ++again) copy.run(from.warehouse, to.warehouse, from.slots);
  to.expect([&](IntVec3 c, int component, const IndexBox& interior) {
    const bool shared = interior.contains(c) && holds(levels.coarse, c);
    return shared ? number_of(c, old_salt + component) : untouched;
  });
}

class Transfer : public testing::TestWithParam<Shape> {
 protected:
  void check(void (Transfers::*what)()) {
    for (const Shape& shape : cuts(GetParam())) {
      SCOPED_TRACE(testing::Message() << "coarse pieces " << shape.coarse_pieces.x << ", fine "
                                      << shape.fine_pieces.x);
      (Transfers(shape).*what)();
    }
  }
};

TEST_P(Transfer, fills_the_ghosts_that_no_box_holds) {
  check(&Transfers::fill_ghosts);
}
TEST_P(Transfer, fills_new_cells) {
  check(&Transfers::fill_new_cells);
}
TEST_P(Transfer, restricts_what_lies_under_fine_boxes) {
  check(&Transfers::restrict_covered_cells);
}
TEST_P(Transfer, copies_between_layouts) {
  check(&Transfers::copy_to_another_layout);
}

INSTANTIATE_TEST_SUITE_P(Levels, Transfer, testing::ValuesIn(whole_shapes()));

// Beside a side the outermost ghosts of a box have no neighbour along it: boxes fill them each in
// its own way. What stands there must not come into any fine cell, where some box knows better.
class TransferBesideSides : public testing::TestWithParam<Shape> {};

bool beyond(const Level& level, IntVec3 c, int d) {
  return !level.periodic[d] && (c[d] < level.domain.lower[d] || c[d] >= level.domain.upper[d]);
}

bool lacks_a_neighbour(const Level& level, IntVec3 c, const IndexBox& interior) {
  const IndexBox filled = interior.grown(level.ghosts(coarse_ghosts));
  for (int d = 0; d < 3; ++d)
    for (int e = 0; e < 3 && beyond(level, c, d); ++e)
      if (e != d && level.active[e] && !beyond(level, c, e) &&
          (c[e] == filled.lower[e] || c[e] == filled.upper[e] - 1))
        return true;
  return false;
}

TEST_P(TransferBesideSides, does_not_show_which_box_filled_a_ghost) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  for (const Shape& shape : cuts(GetParam())) {
    SCOPED_TRACE(testing::Message()
                 << "coarse pieces " << shape.coarse_pieces.x << ", fine " << shape.fine_pieces.x);
    const Levels levels(shape);
    const TransferGeometry geometry{levels.fine.ratio, levels.fine.active};
    State coarse(levels.coarse, coarse_ghosts + 1), fine(levels.fine, fine_ghosts);
    coarse.fill([&](IntVec3 c, int component, const IndexBox& interior) {
      return lacks_a_neighbour(levels.coarse, c, interior)
                 ? nan
                 : coarse_number(levels.coarse, c, component, 0);
    });
    const int rank = world().rank();
    const auto ghosts = [&](int width) {
      return Interpolation::for_ghosts(levels.coarse, coarse_ghosts, levels.fine, width, rank);
    };
    Interpolation all[] = {
        ghosts(1), ghosts(3),
        Interpolation::for_new_cells(levels.coarse, coarse_ghosts, levels.fine, {}, rank)};
    for (Interpolation& one : all) {
      fine.fill([](IntVec3, int, const IndexBox&) { return untouched; });
      one.run(&coarse.warehouse, nullptr, 0, fine.warehouse, fine.slots, MockOperators(), 1);
      std::int64_t beside = 0;  // that needed ghosts of a side
      fine.each([&](const RealView& v, int component, const IndexBox&) {
        for_each_cell(v.box, [&](IntVec3 c) {
          if (v(c) == untouched) return;
          ASSERT_EQ(v(c), prolonged(c, geometry, 1,
                                    [&](IntVec3 at) {
                                      for (int d = 0; d < 3; ++d)
                                        beside += beyond(levels.coarse, at, d);
                                      return coarse_number(levels.coarse, at, component, 0);
                                    }))
              << "component " << component << " at " << c.x << ' ' << c.y << ' ' << c.z;
        });
      });
      Reduction of_all_ranks;
      const auto sum = of_all_ranks.add_count(beside);
      world().reduce(of_all_ranks);
      EXPECT_GT(of_all_ranks.count(sum), 0);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(
    Levels, TransferBesideSides,
    testing::Values(
        Shape{{{0, 0, 0}, {16, 12, 1}}, {}, {2, 2, 1}, {{{0, 3, 0}, {4, 9, 1}}}},
        Shape{{{0, 0, 0}, {16, 12, 1}},
              {},
              {4, 4, 1},
              {{{0, 0, 0}, {4, 4, 1}}, {{10, 8, 0}, {16, 12, 1}}}},
        Shape{{{0, 0, 0}, {16, 12, 1}},
              {false, true, false},
              {2, 2, 1},
              {{{0, 0, 0}, {4, 3, 1}}, {{12, 9, 0}, {16, 11, 1}}}},
        Shape{{{0, 0, 0}, {16, 12, 1}}, {true, false, false}, {4, 4, 1}, {{{0, 0, 0}, {3, 4, 1}}}},
        Shape{{{0, 0, 0}, {10, 8, 8}}, {}, {2, 2, 2}, {{{0, 2, 2}, {4, 6, 6}}}},
        Shape{{{0, 0, 0}, {10, 8, 8}},
              {false, true, false},
              {2, 2, 2},
              {{{0, 0, 0}, {4, 3, 4}}, {{6, 6, 4}, {10, 8, 8}}}}));

TEST(TransferLimits, threads_share_the_work) {
  Shape shape{{{0, 0, 0}, {96, 96, 1}}, {}, {2, 2, 1}, {}, {2, 2, 1}};
  for (int j = 4; j < 90; j += 12)
    for (int i = 4; i < 90; i += 12) shape.fine.push_back({{i, j, 0}, {i + 8, j + 8, 1}});
  const Levels levels(shape);
  State before(levels.coarse, coarse_ghosts), after(levels.coarse, coarse_ghosts);
  before.fill_with_numbers(coarse_ghosts, old_salt);
  after.fill_with_numbers(coarse_ghosts, new_salt);
  Interpolation ghosts =
      Interpolation::for_ghosts(levels.coarse, coarse_ghosts, levels.fine, 3, world().rank());
  ASSERT_GT(ghosts.cells(), 4 * 2048 / world().size() / 2);  // enough for several threads
  State alone(levels.fine, 3), together(levels.fine, 3);
  const ThreadTeam team(3);
  ghosts.run(&before.warehouse, &after.warehouse, 0.7, alone.warehouse, alone.slots,
             MockOperators(), 1);
  ghosts.run(&before.warehouse, &after.warehouse, 0.7, together.warehouse, together.slots,
             MockOperators(), 1, &team);
  std::vector<RealView> views;
  alone.each([&](const RealView& v, int, const IndexBox&) { views.push_back(v); });
  std::size_t n = 0;
  together.each([&](const RealView& v, int, const IndexBox&) {
    for_each_cell(v.box, [&](IntVec3 c) { ASSERT_EQ(v(c), views[n](c)); });
    ++n;
  });
  // Fine boxes that are large enough to be dealt out in slabs.
  Levels large({{{0, 0, 0}, {96, 96, 1}}, {}, {2, 2, 1}, {{{4, 4, 0}, {92, 92, 1}}}});
  State fine(large.fine, 3), coarse(large.coarse, 3);
  fine.fill_with_numbers(0, old_salt);
  coarse.fill([](IntVec3, int, const IndexBox&) { return untouched; });
  Restriction(large.coarse, large.fine, world().rank())
      .run(fine.warehouse, coarse.warehouse, fine.slots, MockOperators(), &team);
  const TransferGeometry geometry{large.fine.ratio, large.fine.active};
  coarse.expect([&](IntVec3 c, int component, const IndexBox&) {
    if (!holds(large.fine, c * large.fine.ratio)) return untouched;
    return restricted(c, geometry, [&](IntVec3 f) { return number_of(f, old_salt + component); });
  });
}

TEST(TransferLimits, linear_functions_come_through) {
  const auto plane = [](Vec3 x, int component) {
    return component + 2.0 * x.x - 3.0 * x.y + 0.5 * x.z;
  };
  for (const Shape& shape : all_shapes()) {
    if (shape.periodic[0] || shape.periodic[1] || shape.periodic[2]) continue;
    Levels levels(shape);
    for (int d = 0; d < 3; ++d) levels.fine.spacing[d] = 1.0 / shape.ratio[d];
    State before(levels.coarse, coarse_ghosts), fine(levels.fine, 3);
    before.fill(
        [&](IntVec3 c, int n, const IndexBox&) { return plane(levels.coarse.centre(c), n); });
    const auto exact = [&](IntVec3 c, int n, const IndexBox&) {
      return plane(levels.fine.centre(c), n);
    };
    fine.fill(exact);
    Interpolation::for_ghosts(levels.coarse, coarse_ghosts, levels.fine, 3, world().rank())
        .run(&before.warehouse, nullptr, 0, fine.warehouse, fine.slots, MockOperators(), 1);
    fine.each([&](const RealView& v, int n, const IndexBox& cells) {
      for_each_cell(v.box, [&](IntVec3 c) { ASSERT_NEAR(v(c), exact(c, n, cells), 1e-12); });
    });
  }
}

TEST(TransferLimits, refuses_levels_that_do_not_nest) {
  // The fine box reaches the end of the coarse one, whose ghost layers are too few.
  Shape shape{{{0, 0, 0}, {24, 1, 1}},   {},        {2, 1, 1},
              {{{6, 0, 0}, {12, 1, 1}}}, {1, 1, 1}, {1, 1, 1},
              {{{4, 0, 0}, {12, 1, 1}}}};
  const Levels close(shape);
  EXPECT_NO_THROW(
      Interpolation::for_ghosts(close.coarse, 3, close.fine, 3, close.fine.boxes[0].owner));
  EXPECT_THROW(Interpolation::for_ghosts(close.coarse, 2, close.fine, 3, close.fine.boxes[0].owner),
               std::logic_error);
  EXPECT_NO_THROW(Restriction(close.coarse, close.fine, 0));
  shape.fine[0].upper.x = 13;
  const Levels beyond(shape);
  EXPECT_THROW(Restriction(beyond.coarse, beyond.fine, 0), std::logic_error);
  Levels uneven(shape);
  uneven.fine.boxes[0].cells.upper.x -= 3;
  EXPECT_THROW(Restriction(uneven.coarse, uneven.fine, 0), std::logic_error);
}

TEST(TransferLimits, refuses_a_time_without_its_state) {
  const Levels levels({{{0, 0, 0}, {20, 1, 1}}, {}, {2, 1, 1}, {{{5, 0, 0}, {9, 1, 1}}}});
  State before(levels.coarse, 3), fine(levels.fine, 3);
  Interpolation ghosts =
      Interpolation::for_ghosts(levels.coarse, 3, levels.fine, 3, world().rank());
  const MockOperators operators;
  for (const double share : {0.5, 1.0, -0.1, 1.1})
    EXPECT_THROW(
        ghosts.run(&before.warehouse, nullptr, share, fine.warehouse, fine.slots, operators, 1),
        std::logic_error);
}

}  // namespace
}  // namespace sluice::level_transfer_test
