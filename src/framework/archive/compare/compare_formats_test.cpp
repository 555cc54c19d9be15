// Comparisons of a raw archive with one of Sluice: outputs by nearest time, labels by the table,
// particles by place; what is known to differ is found, and nothing else.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "framework/archive/archive_test_support.hpp"
#include "framework/archive/compare/compare.hpp"
#include "framework/archive/compare/norms.hpp"
#include "framework/archive/compare/particle_pairs.hpp"
#include "framework/archive/raw_archive_test_support.hpp"

namespace sluice::compare_formats_test {
namespace {

using namespace archive_test;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::SizeIs;

// The grid of make_grid({6, 4, 1}, {1, 1, 1}) as a raw archive has it, in other patches.
raw_test::Level raw_level() {
  raw_test::Level level =
      raw_test::make_level({{0, 0, 0}, {6, 4, 1}}, {3, 2, 1}, {1, 1, 1}, {0.1, 0.25, 0.5});
  level.anchor = {-1.0, 0.25, 3.0};
  return level;
}

double pressure(IntVec3 i, int) {
  return 2.0 + i.x + 10.0 * i.y;
}

// Particles of the raw archive, by patch, and how they move.
Vec3 place_of(int patch, int n, double time) {
  return {-0.95 + 0.05 * patch + 0.2 * n + 0.02 * time, 0.4 + 0.1 * patch, 3.25};
}

struct Archives {
  TemporaryFolder folder;
  fs::path raw, own;

  Archives() {
    write_raw();
    write_own();
  }

  void write_raw() {
    raw_test::Writer writer(folder / "raw.uda.000");
    for (const auto& [step, time] : {std::pair{1, 0.1}, {4, 1.02}, {7, 2.0}}) {
      const auto place = [t = time](const raw_test::Patch& p, int n, int c) {
        return place_of(p.id, n, t)[c];
      };
      const auto count = [](const raw_test::Patch&) { return 2; };
      const auto heat = [](const raw_test::Patch& p, int n, int) { return p.id + 0.5 * n; };
      writer.add_step(step, time, {raw_level()},
                      {{"press_CC", "CCVariable<double>", 0, pressure},
                       {"only_raw", "CCVariable<double>", 0, pressure},
                       {"p.x", "ParticleVariable<Point>", 0, {}, count, place},
                       {"p.eqPlasticStrain", "ParticleVariable<double>", 0, {}, count, heat}});
    }
    writer.write_index();
    raw = writer.folder();
  }

