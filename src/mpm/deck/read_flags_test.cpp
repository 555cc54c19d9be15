// What <MPM> says of the method: defaults, names, transfers, contradictions.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "mpm/deck/read_mpm_scene.hpp"
#include "mpm/test_support/flagged_deck.hpp"

namespace sluice::mpm::read_flags_test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

// Where the deck leaves it to Sluice: midpoint for particles with a width and splines.
TEST(Flags, ChooseTheTransferThatKeepsVibrationAndSpin) {
  const auto read = [](const std::string& flags) { return read_solids(with_flags(flags)).solids; };
  for (const char* basis : {"gimp", "cpgimp", "3rdorderBS", "4thorderBS", "cpdi", "fast_cpdi",
                            "cpti", "carried_corners"}) {
    const std::string flags = fmt::format("<interpolator>{}</interpolator>", basis);
    EXPECT_EQ(read(flags).transfer, Transfer::midpoint) << basis;
    EXPECT_EQ(read(flags + "<musl>false</musl>").transfer, Transfer::flip) << basis;
    EXPECT_FALSE(read(flags + "<musl>false</musl>").maps_back()) << basis;
    EXPECT_EQ(read(flags + "<transfer>flip</transfer>").transfer, Transfer::flip) << basis;
    EXPECT_EQ(read(flags + "<XPIC2>true</XPIC2>").transfer, Transfer::xpic) << basis;
    EXPECT_EQ(read(flags + "<total_lagrangian>true</total_lagrangian>").transfer, Transfer::flip);
  }
  const std::string gimp = "<interpolator>gimp</interpolator>";
  const MpmScene plain = read(gimp + "<musl>true</musl>");
  EXPECT_EQ(plain.transfer, Transfer::flip);
  EXPECT_TRUE(plain.maps_back());
  EXPECT_EQ(read("").transfer, Transfer::flip);
  EXPECT_TRUE(read("").maps_back());
  EXPECT_FALSE(read("<musl>false</musl>").maps_back());
}

TEST(Flags, HaveTheDefaultsOfTheFormat) {
  const ReadDeck read = read_solids({});
  ASSERT_EQ(read.text, "");
  const MpmScene& s = read.solids;
  EXPECT_EQ(s.basis, Basis::linear);
  EXPECT_EQ(s.transfer, Transfer::flip);
  EXPECT_TRUE(s.musl);
  EXPECT_TRUE(s.heat_conduction);
  EXPECT_FALSE(s.artificial_viscosity);
  EXPECT_FALSE(s.viscosity_heats);
  EXPECT_EQ(s.viscosity_1, 0.2);
  EXPECT_EQ(s.viscosity_2, 2.0);
  EXPECT_EQ(s.subcycles_of_F, 1);
  EXPECT_EQ(s.min_particle_mass, 3e-15);
  EXPECT_TRUE(s.contacts.empty());
  ASSERT_EQ(s.materials.size(), 1u);
  EXPECT_EQ(s.materials[0].name, "block");
  EXPECT_EQ(s.materials[0].constants.density, 1000);
  EXPECT_EQ(s.materials[0].constants.room_temperature, 294);
  EXPECT_EQ(s.materials[0].specific_heat_p, 5);
  EXPECT_EQ(s.materials[0].deactivation_time, 1e8);
}

TEST(Flags, NameBasesAndTransfers) {
  const std::pair<const char*, Basis> bases[] = {
      {"linear", Basis::linear},          {"gimp", Basis::gimp},
      {"cpgimp", Basis::cpgimp},          {"cpdi", Basis::cpdi},
      {"fast_cpdi", Basis::fast_cpdi},    {"cpti", Basis::cpti},
      {"3rdorderBS", Basis::quadratic},   {"quadraticBS", Basis::quadratic},
      {"4thorderBS", Basis::cubic},       {"cubicBS", Basis::cubic},
      {"carried_corners", Basis::carried}};
  for (const auto& [name, basis] : bases) {
    const ReadDeck read =
        read_solids(with_flags(fmt::format("<interpolator>{}</interpolator>", name)));
    EXPECT_EQ(read.text, "") << name;
    EXPECT_EQ(read.solids.basis, basis) << name;
  }
  const char* apic = "<interpolator>quadraticBS</interpolator><transfer>apic</transfer>";
  EXPECT_EQ(read_solids(with_flags(apic)).solids.transfer, Transfer::apic);
  const MpmScene xpic = read_solids(with_flags("<XPIC2>true</XPIC2>")).solids;
  EXPECT_EQ(xpic.transfer, Transfer::xpic);
  EXPECT_TRUE(xpic.xpic2_of_format);
  const MpmScene enhanced = read_solids(with_flags("<UseGradientEnhancedVelocityProjection>true"
                                                   "</UseGradientEnhancedVelocityProjection>"))
                                .solids;
  EXPECT_EQ(enhanced.transfer, Transfer::affine);
  EXPECT_EQ(enhanced.affine_damping, 0);
}

