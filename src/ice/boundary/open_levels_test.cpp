// Open sides of levels that follow the flow: of a rejected step nothing is left.
#include <gtest/gtest.h>

#include <algorithm>

#include "ice/test_support/deck_run.hpp"

namespace sluice::ice::open_levels_test {
namespace {

// A box that waves leave; a finer level is where the density changes.
class OpenLevels : public DeckRun {
 public:
  explicit OpenLevels(const GasBox& box) : DeckRun(text_of(box)) {}

  // All levels, boxes and quantities.
  std::vector<double> values() const {
    std::vector<double> all;
    const Labels& names = labels();
    for (int l = 0; l < hierarchy().level_count(); ++l) {
      const Warehouse& state = hierarchy().level(l).state();
      for (const auto& [label, components] :
           {std::pair{names.mass, 1}, {names.momentum, 2}, {names.energy, 1}})
        for (int c = 0; c < components; ++c)
          for (int b = 0; b < static_cast<int>(state.local_boxes().size()); ++b) {
            const RealView v = state.view(state.find(label, 0), c, b);
            for_each_cell(state.local_boxes()[b].cells,
                          [&](IntVec3 cell) { all.push_back(v(cell)); });
          }
    }
    return all;
  }
  // Does the finer level reach the side x+?
  bool reaches_side() const {
    if (hierarchy().level_count() < 2) return false;
    const Level& fine = hierarchy().level(1).level();
    return std::any_of(fine.boxes.begin(), fine.boxes.end(),
                       [&](const GridBox& b) { return b.cells.upper.x == fine.domain.upper.x; });
  }

 private:
  static std::string text_of(GasBox box) {
    box.scheme = "conservative";
    std::string text = deck_text(box);
    const auto replace_all = [&](const std::string& old, const std::string& by) {
      for (std::size_t at = 0; (at = text.find(old, at)) != text.npos; at += by.size())
        text.replace(at, old.size(), by);
    };
    replace_all("Neumann", "LODI");
    replace_all("<BoundaryConditions>",
                "<BoundaryConditions><LODI><press_infinity>1</press_infinity><sigma>0.27</sigma>"
                "<material>gas</material></LODI>");
    replace_all(
        "</Grid>",
        "</Grid><AMR><ICE><orderOfInterpolation>2</orderOfInterpolation>"
        "<Refinement_Criteria_Thresholds><Variable name='rho_CC' value='0.3' matl='0'/>"
        "</Refinement_Criteria_Thresholds></ICE><Regridder type='Tiled'><max_levels>2</max_levels>"
        "<cell_refinement_ratio>[[2,2,1]]</cell_refinement_ratio>"
        "<min_patch_size>[[8,8,1]]</min_patch_size></Regridder></AMR>");
    return text;
  }
};

TEST(OpenLevels, ForgetARejectedStep) {
  GasBox box;
  box.cells = {24, 24, 1};
  box.periodic = false;
  box.pressure = "1";
  box.density = "1+0.2*exp(-((x-0.8)^2+(y-0.4)^2)/0.02)";
  box.velocity[0] = "0.4-3*(y-0.4)*exp(-((x-0.8)^2+(y-0.4)^2)/0.02)";
  box.velocity[1] = "3*(x-0.8)*exp(-((x-0.8)^2+(y-0.4)^2)/0.02)";
  OpenLevels levels(box), direct(box);
  int at_side = 0;
  for (int step = 0; step < 24; ++step) {
    const double dt = direct.limit();
    if (step % 6 == 1) {
      const std::vector<double> before = levels.values();
      for (int again = 0; again < 2; ++again) EXPECT_FALSE(levels.attempt(30 * dt)) << step;
      EXPECT_EQ(levels.values(), before);
    }
    for (OpenLevels* l : {&levels, &direct}) ASSERT_TRUE(l->attempt(dt));
    ASSERT_EQ(levels.values(), direct.values()) << step;
    EXPECT_EQ(levels.limit(), direct.limit());
    at_side += direct.reaches_side();
  }
  EXPECT_GT(at_side, 12);
}

}  // namespace
}  // namespace sluice::ice::open_levels_test
