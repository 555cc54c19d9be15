// What the finer level lets through is what the coarse cell gets: nothing is created at interfaces.
//
// Registered once more on three ranks (CMakeLists.txt).
#include "framework/refine/flux_register.hpp"

#include <gtest/gtest.h>

#include "framework/base/close_ranks_test_support.hpp"
#include "framework/base/reduction.hpp"
#include "framework/refine/flux_test_scenes.hpp"

namespace sluice::flux_register_test {
namespace {

using namespace flux_test;

// Fine fluxes that go one way, where the coarse level has none; through the first faces they go
// the other way, so that a cell between both ends of a fine region loses on both sides.
double wind(double speed, int d, IntVec3 cell, int level) {
  return level * (cell[d] == 0 ? -speed : speed);
}

// Total of a quantity over what no finer level covers, on all ranks.
double total(TwoLevels& t, int quantity) {
  ExactSum sum;
  const double fine_volume = t.levels().fine.cell_volume();
  t.each(t.coarse(), [&](int q, IntVec3 c, double& v) {
    if (q == quantity && !t.covered(c)) sum.add(v);
  });
  t.each(t.fine(), [&](int q, IntVec3, double& v) {
    if (q == quantity) sum.add(v * fine_volume);
  });
  Reduction all;
  const auto slot = all.add_sum(sum);
  world().reduce(all);
  return all.sum(slot).value();
}

double total_at_start(TwoLevels& t, int quantity, const Start& start) {
  t.each(t.coarse(), [&](int q, IntVec3 c, double& v) { v = start(q, c, 0); });
  t.each(t.fine(), [&](int q, IntVec3 c, double& v) { v = start(q, c, 1); });
  return total(t, quantity);
}

// The changes of coarse cells, by cell and face, found by asking every cell for its neighbours.
class Reference {
 public:
  Reference(TwoLevels& t, const Flux& flux, int substeps) {
    const Level& coarse = t.levels().coarse;
    for_each_cell(coarse.domain, [&](IntVec3 c) {
      if (t.covered(c)) return;
      for (int d = 0; d < 3; ++d)
        for (const bool high : {false, true}) add_face(t, flux, substeps, c, d, high);
    });
  }

  struct Face {
    int direction;
    bool high;
    double change[quantities];
    std::vector<IntVec3> fine_cells;
  };
  std::map<std::array<int, 3>, std::vector<Face>> faces;  // by (z, y, x)

  double change(IntVec3 c, int q) const {
    double sum = 0;
    if (const auto at = faces.find({c.z, c.y, c.x}); at != faces.end())
      for (const Face& f : at->second) sum += f.change[q];
    return sum;
  }

