// A whole deck as a scene, and all faults of a bad one at once.
#include "framework/scene/scene.hpp"

#include "framework/base/test_support/environment.hpp"
#include "framework/scene/test_support/deck_text.hpp"

namespace sluice::scene_test {
namespace {

using testing::HasSubstr;

std::string sides(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& s : names)
    text +=
        "<Face side=\"" + s + "\"><BCType id=\"0\" label=\"Symmetric\" var=\"symmetry\"/></Face>\n";
  return text;
}

struct Parts {
  std::string time = "<maxTime>1</maxTime><timestep_multiplier>1</timestep_multiplier>";
  std::string faces = sides({"x-", "x+", "y-", "y+", "z-", "z+"});
  std::string resolution = "[100,1,1]";
  std::string gravity = "[0,0,0]";
  std::string velocity = "[1,0,0]";
  std::string ice;
  std::string archiver =
      "<filebase>tube.uda</filebase><outputInterval>0.1</outputInterval>"
      "<save label=\"rho_CC\"/>";
  std::string analysis;
};

Deck deck_of(const Parts& p) {
  return read_deck_text(
      "<Uintah_specification><Meta><title>tube</title></Meta>"
      "<SimulationComponent type=\"ICE\"/>\n<Time>" +
          p.time +
          "</Time>\n<Grid>"
          "<BoundaryConditions>" +
          p.faces +
          "</BoundaryConditions><Level><Box label=\"1\">"
          "<lower>[0,0,0]</lower><upper>[1,0.01,0.01]</upper><resolution>" +
          p.resolution +
          "</resolution><patches>[1,1,1]</patches></Box></Level></Grid>\n<DataArchiver>" +
          p.archiver + "</DataArchiver>\n<CFD><cfl>0.4</cfl><ICE>" + p.ice +
          "</ICE></CFD>\n<PhysicalConstants>"
          "<gravity>" +
          p.gravity +
          "</gravity><reference_pressure>101325</reference_pressure>"
          "</PhysicalConstants>\n<MaterialProperties><ICE><material name=\"air\"><geom_object>"
          "<null/><velocity>" +
          p.velocity +
          "</velocity><density>1</density></geom_object>"
          "</material></ICE></MaterialProperties>\n<DataAnalysis>" +
          p.analysis + "</DataAnalysis></Uintah_specification>",
      "deck.ups");
}

TEST(Scene, HoldsWhatTheDeckMeans) {
  SceneOptions options;
  options.ranks = 2;
  const Scene s = read_scene(deck_of({}), options);
  EXPECT_EQ(s.title, "tube");
  EXPECT_EQ(s.component, "ice");
  EXPECT_EQ(s.time.max_time, 1);
  ASSERT_EQ(s.materials.size(), 1u);
  EXPECT_EQ(s.materials[0].name, "air");
  EXPECT_EQ(s.materials[0].kind, "ICE");
  EXPECT_EQ(s.constants.reference_pressure, 101325);
  EXPECT_EQ(s.output.filebase, "tube.uda");
  ASSERT_EQ(s.grid.levels.size(), 1u);
  EXPECT_EQ(s.grid.cell_count(), 100);
  EXPECT_EQ(s.grid.levels[0].boxes.size(), 2u);
  EXPECT_EQ(s.grid.levels[0].active, (std::array<bool, 3>{true, false, false}));
  EXPECT_EQ(s.directions[1].reason, "one cell between symmetric faces");
}

TEST(Scene, OptionsForceDirectionsAndBoxes) {
  SceneOptions options;
  options.force_directions = true;
  options.boxes = {5, 1, 1};
  const Scene s = read_scene(deck_of({}), options);
  EXPECT_EQ(s.grid.levels[0].active_count(), 3);
  EXPECT_EQ(s.grid.levels[0].boxes.size(), 5u);
}

TEST(Scene, VelocitiesAndGravityDecideAboutDirections) {
  Parts moving;
  moving.velocity = "[1,0,0.5]";
  EXPECT_TRUE(read_scene(deck_of(moving), {}).directions[2].active);
  EXPECT_FALSE(read_scene(deck_of(moving), {}).directions[1].active);

  Parts falling;
  falling.gravity = "[0,-9.8,0]";
  EXPECT_TRUE(read_scene(deck_of(falling), {}).directions[1].active);

  Parts formula;
  formula.ice =
      "<customInitialization><formula><velocity_x>x</velocity_x><velocity_y>sin(y)</velocity_y>"
      "<velocity_z>0.0</velocity_z></formula>"
      "</customInitialization>";
  EXPECT_TRUE(read_scene(deck_of(formula), {}).directions[1].active);
  EXPECT_FALSE(read_scene(deck_of(formula), {}).directions[2].active);

  Parts inflow;
  inflow.faces = sides({"x+", "y-", "y+", "z-", "z+"}) +
                 "<Face side=\"x-\"><BCType id=\"all\" label=\"Symmetric\" var=\"symmetry\"/>"
                 "<BCType id=\"0\" label=\"Velocity\" var=\"Dirichlet\"><value>[1,0,2]</value>"
                 "</BCType></Face>";
  EXPECT_TRUE(read_scene(deck_of(inflow), {}).directions[2].active);
}

TEST(Scene, ReportsAllFaultsOfAllBlocks) {
  Parts bad;
  bad.time = "<maxTime>-1</maxTime><timestep_multiplier>1</timestep_multiplier>";
  bad.faces = sides({"x-", "x+", "y-", "y+", "z-"});
  bad.ice =
      "<customInitialization><formula><density>2*densty</density></formula>"
      "</customInitialization>";
  bad.archiver = "<filebase>a</filebase><save label=\"rho_CC\" levels=\"?\"/>";
  bad.analysis = "<Module name=\"minMax\"><material>water</material></Module>";
  std::vector<Fault> faults;
  read_scene(deck_of(bad), {}, faults);
  const std::string text = all_faults(faults);
  EXPECT_EQ(faults.size(), 5u) << text;
  EXPECT_THAT(text, HasSubstr("formula: 'densty' is not a variable"));
  EXPECT_THAT(text, HasSubstr("maxTime -1"));
  EXPECT_THAT(text, HasSubstr("side z+: no boundary condition"));
  EXPECT_THAT(text, HasSubstr("index set '?'"));
  EXPECT_THAT(text, HasSubstr("no material is named 'water'"));
  try {
    read_scene(deck_of(bad), {});
    FAIL() << "expected SceneError";
  } catch (const SceneError& e) {
    EXPECT_EQ(e.faults().size(), 5u);
    EXPECT_EQ(e.status(), ExitStatus::bad_input);
    EXPECT_EQ(std::string(e.what()) + '\n', text);
  }
}

TEST(Scene, MissingBlocksAreNamed) {
  const Deck deck = read_deck_text("<Uintah_specification/>", "deck.ups");
  std::vector<Fault> faults;
  read_scene(deck, {}, faults);
  for (const char* block : {"SimulationComponent", "Time", "Grid", "DataArchiver"})
    EXPECT_THAT(all_faults(faults), HasSubstr(std::string("<") + block + ">"));
}

TEST(Scene, ADeckWithFaultsIsNotInterpreted) {
  Deck deck = deck_of({});
  deck.faults.push_back({Severity::error, {"deck.ups", 1, 1}, "bad", ""});
  std::vector<Fault> faults;
  EXPECT_TRUE(read_scene(deck, {}, faults).grid.levels.empty());
  EXPECT_EQ(all_faults(faults), "deck.ups:1:1: error: bad\n");
}

// Decks of the classic code, when SLUICE_DECKS names the folder that holds its inputs/.
TEST(Scene, ReadsClassicDecks) {
  const auto decks = folder_in_environment("SLUICE_DECKS");
  if (!decks) GTEST_SKIP() << "SLUICE_DECKS is not set";
  struct Case {
    const char* name;
    std::int64_t cells;
    int active;
  };
  for (const Case& c : {Case{"ICE/riemann_sm", 250, 1}, Case{"ICE/riemann3D", 1000000, 3},
                        Case{"ICE/advect", 125, 3}, Case{"ICE/advect_periodic", 8000, 3},
                        Case{"ICE/test2", 100, 1}, Case{"ICE/test3", 100, 1},
                        Case{"ICE/test4", 100, 1}, Case{"UintahRelease/ICE/shockTube", 250, 1},
                        Case{"ICE/explosion", 1024, 2}, Case{"ICE/riemann2D_AMR", 576, 2}}) {
    const std::filesystem::path file = *decks / "inputs" / (std::string(c.name) + ".ups");
    std::vector<Fault> faults;
    const Deck deck = read_deck(file.string());
    const Scene s = read_scene(deck, {}, faults);
    EXPECT_EQ(all_faults(faults), "") << c.name;
    EXPECT_EQ(s.grid.cell_count(), c.cells) << c.name;
    ASSERT_FALSE(s.grid.levels.empty()) << c.name;
    EXPECT_EQ(s.grid.levels[0].active_count(), c.active) << c.name;
  }
}

}  // namespace
}  // namespace sluice::scene_test