TEST(Flags, MisspeltOrObsoleteOnesAreToldAndRead) {
  const ReadDeck read = read_solids(
      with_flags("<UseMomentumForm>false</UseMomentumForm><interpolator>cpid</interpolator>"
                 "<maximum_particle_velocity>1e5</maximum_particle_velocity>"
                 "<dynamic>true</dynamic>"));
  EXPECT_FALSE(any_error(read.faults)) << read.text;
  EXPECT_EQ(read.solids.basis, Basis::cpdi);
  for (const char* told : {"<UseMomentumForm> is obsolete", "'cpid' is obsolete",
                           "<maximum_particle_velocity> in <MPM> has no effect; dropped",
                           "<dynamic> in <MPM> has no effect; dropped"})
    EXPECT_THAT(read.text, HasSubstr(told));
  EXPECT_THAT(flag_faults("<interpolater>gimp</interpolater>"),
              HasSubstr("did you mean 'interpolator'?"));
}

TEST(Flags, OfOtherMethodsAreRefusedByName) {
  EXPECT_THAT(flag_faults("<time_integrator>implicit</time_integrator><XPIC2>true</XPIC2>"),
              HasSubstr("<XPIC2> true with implicit steps is known to the format"));
  EXPECT_THAT(flag_faults("<coupled_flow_analysis>true</coupled_flow_analysis>"),
              HasSubstr("water moves through pores only in the component shmpm"));
  EXPECT_THAT(flag_faults("<DoGranularMPM>true</DoGranularMPM><use_cohesive_zones>true"
                          "</use_cohesive_zones>"),
              HasSubstr("<DoGranularMPM> true with <use_cohesive_zones> is known to the format"));
  EXPECT_EQ(flag_faults("<DoGranularMPM>false</DoGranularMPM>"), "");
}

TEST(Flags, ThatContradictEachOtherAreFaults) {
  EXPECT_THAT(flag_faults("<XPIC2>true</XPIC2><transfer>pic</transfer>"),
              HasSubstr("both select the transfer of velocities"));
  EXPECT_THAT(flag_faults("<artificial_viscosity_heating>true</artificial_viscosity_heating>"),
              HasSubstr("<artificial_viscosity_heating> without <artificial_viscosity>"));
  EXPECT_THAT(flag_faults("<minimum_subcycles_for_F>0</minimum_subcycles_for_F>"),
              HasSubstr("particles would never be deformed"));
  EXPECT_THAT(flag_faults("<axisymmetric>true</axisymmetric>"),
              HasSubstr("needs one cell along z, the angle; the box at solids.ups:"));
  EXPECT_THAT(flag_faults("<affine_damping>0.5</affine_damping>"),
              AllOf(HasSubstr("warning"), HasSubstr("no effect without <transfer> affine")));
  EXPECT_THAT(flag_faults("<boundary_traction_faces>[xminus,zplas]</boundary_traction_faces>"),
              HasSubstr("'zplas' is not a face (did you mean 'zplus'?)"));
}

// The deck of an archive has all defaults written: none of them is a fault.
TEST(Flags, WrittenWithTheirDefaultsAreNoFaults) {
  for (const char* flag :
       {"<UseGradientEnhancedVelocityProjection>true</UseGradientEnhancedVelocityProjection>",
        "<XPIC2>true</XPIC2>", "<interpolator>gimp</interpolator>"}) {
    SolidDeck deck = with_contact("<type>specified</type><master_material>0</master_material>");
    deck.flags = flag;
    const ReadDeck first = read_solids(deck);
    ASSERT_TRUE(first.deck.good()) << first.text;
    ReadDeck again;
    again.deck = load_deck_text(to_xml(*first.deck.root), "solids.ups", {}, solid_schema());
    finish_reading(again);
    EXPECT_EQ(again.faults.size(), first.faults.size()) << again.text;
    EXPECT_EQ(again.solids.transfer, first.solids.transfer);
    EXPECT_EQ(again.solids.basis, first.solids.basis);
  }
}

}  // namespace
}  // namespace sluice::mpm::read_flags_test
