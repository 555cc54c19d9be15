// Reading mechanisms: units, forms of reactions, and what is refused with its place.
#include "kinetics/read_mechanism.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "framework/base/error.hpp"
#include "framework/base/test_support/environment.hpp"
#include "kinetics/species_gas.hpp"

namespace sluice::kinetics::read_mechanism_test {
namespace {

using ::testing::HasSubstr;

const std::string thermo =
    "<thermo><NASA7 Tmin='200' Tmax='1000'><floatArray>2.5, 0, 0, 0, 0, 1, 2</floatArray></NASA7>"
    "<NASA7 Tmin='1000' Tmax='3000'><floatArray>2.5 0 0 0 0 1 2</floatArray></NASA7></thermo>";

// Lines 1 to 9; the reactions begin in line 8.
std::string text(const std::string& reactions, const std::string& atoms = "O:2") {
  return "<mechanism name='small'>\n"
         "<units length='cm' quantity='mol' activation-energy='cal/mol'/>\n"
         "<phase><elementArray>O Zz</elementArray><speciesArray>O O2</speciesArray></phase>\n"
         "<speciesData>\n"
         "<species name='O2'><atomArray>" +
         atoms + "</atomArray>" + thermo +
         "</species>\n"
         "<species name='O'><atomArray>O:1</atomArray>" +
         thermo +
         "</species>\n"
         "</speciesData><reactionData>\n" +
         reactions + "\n</reactionData></mechanism>";
}

std::string reaction(
    const std::string& type, const std::string& rate,
    const std::string& sides = "<reactants>O:2</reactants><products>O2:1</products>") {
  return "<reaction reversible='yes' type='" + type + "'><equation>e</equation>" + sides +
         "<rateCoeff>" + rate + "</rateCoeff></reaction>";
}

std::string law(const std::string& name = "", const std::string& A = "2e6") {
  return "<Arrhenius name='" + name + "'><A>" + A + "</A><b>.5</b><E>1000</E></Arrhenius>";
}

Mechanism read(const std::string& xml) {
  const std::string folder = testing::TempDir() + "mechanisms_" + std::to_string(::getpid());
  std::filesystem::create_directories(folder);
  std::ofstream(folder + "/m.xml") << xml;
  return read_mechanism(folder + "/m.xml");
}

std::string refusal(const std::string& xml) {
  try {
    read(xml);
  } catch (const InputError& error) {
    return error.what();
  }
  return "nothing was refused";
}

TEST(ReadMechanism, GivesSiUnitsAndTheOrderOfThePhase) {
  const Mechanism m =
      read(text(reaction("elementary", law()) + reaction("three-body", law()) +
                reaction("falloff", law("k0") + law("kInf") + "<falloff type='Lindemann'/>")));
  EXPECT_EQ(m.species[0].name, "O");
  EXPECT_DOUBLE_EQ(m.species[1].molar_mass, 31.998e-3);
  ASSERT_EQ(m.reactions.size(), 3u);
  EXPECT_DOUBLE_EQ(m.reactions[0].rate.A, 2);
  EXPECT_DOUBLE_EQ(m.reactions[0].rate.E, 4184);
  EXPECT_DOUBLE_EQ(m.reactions[1].rate.A, 2e-6);
  EXPECT_DOUBLE_EQ(m.reactions[2].rate.A, 2);
  EXPECT_DOUBLE_EQ(m.reactions[2].falloff->low.A, 2e-6);
  EXPECT_EQ(m.reactions[1].efficiency, (std::vector<double>{1, 1}));
}

TEST(ReadMechanism, NamesThePlaceOfWhatItRefuses) {
  EXPECT_THAT(refusal(text(reaction("plog", law()))),
              HasSubstr("m.xml:8:1: a reaction of type 'plog'"));
  EXPECT_THAT(refusal(text(reaction("falloff", law("k0") + law("kInf") + "<falloff type='SRI'/>"))),
              HasSubstr("m.xml:8"));
  EXPECT_THAT(refusal(text(reaction("elementary", law("", "1e")))), HasSubstr("m.xml:8"));
  EXPECT_THAT(refusal(text(reaction("elementary", law("", "-1")))), HasSubstr("must be positive"));
  EXPECT_THAT(refusal(text(reaction("elementary", law(),
                                    "<reactants>O3:1</reactants><products>O2:1</products>"))),
              HasSubstr("no species 'O3'"));
  EXPECT_THAT(refusal(text(reaction("elementary", law(),
                                    "<reactants>O:1</reactants><products>O2:1</products>"))),
              HasSubstr("makes or destroys atoms"));
  EXPECT_THAT(refusal(text("", "Zz:1")), HasSubstr("m.xml:5:20: the mass of element 'Zz'"));
  EXPECT_THAT(refusal("<mechanism>\n<phase>\n"), HasSubstr("m.xml:"));
  EXPECT_THAT(refusal("<other/>"), HasSubstr("not <mechanism>"));
}

TEST(ReadMechanism, RefusesAFileThatIsNotThere) {
  EXPECT_THROW(read_mechanism("/no/such/folder/mechanism.xml"), InputError);
}

TEST(ReadMechanism, ReadsTheFilesOfTheCollection) {
  const auto decks = folder_in_environment("SLUICE_DECKS");
  if (!decks) GTEST_SKIP() << "SLUICE_DECKS is not set: no collection of decks";
  const std::map<std::string, std::pair<std::size_t, std::size_t>> sizes = {
      {"Burke2012Modified", {9, 23}},
      {"h2o2", {10, 29}},
      {"air", {8, 8}},
      {"gri30", {53, 325}},
      {"gri30_highT", {53, 325}}};
  for (const auto& [name, size] : sizes) {
    const Mechanism m =
        read_mechanism((*decks / "inputs/ICE/RX_MODELS" / (name + ".xml")).string());
    EXPECT_EQ(m.species.size(), size.first) << name;
    EXPECT_EQ(m.reactions.size(), size.second) << name;
    EXPECT_EQ(m.diffusion.size(), size.first * size.first) << name;
    if (name == "gri30") {
      EXPECT_THROW(SpeciesGas(m, 0), InputError);
    }
  }
}

}  // namespace
}  // namespace sluice::kinetics::read_mechanism_test
