// Regions, precedence, coverage and faults of boundary conditions.
#include "framework/scene/boundary.hpp"

#include "framework/scene/test_support/deck_text.hpp"

namespace sluice::boundary_test {
namespace {

using testing::HasSubstr;

const std::string symmetric = "<BCType id=\"all\" label=\"Symmetric\" var=\"symmetry\"/>";

std::string bc(const std::string& id, const std::string& label, const std::string& var,
               const std::string& value) {
  return "<BCType id=\"" + id + "\" label=\"" + label + "\" var=\"" + var + "\">" +
         (value.empty() ? "" : "<value>" + value + "</value>") + "</BCType>\n";
}
std::string face(const std::string& attributes, const std::string& content) {
  return "<Face " + attributes + ">" + content + "</Face>\n";
}
const std::string outflow =
    bc("0", "Pressure", "Neumann", "0") + bc("0", "Density", "Neumann", "0") +
    bc("0", "Temperature", "Neumann", "0") + bc("0", "Velocity", "Neumann", "[0,0,0]");

// Symmetric faces on the named sides.
std::string mirrors(const std::vector<std::string>& sides) {
  std::string text;
  for (const std::string& s : sides) text += face("side=\"" + s + "\"", symmetric);
  return text;
}

struct Read {
  BoundaryConditions conditions;
  Grid grid;
  std::string faults;
};

// 8 x 4 x 2 cells in [0,2] x [0,1] x [0,1].
Read read(const std::string& faces, int materials = 1, const std::string& periodic = "") {
  const DeckText deck(
      "<Grid><BoundaryConditions>\n" + faces +
      "</BoundaryConditions><Level><Box><lower>[0,0,0]</lower><upper>[2,1,1]</upper>"
      "<resolution>[8,4,2]</resolution></Box>" +
      (periodic.empty() ? "" : "<periodic>" + periodic + "</periodic>") + "</Level></Grid>\n");
  std::vector<Fault> faults;
  const GridSettings settings = read_grid_settings(deck.first(), faults);
  std::vector<int> all;
  for (int m = 0; m < materials; ++m) all.push_back(m);
  Read r;
  r.conditions = read_boundary_conditions(
      deck.first().child("BoundaryConditions"), settings, materials,
      {{"Pressure", {0}}, {"Density", all}, {"Temperature", all}, {"Velocity", all}}, faults);
  r.grid = build_grid(settings, {});
  r.faults = all_faults(faults);
  return r;
}

TEST(Boundary, WholeSidesWithValuesAndLocations) {
  const Read r = read(face("side=\"x-\"", bc("0", "Pressure", "Dirichlet", "101325") +
                                              bc("0", "Density", "Neumann", "0") +
                                              bc("0", "Temperature", "Dirichlet", "300") +
                                              bc("0", "Velocity", "Dirichlet", "[1, -2, 3]") +
                                              bc("0", "SpecificVol", "computeFromDensity", "0.0")) +
                      face("side=\"x+\"", outflow) + mirrors({"y-", "y+", "z-", "z+"}));
  ASSERT_EQ(r.faults, "");
  const BoundaryRegion& inlet = r.conditions.side(Side::x_minus).regions.at(0);
  EXPECT_EQ(inlet.find("Pressure", 0)->kind, ConditionKind::dirichlet);
  EXPECT_EQ(inlet.find("Pressure", 0)->value, 101325);
  EXPECT_EQ(inlet.find("Velocity", 0)->vector, (Vec3{1, -2, 3}));
  EXPECT_TRUE(inlet.find("Velocity", 0)->is_vector);
  EXPECT_EQ(inlet.find("SpecificVol", 0)->kind, ConditionKind::compute_from_density);
  EXPECT_FALSE(inlet.find("Temperature", 0)->zero_gradient());
  EXPECT_EQ(inlet.find("scalar-f", 0), nullptr);
  EXPECT_EQ(inlet.where.line, 3);
  const BoundaryRegion& outlet = r.conditions.side(Side::x_plus).regions.at(0);
  EXPECT_TRUE(outlet.find("Velocity", 0)->zero_gradient());
  EXPECT_EQ(outlet.find("SpecificVol", 0), nullptr);
  const Condition* mirror = r.conditions.side(Side::z_plus).regions.at(0).find("Density", 0);
  ASSERT_NE(mirror, nullptr);
  EXPECT_EQ(mirror->kind, ConditionKind::symmetry);
}

TEST(Boundary, SpecificBeatsAllAndTheFirstListedWins) {
  BoundaryRegion region;
  auto add = [&](const std::string& variable, int material, double value) {
    Condition c;
    c.variable = variable;
    c.material = material;
    c.value = value;
    region.conditions.push_back(c);
  };
  add("Symmetric", -1, 9);
  add("Density", -1, 1);
  add("Density", 2, 2);
  add("Density", 2, 3);
  add("Density", -1, 4);
  add("Temperature", 1, 5);
  EXPECT_EQ(region.find("Density", 2)->value, 2);
  EXPECT_EQ(region.find("Density", 0)->value, 1);
  EXPECT_EQ(region.find("Temperature", 1)->value, 5);
  EXPECT_EQ(region.find("Temperature", 0)->value, 9);  // Symmetric stands for it
  EXPECT_EQ(region.find("Pressure", 0)->value, 9);
}

TEST(Boundary, AttributeValuesAndLists) {
  const Read r = read(
      face("side=\"x-\"",
           "<BCType ids=\"[0,1]\" label=\"Density\" var=\"Dirichlet\" value=\"2.5\"/>" +
               bc("all", "Temperature", "Neumann", "0") + bc("0", "Pressure", "Neumann", "0") +
               bc("0", "Velocity", "Dirichlet", "[0,0,0]") + bc("1", "Velocity", "Neumann", "0")) +
          mirrors({"x+", "y-", "y+", "z-", "z+"}),
      2);
  ASSERT_EQ(r.faults, "");
  const BoundaryRegion& region = r.conditions.side(Side::x_minus).regions.at(0);
  EXPECT_EQ(region.find("Density", 1)->value, 2.5);
  EXPECT_EQ(region.find("Velocity", 0)->kind, ConditionKind::dirichlet);
  EXPECT_TRUE(region.find("Velocity", 1)->zero_gradient());
}

TEST(Boundary, ShapesTakeTheirFacesFromTheSide) {
  // Face centres on y-: x = 1/8, 3/8, ...; z = 1/4, 3/4.
  const Read r = read(
      face("circle=\"y-\" origin=\"0.375 0.0 0.25\" radius=\"0.25\"", outflow) +
      face("rectangle=\"y-\" lower=\"1.0, 0, 0\" upper=\"1.375, 0, 1\" name=\"slot\"", outflow) +
      mirrors({"x-", "x+", "y-", "y+", "z-", "z+"}));
  ASSERT_EQ(r.faults, "");
  const BoundarySide& side = r.conditions.side(Side::y_minus);
  ASSERT_EQ(side.regions.size(), 3u);
  EXPECT_EQ(side.regions[2].name, "slot");
  const RegionMap map(side, Side::y_minus, r.grid.levels[0]);
  EXPECT_FALSE(map.uniform());
  // Inclusive: the faces at a distance of exactly 1/4 belong to the circle.
  const std::vector<std::vector<int>> expected = {{1, 1, 1, 0, 2, 2, 0, 0},
                                                  {0, 0, 0, 0, 2, 2, 0, 0}};
  for (int k = 0; k < 2; ++k)
    for (int i = 0; i < 8; ++i)
      EXPECT_EQ(map.region(i, k), expected[std::size_t(k)][std::size_t(i)]) << i << ' ' << k;
  EXPECT_EQ(map.counts(), (std::vector<std::int64_t>{9, 3, 4}));
  const RegionMap whole(r.conditions.side(Side::z_plus), Side::z_plus, r.grid.levels[0]);
  EXPECT_TRUE(whole.uniform());
  EXPECT_EQ(whole.region(7, 3), 0);
  EXPECT_EQ(whole.counts(), (std::vector<std::int64_t>{32}));
}

TEST(Boundary, EveryShapeHasItsRule) {
  RegionShape s;
  s.kind = RegionShape::Kind::annulus;
  s.origin = {0, 5, 0};
  s.inner_radius = 1;
  s.radius = 2;
  EXPECT_FALSE(s.contains(1, {1, 0, 0}));  // on the inner circle; y does not count
  EXPECT_TRUE(s.contains(1, {2, 0, 0}));
  EXPECT_TRUE(s.contains(1, {0, 7, -1.5}));
  EXPECT_FALSE(s.contains(1, {2, 0, 0.1}));
  s.kind = RegionShape::Kind::ellipse;
  s.origin = {0, 0, 0};
  s.major_radius = 2;
  s.minor_radius = 1;
  EXPECT_TRUE(s.contains(2, {2, 0, 3}));
  EXPECT_FALSE(s.contains(2, {0, 1.1, 3}));
  s.angle = 90;
  EXPECT_TRUE(s.contains(2, {0, 1.9, 3}));
  EXPECT_FALSE(s.contains(2, {1.1, 0, 3}));
  s.kind = RegionShape::Kind::rectangulus;
  s.lower = {0, 0, 0};
  s.upper = {0, 4, 4};
  s.inner_lower = {0, 1, 1};
  s.inner_upper = {0, 3, 3};
  EXPECT_TRUE(s.contains(0, {9, 0, 4}));
  EXPECT_TRUE(s.contains(0, {9, 0.5, 2}));
  EXPECT_FALSE(s.contains(0, {9, 1, 3}));
  EXPECT_FALSE(s.contains(0, {9, 5, 2}));
}

TEST(Boundary, RepeatedSidesAndShapesAreOneRegion) {
  const std::string second = bc("1", "Density", "Neumann", "0") +
                             bc("1", "Temperature", "Neumann", "0") +
                             bc("1", "Velocity", "Neumann", "[0,0,0]");
  const std::string circle = "circle=\"x-\" origin=\"0 0.5 0.5\" radius=\"0.4\"";
  const Read r = read(face(circle, outflow) + face("side=\"x-\"", outflow) + face(circle, second) +
                          face("side=\"x-\"", second) + mirrors({"x+", "y-", "y+", "z-", "z+"}),
                      2);
  EXPECT_EQ(r.faults, "");
  EXPECT_EQ(r.conditions.side(Side::x_minus).regions.size(), 2u);
}

TEST(Boundary, PeriodicSidesNeedNothing) {
  const Read r = read(mirrors({"y-", "y+", "z-", "z+"}), 1, "[1,0,0]");
  EXPECT_EQ(r.faults, "");
  EXPECT_TRUE(r.conditions.side(Side::x_plus).periodic);
  EXPECT_TRUE(r.conditions.side(Side::x_plus).regions.empty());
  const Read more = read(mirrors({"x-", "y-", "y+", "z-", "z+"}), 1, "[1,0,0]");
  EXPECT_THAT(more.faults, HasSubstr("warning: side x- is periodic"));
  EXPECT_THAT(more.faults, Not(HasSubstr("error")));
}

TEST(Boundary, GapsAreReportedPerRegion) {
  const Read none = read("");
  EXPECT_THAT(none.faults, HasSubstr("side x-: no boundary condition for Pressure of material 0, "
                                     "Density of material 0, Temperature of material 0, Velocity"));
  EXPECT_THAT(none.faults, HasSubstr("side z+"));
  const Read partial = read(face("circle=\"x-\" origin=\"0 0.5 0.5\" radius=\"0.4\"",
                                 bc("0", "Density", "Neumann", "0")) +
                            mirrors({"x-", "x+", "y-", "y+", "z-", "z+"}));
  EXPECT_THAT(partial.faults,
              HasSubstr("deck.ups:3:1: error: circle x-: no boundary condition for Pressure of "
                        "material 0, Temperature of material 0, Velocity of material 0"));
  const Read second =
      read(mirrors({"x-", "x+", "y-", "y+", "z-"}) + face("side=\"z+\"", outflow), 2);
  EXPECT_THAT(second.faults, HasSubstr("Velocity of material 1"));
  EXPECT_THAT(second.faults, Not(HasSubstr("material 0")));
}

TEST(Boundary, FaultsOfFacesAndConditions) {
  const std::string rest = mirrors({"x-", "x+", "y-", "y+", "z-", "z+"});
  struct Case {
    std::string faces, message;
  };
  const std::vector<Case> cases = {
      {face("side=\"x\"", outflow), "side=\"x\"; sides are x-, x+"},
      {face("name=\"wall\"", outflow), "no side"},
      {face("circle=\"x-\" origin=\"0 0 0\"", outflow), "needs the attribute radius"},
      {face("circle=\"x-\" origin=\"0 0 0\" radius=\"-1\"", outflow), "must be positive"},
      {face("circle=\"x-\" origin=\"0 0\" radius=\"1\"", outflow), "has 2 numbers"},
      {face("circle=\"x-\" origin=\"0.5 0 0\" radius=\"1\"", outflow), "the plane x = 0"},
      {face("annulus=\"x-\" origin=\"0 0 0\" inner_radius=\"2\" outer_radius=\"1\"", outflow),
       "inner_radius 2 must be below"},
      {face("circle=\"x-\" origin=\"0 0 0\" radius=\"0.01\"", outflow),
       "warning: circle x-: no cell face has its centre"},
      {face("side=\"x-\"", bc("0", "Velocity", "Dirichlet", "")), "needs a <value>"},
      {face("side=\"x-\"", bc("0", "Velocity", "Dirichlet", "3")), "must be a vector"},
      {face("side=\"x-\"", bc("0", "Density", "Dirichlet", "[1,1,1]")), "must be one number"},
      {face("side=\"x-\"", bc("0", "Density", "Dirichlet", "-1")), "must be greater than 0"},
      {face("side=\"x-\"", bc("0", "Temperature", "Dirichlet", "hot")), "'hot', not a number"},
      {face("side=\"x-\"",
            "<BCType id=\"0\" label=\"Density\" var=\"Neumann\" value=\"0\">"
            "<value>0</value></BCType>"),
       "keep one"},
      {face("side=\"x-\"", "<BCType label=\"Density\" var=\"Neumann\" value=\"0\"/>"),
       "neither id nor ids"},
      {face("side=\"x-\"", bc("3", "Density", "Neumann", "0")), "the deck has 1 material"},
      {face("side=\"x-\"", bc("0", "Velocty", "Neumann", "0")), "did you mean 'Velocity'?"},
  };
  for (const Case& c : cases) {
    const Read r = read(c.faces + rest);
    EXPECT_THAT(r.faults, HasSubstr(c.message)) << c.faces;
    EXPECT_THAT(r.faults, HasSubstr("deck.ups:3:")) << c.faces;
  }
}

}  // namespace
}  // namespace sluice::boundary_test
