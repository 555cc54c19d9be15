// <AMR> from the deck: levels that are added, every fault of them, regions and criteria.
#include "framework/scene/refinement_settings.hpp"

#include "framework/base/error.hpp"
#include "framework/base/test_support/environment.hpp"
#include "framework/scene/scene.hpp"
#include "framework/scene/test_support/deck_text.hpp"

namespace sluice::refinement_settings_test {
namespace {

using testing::HasSubstr;

constexpr std::array<bool, 3> flat = {true, true, false};  // x and y are dimensions of the run

struct Read {
  RefinementSettings settings;
  GridSettings grid;
  std::string faults;
};

std::string one_level(const std::string& cells) {
  return "<Level><Box><lower>[0,0,0]</lower><upper>[1,1,1]</upper><resolution>" + cells +
         "</resolution></Box></Level>";
}

Read read(const std::string& blocks, const std::string& levels = one_level("[32,16,1]"),
          const std::array<bool, 3>& active = flat) {
  const DeckText deck("<Grid>" + levels + "</Grid>\n" + blocks);
  std::vector<Fault> faults;
  Read r;
  r.grid = read_grid_settings(*deck.root().child("Grid"), faults);
  EXPECT_EQ(all_faults(faults), "");
  r.settings = read_refinement(deck.root(), r.grid, active, faults);
  r.faults = all_faults(faults);
  return r;
}

std::string regridder(const std::string& more, const std::string& type = "Tiled") {
  return "<AMR><Regridder type=\"" + type + "\">" + more + "</Regridder></AMR>";
}

constexpr const char* three_levels =
    "<max_levels>3</max_levels><cell_refinement_ratio>[[2,4,1]]</cell_refinement_ratio>"
    "<min_patch_size>[[8,16,1],[4,8,1]]</min_patch_size>";

TEST(RefinementSettings, WithoutAmrThereIsOneLevel) {
  const Read r = read("");
  EXPECT_EQ(r.faults, "");
  EXPECT_FALSE(r.settings.adaptive);
  EXPECT_EQ(r.settings.max_levels, 1);
  EXPECT_EQ(r.grid.levels.size(), 1u);
}

TEST(RefinementSettings, ARegridderAddsLevelsWithoutBoxes) {
  const Read r = read(regridder(three_levels));
  ASSERT_EQ(r.faults, "");
  EXPECT_TRUE(r.settings.adaptive);
  EXPECT_EQ(r.settings.max_levels, 3);
  EXPECT_EQ(r.settings.tile, (std::vector<IntVec3>{{1, 1, 1}, {8, 16, 1}, {4, 8, 1}}));
  EXPECT_EQ(r.settings.stability_dilation, (IntVec3{1, 1, 0}));
  EXPECT_EQ(r.settings.min_boundary_cells, (IntVec3{1, 1, 0}));
  EXPECT_EQ(r.settings.max_interval, 50);
  GridOptions options;
  options.active = flat;
  const Grid grid = build_grid(r.grid, options);
  ASSERT_EQ(grid.levels.size(), 3u);
  EXPECT_EQ(grid.cell_count(), 512);
  for (std::size_t l = 1; l < 3; ++l) {
    EXPECT_TRUE(grid.levels[l].boxes.empty());
    EXPECT_EQ(grid.levels[l].ratio, (IntVec3{2, 4, 1}));  // the last of the list holds on
    EXPECT_EQ(grid.levels[l].index, static_cast<int>(l));
  }
  EXPECT_EQ(grid.levels[2].domain, (IndexBox{{0, 0, 0}, {128, 256, 1}}));
  EXPECT_EQ(grid.levels[2].spacing, (Vec3{1.0 / 128, 1.0 / 256, 1}));
  EXPECT_EQ(grid.levels[2].active, flat);
}

TEST(RefinementSettings, EveryTagIsRead) {
  const Read r = read(
      "<AMR><useLockStep>true</useLockStep><ICE><orderOfInterpolation>2</orderOfInterpolation>"
      "<do_Refluxing>false</do_Refluxing></ICE><Regridder type=\"Tiled\">" +
      std::string(three_levels) +
      "<cell_stability_dilation>[3,2,1]</cell_stability_dilation>"
      "<cell_regrid_dilation>[1,4,0]</cell_regrid_dilation>"
      "<cell_deletion_dilation>[5,6,7]</cell_deletion_dilation>"
      "<min_boundary_cells>[2,3,1]</min_boundary_cells>"
      "<max_timestep_interval>0</max_timestep_interval>"
      "<min_timestep_interval>2</min_timestep_interval><regrid_once>true</regrid_once>"
      "</Regridder></AMR><LoadBalancer><gainThreshold>0.2</gainThreshold></LoadBalancer>");
  ASSERT_EQ(r.faults, "");
  const RefinementSettings& s = r.settings;
  EXPECT_TRUE(s.lock_step);
  EXPECT_EQ(s.interpolation_order, 2);
  EXPECT_EQ(s.interface_order, 2);  // as the other
  EXPECT_FALSE(s.reflux);
  EXPECT_EQ(s.stability_dilation, (IntVec3{3, 2, 0}));
  EXPECT_EQ(s.regrid_dilation, (IntVec3{1, 4, 0}));
  EXPECT_EQ(s.deletion_dilation, (IntVec3{5, 6, 0}));
  EXPECT_EQ(s.min_boundary_cells, (IntVec3{2, 3, 0}));
  EXPECT_EQ(s.max_interval, 0);
  EXPECT_EQ(s.min_interval, 2);
  EXPECT_TRUE(s.once);
  EXPECT_EQ(s.balance_gain, 0.2);
  EXPECT_EQ(read("<AMR><ICE><orderOfInterpolation>0</orderOfInterpolation>"
                 "<orderOf_CFI_Interpolation>2</orderOf_CFI_Interpolation></ICE></AMR>")
                .settings.interface_order,
            2);
}

TEST(RefinementSettings, RatiosAndTilesObeyTheDimensionsOfTheRun) {
  const Read r =
      read(regridder("<max_levels>2</max_levels><cell_refinement_ratio>[[2,2,2]]"
                     "</cell_refinement_ratio><min_patch_size>[[8,8,8]]"
                     "</min_patch_size>"));
  EXPECT_THAT(r.faults, HasSubstr("warning: refinement ratio 2 in direction z"));
  EXPECT_EQ(r.grid.levels[1].ratio, (IntVec3{2, 2, 1}));
  EXPECT_EQ(r.settings.tile[1], (IntVec3{8, 8, 1}));
  const Read simple =
      read(regridder("<max_levels>4</max_levels><simple_refinement_ratio>2"
                     "</simple_refinement_ratio><min_patch_size>[[8,8,1]]</min_patch_size>"));
  EXPECT_EQ(simple.faults, "");
  EXPECT_EQ(simple.grid.levels[3].ratio, (IntVec3{2, 2, 1}));
}

TEST(RefinementSettings, OneLevelIsTheCoarsest) {
  const Read r =
      read(regridder("<max_levels>1</max_levels><cell_refinement_ratio>[[3,3,1]]"
                     "</cell_refinement_ratio>"));
  EXPECT_EQ(r.faults, "");
  EXPECT_FALSE(r.settings.adaptive);
  EXPECT_EQ(r.grid.levels.size(), 1u);
}

TEST(RefinementSettings, Faults) {
  const std::string two = "<max_levels>2</max_levels>";
  const std::string ratio = "<cell_refinement_ratio>[[2,2,1]]</cell_refinement_ratio>";
  const std::string tile = "<min_patch_size>[[8,8,1]]</min_patch_size>";
  const auto ratios = [](const std::string& list) {
    return "<cell_refinement_ratio>" + list + "</cell_refinement_ratio>";
  };
  const auto tiles = [](const std::string& list) {
    return "<min_patch_size>" + list + "</min_patch_size>";
  };
  struct Case {
    std::string inside, message;
  };
  for (const Case& c : {
           Case{two + tile, "error: <Regridder> has no refinement ratios"},
           Case{two + ratio, "error: <Regridder> has no <min_patch_size>"},
           Case{two + tile + ratios("[[3,3,1]]"),
                "error: refinement ratio 3 in direction x between levels 0 and 1; it must be 1, 2"},
           Case{two + tile + ratios("[[2,8,1]]"), "use several levels to reach it"},
           Case{two + tile + ratios("[[1,1,1]]"), "error: level 1 refines no active direction"},
           Case{two + tile + ratios("[[1,1,4]]"), "error: level 1 refines no active direction"},
           Case{two + ratio + tiles("[[2,8,1]]"),
                "error: a tile of 2 cells in direction x for level 1; it must have at least 4"},
           Case{two + ratio + tiles("[[8,9,1]]"),
                "warning: a tile of 9 cells in direction y for level 1, where the refinement ratio "
                "is "
                "2: it is replaced by tiles of whole coarse cells, of 10"},
           Case{two + tile + ratios("[[2,2,1],[4,4,1]]"),
                "warning: 2 refinement ratios for 1 finer level"},
           Case{two + ratio + tiles("[[8,8,1],[4,4,1]]"),
                "warning: 2 tile sizes for 1 finer level"},
           Case{"<max_levels>14</max_levels>" + tile + ratios("[[4,1,1]]"), "more than 2^30 cells"},
           Case{"<max_levels>12</max_levels>" + tile + ratios("[[4,4,1]]"),
                "is to be flagged for refinement"},
           Case{two + ratio + tile + "<cell_stability_dilation>[1,0,0]</cell_stability_dilation>",
                "warning: cell_stability_dilation 0 in direction y"},
           Case{two + ratio + tile + "<min_boundary_cells>[0,1,0]</min_boundary_cells>",
                "warning: min_boundary_cells 0 in direction x; read as 1"},
           Case{two + ratio + tile + "<min_timestep_interval>3</min_timestep_interval>",
                "use at most 2"},
           Case{two + ratio + tile + "<simple_refinement_ratio>4</simple_refinement_ratio>",
                "warning: <simple_refinement_ratio> has no effect together with"},
           Case{two + ratio + tile +
                    "<min_timestep_interval>2</min_timestep_interval>"
                    "<max_timestep_interval>1</max_timestep_interval>",
                "warning: max_timestep_interval 1 has no effect: min_timestep_interval is 2"},
           Case{two + ratio + tile + "<adaptive>false</adaptive>", "warning: <adaptive> is false"},
       }) {
    const Read r = read(regridder(c.inside));
    EXPECT_THAT(r.faults, HasSubstr(c.message)) << c.inside;
    EXPECT_THAT(r.faults, HasSubstr("deck.ups:")) << c.inside;
    const bool error = c.message.find("warning") == std::string::npos &&
                       c.message.find("use at most 2") == std::string::npos;
    EXPECT_EQ(r.grid.levels.size(), error ? 1u : r.settings.adaptive ? 2u : 1u) << c.inside;
  }
}

TEST(RefinementSettings, ARegionWithoutCellsIsToldOf) {
  const auto faults = [](const std::string& low, const std::string& high) {
    return read("<AMR><Refine name=\"spot\"><geom_object><box><min>" + low + "</min><max>" + high +
                "</max></box></geom_object></Refine><Regridder type=\"Tiled\">" + three_levels +
                "</Regridder></AMR>")
        .faults;
  };
  const std::string told = "warning: <Refine>: spot has no effect: no cell of the coarsest level";
  EXPECT_THAT(faults("[2,0,0]", "[3,1,1]"), HasSubstr(told));       // outside of the domain
  EXPECT_THAT(faults("[0.5,0,0]", "[0.51,1,1]"), HasSubstr(told));  // between two centres
  EXPECT_THAT(faults("[0,0,0]", "[1,1,0.4]"), HasSubstr(told));     // below the one layer of z
  EXPECT_EQ(faults("[0.5,0,0]", "[0.515625,1,0.5]"), "");           // up to centres
}

TEST(RefinementSettings, WhatAnEntryBringsIsSaidOnce) {
  const Read r =
      read(regridder("<max_levels>3</max_levels><cell_refinement_ratio>[[2,2,2]]"
                     "</cell_refinement_ratio><min_patch_size>[[8,8,1]]"
                     "</min_patch_size>"));
  const std::size_t first = r.faults.find("direction z");
  ASSERT_NE(first, std::string::npos);
  EXPECT_EQ(r.faults.find("direction z", first + 1), std::string::npos) << r.faults;
}

TEST(RefinementSettings, OtherTypesStandForTheTiledOne) {
  const Read r =
      read(regridder("<max_levels>2</max_levels><cell_refinement_ratio>[[4,4,1]]"
                     "</cell_refinement_ratio>",
                     "Hierarchical"));
  EXPECT_THAT(r.faults,
              HasSubstr("warning: the Hierarchical regridder is replaced by the Tiled one"));
  ASSERT_TRUE(r.settings.adaptive);
  EXPECT_EQ(r.settings.tile[1], (IntVec3{8, 8, 1}));
  const Read single = read(regridder("<max_levels>2</max_levels>", "SingleLevel"));
  EXPECT_THAT(single.faults, HasSubstr("a SingleLevel regridder has no effect"));
  EXPECT_FALSE(single.settings.adaptive);
  const Read fixed = read("<AMR type=\"StaticGridML\"><Regridder type=\"Tiled\">" +
                          std::string(three_levels) + "</Regridder></AMR>");
  EXPECT_THAT(fixed.faults, HasSubstr("no effect with type StaticGridML"));
  EXPECT_EQ(fixed.grid.levels.size(), 1u);
  EXPECT_THAT(read("<AMR type=\"Dynamic\"></AMR>").faults, HasSubstr("no <Regridder>"));
}

TEST(RefinementSettings, RegionsErrorEstimatesAndInterfaces) {
  const std::string box =
      "<geom_object><box><min>[0,0,0]</min><max>[0.5,1,1]</max></box></geom_object>";
  const auto with = [&](const std::string& more) {
    return read("<AMR>" + more + "<Regridder type=\"Tiled\">" + three_levels +
                "</Regridder></AMR>");
  };
  const Read r = with("<Refine name=\"inlet\" level=\"1\">" + box + "</Refine><Refine>" + box +
                      "</Refine><ErrorEstimate variable=\"rho_CC\" tolerance=\"0.01\"/>"
                      "<ErrorEstimate variable=\"temp_CC\" matl=\"2\" tolerance=\"0.1\"/>");
  ASSERT_EQ(r.faults, "");
  ASSERT_EQ(r.settings.regions.size(), 2u);
  EXPECT_EQ(r.settings.regions[0].name, "inlet");
  EXPECT_EQ(r.settings.regions[0].finest_level, 1);
  EXPECT_TRUE(r.settings.regions[0].piece->inside({0.4, 0.5, 0.5}));
  EXPECT_FALSE(r.settings.regions[0].piece->inside({0.6, 0.5, 0.5}));
  EXPECT_EQ(r.settings.regions[1].name, "region 1");
  EXPECT_EQ(r.settings.regions[1].finest_level, 2);
  ASSERT_EQ(r.settings.errors.size(), 2u);
  EXPECT_EQ(r.settings.errors[0].label, "rho_CC");
  EXPECT_EQ(r.settings.errors[0].material, 0);
  EXPECT_EQ(r.settings.errors[0].tolerance, 0.01);
  EXPECT_EQ(r.settings.errors[1].material, 2);

  EXPECT_THAT(with("<Refine level=\"0\">" + box + "</Refine>").faults,
              HasSubstr("error: <Refine>"));
  const Read deep = with("<Refine level=\"5\">" + box + "</Refine>");
  EXPECT_THAT(deep.faults,
              HasSubstr("warning: <Refine>: level 5, but with max_levels 3 the finest level is 2"));
  EXPECT_EQ(deep.settings.regions[0].finest_level, 2);
  EXPECT_THAT(with("<Refine/>").faults, HasSubstr("<Refine> has no <geom_object>"));
  EXPECT_THAT(with("<Refine><geom_object/></Refine>").faults,
              HasSubstr("without a geometry piece"));
  EXPECT_THAT(with("<ErrorEstimate tolerance=\"1\"/>").faults, HasSubstr("has no variable"));
  EXPECT_THAT(with("<ErrorEstimate variable=\"rho_CC\" tolerance=\"0\"/>").faults,
              HasSubstr("tolerance 0; it must be greater than 0"));
  EXPECT_THAT(with("<ErrorEstimate variable=\"rho_CC\" tolerance=\"1.5\"/>").faults,
              HasSubstr("tolerance 1.5; it must be greater than 0 and at most 1"));
  EXPECT_EQ(with("<ErrorEstimate variable=\"rho_CC\" tolerance=\"1\"/>").faults, "");
  const Read near = with(
      "<MaterialInterface distance=\"0.25\"/>"
      "<MaterialInterface matl=\"1\" distance=\"0\" level=\"1\"/>");
  ASSERT_EQ(near.faults, "");
  ASSERT_EQ(near.settings.interfaces.size(), 2u);
  EXPECT_EQ(near.settings.interfaces[0].material, -1);
  EXPECT_EQ(near.settings.interfaces[0].distance, 0.25);
  EXPECT_EQ(near.settings.interfaces[0].finest_level, 2);
  EXPECT_EQ(near.settings.interfaces[1].material, 1);
  EXPECT_EQ(near.settings.interfaces[1].finest_level, 1);
  for (const char* bad : {"", "distance=\"-1\""})
    EXPECT_THAT(with("<MaterialInterface " + std::string(bad) + "/>").faults,
                HasSubstr("error: <MaterialInterface> needs a distance of 0"));
  EXPECT_THAT(with("<MaterialInterface distance=\"1\" level=\"0\"/>").faults,
              HasSubstr("error: <MaterialInterface>: level 0"));
  EXPECT_THAT(
      with("<MaterialInterface distance=\"1\" level=\"3\"/>").faults,
      HasSubstr(
          "warning: <MaterialInterface>: level 3, but with max_levels 3 the finest level is 2"));
  EXPECT_THAT(read("<AMR><MaterialInterface distance=\"1\"/></AMR>").faults,
              HasSubstr("warning: <MaterialInterface> has no effect"));
  const Read idle = read("<AMR><Refine>" + box + "</Refine></AMR>");
  EXPECT_THAT(idle.faults, HasSubstr("warning: <Refine> has no effect"));
  EXPECT_TRUE(idle.settings.regions.empty());
}

std::string level(const std::string& lower, const std::string& upper, const std::string& cells,
                  const std::string& more = "") {
  return "<Level><Box><lower>" + lower + "</lower><upper>" + upper + "</upper><resolution>" +
         cells + "</resolution>" + more + "</Box></Level>";
}

TEST(RefinementSettings, StaticLevelsStayAsTheGridHasThem) {
  const std::string levels = one_level("[8,8,1]") + level("[0,0,0]", "[0.5,1,1]", "[8,16,1]") +
                             level("[0,0.25,0]", "[0.375,0.75,1]", "[24,32,1]");
  const Read r = read("<AMR type=\"StaticGridML\"></AMR>", levels);
  EXPECT_EQ(r.faults, "");
  EXPECT_FALSE(r.settings.adaptive);
  EXPECT_EQ(r.settings.max_levels, 3);
  EXPECT_EQ(r.grid.levels.size(), 3u);
  const Read both = read(regridder(three_levels), levels);
  EXPECT_TRUE(both.settings.adaptive);
  ASSERT_EQ(both.settings.start_boxes.size(), 2u);
  EXPECT_EQ(both.settings.start_boxes[0].boxes.front().volume(), 8 * 16);
}

TEST(RefinementSettings, StaticLevelsKeepAMargin) {
  const auto with = [](const std::string& finest, const std::string& periodic) {
    return read("", one_level("[8,8,1]").insert(7, periodic) +
                        level("[0,0.25,0]", "[0.5,0.75,1]", "[8,8,1]") + finest);
  };
  EXPECT_EQ(with(level("[0,0.375,0]", "[0.375,0.625,1]", "[12,8,1]"), "").faults, "");
  EXPECT_THAT(with(level("[0.25,0.375,0]", "[0.5,0.625,1]", "[8,8,1]"), "").faults,
              HasSubstr("it touches the edge of level 1"));
  // At a periodic side the margin lies across it.
  EXPECT_THAT(
      with(level("[0,0.375,0]", "[0.375,0.625,1]", "[12,8,1]"), "<periodic>[1,0,0]</periodic>")
          .faults,
      HasSubstr("it touches the edge of level 1"));
  EXPECT_THAT(read("", one_level("[8,8,1]") + level("[0,0,0]", "[0.5,0.5,1]", "[12,12,1]")).faults,
              HasSubstr("refinement ratio 3 in direction x between levels 0 and 1"));
}

TEST(RefinementSettings, ClassicDecksGetTheirLevels) {
  const auto decks = folder_in_environment("SLUICE_DECKS");
  if (!decks) GTEST_SKIP() << "SLUICE_DECKS is not set";
  struct Case {
    const char* name;
    IndexBox finest;
    bool adaptive;
  };
  for (const Case& c : {Case{"ICE/explosion", {{0, 0, 0}, {512, 512, 1}}, true},
                        Case{"ICE/riemann_AMR", {{0, 0, 0}, {1600, 1, 1}}, true},
                        Case{"ICE/riemann2D_AMR", {{0, 0, 0}, {384, 384, 1}}, true},
                        Case{"ICE/BW_reflect_AMR", {{0, 0, 0}, {100, 100, 100}}, true},
                        Case{"ICE/advectAMR", {{0, 0, 0}, {160, 160, 160}}, false}}) {
    const std::filesystem::path file = *decks / "inputs" / (std::string(c.name) + ".ups");
    std::vector<Fault> faults;
    const Scene s = read_scene(read_deck(file.string()), {}, faults);
    EXPECT_EQ(all_faults(faults), "") << c.name;
    ASSERT_FALSE(s.grid.levels.empty()) << c.name;
    EXPECT_EQ(s.grid.levels.back().domain, c.finest) << c.name;
    EXPECT_EQ(s.refinement.adaptive, c.adaptive) << c.name;
    EXPECT_EQ(s.grid.levels.back().boxes.empty(), c.adaptive) << c.name;
    EXPECT_EQ(s.refinement.max_levels, static_cast<int>(s.grid.levels.size())) << c.name;
  }
}

}  // namespace
}  // namespace sluice::refinement_settings_test