 private:
  void add_face(TwoLevels& t, const Flux& flux, int substeps, IntVec3 c, int d, bool high) {
    const Level &coarse = t.levels().coarse, &fine = t.levels().fine;
    if (!coarse.active[d]) return;
    IntVec3 neighbour = c;
    neighbour[d] += high ? 1 : -1;
    if (!coarse.domain.contains(neighbour) && !coarse.periodic[d]) return;
    neighbour = wrapped(neighbour, coarse);
    if (!t.covered(neighbour)) return;
    Face face{d, high, {}, {}};
    IndexBox layer = refine(IndexBox{neighbour, neighbour + IntVec3::all(1)}, fine.ratio);
    if (high)
      layer.upper[d] = layer.lower[d] + 1;
    else
      layer.lower[d] = layer.upper[d] - 1;
    for_each_cell(layer, [&](IntVec3 f) { face.fine_cells.push_back(f); });
    for (int q = 0; q < quantities; ++q) {
      double sum = 0;
      for (int s = 0; s < substeps; ++s)
        for (IntVec3 f : face.fine_cells) {
          if (!high) ++f[d];
          sum += flux(q, d, wrapped(f, fine), 1, s);
        }
      IntVec3 own = c;
      if (high) ++own[d];
      const double recorded = flux(q, d, wrapped(own, coarse), 0, 0);
      face.change[q] = (high ? -1 : 1) * (sum * fine.cell_volume() - recorded);
    }
    faces[{c.z, c.y, c.x}].push_back(face);
  }
};

TEST_P(FluxRegisters, CoarseCellsGetWhatPassesTheFineFaces) {
  TwoLevels t(scene(), many(scene()), world());
  const int substeps = 3;
  Start start = exact_start;
  EXPECT_EQ(t.step(start, exact_flux, substeps).limited, 0);
  const Reference wanted(t, exact_flux, substeps);
  EXPECT_FALSE(wanted.faces.empty());
  // Without interface faces the same fluxes move what the scheme of the level alone moves.
  Scene bare = scene();
  bare.refined = {};
  TwoLevels alone(bare, Cut{}, world());
  alone.step(start, exact_flux, substeps);
  const auto plain = values_of(alone, alone.coarse());
  t.each(t.coarse(), [&](int q, IntVec3 c, double& v) {
    ASSERT_EQ(v, plain.at({q, c.z, c.y, c.x}) + wanted.change(c, q))
        << q << " at " << c.x << ' ' << c.y << ' ' << c.z;
  });
}

TEST_P(FluxRegisters, KeepTotals) {
  TwoLevels t(scene(), many(scene()), world());
  for (int q = 0; q < quantities; ++q) {
    const double before = total_at_start(t, q, exact_start);
    const CorrectionReport report = t.step(exact_start, exact_flux, 2);
    EXPECT_EQ(report.limited, 0);
    EXPECT_FALSE(report.failed);
    EXPECT_EQ(total(t, q), before);
  }
}

TEST_P(FluxRegisters, KeepTotalsWhereCellsAreLimited) {
  TwoLevels t(scene(), many(scene()), world());
  std::int64_t limited = 0;
  for (const double sign : {1.0, -1.0})
    for (int q = 0; q < quantities; ++q) {
      const double before = total_at_start(t, q, poor_start);
      const Flux flux = [&](int k, int d, IntVec3 cell, int level, int step) {
        return wind(sign * 0.5, d, cell, level) + level * exact_flux(k, d, cell, level, step);
      };
      const CorrectionReport report = t.step(poor_start, flux, 2);
      limited += report.limited;
      EXPECT_FALSE(report.failed);
      EXPECT_EQ(total(t, q), before);
    }
  EXPECT_GT(limited, 0);
}

TEST_P(FluxRegisters, SayWhichCellsAreLimitedAndGiveTheRestToTheirFineCells) {
  TwoLevels t(scene(), many(scene()), world());
  const int substeps = 2;
  const CorrectionReport report = t.step(poor_start, exact_flux, substeps);
  const Reference wanted(t, exact_flux, substeps);
  Scene bare = scene();
  bare.refined = {};
  TwoLevels alone(bare, Cut{}, world());
  alone.step(poor_start, exact_flux, substeps);
  const auto plain = values_of(alone, alone.coarse());
  std::int64_t limited = 0;
  IntVec3 first{};
  std::map<std::array<int, 4>, double> back;  // changes of fine cells
  for (const auto& [key, faces] : wanted.faces) {
    const IntVec3 c{key[2], key[1], key[0]};
    const double share = Positive::share(plain.at({0, c.z, c.y, c.x}), wanted.change(c, 0));
    if (share < 1 && limited++ == 0) first = c;
    for (const Reference::Face& f : faces)
      for (const IntVec3& cell : f.fine_cells)
        for (int q = 0; q < quantities; ++q)
          back[{q, cell.z, cell.y, cell.x}] += (1 - share) * f.change[q] /
                                               static_cast<double>(f.fine_cells.size()) /
                                               t.levels().fine.cell_volume();
  }
  EXPECT_EQ(report.limited, limited);
  EXPECT_EQ(report.first, first);
  EXPECT_FALSE(report.failed);
  // The same with cells that bear everything: nothing goes back.
  TwoLevels rich(scene(), many(scene()), world());
  rich.step(exact_start, exact_flux, substeps);
  const auto without = values_of(rich, rich.fine());
  t.each(t.fine(), [&](int q, IntVec3 c, double& v) {
    const auto more = back.find({q, c.z, c.y, c.x});
    ASSERT_EQ(v, without.at({q, c.z, c.y, c.x}) + (more == back.end() ? 0.0 : more->second));
  });
}

TEST_P(FluxRegisters, FailWhereFineCellsCannotTakeTheRestEither) {
  TwoLevels t(scene(), many(scene()), world());
  const Start poor = [](int q, IntVec3, int) { return q == 0 ? 0x1p-12 : 1.0; };
  // What comes into a fine cell leaves it again: only the coarse cells lose.
  bool failed = false;
  for (const double sign : {1.0, -1.0}) {
    const Flux flux = [&](int, int d, IntVec3 cell, int level, int) {
      return wind(sign * 0.25, d, cell, level);
    };
    const CorrectionReport report = t.step(poor, flux, 2);
    EXPECT_TRUE(report.limited > 0 || !report.failed);
    failed = failed || report.failed;
  }
  EXPECT_TRUE(failed);
}

TEST_P(FluxRegisters, DoNotDependOnBoxesOrRanks) {
  for (const bool poor : {false, true}) {
    const Start start = poor ? poor_start : any_start;
    TwoLevels one(scene(), Cut{}, world()), other(scene(), many(scene()), world());
    const CorrectionReport a = one.step(start, any_flux, 2), b = other.step(start, any_flux, 2);
    EXPECT_EQ(a.limited, b.limited * world().size());  // each rank counted all cells of the first
    EXPECT_EQ(a.first, b.first);
    if (one.levels().coarse.active_count() > 1) {
      EXPECT_EQ(a.limited > 0, poor);
    }
    const auto coarse = values_of(one, one.coarse()), fine = values_of(one, one.fine());
    for (const bool is_fine : {false, true})
      other.each(is_fine ? other.fine() : other.coarse(), [&](int q, IntVec3 c, double& v) {
        ASSERT_EQ(v, (is_fine ? fine : coarse).at({q, c.z, c.y, c.x}));
      });
  }
}

INSTANTIATE_TEST_SUITE_P(FluxRegister, FluxRegisters,
                         testing::Range(std::size_t{0}, cases().size()), name_of_case);

TEST(FluxRegister, LeavesCellsAloneThatNothingChanges) {
  Scene scene{{12, 10, 1}, {2, 2, 1}, {}, {{{4, 3, 0}, {8, 7, 1}}}};
  TwoLevels t(scene, Cut{}, world());
  const Flux uniform = [](int, int, IntVec3, int level, int) { return level == 0 ? 0.5 : 0.5; };
  t.step(any_start, uniform, 2);  // two substeps of fluxes 1/2 of width 1/2: 1/2 a coarse face
  TwoLevels alone(Scene{{12, 10, 1}, {2, 2, 1}, {}, {}}, Cut{}, world());
  alone.step(any_start, uniform, 2);
  const auto plain = values_of(alone, alone.coarse());
  t.each(t.coarse(), [&](int q, IntVec3 c, double& v) {
    ASSERT_EQ(v, plain.at({q, c.z, c.y, c.x}));
  });
}

TEST(FluxRegister, IsEmptyWithoutAFinerLevelAndWhereThatIsEverywhere) {
  for (const std::vector<IndexBox>& refined :
       {std::vector<IndexBox>{}, std::vector<IndexBox>{{{0, 0, 0}, {8, 4, 1}}}}) {
    TwoLevels t(Scene{{8, 4, 1}, {2, 2, 1}, {true, false, false}, refined}, Cut{}, world());
    EXPECT_TRUE(t.registers().coarse_faces().empty());
    EXPECT_TRUE(t.registers().fine_faces().empty());
    EXPECT_EQ(t.step(any_start, any_flux, 2).limited, 0);
  }
}

TEST(FluxRegister, WorksAnywhereOnTheGrid) {
  Scene scene = cases()[10].scene, moved = scene;
  moved.low = {-5, 3, 0};
  for (IndexBox& r : moved.refined) r = r.shifted(moved.low);
  TwoLevels here(scene, Cut{}, world()), there(moved, Cut{}, world());
  const auto back = [&](IntVec3 c, int level) {
    return c - (level == 0 ? moved.low : moved.low * moved.ratio);
  };
  const CorrectionReport a = here.step(poor_start, any_flux, 2);
  const CorrectionReport b = there.step(
      [&](int q, IntVec3 c, int l) { return poor_start(q, back(c, l), l); },
      [&](int q, int d, IntVec3 c, int l, int step) { return any_flux(q, d, back(c, l), l, step); },
      2);
  EXPECT_GT(a.limited, 0);
  EXPECT_EQ(a.limited, b.limited);
  EXPECT_EQ(a.first + moved.low, b.first);
  for (const int l : {0, 1}) {
    const auto wanted = values_of(here, l == 0 ? here.coarse() : here.fine());
    there.each(l == 0 ? there.coarse() : there.fine(), [&](int q, IntVec3 c, double& v) {
      const IntVec3 from = back(c, l);
      ASSERT_EQ(v, wanted.at({q, from.z, from.y, from.x}));
    });
  }
}

TEST(FluxRegister, StartsANewStepWithoutTheLastOne) {
  const Scene scene = cases()[5].scene;
  TwoLevels twice(scene, Cut{}, world()), once(scene, Cut{}, world());
  twice.step(any_start, exact_flux, 2);
  twice.step(any_start, any_flux, 2);
  once.step(any_start, any_flux, 2);
  EXPECT_EQ(values_of(twice, twice.coarse()), values_of(once, once.coarse()));
}

TEST(FluxRegister, RefusesAFineBoxThatCutsACoarseCell) {
  Levels l = levels_of(Scene{{8, 1, 1}, {2, 1, 1}, {}, {{{2, 0, 0}, {4, 1, 1}}}}, Cut{}, world());
  ++l.fine.boxes[0].cells.upper.x;
  EXPECT_THROW(FluxRegister(l.coarse, l.fine, 1, world().rank()), std::logic_error);
}

TEST(FluxRegister, RefusesAFineBoxWithoutCoarseCellsAround) {
  Levels l = levels_of(Scene{{8, 1, 1}, {2, 1, 1}, {}, {{{2, 0, 0}, {4, 1, 1}}}}, Cut{}, world());
  l.coarse.boxes[0].cells.upper.x = 4;
  EXPECT_THROW(FluxRegister(l.coarse, l.fine, 1, world().rank()), std::logic_error);
}

}  // namespace
}  // namespace sluice::flux_register_test
