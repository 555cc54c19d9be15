// Each effect of solids with each basis and transfer: bodies that move uniformly go on so, and keep
// their momentum and energy.
#include <gtest/gtest.h>

#include <cmath>

#include "mpm/deck/bases.hpp"
#include "mpm/test_support/text_run.hpp"

namespace sluice::mpm::every_effect_test {
namespace {

constexpr double allowed =
    2e-13;  // of velocities (over 4 m/s) and energies; measured: at most 1.6e-13
constexpr int steps = 3;

struct Effect {
  const char* name;
  const char* flags;     // in <MPM>
  const char* material;  // further tags of both materials
  const char* contact;   // between the two bodies, which touch; empty: there is one
};

const Effect effects[] = {
    {"Plain", "", "", ""},
    {"ArtificialViscosity", "<artificial_viscosity>true</artificial_viscosity>", "", ""},
    {"PressureStabilization", "<DoPressureStabilization>true</DoPressureStabilization>", "", ""},
    {"SubcyclesOfF", "<minimum_subcycles_for_F>3</minimum_subcycles_for_F>", "", ""},
    {"NoHeatConduction", "<DoExplicitHeatConduction>false</DoExplicitHeatConduction>", "", ""},
    {"Damage", "",
     "<damage_model type='Threshold'><failure_mean>1e9</failure_mean>"
     "<failure_distrib>constant</failure_distrib>"
     "<failure_criteria>MaximumPrincipalStress</failure_criteria></damage_model>"
     "<erosion algorithm='ZeroStress'/>",
     ""},
    {"ScalarDiffusion", "<do_scalar_diffusion>true</do_scalar_diffusion>",
     "<diffusion_model type='jg'><diffusivity>0.1</diffusivity></diffusion_model>", ""},
    {"SingleVelocity", "", "", "<type>single_velocity</type><materials>[0,1]</materials>"},
    {"Friction", "", "", "<type>friction_bard</type><materials>[0,1]</materials><mu>0.3</mu>"},
    {"Approach", "", "", "<type>approach</type><materials>[0,1]</materials><mu>0.3</mu>"},
};

const char* const transfers[] = {"flip", "pic", "xpic", "apic", "affine", "midpoint"};

std::string body(double from, double to) {
  return fmt::format(
      "<geom_object><box><min>[{0},0.25,0.25]</min><max>[{1},0.5,0.5]</max></box>"
      "<res>[2,2,2]</res><velocity>[1,2,-3]</velocity><temperature>300</temperature>"
      "</geom_object>",
      from, to);
}

SolidDeck deck_of(const Effect& effect, const BasisRow& basis, const char* transfer) {
  SolidDeck deck;
  deck.cells = "[8,8,8]";
  deck.flags = fmt::format("<interpolator>{}</interpolator><transfer>{}</transfer>{}", basis.word,
                           transfer, effect.flags);
  deck.objects = body(0.25, 0.5);
  deck.material = effect.material;
  if (effect.contact[0] != '\0') {
    deck.further = solid_material("other", effect.material + body(0.5, 0.75));
    deck.contacts = std::string("<contact>") + effect.contact + "</contact>\n";
  }
  return deck;
}

// The particles of a material all have the velocity of the start.
void expect_uniform(const TextRun& run, int material) {
  const auto v = run.particles("p.velocity", material);
  const double expected[] = {1, 2, -3};
  ASSERT_EQ(v.size(), 3U);
  for (std::size_t d = 0; d < 3; ++d)
    for (const double u : v[d]) EXPECT_NEAR(u, expected[d], allowed * 4);
}

class EveryEffectOf : public testing::TestWithParam<BasisRow> {};

TEST_P(EveryEffectOf, MovesUniformlyWithEachTransferAndEffect) {
  for (const char* transfer : transfers)
    for (const Effect& effect : effects) {
      SCOPED_TRACE(fmt::format("{} {}", transfer, effect.name));
      const SolidDeck deck = deck_of(effect, GetParam(), transfer);
      const ReadDeck read = read_solids(deck);
      const bool no_form = (std::string(transfer) == "apic" && !GetParam().one_second_moment) ||
                           (std::string(transfer) == "midpoint" && GetParam().points);
      EXPECT_EQ(any_error(read.faults), no_form) << read.text;
      if (any_error(read.faults)) continue;
      const TextRun run(
          deck,
          {{"<maxTime>1</maxTime>",
            fmt::format("<maxTime>1</maxTime><max_Timesteps>{}</max_Timesteps>", steps)},
           {"<outputInterval>0</outputInterval>",
            saves({"p.velocity", "KineticEnergy", "StrainEnergy", "TotalMomentum"})}},
          "every_effect");
      expect_uniform(run, 0);
      if (effect.contact[0] != '\0') expect_uniform(run, 1);
      const auto kinetic = run.history("KineticEnergy"), momentum = run.history("TotalMomentum");
      ASSERT_GE(kinetic.size(), 2U);
      const double K = kinetic.front()[1];
      EXPECT_NEAR(kinetic.back()[1], K, allowed * K);
      EXPECT_LT(std::fabs(run.history("StrainEnergy").back()[1]), allowed * K);
      for (std::size_t d = 1; d <= 3; ++d)
        EXPECT_NEAR(momentum.back()[d], momentum.front()[d],
                    allowed * std::fabs(momentum.front()[d]));
    }
}

std::string name_of_case(const testing::TestParamInfo<BasisRow>& test) {
  std::string name(test.param.word);
  for (char& c : name)
    if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
  return name;
}

INSTANTIATE_TEST_SUITE_P(Basis, EveryEffectOf,
                         testing::ValuesIn(basis_rows().begin(), basis_rows().end()), name_of_case);

}  // namespace
}  // namespace sluice::mpm::every_effect_test
