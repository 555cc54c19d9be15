// What a deck says of solids beside the flags of <MPM>: files, stray tags, faults with their lines.
#include "mpm/deck/read_mpm_scene.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "framework/base/temporary_folder.hpp"
#include "mpm/test_support/flagged_deck.hpp"

namespace sluice::mpm::read_mpm_scene_test {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Not;

// Materials of one law and one MatTypeIdx are a family; those that contacts act on come first.
TEST(Grains, MaterialsThatExchangeThem) {
  SolidDeck deck = with_flags("<DoGranularMPM>true</DoGranularMPM>");
  const std::string lone = "<MatTypeIdx>2</MatTypeIdx>";
  deck.further = solid_material("wall",
                                "<allow_DWIndex_correction>false"
                                "</allow_DWIndex_correction>") +
                 solid_material("other", lone) +
                 solid_material("apart", "<applied_contact_model>false</applied_contact_model>") +
                 solid_material("slot", "<critical_density>800</critical_density>");
  deck.contacts = "<contact><type>friction</type><mu>0.3</mu></contact>";
  const ReadDeck read = read_solids(deck);
  EXPECT_FALSE(any_error(read.faults)) << read.text;
  EXPECT_THAT(read.text,
              HasSubstr("materials 0 and 4 exchange particles (DoGranularMPM) and differ "
                        "in <critical_density>"));
  ASSERT_EQ(read.solids.grains.size(), 1U);
  EXPECT_EQ(read.solids.grains[0].members, (std::vector<int>{0, 4, 3}));
  EXPECT_EQ(read.solids.grains[0].in_contact, 2U);
  ASSERT_EQ(read.solids.contacts.size(), 1U);
  EXPECT_EQ(read.solids.contacts[0].materials, (std::vector<int>{0, 1, 2, 4}));
  EXPECT_EQ(read.solids.materials[4].loosest, 1.25);
  EXPECT_DOUBLE_EQ(read.solids.materials[0].loosest, 1.0816);
  // An empty material makes particles of the form of those that may come.
  EXPECT_EQ(read.solids.materials[4].forms().size(), read.solids.materials[0].objects.size());
  EXPECT_TRUE(read.solids.materials[1].forms().empty());
}

TEST(Grains, WithoutSlotsOrTouchAreTold) {
  EXPECT_THAT(flag_faults("<DoGranularMPM>true</DoGranularMPM>"),
              HasSubstr("<DoGranularMPM> has no effect: no two materials can exchange particles"));
  EXPECT_THAT(flag_faults("<GranularMPMVcriz>1.1</GranularMPMVcriz>"),
              HasSubstr("<GranularMPMVcriz> has no effect without <DoGranularMPM> true"));
  SolidDeck deck = with_flags("<DoGranularMPM>true</DoGranularMPM>");
  deck.material = "<critical_density>1000</critical_density>";
  EXPECT_THAT(read_solids(deck).text,
              HasSubstr("<critical_density> 1000 is not below <density> 1000"));
}

TEST(Contacts, OfASingleFieldShareOneVelocity) {
  SolidDeck deck = with_contact("<type>friction</type><mu>0.3</mu>");
  std::string text = text_of(deck);
  const std::string type = "type='mpm'";
  text.replace(text.find(type), type.size(), "type='sfmpm'");
  ReadDeck read;
  read.deck = load_deck_text(text, "solids.ups", {}, solid_schema());
  finish_reading(read);
  EXPECT_THAT(read.text,
              HasSubstr("<contact> friction_bard has no effect: all materials of sfmpm"));
  ASSERT_EQ(read.solids.contacts.size(), 1U);
  EXPECT_EQ(read.solids.contacts[0].kind, ContactKind::single_velocity);
  EXPECT_TRUE(read.solids.contacts[0].materials.empty());
}

TEST(Blocks, OfFluidsAreDroppedWithTheirLine) {
  SolidDeck deck;
  deck.blocks = "<CFD><cfl>0.4</cfl><nonsense/></CFD>";
  EXPECT_THAT(read_solids(deck).text, AllOf(HasSubstr("solids.ups:8:"),
                                            HasSubstr("<CFD> in <Uintah_specification> has no "
                                                      "effect; dropped"),
                                            Not(HasSubstr("error"))));
}

TEST(Materials, BadOnesAreErrorsWithTheirLine) {
  const auto faults = [](const std::string& from, const std::string& to) {
    std::string text = text_of({});
    text.replace(text.find(from), from.size(), to);
    ReadDeck read;
    read.deck = load_deck_text(text, "solids.ups", {}, solid_schema());
    finish_reading(read);
    return read.text;
  };
  EXPECT_THAT(faults("<density>1000", "<density>-1"),
              AllOf(HasSubstr("solids.ups:10:"), HasSubstr("'-1' is out of range")));
  EXPECT_THAT(faults("<specific_heat>5</specific_heat>", ""), HasSubstr("needs <specific_heat>"));
  EXPECT_THAT(faults("[2,2,2]", "[2,0,2]"), HasSubstr("'[2,0,2]' is out of range"));
  EXPECT_THAT(faults("<temperature>300</temperature>", "<temprature>300</temprature>"),
              HasSubstr("did you mean 'temperature'?"));
  SolidDeck deck;
  deck.material = "<activation_time>2</activation_time><deactivation_time>1</deactivation_time>";
  EXPECT_THAT(read_solids(deck).text, AllOf(HasSubstr("is not after <activation_time> 2"),
                                            HasSubstr("add <is_active>false</is_active>")));
  deck.material = "";
  deck.objects = "";
  EXPECT_THAT(read_solids(deck).text, HasSubstr("no material has a <geom_object>"));
}

TEST(Materials, StrayStateAndConstantsAreToldAndDropped) {
  SolidDeck deck;
  deck.material = "<D1>0.1</D1><gamma>1.4</gamma>";
  deck.objects.insert(deck.objects.find("<res>"),
                      "<density>5</density><pressure>1</pressure><concentration>0</concentration>");
  const ReadDeck read = read_solids(deck);
  EXPECT_FALSE(any_error(read.faults)) << read.text;
  for (const char* told :
       {"<D1> is obsolete", "<gamma> is obsolete", "<density> in <geom_object> has no effect",
        "<pressure> in", "<concentration> in <geom_object> has no effect"})
    EXPECT_THAT(read.text, HasSubstr(told));
}

// Two flow models call their yield stress <sigma_0>: neither takes it from the other.
TEST(Materials, TakeTheYieldStressByTheNameOfTheirFlowModel) {
  const auto metal = [](const std::string& flow) {
    SolidDeck deck;
    deck.further =
        "<material><density>8930</density><constitutive_model type='elastic_plastic'>"
        "<bulk_modulus>136e9</bulk_modulus><shear_modulus>46e9</shear_modulus>" +
        flow +
        "</constitutive_model><thermal_conductivity>1</thermal_conductivity>"
        "<specific_heat>5</specific_heat></material>";
    return read_solids(deck).text;
  };
  const std::string copper =
      "<flow_model type='steinberg_cochran_guinan'><mu_0>47.7e9</mu_0><sigma_0>1e8</sigma_0>"
      "<Y_max>6.4e8</Y_max><beta>36</beta><n>.45</n></flow_model>";
  EXPECT_EQ(metal(copper), "");
  for (const char* name : {"sigma_0", "sigma_Y"})
    EXPECT_EQ(metal(fmt::format("<flow_model type='isotropic_hardening'><{0}>1e8</{0}><K>0</K>"
                                "</flow_model>",
                                name)),
              "");
  EXPECT_THAT(metal("<flow_model type='isotropic_hardening'><K>0</K></flow_model>"),
              HasSubstr("<sigma_Y> is needed"));
}

TEST(CohesiveZones, BadPointsAreErrorsWithTheirLine) {
  const TemporaryFolder folder;
  const auto told = [&](const std::string& row, const std::string& more = {}) {
    const std::filesystem::path file = folder.path() / "points.txt";
    std::ofstream(file) << "0.4 0.4 0.4 1 1 0 0 0 1 0 0 1\n" << row << '\n';
    SolidDeck deck;
    deck.flags = "<use_cohesive_zones>true</use_cohesive_zones>";
    deck.further = solid_material("other", "");
    deck.contacts = "<cohesive_zone><cz_filename>" + file.string() +
                    "</cz_filename><sig_max>1</sig_max><tau_max>1</tau_max><delta_n>1</delta_n>"
                    "<delta_t>1</delta_t>" +
                    more + "</cohesive_zone>";
    return read_solids(deck).text;
  };
  EXPECT_EQ(told("0.5 0.5 0.5 1 0 1 0 1 0 0 1 0"), "");
  EXPECT_THAT(told("0.5 0.5 0.5 0 0 1 0 1 0 0 1 0"), HasSubstr("points.txt:2:13: area 0"));
  EXPECT_THAT(told("0.5 0.5 0.5 1 0 1 0 0 2 0 1 0"), HasSubstr("parallel"));
  EXPECT_THAT(told("0.5 0.5 0.5 1 0 1 0 1 0 0 1 2"), HasSubstr("there is no material 2"));
  EXPECT_THAT(told("0.5 0.5 0.5 1 0 1 0 1 0 0 1 1"), HasSubstr("connects two materials"));
  EXPECT_THAT(told("0.5 0.5 0.5 1 0 1 0 1 0 0 1 0", "<do_rotation>true</do_rotation>"),
              HasSubstr("<do_rotation> true"));
}

TEST(Contacts, HaveTheFormatsNames) {
  const std::pair<const char*, ContactKind> kinds[] = {
      {"single_velocity", ContactKind::single_velocity},
      {"friction", ContactKind::friction},
      {"friction_bard", ContactKind::friction},
      {"friction_LR", ContactKind::friction},
      {"approach", ContactKind::friction},
      {"specified", ContactKind::specified},
      {"rigid", ContactKind::specified},
      {"specified_velocity", ContactKind::specified},
      {"specified_friction", ContactKind::specified_friction}};
  for (const auto& [name, kind] : kinds) {
    const ReadDeck read = read_solids(
        with_contact(fmt::format("<type>{}</type><materials>[0,1]</materials><mu>0.3</mu>", name)));
    ASSERT_EQ(read.solids.contacts.size(), 1u) << name << read.text;
    const ContactRule& rule = read.solids.contacts[0];
    EXPECT_EQ(rule.kind, kind) << name;
    EXPECT_THAT(rule.materials, ElementsAre(0, 1));
    EXPECT_EQ(rule.friction, 0.3);
    const bool by_master =
        kind == ContactKind::specified || kind == ContactKind::specified_friction;
    EXPECT_EQ(rule.applied_before_and_after_integration, !by_master) << name;
  }
  EXPECT_TRUE(read_solids(with_contact("<type>null</type>")).solids.contacts.empty());
}

TEST(Contacts, BadOnesAreErrors) {
  EXPECT_THAT(read_solids(with_contact("<type>friction_bard</type>")).text,
              HasSubstr("<contact> friction_bard needs <mu>"));
  const ReadDeck unknown =
      read_solids(with_contact("<type>single_velocity</type><materials>[0,1,2]</materials>"));
  EXPECT_THAT(unknown.text,
              HasSubstr("warning: <materials>: there is no material 2: the deck has 2, counted"));
  EXPECT_THAT(unknown.solids.contacts.at(0).materials, ElementsAre(0, 1));
  EXPECT_THAT(read_solids(with_contact("<type>frction_bard</type>")).text,
              HasSubstr("did you mean 'friction_bard'?"));
  EXPECT_THAT(read_solids(with_contact("<type>fluid</type>")).text,
              HasSubstr("'fluid' is known to the format, but not supported yet"));
  EXPECT_THAT(read_solids(with_contact("<type>rigid</type><filename>none.txt</filename>")).text,
              HasSubstr("there is no file 'none.txt'"));
}

TEST(Contacts, ProfilesAreReadBesideTheDeck) {
  const TemporaryFolder folder;
  std::ofstream(folder / "profile.txt") << "0 1 0 0\n0.5 2 0 0\n";
  std::ofstream(folder / "back.txt") << "0 1 0 0\n0 2 0 0\n";
  const std::string deck = (folder / "deck.ups").string();
  const ReadDeck read =
      read_solids(with_contact("<type>specified</type><filename>inputs/MPM/profile.txt</filename>"
                               "<stop_time>0.7</stop_time><direction>[1,1,0]</direction>"),
                  deck);
  EXPECT_THAT(read.text, AllOf(HasSubstr("warning: 'inputs/MPM/profile.txt' does not exist"),
                               Not(HasSubstr("error"))));
  ASSERT_EQ(read.solids.contacts.size(), 1u);
  const ContactRule& rule = read.solids.contacts[0];
  ASSERT_EQ(rule.profile.size(), 2u);
  EXPECT_EQ(rule.profile[1][1], 2);
  EXPECT_EQ(rule.stop_time, 0.7);
  EXPECT_EQ(rule.directions, (IntVec3{1, 1, 0}));
  EXPECT_THAT(
      read_solids(with_contact("<type>specified</type><filename>back.txt</filename>"), deck).text,
      HasSubstr("back.txt:2:1: time 0 is not after the one before, 0"));
}

SolidDeck with_load(const std::string& load, const std::string& piece) {
  SolidDeck deck = with_flags("<use_load_curves>true</use_load_curves>");
  deck.blocks = fmt::format(
      "<PhysicalBC><MPM><{0}><geom_object>{1}</geom_object><load_curve><id>1</id>"
      "<time_point><time>0</time><load>0</load></time_point>"
      "<time_point><time>1</time><load>5</load></time_point></load_curve></{0}></MPM></PhysicalBC>",
      load, piece);
  return deck;
}

TEST(Loads, FollowTheirCurves) {
  const std::string box = "<box><min>[0.2,0.2,0.2]</min><max>[0.21,0.6,0.6]</max></box>";
  const ReadDeck read = read_solids(with_load("pressure", box));
  ASSERT_EQ(read.text, "");
  ASSERT_EQ(read.solids.loads.size(), 1u);
  EXPECT_EQ(read.solids.loads[0].shape, "box");
  EXPECT_EQ(read.solids.loads[0].points.back(), std::pair(1.0, 5.0));
  EXPECT_FALSE(read.solids.loads[0].material);
  EXPECT_THAT(read_solids(with_load("torque", box)).text,
              HasSubstr("<torque> acts on a surface of <cylinder>, not of <box>"));
  SolidDeck unused = with_load("pressure", box);
  unused.flags = "";
  EXPECT_THAT(read_solids(unused).text, HasSubstr("<PhysicalBC> has no effect"));
  EXPECT_TRUE(read_solids(unused).solids.loads.empty());
  SolidDeck backwards = with_load("pressure", box);
  backwards.blocks.replace(backwards.blocks.find("<time>1"), 7, "<time>0");
  EXPECT_THAT(read_solids(backwards).text, HasSubstr("time 0 is not after the one before, 0"));
}

std::string faces_but(const std::string& side, const std::string& conditions) {
  std::string faces;
  for (const char* other : {"x-", "x+", "y-", "y+", "z-", "z+"})
    if (side != other)
      faces += fmt::format(
          "<Face side='{}'><BCType id='all' label='Symmetric' var='symmetry'/>"
          "</Face>\n",
          other);
  return faces + conditions;
}

TEST(Faces, WithoutConditionsLetParticlesOutWithOneWarning) {
  SolidDeck deck;
  const std::string told = "warning: side x+ without conditions: particles leave through it";
  deck.faces = faces_but("x+", "");
  EXPECT_THAT(read_solids(deck).text, HasSubstr(told));
  EXPECT_TRUE(read_solids(deck).solids.boundaries.size() == 5);
  deck.faces = faces_but("x+", "<Face side='x+'/>");
  EXPECT_THAT(read_solids(deck).text, HasSubstr(told));
  deck.faces = "<Face side='y+'/>";
  EXPECT_THAT(read_solids(deck).text, HasSubstr("sides x-, x+, y-, y+, z-, z+ without"));
  deck.faces = faces_but("x+", "");
  deck.level = "<periodic>[1,0,0]</periodic>";
  deck.faces = faces_but("x+", "");
  EXPECT_THAT(read_solids(deck).text, Not(HasSubstr("error")));
}

TEST(Faces, GiveSolidsTheirConditions) {
  SolidDeck deck;
  deck.faces = faces_but(
      "x+",
      "<Face side='x+'><BCType id='0' label='Velocity' var='Dirichlet'><value>[1,0,0]</value>"
      "</BCType><BCType id='all' label='Temperature' var='Dirichlet'><value>5</value></BCType>"
      "</Face>");
  const ReadDeck read = read_solids(deck);
  ASSERT_EQ(read.text, "");
  ASSERT_EQ(read.solids.boundaries.size(), 7u);
  std::vector<SolidBoundary> of_side;
  for (const SolidBoundary& b : read.solids.boundaries)
    if (b.side == Side::x_plus) of_side.push_back(b);
  ASSERT_EQ(of_side.size(), 2u);
  EXPECT_EQ(of_side[0].kind, SolidBoundary::Kind::velocity);
  EXPECT_EQ(of_side[0].material, 0);
  EXPECT_EQ(of_side[0].value, (Vec3{1, 0, 0}));
  EXPECT_EQ(of_side[1].kind, SolidBoundary::Kind::temperature);
  EXPECT_EQ(of_side[1].material, -1);
  EXPECT_EQ(of_side[1].value.x, 5);
}

TEST(Splitting, NeedsACriterion) {
  EXPECT_THAT(flag_faults("<refine_particles>true</refine_particles>"),
              HasSubstr("<refine_particles> needs a criterion"));
}

}  // namespace
}  // namespace sluice::mpm::read_mpm_scene_test
