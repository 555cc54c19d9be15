// Particles by number, in a box and followed from it; outputs of a range; rows as JSON.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "framework/archive/archive_test_support.hpp"
#include "framework/archive/extract/extract.hpp"
#include "framework/archive/selection.hpp"
#include "framework/base/error.hpp"
#include "framework/base/json.hpp"

namespace sluice::extract_times_test {
namespace {

using namespace archive_test;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

class ExtractTimes : public ::testing::Test {
 protected:
  // Five outputs at 0, 0.1, ... 0.4; particle n of 3, 5, 7 is at x = n/10 - 1 + t.
  ExtractTimes() {
    const Grid grid = make_grid({10, 1, 1}, {2, 1, 1});
    ArchiveWriter writer = ArchiveWriter::create(setup_in(folder_.path()));
    for (int step = 0; step < 5; ++step) {
      const double t = 0.1 * step;
      Fields fields;
      fields.add(grid.levels[0], real_label("press_CC"), 0,
                 [t](IntVec3 c, int) { return c.x + 100 * t; });
      const auto place = [t](double id, int c) {
        return c == 0 ? 0.1 * id - 1 + t : c == 3 ? 1000 * id + t : 3.0;
      };
      fields.add_particles(0, 0, {7, 3}, place);
      if (step < 3) fields.add_particles(0, 1, {5}, place);  // particle 5 goes
      writer.write_output({step, t, 0.1, 0.1, {}}, grid, fields.pieces());
    }
    writer.finish();
    archive_ = Archive::open(writer.folder());
  }

  std::string text(const std::string& time, const ExtractOptions& options, TextForm form) {
    std::string all;
    ValueRows rows;
    rows.to(form, [&](std::string_view part) { all += part; });
    Extraction extraction(options, rows);
    for (const StepEntry& s : select_steps(archive_, Stored::outputs, time))
      extraction.add(archive_.read_output(s));
    extraction.finish();
    return all;
  }
  Json rows(const std::string& time, const ExtractOptions& options) {
    return Json::parse(text(time, options, TextForm::json)).at("rows");
  }
  // (time, id) of each row.
  std::vector<std::pair<double, int>> particles(const std::string& time,
                                                const ExtractOptions& options) {
    std::vector<std::pair<double, int>> found;
    const Json all = rows(time, options);
    for (const Json& row : all.entries())
      found.emplace_back(row.at(0).get<double>(), row.at(3).get<int>());
    return found;
  }

  TemporaryFolder folder_;
  Archive archive_;
};

using Seen = std::vector<std::pair<double, int>>;

TEST_F(ExtractTimes, RangesChooseOutputs) {
  const auto steps = [&](const char* text) {
    std::vector<int> found;
    for (const StepEntry& s : select_steps(archive_, Stored::outputs, text))
      found.push_back(s.step);
    return found;
  };
  EXPECT_THAT(steps("all"), ElementsAre(0, 1, 2, 3, 4));
  EXPECT_THAT(steps("0.1:0.3"), ElementsAre(1, 2, 3));
  EXPECT_THAT(steps("0.15:"), ElementsAre(2, 3, 4));
  EXPECT_THAT(steps(":0.15"), ElementsAre(0, 1));
  EXPECT_THAT(steps("#3:last"), ElementsAre(3, 4));
  EXPECT_THAT(steps("0.19"), ElementsAre(2));
  const auto message = [&](const char* text) {
    try {
      select_steps(archive_, Stored::outputs, text);
    } catch (const InputError& e) {
      return std::string(e.what());
    }
    return std::string("no error");
  };
  EXPECT_THAT(message("0.11:0.14"), HasSubstr("the nearest is step 1 at 0.1"));
  EXPECT_THAT(message("0.3:0.1"), HasSubstr("begins after its end"));
  EXPECT_THAT(message("a:b"), HasSubstr("'a' is not a time"));
  EXPECT_THAT(message("#9:"), HasSubstr("there are #0 to #4"));
}

TEST_F(ExtractTimes, ParticlesByNumberAndBoxOverTime) {
  ExtractOptions options;
  options.label = "p.heat";
  options.particles = {5, 7};
  EXPECT_EQ(particles("#1:#3", options),
            (Seen{{0.1, 5}, {0.1, 7}, {0.2, 5}, {0.2, 7}, {0.1 * 3, 7}}));
  options.particles = {6, 100};
  try {
    rows("all", options);
    FAIL() << "no such particle";
  } catch (const InputError& e) {
    EXPECT_THAT(e.what(), HasSubstr("no particle has the number 6, 100: the nearest is 7"));
  }
  options.particles.clear();
  // In a box that stands still particle n is at time t where -0.55 <= n/10 - 1 + t <= -0.25.
  options.from = Vec3{-0.55, 0, 0};
  options.to = Vec3{-0.25, 10, 10};
  EXPECT_EQ(particles("first", options), (Seen{{0, 5}, {0, 7}}));
  EXPECT_EQ(particles("0.2:", options), (Seen{{0.2, 3}, {0.2, 5}, {0.1 * 3, 3}, {0.4, 3}}));
  options.follow = true;
  EXPECT_EQ(particles("all", options),
            (Seen{{0, 5}, {0, 7}, {0.1, 5}, {0.1, 7}, {0.2, 5}, {0.2, 7}, {0.1 * 3, 7}, {0.4, 7}}));
}

TEST_F(ExtractTimes, APointOverTimeAsJson) {
  ExtractOptions options;
  options.label = "press_CC";
  options.at = {{-0.77, 0.3, 3.1}};
  const Json all = Json::parse(text("all", options, TextForm::json));
  EXPECT_EQ(all.at("label").get<std::string>(), "press_CC");
  EXPECT_EQ(all.at("unit").get<std::string>(), "Pa");
  EXPECT_EQ(all.at("columns").get<std::vector<std::string>>(),
            (std::vector<std::string>{"time", "level", "material", "i", "j", "k", "x", "y", "z",
                                      "value"}));
  ASSERT_EQ(all.at("rows").size(), 5u);
  for (std::size_t n = 0; n < 5; ++n)
    EXPECT_DOUBLE_EQ(all.at("rows").at(n).at(9).get<double>(),
                     2 + 100 * (0.1 * static_cast<double>(n)));
  EXPECT_THAT(text("all", options, TextForm::csv), HasSubstr("\n0.10000000000000001,0,0,2,0,0,"));
}

TEST_F(ExtractTimes, WhatDoesNotFitTheLabelIsRefused) {
  const auto message = [&](const ExtractOptions& options) {
    try {
      rows("last", options);
    } catch (const InputError& e) {
      return std::string(e.what());
    }
    return std::string("no error");
  };
  ExtractOptions of_particles{"p.heat", {}, -1, {}, {}};
  of_particles.at = {{0, 0, 0}};
  EXPECT_THAT(message(of_particles), HasSubstr("choose them by number (--particle)"));
  ExtractOptions of_grid{"press_CC", {}, -1, {}, {}};
  of_grid.particles = {5};
  EXPECT_THAT(message(of_grid), HasSubstr("press_CC is a label of the grid"));
}

}  // namespace
}  // namespace sluice::extract_times_test
