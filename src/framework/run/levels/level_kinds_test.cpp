// Blocks that choose their graph: the bits of plain loops over whole fields, whatever the blocks,
// threads, boxes and ranks, and whether they choose at all.
#include <gtest/gtest.h>

#include "framework/run/test_support/kinds_run.hpp"

namespace sluice::level_kinds_test {
namespace {

using namespace kinds_test;

// Whole fields, cell by cell.
class Plain {
 public:
  std::vector<double> mass[2], share[2], momentum[2], flux[2];  // low faces, closing face last
  double sums[2] = {0, 0}, maximum = 0;
  std::int64_t faults = 0;

  Plain(const IndexBox& domain, const KindsMock::Start& from) : domain_(domain) {
    for_each_cell(domain_, [&](IntVec3 c) {
      for (int m = 0; m < 2; ++m) mass[m].push_back(from(m, c));
      for (int n = 0; n < 2; ++n) momentum[n].push_back(1 + n);
    });
    find_shares();
  }
  std::size_t at(IntVec3 c) const {
    const IntVec3 n = domain_.size(), i = c - domain_.lower;
    return static_cast<std::size_t>(i.x + n.x * (i.y + static_cast<std::int64_t>(n.y) * i.z));
  }
  double flux_at(int m, IntVec3 face, double courant) const {
    IntVec3 low = face, high = face;
    low.x = std::max(face.x - 1, domain_.lower.x);
    high.x = std::min(face.x, domain_.upper.x - 1);
    return flux_of(mass[m][at(low)], mass[m][at(high)], courant);
  }
  void step(double courant, double most = 1e300) {
    std::vector<double> next[2] = {mass[0], mass[1]};
    sums[0] = sums[1] = maximum = 0;
    faults = 0;
    ExactSum entered[2];
    for_each_cell(domain_, [&](IntVec3 c) {
      for (int m = 0; m < 2; ++m) {
        const double in = flux_at(m, c, courant), out = flux_at(m, c + IntVec3{1, 0, 0}, courant);
        next[m][at(c)] = mass_of(mass[m][at(c)], in, out);
        if (c.x == domain_.lower.x) entered[m].add(in);
        if (c.x == domain_.upper.x - 1) entered[m].add(-out);
        faults += next[m][at(c)] > most;
      }
      for (auto& p : momentum)
        p[at(c)] =
            momentum_of(p[at(c)], mass[0][at(c)] + mass[1][at(c)], next[0][at(c)] + next[1][at(c)]);
      maximum = std::max(maximum, next[0][at(c)] + next[1][at(c)]);
    });
    for (int m = 0; m < 2; ++m) {
      mass[m] = next[m];
      sums[m] = entered[m].value();
    }
    find_shares();
  }

