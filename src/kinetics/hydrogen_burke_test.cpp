// The mechanism of hydrogen against the file of it in the collection of decks, number by number.
#include "kinetics/hydrogen_burke.hpp"

#include <gtest/gtest.h>

#include "framework/base/test_support/environment.hpp"
#include "kinetics/read_mechanism.hpp"

namespace sluice::kinetics::hydrogen_burke_test {
namespace {

void expect_same(const Arrhenius& one, const Arrhenius& other) {
  EXPECT_DOUBLE_EQ(one.A, other.A);
  EXPECT_EQ(one.b, other.b);
  EXPECT_EQ(one.E, other.E);
}

void expect_same(const std::vector<Participant>& one, const std::vector<Participant>& other) {
  ASSERT_EQ(one.size(), other.size());
  for (std::size_t n = 0; n < one.size(); ++n) {
    EXPECT_EQ(one[n].species, other[n].species);
    EXPECT_EQ(one[n].count, other[n].count);
  }
}

void expect_same(const Species& one, const Species& other) {
  EXPECT_EQ(one.name, other.name);
  EXPECT_EQ(one.atoms, other.atoms);
  EXPECT_EQ(one.molar_mass, other.molar_mass);
  EXPECT_EQ(one.thermo.T_low, other.thermo.T_low);
  EXPECT_EQ(one.thermo.T_mid, other.thermo.T_mid);
  EXPECT_EQ(one.thermo.T_high, other.thermo.T_high);
  EXPECT_EQ(one.thermo.low, other.thermo.low);
  EXPECT_EQ(one.thermo.high, other.thermo.high);
  EXPECT_EQ(one.viscosity, other.viscosity);
  EXPECT_EQ(one.conductivity, other.conductivity);
}

void expect_same(const Reaction& one, const Reaction& other) {
  EXPECT_EQ(one.equation, other.equation);
  EXPECT_EQ(one.reversible, other.reversible);
  EXPECT_EQ(one.third_body, other.third_body);
  EXPECT_EQ(one.efficiency, other.efficiency);
  expect_same(one.reactants, other.reactants);
  expect_same(one.products, other.products);
  expect_same(one.rate, other.rate);
  ASSERT_EQ(one.falloff.has_value(), other.falloff.has_value());
  if (!one.falloff) return;
  expect_same(one.falloff->low, other.falloff->low);
  EXPECT_EQ(one.falloff->troe, other.falloff->troe);
  EXPECT_EQ(one.falloff->a, other.falloff->a);
  EXPECT_EQ(one.falloff->T3, other.falloff->T3);
  EXPECT_EQ(one.falloff->T1, other.falloff->T1);
  EXPECT_EQ(one.falloff->T2, other.falloff->T2);
}

TEST(HydrogenBurke, IsTheMechanismOfTheFile) {
  const auto decks = folder_in_environment("SLUICE_DECKS");
  if (!decks) GTEST_SKIP() << "SLUICE_DECKS is not set: no collection of decks";
  const Mechanism file =
      read_mechanism((*decks / "inputs/ICE/RX_MODELS/Burke2012Modified.xml").string());
  const Mechanism& ours = burke_hydrogen();
  EXPECT_EQ(ours.elements, file.elements);
  EXPECT_EQ(ours.diffusion, file.diffusion);
  ASSERT_EQ(ours.species.size(), file.species.size());
  for (std::size_t k = 0; k < ours.species.size(); ++k)
    expect_same(ours.species[k], file.species[k]);
  ASSERT_EQ(ours.reactions.size(), file.reactions.size());
  for (std::size_t r = 0; r < ours.reactions.size(); ++r) {
    SCOPED_TRACE(ours.reactions[r].equation);
    expect_same(ours.reactions[r], file.reactions[r]);
  }
}

TEST(HydrogenBurke, HasTheSizeOfThePublishedSet) {
  EXPECT_EQ(burke_hydrogen().species.size(), 9u);
  EXPECT_EQ(burke_hydrogen().reactions.size(), 23u);
  EXPECT_EQ(burke_hydrogen().diffusion.size(), 81u);
}

}  // namespace
}  // namespace sluice::kinetics::hydrogen_burke_test
