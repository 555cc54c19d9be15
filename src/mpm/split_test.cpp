// Particles that are split: what they carry is shared, nothing else changes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "mpm/test_support/text_run.hpp"

namespace sluice::mpm::split_test {
namespace {

// A plate that flies apart along x; its edges grow until the ratio is reached.
TextRun pulled(const std::string& basis, const std::string& criterion, int threads = 1,
               const std::string& patches = "[1,1,1]") {
  SolidDeck deck;
  deck.upper = "[1,1,0.1]";
  deck.cells = "[10,10,1]";
  deck.flags = "<interpolator>" + basis + "</interpolator>" +
               (criterion.empty() ? "" : "<refine_particles>true</refine_particles>");
  deck.objects = "";
  for (const char* part : {"0.2,0.4;0.5,0.6;-3", "0.5,0.4;0.8,0.6;3"}) {
    const std::string p = part;
    const std::size_t a = p.find(';'), b = p.rfind(';');
    deck.objects += "<geom_object><box><min>[" + p.substr(0, a) + ",0]</min><max>[" +
                    p.substr(a + 1, b - a - 1) + ",1]</max></box><res>[2,2,1]</res><velocity>[" +
                    p.substr(b + 1) +
                    ",0.5,0]</velocity><temperature>300</temperature>"
                    "</geom_object>";
  }
  if (!criterion.empty())
    deck.blocks = "<AMR><MPM><Refinement_Criteria_Thresholds>" + criterion +
                  "</Refinement_Criteria_Thresholds></MPM></AMR>";
  return TextRun(
      deck,
      {{"<bulk_modulus>1e6", "<bulk_modulus>1e4"},
       {"<shear_modulus>5e5", "<shear_modulus>5e3"},
       {"<maxTime>1<", "<maxTime>0.05<"},
       {"<resolution>", "<patches>" + patches + "</patches><resolution>"},
       {"<outputInterval>0</outputInterval>",
        "<outputTimestepInterval>1000000</outputTimestepInterval><outputInitTimestep/>"
        "<outputLastTimestep>true</outputLastTimestep><save label='p.x'/><save label='p.mass'/>"
        "<save label='p.volume'/><save label='p.particleID'/><save label='p.velocity'/>"}},
      "split", threads);
}

double sum(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0);
}

constexpr const char* stretched = "<Variable name='stretchRatio' value='1.5' matl='0'/>";

class Split : public testing::TestWithParam<const char*> {};

TEST_P(Split, KeepsMassMomentumAndVolume) {
  const TextRun run = pulled(GetParam(), stretched);
  const auto before = run.particles("p.mass", 0, "first")[0], after = run.particles("p.mass")[0];
  EXPECT_GT(after.size(), before.size());
  EXPECT_EQ((after.size() - before.size()) % 3, 0u);  // four for one
  EXPECT_NEAR(sum(after) / sum(before), 1, 1e-14);
  const double smallest = *std::min_element(after.begin(), after.end());
  EXPECT_NEAR(smallest / before[0], 0.25, 1e-14);  // once
  const auto v = run.particles("p.velocity");
  double momentum = 0;
  for (std::size_t p = 0; p < after.size(); ++p) momentum += after[p] * v[1][p];
  EXPECT_NEAR(momentum / (0.5 * sum(after)), 1, 1e-12);
  // It flies as the whole ones do, nearly.
  const TextRun whole = pulled(GetParam(), "");
  EXPECT_NEAR(sum(run.particles("p.volume")[0]) / sum(whole.particles("p.volume")[0]), 1, 0.03);
}

INSTANTIATE_TEST_SUITE_P(Of, Split, testing::Values("linear", "gimp", "cpdi"),
                         [](const auto& test) { return std::string(test.param); });

TEST(Split, HalvesEveryEdgeWhereStressIsHigh) {
  const TextRun run = pulled("gimp", "<Variable name='stressNorm' value='100' matl='all'/>");
  const auto before = run.particles("p.mass", 0, "first")[0], after = run.particles("p.mass")[0];
  EXPECT_GT(after.size(), before.size());
  EXPECT_NEAR(*std::min_element(after.begin(), after.end()) / before[0], 0.25, 1e-14);
}

TEST(Split, NeitherBoxesNorThreadsShow) {
  const TextRun plain = pulled("gimp", stretched);
  const TextRun other = pulled("gimp", stretched, 2, "[3,2,1]");
  for (const char* label : {"p.x", "p.mass", "p.volume", "p.velocity"}) {
    const auto a = plain.particles(label), b = other.particles(label);
    const auto i = plain.particles("p.particleID")[0], j = other.particles("p.particleID")[0];
    ASSERT_EQ(i.size(), j.size());
    std::map<double, std::size_t> place;
    for (std::size_t p = 0; p < j.size(); ++p) place[j[p]] = p;
    for (std::size_t c = 0; c < a.size(); ++c)
      for (std::size_t p = 0; p < i.size(); ++p)
        ASSERT_EQ(a[c][p], b[c][place.at(i[p])]) << label << ' ' << i[p];
  }
}

}  // namespace
}  // namespace sluice::mpm::split_test