 private:
  void find_shares() {
    for (int m = 0; m < 2; ++m) {
      share[m] = mass[m];
      for (std::size_t n = 0; n < mass[m].size(); ++n)
        if (mass[m][n] != 0) share[m][n] = mass[m][n] / (mass[0][n] + mass[1][n]);
    }
  }
  IndexBox domain_;
};

void expect_field(const Warehouse& w, int slot, int c, const Plain& plain,
                  const std::vector<double>& expected, const std::string& what) {
  for (int b = 0; b < static_cast<int>(w.local_boxes().size()); ++b) {
    const RealView v = w.view(slot, c, b);
    for_each_cell(w.local_boxes()[b].cells, [&](IntVec3 cell) {
      ASSERT_EQ(v(cell), expected[plain.at(cell)])
          << what << " of slot " << slot << '.' << c << " at " << cell.x << ' ' << cell.y << ' '
          << cell.z;
    });
  }
}

void expect_state(const Warehouse& w, const Plain& plain, const std::string& what) {
  for (int m = 0; m < 2; ++m) {
    expect_field(w, 2 * m, 0, plain, plain.mass[m], what);
    expect_field(w, 2 * m + 1, 0, plain, plain.share[m], what);
    expect_field(w, 4, m, plain, plain.momentum[m], what);
  }
}

struct Way {
  std::string name;
  SolverOptions options;
  IntVec3 pieces{1, 1, 1};
  bool cut = false;  // after every step
};

std::vector<Way> ways(IntVec3 cells) {
  const IntVec3 small{8, 4, 3};
  const IntVec3 pieces{3, cells.y > 1 ? 2 : 1, cells.z > 1 ? 2 : 1};
  std::vector<Way> w(8);
  w[0].name = "all in one";
  w[1].name = "forced";
  w[1].options.force_all = true;
  w[1].options.block = small;
  w[2].name = "small blocks";
  w[2].options.block = small;
  w[3].name = "two threads";
  w[3].options.threads = 2;
  w[3].options.block = small;
  w[4].name = "boxes";
  w[4].options.block = small;
  w[4].pieces = pieces;
  w[5].name = "touched";
  w[5].options.block = small;
  w[5].cut = true;
  w[6].name = "substeps";
  w[6].options.block = small;
  w[6].options.substeps = 2;
  w[7].name = "boxes and threads";
  w[7].options.threads = 2;
  w[7].pieces = pieces;
  return w;
}

constexpr double dt = 0.5;
constexpr int steps = 60;

class KindsOnShapes : public testing::TestWithParam<IntVec3> {};

TEST_P(KindsOnShapes, NoWayChangesABit) {
  const IntVec3 cells = GetParam();
  for (const Way& way : ways(cells)) {
    KindsRun run(cells, way.options, way.pieces);
    Plain plain(run.level.domain, start);
    for (int n = 0; n < steps; ++n) {
      const bool saving = n % 20 == 7;
      if (saving)
        run.step(dt, {kinds_labels().flux, kinds_labels().share_of_second});
      else
        run.step(dt);
      if (saving) {
        const Warehouse& out = run.solver.outputs();
        expect_field(out, out.find(kinds_labels().share_of_second, 1), 0, plain, plain.share[1],
                     way.name);
        for (int m = 0; m < 2; ++m)
          for (int b = 0; b < static_cast<int>(out.local_boxes().size()); ++b)
            for_each_cell(out.local_boxes()[b].cells.grown(0, 0, 1), [&](IntVec3 face) {
              const int slot = out.find(kinds_labels().flux, m);
              ASSERT_EQ(out.view(slot, 0, b)(face), plain.flux_at(m, face, dt))
                  << way.name << ", flux of " << m << " at " << face.x;
            });
      }
      plain.step(dt);
      expect_state(run.solver.state(), plain, way.name + " after step " + std::to_string(n));
      for (int m = 0; m < 2; ++m) ASSERT_EQ(run.solver.attempt_result().sums[m], plain.sums[m]);
      ASSERT_EQ(run.solver.attempt_result().maxima[0], plain.maximum);
      for (int slot = 0; slot < 5; ++slot) run.known(slot);
      if (way.cut) run.solver.mark_modified();
      if (HasFatalFailure()) return;
    }
    if (way.options.force_all) {
      EXPECT_EQ(run.solver.graphs().blocks_run(0) + run.solver.graphs().blocks_run(1), 0);
    } else if (way.options.block != IntVec3{}) {
      for (int kind = 0; kind < 3; ++kind)
        EXPECT_GT(run.solver.graphs().blocks_run(kind), steps) << way.name;
      EXPECT_GT(run.solver.graphs().blocks_skipped(), 0);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Shapes, KindsOnShapes,
                         testing::Values(IntVec3{96, 1, 1}, IntVec3{96, 9, 1}, IntVec3{96, 1, 7},
                                         IntVec3{96, 6, 5}));

SolverOptions small_blocks() {
  SolverOptions o;
  o.block = {8, 4, 3};
  return o;
}

TEST(Kinds, OfMaterialsThatAreNowhereHaveNoGraph) {
  KindsRun run({96, 9, 1}, small_blocks(), {1, 1, 1},
               [](int m, IntVec3 c) { return m == 0 ? start(0, c) + 1 : 0; });
  const int before = run.mock.declared;
  run.step(dt);
  EXPECT_EQ(run.mock.declared, before + 1);
  EXPECT_EQ(run.solver.graphs().blocks_run(1) + run.solver.graphs().blocks_run(2), 0);
  EXPECT_EQ(run.solver.graphs().effect_tasks(),
            (std::vector<int>{2, 0}));  // faces and update, no mixing
  EXPECT_EQ(run.solver.graphs().effect_doubles(), (std::vector<double>{6, 0}));
  EXPECT_EQ(run.solver.graphs().step(false, {}).plan(0).tasks.size(), 2u);
  EXPECT_EQ(run.solver.graphs().step(false, {}).plan(-1).tasks.size(),
            3u);  // the general one, made when asked for
  const auto& tasks = run.solver.graphs().step(false, {}).list(1).tasks();
  EXPECT_TRUE(std::any_of(tasks.begin(), tasks.end(),
                          [](const Task& t) { return t.name == "faces of 1"; }));
}

TEST(Kinds, TimesOfAllAreAdded) {
  SolverOptions o = small_blocks();
  o.sample_every = 1;
  KindsRun run({96, 9, 1}, o);
  for (int n = 0; n < 5; ++n) run.step(dt);
  const std::vector<double> seconds = run.solver.graphs().effect_seconds();
  EXPECT_GT(seconds[0], 0);
  EXPECT_GT(seconds[1], 0);
  EXPECT_EQ(run.solver.graphs().effect_tasks(), (std::vector<int>{2, 1}));
  EXPECT_EQ(run.solver.graphs().effect_doubles(), (std::vector<double>{0, 12}));
  EXPECT_EQ(run.solver.graphs().blocks_run(), run.solver.graphs().blocks_run(0) +
                                                  run.solver.graphs().blocks_run(1) +
                                                  run.solver.graphs().blocks_run(2));
}

TEST(Kinds, ARedoneStepChoosesAgain) {
  const double most = 2.3;
  KindsRun run({96, 9, 1}, small_blocks(), {2, 1, 1}, start, most);
  KindsRun forced({96, 9, 1}, {1, true, 0, {}}, {1, 1, 1}, start, most);
  Plain plain(run.level.domain, start);
  int redone = 0;
  for (int n = 0; n < 20; ++n) {
    const bool rejected = n % 5 == 4;
    for (KindsRun* r : {&run, &forced}) {
      if (rejected) {  // what it leaves in the new state is written over
        r->attempt(0.75);
        r->solver.reject();
      }
      for (int tries = 0; r->attempt(dt).faults > 0 && tries < 3; ++tries) {
        redone += r == &run;
        r->solver.mask_faults();
      }
      EXPECT_EQ(r->solver.attempt_result().faults, 0);
      r->solver.advance();
      r->solver.accept();
    }
    for (int slot = 0; slot < 5; ++slot) run.known(slot);
    const Warehouse& a = run.solver.state();
    const Warehouse& b = forced.solver.state();
    for (int slot = 0; slot < 5; ++slot)
      for (int box = 0; box < 2; ++box)
        for_each_cell(a.local_boxes()[box].cells, [&](IntVec3 c) {
          ASSERT_EQ(a.view(slot, 0, box)(c), b.view(slot, 0, 0)(c)) << "step " << n;
        });
    if (HasFatalFailure()) return;
  }
  EXPECT_GT(redone, 5);
}

TEST(Kinds, WhatOthersWriteIsSeenOnceTheyTell) {
  KindsRun run({96, 9, 1}, small_blocks(), {1, 1, 1},
               [](int m, IntVec3) { return m == 0 ? 1.0 : 0.0; });
  const int blocks = 12 * 3;
  EXPECT_EQ(run.known(2), 0);  // nothing is known of what was initialised
  for (int n = 0; n < 3; ++n) run.step(dt);
  for (int slot : {1, 2, 3}) EXPECT_EQ(run.known(slot), blocks) << slot;
  EXPECT_EQ(run.known(0), 0);
  run.solver.state().view(2, 0, 0)(40, 5, 0) = 0.5;
  run.solver.state().view(3, 0, 0)(40, 5, 0) = 0.5 / 1.5;
  run.solver.state().view(1, 0, 0)(40, 5, 0) = 1 / 1.5;
  run.solver.mark_modified();
  EXPECT_EQ(run.known(2), 0);
  run.step(dt);
  EXPECT_EQ(run.solver.state().view(2, 0, 0)(41, 5, 0), 0.25);
  // Mixed are the four blocks that have the cell within two cells; two of them see nothing of it
  // along x and sleep.
  EXPECT_EQ(run.solver.graphs().blocks_run(2), 2);
  EXPECT_EQ(run.known(2), blocks - 4);
}

TEST(Kinds, ALevelLaidOutAnewKnowsNothing) {
  KindsRun run({96, 9, 1}, small_blocks());
  for (int n = 0; n < 10; ++n) run.step(dt);
  const Warehouse before = run.solver.lay_out(level_of({96, 9, 1}, {4, 1, 1}).boxes);
  Warehouse& state = run.solver.state();
  for (int slot = 0; slot < 5; ++slot)
    for (int b = 0; b < 4; ++b)
      for (int c = 0; c < state.info(slot).components; ++c)
        for_each_cell(state.local_boxes()[b].cells, [&](IntVec3 cell) {
          state.view(slot, c, b)(cell) = before.view(slot, c, 0)(cell);
        });
  run.solver.mark_modified();
  Plain plain(run.level.domain, start);
  for (int n = 0; n < 20; ++n) {
    if (n >= 10) run.step(dt);
    plain.step(dt);
  }
  expect_state(run.solver.state(), plain, "after another layout");
  EXPECT_GT(run.known(2), 0);
}

// Serially and (see CMakeLists.txt) on three ranks.
TEST(KindsOnRanks, GiveTheSameBits) {
  KindsRun run({96, 9, 1}, small_blocks(), {6, 1, 1});
  Plain plain(run.level.domain, start);
  for (int n = 0; n < 40; ++n) {
    run.step(dt);
    plain.step(dt);
    expect_state(run.solver.state(), plain, "step " + std::to_string(n));
    for (int m = 0; m < 2; ++m) ASSERT_EQ(run.solver.attempt_result().sums[m], plain.sums[m]);
    if (HasFatalFailure()) return;
  }
}

}  // namespace
}  // namespace sluice::level_kinds_test