  // Numbered in the opposite order; at time 1 one pressure differs by 1/4.
  void write_own() {
    const Grid grid = make_grid({6, 4, 1}, {2, 1, 1});
    const Label strain =
        declare_label({"p.plasticStrain", ValueType::real, Centring::particle, "1", "a test"});
    ArchiveWriter writer = ArchiveWriter::create(setup_in(folder.path()));
    for (const auto& [step, time] : {std::pair{2, 1.0}, {3, 2.0}}) {
      Fields fields;
      fields.add(grid.levels[0], real_label("press_CC"), 0, [s = step](IntVec3 i, int c) {
        return pressure(i, c) + (s == 2 && i == IntVec3{5, 3, 0} ? 0.25 : 0.0);
      });
      std::vector<double> ids;
      for (int id = 11; id >= 0; --id) ids.push_back(id);
      fields.add_particles(0, 0, ids, [t = time](double id, int c) {
        const int n = 11 - static_cast<int>(id);
        return c < 3 ? place_of(n / 2, n % 2, t)[c] : n / 2 + 0.5 * (n % 2);
      });
      for (FieldPiece& piece : fields.pieces())
        if (piece.label.name() == "p.heat") piece.label = strain;
      writer.write_output({step, time, 0.5, 0.5, {}}, grid, fields.pieces());
    }
    writer.finish();
    own = writer.folder();
  }
};

TEST(CompareFormats, FindsTheOneDifferenceAndPairsTheRest) {
  const Archives archives;
  const Archive raw = Archive::open(archives.raw), own = Archive::open(archives.own);
  CompareOptions options;
  options.absolute = 1e-3;  // particles have moved by 0.0004 between the times
  for (const bool turned : {false, true}) {
    const CompareResult r = turned ? compare(own, raw, options) : compare(raw, own, options);
    EXPECT_THAT(r.not_comparable, SizeIs(0));
    ASSERT_THAT(r.paired, SizeIs(2));
    const StepEntry& of_raw = turned ? r.paired[0].second : r.paired[0].first;
    EXPECT_EQ(of_raw.step, 4);
    ASSERT_THAT(r.fields, SizeIs(1));
    EXPECT_EQ(r.fields[0].first.label, "press_CC");
    EXPECT_EQ(r.fields[0].first.index, (IntVec3{5, 3, 0}));
    EXPECT_DOUBLE_EQ(r.fields[0].largest.size(), 0.25);
    EXPECT_EQ(r.differing, 1);
    // Cells, strains and three coordinates of twelve particles, at two times.
    EXPECT_EQ(r.values, 2 * (24 + 12 + 36));
    std::string notes;
    for (const std::string& note : r.notes) notes += note + '\n';
    EXPECT_THAT(notes, HasSubstr("step 1 at time 0.1"));
    EXPECT_THAT(notes, HasSubstr("has only_raw\n"));
    EXPECT_THAT(notes, HasSubstr("12 of 12 and 12 paired by place"));
  }
  options.time_tolerance = 0.01;
  EXPECT_THAT(compare(raw, own, options).paired, SizeIs(1));
}

TEST(CompareFormats, NormsAreThoseOfTheOneDifference) {
  const Archives archives;
  const Archive raw = Archive::open(archives.raw), own = Archive::open(archives.own);
  const NormsResult r = difference_norms(raw, own, {});
  ASSERT_THAT(r.rows, SizeIs(2));
  EXPECT_EQ(r.rows[0].time, 1.02);
  EXPECT_EQ(r.rows[0].other_time, 1.0);
  EXPECT_DOUBLE_EQ(r.rows[0].l1, 0.25 / 24);
  EXPECT_DOUBLE_EQ(r.rows[0].l2, 0.25 / std::sqrt(24.0));
  EXPECT_DOUBLE_EQ(r.rows[0].linf, 0.25);
  EXPECT_EQ(r.rows[1].linf, 0);
  EXPECT_THAT(r.skipped, ElementsAre("only_raw"));
}

TEST(CompareFormats, NamesGoBothWaysAndUsersComeFirst) {
  EXPECT_THAT(names_elsewhere("p.eqPlasticStrain", {}),
              ElementsAre("p.eqPlasticStrain", "p.plasticStrain"));
  EXPECT_THAT(names_elsewhere("p.plasticStrain", {parse_label_name("mine=p.plasticStrain")}),
              ElementsAre("mine", "p.plasticStrain", "p.eqPlasticStrain"));
  EXPECT_THAT(names_elsewhere("p.volume+", {}), ElementsAre("p.volume+", "p.volume"));
  for (const char* wrong : {"a", "=b", "a=", ""}) EXPECT_THROW(parse_label_name(wrong), InputError);
}

// Points of a lattice, moved by less than half its spacing, in another order.
TEST(CompareFormats, NearestPointsOfAMovedLattice) {
  for (const IntVec3 n : {IntVec3{9, 7, 5}, {40, 1, 1}, {1, 20, 20}, {1, 1, 1}}) {
    std::vector<Vec3> a, b;
    for_each_cell({{0, 0, 0}, n}, [&](IntVec3 i) { a.push_back(to_real(i) * 0.1); });
    for (std::size_t k = a.size(); k-- > 0;)
      b.push_back(a[k] + Vec3{0.04, k % 2 == 0 ? 0.02 : -0.02, 0.01});
    const auto pairs = mutual_nearest(a, b);
    ASSERT_EQ(pairs.size(), a.size());
    for (const auto& [p, q] : pairs) EXPECT_EQ(p + q, a.size() - 1);
  }
  EXPECT_THAT(mutual_nearest({{0, 0, 0}, {10, 0, 0}}, {{1, 0, 0}}),
              ElementsAre(std::pair<std::size_t, std::size_t>{0, 0}));
  EXPECT_THAT(mutual_nearest({}, {{1, 0, 0}}), SizeIs(0));
}

}  // namespace
}  // namespace sluice::compare_formats_test
