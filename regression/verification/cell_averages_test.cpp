// Averages of boxes of cells against closed forms and against sums over what the archive holds.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <iterator>
#include <numbers>

#include "framework/base/temporary_folder.hpp"
#include "sluice_source_dir.hpp"
#include "verification/case_run.hpp"

namespace sluice::verification::cell_averages_test {
namespace {

namespace fs = std::filesystem;

// One of our decks that averages a variable.
class AveragingDeck {
 public:
  AveragingDeck(const std::string& deck, const std::string& label, const std::string& module) {
    std::ifstream in(fs::path(SLUICE_SOURCE_DIR) / "inputs/ice" / (deck + ".ups"));
    std::string text(std::istreambuf_iterator<char>(in), {});
    text.insert(text.rfind("</Uintah_specification>"),
                "<DataAnalysis><Module name=\"spatialAvg\">" + module +
                    "<Variables><analyze label=\"" + label +
                    "\"/></Variables></Module></DataAnalysis>");
    text.insert(text.find("</DataArchiver>"), "<save label=\"spatialAvg_" + label +
                                                  "\"/><save label=\"spatialAvg_variance_" + label +
                                                  "\"/>");
    std::ofstream(path()) << text;
  }
  std::string path() const { return (folder_.path() / "deck.ups").string(); }

 private:
  TemporaryFolder folder_;
};

const std::string always = "<timeStart>0</timeStart><timeStop>100</timeStop>";

// Mean of a linear field over a box around a cell: that of the cell; variance: sum over the
// directions of (slope dx)^2 (n^2 - 1)/12.
TEST(CellAverages, OfALinearFieldAreClosedForms) {
  const AveragingDeck deck("turbulence_box", "vel_CC",
                           always + "<avgBoxCells>[5,3,7]</avgBoxCells>");
  const std::string formula = "CFD/ICE/customInitialization/formula/";
  const CaseRun run(deck.path(),
                    {resolution(12, 16, 24), formula + "velocity_x=0.3*x + 0.2*y - 0.1*z",
                     formula + "velocity_y=-0.4*x", formula + "velocity_z=2"},
                    {"--max-steps", "1"});
  const double dx = 2 * std::numbers::pi;
  const double hx = dx / 12, hy = dx / 16, hz = dx / 24;
  const double along_x = hx * hx * 24 / 12, along_y = hy * hy * 8 / 12, along_z = hz * hz * 48 / 12;
  const double wanted[] = {0.09 * along_x + 0.04 * along_y + 0.01 * along_z, 0.16 * along_x, 0};
  for (int c = 0; c < 3; ++c) {
    const CellValues u = run.field("vel_CC", c, "first");
    const CellValues mean = run.field("spatialAvg_vel_CC", c, "first");
    const CellValues variance = run.field("spatialAvg_variance_vel_CC", c, "first");
    for (int k = 3; k < 21; ++k)
      for (int j = 1; j < 15; ++j)
        for (int i = 2; i < 10; ++i) {
          EXPECT_NEAR(mean.at(i, j, k), u.at(i, j, k), 1e-14);
          EXPECT_NEAR(variance.at(i, j, k), wanted[c], 1e-14);
        }
  }
}

struct Sums {
  double mean = 0, variance = 0;
  int count = 0;
};

// Of the box [2 a + 1, 2 b + 1, 1] around a cell, as the archive has it.
Sums sums_of(const CellValues& q, int i, int j, int a, int b, bool periodic) {
  Sums s;
  long double sum = 0, squares = 0;
  for (int pass = 0; pass < 2; ++pass)
    for (int y = j - b; y <= j + b; ++y)
      for (int x = i - a; x <= i + a; ++x) {
        if (!periodic && (x < 0 || y < 0 || x >= q.size.x || y >= q.size.y)) continue;
        const long double value = q.at((x + q.size.x) % q.size.x, (y + q.size.y) % q.size.y);
        if (pass == 0) {
          sum += value;
          ++s.count;
        } else {
          squares += (value - sum / s.count) * (value - sum / s.count);
        }
      }
  s.mean = static_cast<double>(sum / s.count);
  s.variance = static_cast<double>(squares / s.count);
  return s;
}

// Everywhere, where boxes are whole, or where they are not; across ends and periodic ends.
TEST(CellAverages, AreThoseOfWhatIsSaved) {
  struct Case {
    const char *deck, *where;
    bool periodic, whole, cut;  // cells with whole boxes have averages; others
  };
  for (const Case& c : {Case{"explosion_2d", "everywhere", false, true, true},
                        Case{"explosion_2d", "interior", false, true, false},
                        Case{"explosion_2d", "boundaries", false, false, true},
                        Case{"vortex", "interior", true, true, false}}) {
    const AveragingDeck deck(
        c.deck, "press_CC",
        always + "<avgBoxCells>[5,3,9]</avgBoxCells><domain>" + std::string(c.where) + "</domain>");
    const CaseRun run(deck.path(), {resolution(30, 26), "Time/maxTime=0.3"});
    const CellValues p = run.field("press_CC"), mean = run.field("spatialAvg_press_CC"),
                     variance = run.field("spatialAvg_variance_press_CC");
    EXPECT_GT(highest(variance), 1e-5);
    for (int j = 0; j < p.size.y; ++j)
      for (int i = 0; i < p.size.x; ++i) {
        Sums s = sums_of(p, i, j, 2, 1, c.periodic);
        if (!(s.count == 15 ? c.whole : c.cut)) s = {};
        EXPECT_NEAR(mean.at(i, j), s.mean, 4e-15) << c.deck << " " << c.where;
        EXPECT_NEAR(variance.at(i, j), s.variance, 4e-15) << c.deck << " " << c.where;
      }
  }
}

TEST(CellAverages, AreTakenFromStartToStop) {
  const AveragingDeck deck("explosion_2d", "press_CC",
                           "<timeStart>0.05</timeStart><timeStop>0.15</timeStop>"
                           "<avgBoxCells>[3,3,1]</avgBoxCells>");
  const CaseRun run(deck.path(),
                    {resolution(20, 20), "Time/maxTime=0.2", "DataArchiver/outputInterval=0.1"});
  EXPECT_EQ(highest(run.field("spatialAvg_press_CC", 0, "first")), 0);
  EXPECT_GT(lowest(run.field("spatialAvg_press_CC", 0, "0.1")), 0);
  EXPECT_EQ(highest(run.field("spatialAvg_press_CC", 0, "last")), 0);
}

// A box may not go around a periodic domain and meet itself.
TEST(CellAverages, ABoxIsNoLargerThanAPeriodicDomain) {
  const AveragingDeck deck("vortex", "press_CC", always + "<avgBoxCells>[13,3,1]</avgBoxCells>");
  EXPECT_NO_THROW(CaseRun(deck.path(), {resolution(13, 12)}, {"--max-steps", "1"}));
  EXPECT_THROW(CaseRun(deck.path(), {resolution(12, 12)}, {"--max-steps", "1"}),
               std::runtime_error);
}

}  // namespace
}  // namespace sluice::verification::cell_averages_test
