// Every piece from its tags, labels, geometry objects, files, and what is said about bad ones.
#include "framework/scene/geometry_reader.hpp"

#include <fstream>

#include "framework/base/temporary_folder.hpp"
#include "framework/scene/test_support/deck_text.hpp"

namespace sluice::geometry_reader_test {
namespace {

using testing::HasSubstr;

PiecePtr piece_of(const std::string& xml, std::string* said = nullptr) {
  const DeckText deck(xml);
  std::vector<Fault> faults;
  const GeometryReader reader(deck.root(), faults);
  PiecePtr piece = reader.piece(deck.first(), faults);
  if (said != nullptr)
    *said = all_faults(faults);
  else
    EXPECT_EQ(all_faults(faults), "") << xml;
  return piece;
}

struct Case {
  std::string xml;
  Vec3 in, out;
};

TEST(GeometryReader, BuildsEveryPiece) {
  const std::string ends = "<bottom>[0,0,0]</bottom><top>[0,0,1]</top>";
  const std::vector<Case> cases = {
      {"<box><min>[0,0,0]</min><max>[1,1,1]</max></box>", {1, 1, 1}, {1, 1.1, 1}},
      {"<sphere><origin>[1,0,0]</origin><radius>2</radius></sphere>", {3, 0, 0}, {-1.1, 0, 0}},
      {"<sphere><center>[1,0,0]</center><radius>2</radius></sphere>", {3, 0, 0}, {-1.1, 0, 0}},
      {"<cylinder>" + ends + "<radius>1</radius></cylinder>", {1, 0, 1}, {0, 0, 1.1}},
      {"<cone>" + ends + "<bottom_radius>1</bottom_radius><top_radius>0</top_radius></cone>",
       {0.5, 0, 0.5},
       {0.6, 0, 0.5}},
      {"<ellipsoid><origin>[0,0,0]</origin><rx>1</rx><ry>2</ry><rz>3</rz></ellipsoid>",
       {0, 2, 0},
       {2, 0, 0}},
      {"<ellipsoid><origin>[0,0,0]</origin><rx>9</rx><ry>9</ry><rz>9</rz><v1>[1,1,0]</v1>"
       "<v2>[-1,1,0]</v2><v3>[0,0,2]</v3></ellipsoid>",
       {0, 0, 2},
       {1.2, 1.2, 0}},
      {"<torus><center>[0,0,0]</center><major_radius>2</major_radius>"
       "<minor_radius>0.5</minor_radius><axis>x</axis></torus>",
       {0, 2, 0},
       {2, 0, 0}},
      {"<parallelepiped><p1>[0,0,0]</p1><p2>[1,0,0]</p2><p3>[0,1,0]</p3><p4>[1,0,1]</p4>"
       "</parallelepiped>",
       {1.2, 0.5, 0.5},
       {0.2, 0.5, 0.5}},
      {"<polyhedron><center>[0,0,0]</center><bounds>"
       "<half_space type=\"absolute\"><planePoint>[1,0,0]</planePoint><normal>[-1,0,0]</normal>"
       "</half_space><half_space type=\"relative\"><offset>[-1,0,0]</offset></half_space>"
       "<half_space type=\"relative\"><offset>[0,1,0]</offset></half_space>"
       "<half_space type=\"relative\"><offset>[0,-1,0]</offset></half_space>"
       "<half_space type=\"relative\"><offset>[0,0,1]</offset></half_space>"
       "<half_space type=\"relative\"><offset>[0,0,-1]</offset></half_space>"
       "</bounds></polyhedron>",
       {0.9, -0.9, 0.9},
       {1.1, 0, 0}},
      {"<smoothcyl><discretization_scheme>pie_slices</discretization_scheme>" + ends +
           "<inner_radius>0.5</inner_radius><outer_radius>1</outer_radius>"
           "<num_radial>3</num_radial><num_axial>1</num_axial><num_angular>8</num_angular>"
           "<arc_start_angle>0</arc_start_angle><arc_angle>90</arc_angle></smoothcyl>",
       {0.5, 0.5, 0.5},
       {-0.5, 0.5, 0.5}},
      {"<plane_shell><center>[0,0,0]</center><normal>[0,0,1]</normal><radius>1</radius>"
       "<thickness>0.2</thickness><num_radius>5</num_radius></plane_shell>",
       {0.5, 0.5, 0.09},
       {0, 0, 0.11}},
      {"<sphere_shell><origin>[0,0,0]</origin><radius>1</radius><thickness>0.2</thickness>"
       "<num_lat>5</num_lat><num_long>5</num_long></sphere_shell>",
       {0, 1, 0},
       {0, 0, 0}},
      {"<sphere_membrane><origin>[0,0,0]</origin><radius>1</radius><thickness>0.2</thickness>"
       "<num_lat>5</num_lat><num_long>5</num_long></sphere_membrane>",
       {0, 1, 0},
       {0, 0, 0}},
      {"<cylinder_shell>" + ends + "<radius>1</radius><thickness>0.2</thickness></cylinder_shell>",
       {0, 1, 0.5},
       {0, 0, 0.5}},
      {"<corrugated><xymin>[0,0,0]</xymin><xymax>[2,1,0]</xymax><thickness>1</thickness>"
       "<normal>[0,0,1]</normal><corr_edge>y+</corr_edge><curve>sin</curve>"
       "<wavelength>1</wavelength><amplitude>0.2</amplitude></corrugated>",
       {0.25, 1.15, 0.5},
       {0.75, 0.9, 0.5}},
      {"<null/>", {1e9, 0, 0}, {0, -1e9, 0}},
      {"<union><box><min>[0,0,0]</min><max>[1,1,1]</max></box>"
       "<sphere><origin>[5,0,0]</origin><radius>1</radius></sphere></union>",
       {5, 0, 1},
       {3, 0, 0}},
      {"<intersection><box><min>[0,0,0]</min><max>[1,1,1]</max></box>"
       "<sphere><origin>[0,0,0]</origin><radius>1</radius></sphere></intersection>",
       {0.5, 0.5, 0.5},
       {0.9, 0.9, 0.9}},
      {"<difference><box><min>[0,0,0]</min><max>[1,1,1]</max></box>"
       "<sphere><origin>[0,0,0]</origin><radius>1</radius></sphere></difference>",
       {0.9, 0.9, 0.9},
       {0.5, 0.5, 0.5}},
  };
  for (const Case& c : cases) {
    const PiecePtr piece = piece_of(c.xml);
    ASSERT_NE(piece, nullptr) << c.xml;
    EXPECT_TRUE(piece->inside(c.in)) << c.xml;
    EXPECT_EQ(piece->inside(c.out), c.xml == "<null/>") << c.xml;
  }
}

TEST(GeometryReader, LabelsStandForPiecesAnywhereInTheDeck) {
  const DeckText deck(R"(
    <first><difference><box label="whole"><min>[0,0,0]</min><max>[2,1,1]</max></box>
      <box label="right"><min>[1,0,0]</min><max>[2,1,1]</max></box></difference></first>
    <second><box label="right"/></second>
    <third><union><box name="right"></box><sphere label="ball"/></union></third>
    <fourth><sphere label="ball"><origin>[9,0,0]</origin><radius>1</radius></sphere></fourth>)");
  std::vector<Fault> faults;
  const GeometryReader reader(deck.root(), faults);
  auto nth = [&](std::size_t n) {
    return reader.piece(*deck.root().children[n]->children.front(), faults);
  };
  const PiecePtr left = nth(0), right = nth(1), both = nth(2);
  ASSERT_EQ(all_faults(faults), "");
  EXPECT_TRUE(left->inside({0.5, 0.5, 0.5}));
  EXPECT_FALSE(left->inside({1.5, 0.5, 0.5}));
  EXPECT_TRUE(right->inside({1.5, 0.5, 0.5}));
  EXPECT_TRUE(both->inside({9.5, 0, 0}));  // defined further down
  EXPECT_TRUE(both->inside({1.5, 0.5, 0.5}));
}

TEST(GeometryReader, LabelFaults) {
  std::string said;
  EXPECT_EQ(piece_of("<box label=\"bx\"/><box label=\"box\"><min>[0,0,0]</min><max>[1,1,1]</max>"
                     "</box>",
                     &said),
            nullptr);
  EXPECT_THAT(said, HasSubstr("no geometry piece has the label 'bx'"));
  EXPECT_THAT(said, HasSubstr("did you mean 'box'?"));
  EXPECT_EQ(piece_of("<sphere label=\"a\"/><box label=\"a\"><min>[0,0,0]</min><max>[1,1,1]</max>"
                     "</box>",
                     &said),
            nullptr);
  EXPECT_THAT(said, HasSubstr("geometry 'a' is a <box>"));
  const std::string a = "<box label=\"a\"><min>[0,0,0]</min><max>[1,1,1]</max></box>";
  const std::string b = "<box label=\"a\"><min>[0,0,0]</min><max>[2,1,1]</max></box>";
  piece_of("<box label=\"a\"/>" + a + b, &said);
  EXPECT_THAT(said, HasSubstr("geometry label 'a' has two definitions"));
  EXPECT_NE(piece_of("<box label=\"a\"/>" + a + a, &said), nullptr);
  EXPECT_EQ(said, "");
  EXPECT_NE(piece_of(a + b, &said), nullptr);  // nobody reuses it
  EXPECT_EQ(said, "");
  piece_of("<union label=\"u\"><union label=\"u\"/></union>", &said);
  EXPECT_THAT(said, HasSubstr("nested deeper"));
}

TEST(GeometryReader, FaultsOfPiecesAreAllReported) {
  std::string said;
  EXPECT_EQ(piece_of("<union><sphere><origin>[0,0,0]</origin><radius>-1</radius></sphere>\n"
                     "<box><min>[0,0,0]</min><max>[0,1,1]</max></box></union>",
                     &said),
            nullptr);
  EXPECT_THAT(said, HasSubstr("deck.ups:2:8: error: sphere: radius is -1"));
  EXPECT_THAT(said, HasSubstr("deck.ups:3:1: error: box: min 0 is not below max 0"));
  piece_of("<difference><box><min>[0,0,0]</min><max>[1,1,1]</max></box></difference>", &said);
  EXPECT_THAT(said, HasSubstr("a difference has 1 pieces"));
  piece_of("<union/>", &said);
  EXPECT_THAT(said, HasSubstr("at least one piece"));
  piece_of("<tri><name>no_such_surface</name></tri>", &said);
  EXPECT_THAT(said, HasSubstr("'no_such_surface.pts' cannot be opened"));
  piece_of("<ellipsoid><origin>[0,0,0]</origin><rx>1</rx></ellipsoid>", &said);
  EXPECT_THAT(said, HasSubstr("give rx, ry, rz or v1, v2, v3"));
}

TEST(GeometryReader, FilesAreFoundBesideTheDeck) {
  const TemporaryFolder folder;
  std::ofstream(folder / "tet.pts") << "0 0 0\n1 0 0\n0 1 0\n0 0 1\n";
  std::ofstream(folder / "tet.tri") << "0 1 2\n0 1 3\n0 2 3\n1 2 3\n";
  std::ofstream(folder / "line.pts") << "0 0\n1 0\n0 1\n";
  std::ofstream(folder / "cloud.pts") << "0.1 0.1 0.1 5\n0.2 0.2 0.2 6\n";
  const Deck deck = read_deck_text(
      "<Uintah_specification><tri><name>tet</name></tri>"
      "<line_segment><name>line.pts</name></line_segment>"
      "<file><name>cloud.pts</name><var>p.color</var></file></Uintah_specification>",
      (folder / "deck.ups").string());
  std::vector<Fault> faults;
  const GeometryReader reader(*deck.root, faults);
  std::vector<PiecePtr> pieces;
  for (const auto& child : deck.root->children) pieces.push_back(reader.piece(*child, faults));
  ASSERT_EQ(all_faults(faults), "");
  EXPECT_TRUE(pieces[0]->inside({0.1, 0.1, 0.1}));
  EXPECT_TRUE(pieces[1]->inside({0.3, 0.3, 7}));
  ASSERT_NE(pieces[2]->points(), nullptr);
  EXPECT_EQ(pieces[2]->points()->size(), 2u);
}

TEST(GeometryReader, ObjectsCarryTheirInitialValues) {
  const DeckText deck(R"(<geom_object><box><min>[0,0,0]</min><max>[1,1,1]</max></box>
    <sphere><origin>[2,0,0]</origin><radius>0.5</radius></sphere>
    <res>[2,3,1]</res><velocity>[1,-2,0]</velocity><density>1.2</density>
    <temperature>300</temperature></geom_object>)");
  std::vector<Fault> faults;
  const GeometryReader reader(deck.root(), faults);
  const GeomObject o = reader.object(deck.first(), faults);
  ASSERT_EQ(all_faults(faults), "");
  EXPECT_EQ(o.res, (IntVec3{2, 3, 1}));
  EXPECT_EQ(o.velocity, (Vec3{1, -2, 0}));
  EXPECT_EQ(o.value("density"), 1.2);
  EXPECT_EQ(o.value("temperature"), 300);
  EXPECT_FALSE(o.has("volumeFraction"));
  EXPECT_EQ(o.value_where.at("density").line, 4);
  EXPECT_TRUE(o.piece->inside({2, 0, 0}));

  Level level;
  level.spacing = {0.5, 0.5, 0.5};
  const std::vector<std::int32_t> n = count_inside(o, level, {{0, 0, 0}, {4, 2, 2}});
  EXPECT_EQ(n[0], 6);
  EXPECT_EQ(n[1], 6);
  EXPECT_EQ(n[2], 0);
}

TEST(GeometryReader, ObjectFaults) {
  const DeckText deck("<geom_object><res>[0,1,1]</res></geom_object>");
  std::vector<Fault> faults;
  const GeometryReader reader(deck.root(), faults);
  EXPECT_EQ(reader.object(deck.first(), faults).piece, nullptr);
  EXPECT_THAT(all_faults(faults), HasSubstr("without a geometry piece"));
  EXPECT_THAT(all_faults(faults), HasSubstr("res is [0, 1, 1]"));
}

}  // namespace
}  // namespace sluice::geometry_reader_test
