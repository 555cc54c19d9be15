// A deformation that a file prescribes: particles have that of its rows, whatever the transfer.
#include <gtest/gtest.h>

#include <fstream>

#include "framework/base/temporary_folder.hpp"
#include "mpm/test_support/text_run.hpp"

namespace sluice::mpm::prescribed_test {
namespace {

std::string name_of(const testing::TestParamInfo<const char*>& test) {
  constexpr const char* names[] = {"by_default", "musl", "usl", "gimp"};
  return names[test.index];
}

class Prescribed : public testing::TestWithParam<const char*> {};

// Squeezed to .8, .9 and 1.1, and then to 1.05, 1, 1 with a shear of .1.
TEST_P(Prescribed, ParticlesHaveTheDeformationOfTheRows) {
  const TemporaryFolder folder;
  const std::string file = (folder / "rows.inp").string();
  std::ofstream(file) << "0 1 0 0 0 1 0 0 0 1 0 0 0 1\n"
                         "0.1 .8 0 0 0 .9 0 0 0 1.1 0 0 0 1\n"
                         "0.2 1.05 .1 0 0 1 0 0 0 1 0 0 0 1\n";
  SolidDeck deck;
  deck.lower = "[-2,-2,-2]";
  deck.upper = "[3,3,3]";
  deck.cells = "[5,5,5]";
  deck.flags = std::string(GetParam()) +
               "<UsePrescribedDeformation>true</UsePrescribedDeformation>"
               "<PrescribedDeformationFile>" +
               file + "</PrescribedDeformationFile>";
  deck.objects =
      "<geom_object><box><min>[0,0,0]</min><max>[1,1,1]</max></box><res>[1,1,1]</res>"
      "<velocity>[0,0,0]</velocity><temperature>300</temperature></geom_object>";
  const TextRun run(
      deck,
      {{"<maxTime>1<", "<maxTime>0.2<"},
       {"<outputInterval>0</outputInterval>", saves({"p.x", "p.stress", "p.deformationMeasure"})}},
      "prescribed");
  const double F[] = {1.05, 0.1, 0, 0, 1, 0, 0, 0, 1};
  const auto found = run.particles("p.deformationMeasure");
  for (std::size_t e = 0; e < 9; ++e) EXPECT_NEAR(found[e][0], F[e], 1e-9) << e;
  EXPECT_NEAR(run.particles("p.x")[0][0], 1.05 * 0.5 + 0.1 * 0.5, 1e-9);
  EXPECT_NE(run.particles("p.stress")[0][0], 0);
}

INSTANTIATE_TEST_SUITE_P(Of, Prescribed,
                         testing::Values("", "<interpolator>linear</interpolator><musl>true</musl>",
                                         "<interpolator>linear</interpolator><musl>false</musl>",
                                         "<interpolator>gimp</interpolator>"),
                         name_of);

}  // namespace
}  // namespace sluice::mpm::prescribed_test
