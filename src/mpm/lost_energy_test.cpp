// Lost energy of motion as heat: the sum over particles is the energy account's, whatever the
// basis and the transfer; what vibrates does not heat itself.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "framework/base/json.hpp"
#include "mpm/test_support/solid_run.hpp"
#include "mpm/test_support/text_run.hpp"

namespace sluice::mpm::lost_energy_test {
namespace {

double sum(const std::vector<double>& of) {
  return std::accumulate(of.begin(), of.end(), 0.0);
}

double of_account(const TextRun& run, const std::string& name) {
  for (const auto& [entry, value] : run.report().budget)
    if (entry == name) return value;
  return 0;
}

struct Case {
  const char* basis;
  const char* transfer;
  const char* further = "";  // flags
};
void PrintTo(const Case& c, std::ostream* out) {
  *out << c.basis << ' ' << c.transfer << ' ' << c.further;
}

// Two blocks that meet in a corner of mirrors: of one material, or of two that slide.
SolidDeck meeting(const Case& c, int materials) {
  const auto block = [](double x, double y, double speed) {
    return fmt::format(
        "<geom_object><box><min>[{},{},-1]</min><max>[{},{},2]</max></box><res>[2,2,1]</res>"
        "<velocity>[{},-3,0]</velocity><temperature>300</temperature></geom_object>",
        x, y, x + 0.3, y + 0.3, speed);
  };
  SolidDeck deck;
  deck.upper = "[1,1,0.05]";
  deck.cells = "[20,20,1]";
  deck.flags = fmt::format(
      "<interpolator>{}</interpolator>{}{}<lost_energy>heat</lost_energy>"
      "<DoExplicitHeatConduction>false</DoExplicitHeatConduction>",
      c.basis, c.transfer[0] != 0 ? fmt::format("<transfer>{}</transfer>", c.transfer) : "",
      c.further);
  deck.objects = block(0.1, 0.2, 6);
  const std::string other = block(0.45, 0.02, -6);
  if (materials == 1) {
    deck.objects += other;
    return deck;
  }
  deck.further = solid_material("other", other);
  deck.contacts =
      "<contact><type>friction_bard</type><mu>0.3</mu><materials>[0,1]</materials></contact>";
  return deck;
}

const TextRun::Rewrites saves_losses = {
    {"<maxTime>1<", "<maxTime>0.03<"},
    {"<outputInterval>0</outputInterval>",
     saves({"p.lostEnergy", "p.heatOfLosses", "p.temperature", "p.mass", "KineticEnergy"})}};

class LostEnergy : public testing::TestWithParam<Case> {};

// Two ways to the same: each particle's own loss, and what the books of nodes and particles differ.
TEST_P(LostEnergy, OfParticlesIsThatOfTheAccount) {
  const TextRun run(meeting(GetParam(), 1), saves_losses, "lost");
  const double scale = run.history("KineticEnergy").front()[1];
  const double budget = of_account(run, "transfer loss") + of_account(run, "integration loss");
  EXPECT_GT(std::fabs(budget), 1e-4 * scale);
  EXPECT_NEAR(sum(run.particles("p.lostEnergy")[0]), budget, 1e-12 * scale);
  const std::vector<double> heat = run.particles("p.heatOfLosses")[0],
                            T = run.particles("p.temperature")[0], m = run.particles("p.mass")[0];
  EXPECT_NEAR(-of_account(run, "back as heat"), sum(heat), 5e-12 * scale);
  constexpr double specific_heat = 5;
  for (std::size_t p = 0; p < heat.size(); ++p) {
    ASSERT_GE(heat[p], 0);
    ASSERT_NEAR(T[p], 300 + heat[p] / (m[p] * specific_heat), 1e-9);
  }
}

INSTANTIATE_TEST_SUITE_P(Of, LostEnergy,
                         testing::Values(Case{"gimp", ""}, Case{"gimp", "flip"}, Case{"linear", ""},
                                         Case{"3rdorderBS", ""}, Case{"3rdorderBS", "apic"},
                                         Case{"cpdi", ""}, Case{"carried_corners", ""},
                                         Case{"gimp", "affine"}));

// What contact takes becomes heat of both bodies.
TEST(LostEnergyOfContact, WarmsBothSides) {
  const TextRun run(meeting({"gimp", ""}, 2), saves_losses, "slide");
  const double contact = of_account(run, "contact loss");
  EXPECT_GT(contact, 0.01 * run.history("KineticEnergy").front()[1]);
  double heat = 0;
  for (const int material : {0, 1}) {
    const double own = sum(run.particles("p.heatOfLosses", material)[0]);
    EXPECT_GT(own, 0.3 * contact);
    heat += own;
  }
  EXPECT_NEAR(-of_account(run, "back as heat"), heat, 1e-9 * contact);
  // Not more than what was lost, and no gain by error.
  const double scale = run.history("KineticEnergy").front()[1];
  const double lost =
      of_account(run, "transfer loss") + of_account(run, "integration loss") + contact;
  EXPECT_LE(heat, lost + 0.005 * scale);
  EXPECT_EQ(run.report().solids_text.find("has gained"), std::string::npos);
}

// Contact and gravity give nodes impulses that no stress of particles gave: what particles lose is
// still what the books of nodes say, and with heat and what is not lost yet no energy is missing.
class LossesBesideImpulses : public testing::TestWithParam<Case> {};

TEST_P(LossesBesideImpulses, AreThoseOfTheAccount) {
  TextRun::Rewrites rewrites = saves_losses;
  rewrites.emplace_back("<gravity>[0,0,0]<", "<gravity>[0,-20,0]<");
  const TextRun run(meeting(GetParam(), 2), rewrites, "fall");
  const double scale = run.history("KineticEnergy").front()[1];
  const double contact = of_account(run, "contact loss");
  EXPECT_GT(contact, 0.01 * scale);
  double lost = 0;
  for (const int material : {0, 1}) lost += sum(run.particles("p.lostEnergy", material)[0]);
  const double budget = of_account(run, "transfer loss") + of_account(run, "integration loss");
  EXPECT_NEAR(lost, budget + contact, 1e-11 * scale);
  const Json energy = Json::parse(run.report().conservation_json).at("total energy");
  EXPECT_LE(std::fabs(energy.at("drift").get<double>()), 1e-11);
}

INSTANTIATE_TEST_SUITE_P(Of, LossesBesideImpulses,
                         testing::Values(Case{"gimp", ""}, Case{"gimp", "flip"}, Case{"linear", ""},
                                         Case{"3rdorderBS", ""}, Case{"3rdorderBS", "apic"},
                                         Case{"cpdi", ""}, Case{"gimp", "affine"}));

// Nodes at which a wall gives energy back count against those at which it takes some.
TEST(LostEnergyOfContact, OfABounceIsNotMoreThanItsLoss) {
  const SolidRun run("bouncing_bar", {"MPM/lost_energy=heat"});
  double left = 0, contact = 0;
  for (const auto& [name, value] : run.report().budget) {
    left += value;
    if (name == "contact loss") contact = value;
  }
  EXPECT_GT(contact, 0);
  EXPECT_NEAR(left, 0, 0.02 * contact);
  EXPECT_EQ(run.report().solids_text.find("has gained"), std::string::npos);
}

struct Bar {
  const char* basis;
  const char* flags;
};
void PrintTo(const Bar& b, std::ostream* out) {
  *out << b.basis << ' ' << b.flags;
}
class VibratingBar : public testing::TestWithParam<Bar> {};

// Bar of 20 cells, c = 1 m/s, a hundred periods of its lowest mode, particles of which cross kinks
// of shape functions: its heat is no more than what it has lost, and what it has with its heat no
// more than at the start but for the swing of the leapfrog, omega dt/2.
TEST_P(VibratingBar, NeverGains) {
  constexpr int cells = 20, parts = 2 * cells;
  constexpr double amplitude = 0.01, period = 2 * cells;
  const auto file =
      std::filesystem::temp_directory_path() / fmt::format("sluice_bar_{}.txt", ::getpid());
  std::ofstream points(file);
  double start = 0;
  for (int n = 0; n < parts; ++n) {
    const double s = (n + 0.5) / parts, v = amplitude * std::cos(std::numbers::pi * s);
    points << fmt::format("{} 0.5 0.5 0.5 {} 0 0\n", 5.1 + cells * s, v);
    start += 0.25 * v * v;
  }
  points.close();
  SolidDeck deck;
  deck.upper = deck.cells = "[30,1,1]";
  deck.flags = fmt::format(
      "<interpolator>{}</interpolator><lost_energy>heat</lost_energy>{}"
      "<DoExplicitHeatConduction>false</DoExplicitHeatConduction>",
      GetParam().basis, GetParam().flags);
  deck.objects = fmt::format(
      "<geom_object><file><name>{}</name><var>p.volume</var><var>p.velocity</var></file>"
      "<res>[2,1,1]</res><velocity>[0,0,0]</velocity><temperature>300</temperature>"
      "</geom_object>",
      file.string());
  const TextRun run(deck,
                    {{"<density>1000<", "<density>1<"},
                     {"<bulk_modulus>1e6<", "<bulk_modulus>0.6<"},
                     {"<shear_modulus>5e5<", "<shear_modulus>0.3<"},
                     {"<maxTime>1<", fmt::format("<maxTime>{}<", 100 * period)},
                     {"<delt_max>1<", "<delt_max>100<"},
                     {"<timestep_multiplier>0.4<", "<timestep_multiplier>0.8<"},
                     {"<outputInterval>0</outputInterval>",
                      saves({"p.heatOfLosses", "p.lostEnergy", "KineticEnergy", "StrainEnergy"})}},
                    "bar");
  std::filesystem::remove(file);
  const auto kinetic = run.history("KineticEnergy"), inner = run.history("StrainEnergy");
  double most = 0;
  for (std::size_t n = 0; n < kinetic.size(); ++n)
    most = std::max(most, (kinetic[n][1] + inner[n][1]) / start);
  constexpr double swing = 0.5 * 0.8 * std::numbers::pi / cells;
  EXPECT_LE(most, 1 + swing + 0.005);
  const double heat = sum(run.particles("p.heatOfLosses")[0]),
               lost = sum(run.particles("p.lostEnergy")[0]);
  EXPECT_GE(heat, -1e-12 * start);
  EXPECT_LE(heat, std::max(0.0, lost) + swing * start);
  const Json solids = Json::parse(run.report().solids_json).at("block");
  EXPECT_LE(solids.at("numerical_gain_of_scale").get<double>(), 0.005);
  EXPECT_EQ(solids.at("above_gain_limit_since_step").get<int>(), 0);
}

INSTANTIATE_TEST_SUITE_P(Of, VibratingBar,
                         testing::Values(Bar{"gimp", ""}, Bar{"3rdorderBS", ""}, Bar{"cpdi", ""},
                                         Bar{"gimp", "<transfer>flip</transfer>"},
                                         Bar{"gimp",
                                             "<artificial_viscosity>true</artificial_viscosity>"}));

// Blocks that rattle in a corner of mirrors: all that becomes heat is less than what they had.
TEST(LostEnergyOfContact, IsNoMoreThanWhatBodiesHad) {
  SolidDeck deck = meeting({"gimp", ""}, 2);
  const TextRun run(deck,
                    {{"<maxTime>1<", "<maxTime>0.2<"},
                     {"<outputInterval>0</outputInterval>", saves({"p.temperature", "p.mass"})}},
                    "rattle");
  constexpr double specific_heat = 5, energy = 0.5 * (6 * 6 + 3 * 3);  // J/kg
  double heat = 0, mass = 0;
  for (const int material : {0, 1}) {
    const auto T = run.particles("p.temperature", material)[0],
               m = run.particles("p.mass", material)[0];
    for (std::size_t p = 0; p < T.size(); ++p) {
      ASSERT_GE(T[p], 300 - 1e-9);
      heat += m[p] * specific_heat * (T[p] - 300);
      mass += m[p];
    }
  }
  EXPECT_LE(heat, 1.005 * energy * mass);
  EXPECT_GT(heat, 0.1 * energy * mass);
}

}  // namespace
}  // namespace sluice::mpm::lost_energy_test
