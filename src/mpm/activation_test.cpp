// Materials that take part for a time only.
#include <gtest/gtest.h>

#include <map>

#include "mpm/test_support/text_run.hpp"

namespace sluice::mpm::activation_test {
namespace {

constexpr double g = 10;

// Two blocks at one place, without contact; the second takes part between two times.
TextRun falling(const std::string& role, const std::string& flags, int threads = 1,
                const std::string& patches = "[1,1,1]") {
  const std::string object =
      "<geom_object><box><min>[0.4,0.5,0]</min><max>[0.6,0.7,0.1]</max></box><res>[2,2,1]</res>"
      "<velocity>[0,0,0]</velocity><temperature>300</temperature></geom_object>";
  SolidDeck deck;
  deck.upper = "[1,1,0.1]";
  deck.cells = "[10,10,1]";
  deck.flags = flags;
  deck.objects = object;
  deck.further = solid_material("late", role + object);
  return TextRun(deck,
                 {{"<gravity>[0,0,0]", "<gravity>[0,-10,0]"},
                  {"<maxTime>1<", "<maxTime>0.25<"},
                  {"<resolution>", "<patches>" + patches + "</patches><resolution>"},
                  {"<outputInterval>0</outputInterval>",
                   saves({"p.x", "p.velocity", "p.stress", "p.particleID"})}},
                 "activation", threads);
}

double mean(const std::vector<double>& values) {
  double sum = 0;
  for (const double v : values) sum += v / static_cast<double>(values.size());
  return sum;
}

std::string name_of(const testing::TestParamInfo<const char*>& test) {
  constexpr const char* names[] = {"gimp", "linear", "xpic"};
  return names[test.index];
}

class Activation : public testing::TestWithParam<const char*> {};

// A free fall from the step at which it takes part.
TEST_P(Activation, WaitsAndFalls) {
  const TextRun run =
      falling("<is_active>false</is_active><activation_time>0.1</activation_time>", GetParam());
  const double first = mean(run.particles("p.velocity", 0)[1]);
  const double late = mean(run.particles("p.velocity", 1)[1]);
  const double dt = run.time() / static_cast<double>(run.report().steps);
  EXPECT_NEAR(first, -g * run.time(), g * dt);
  EXPECT_NEAR(late, -g * (run.time() - 0.1), g * dt);
  EXPECT_NEAR(mean(run.particles("p.x", 1)[1]), 0.6 - late * late / (2 * g), 2 * dt);
}

INSTANTIATE_TEST_SUITE_P(Of, Activation,
                         testing::Values("<interpolator>gimp</interpolator>",
                                         "<interpolator>linear</interpolator><musl>true</musl>",
                                         "<interpolator>quadraticBS</interpolator>"
                                         "<transfer>xpic</transfer>"),
                         name_of);

// The one that has never taken part is as it was seeded, to the bit.
TEST(Deactivation, LeavesWhatIs) {
  const TextRun run =
      falling("<is_active>false</is_active><activation_time>0.5</activation_time>", "");
  EXPECT_EQ(mean(run.particles("p.velocity", 1)[1]), 0);
  EXPECT_NEAR(mean(run.particles("p.x", 1)[1]), 0.6, 1e-15);
  const TextRun stops = falling("<deactivation_time>0.1</deactivation_time>", "");
  const double dt = stops.time() / static_cast<double>(stops.report().steps);
  EXPECT_NEAR(mean(stops.particles("p.velocity", 1)[1]), -g * 0.1, g * dt);
  EXPECT_NEAR(mean(stops.particles("p.x", 1)[1]), 0.55, 2 * dt);
}

TEST(ActivationBits, NeitherBoxesNorThreadsShow) {
  const char* role = "<is_active>false</is_active><activation_time>0.1</activation_time>";
  const TextRun plain = falling(role, ""), other = falling(role, "", 2, "[3,2,1]");
  for (const char* label : {"p.x", "p.velocity", "p.stress"}) {
    const auto a = plain.particles(label, 1), b = other.particles(label, 1);
    const auto i = plain.particles("p.particleID", 1)[0], j = other.particles("p.particleID", 1)[0];
    ASSERT_EQ(i.size(), j.size());
    std::map<double, std::size_t> place;
    for (std::size_t p = 0; p < j.size(); ++p) place[j[p]] = p;
    for (std::size_t c = 0; c < a.size(); ++c)
      for (std::size_t p = 0; p < i.size(); ++p)
        ASSERT_EQ(a[c][p], b[c][place.at(i[p])]) << label << ' ' << i[p];
  }
}

}  // namespace
}  // namespace sluice::mpm::activation_test
