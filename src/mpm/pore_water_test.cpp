// Water in pores, against closed forms: drag, waves, consolidation, rest; and what is conserved.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "framework/base/temporary_folder.hpp"
#include "mpm/step/pore_water.hpp"
#include "mpm/test_support/solid_run.hpp"
#include "mpm/test_support/text_run.hpp"

namespace sluice::mpm::pore_water_test {
namespace {

constexpr double pi = 3.14159265358979323846;

// A column along x of one cell across; density of grains 2000, K = 1e6, G = 5e5.
SolidDeck column(const std::string& water, double velocity = 0) {
  SolidDeck deck;
  deck.upper = "[1,0.05,0.05]";
  deck.cells = "[20,1,1]";
  deck.flags =
      "<interpolator>gimp</interpolator><coupled_flow_analysis>true</coupled_flow_analysis>";
  deck.material = "<water_density>1000</water_density>" + water;
  deck.objects = fmt::format(
      "<geom_object><box><min>[0,0,0]</min><max>[1,1,1]</max></box><res>[2,1,1]</res>"
      "<velocity>[{},0,0]</velocity><temperature>300</temperature></geom_object>",
      velocity);
  return deck;
}

TextRun::Rewrites until(double time, TextRun::Rewrites more = {}) {
  TextRun::Rewrites all = {{"type='mpm'", "type='shmpm'"},
                           {"<density>1000<", "<density>2000<"},
                           {"<maxTime>1<", fmt::format("<maxTime>{}<", time)},
                           {"<outputInterval>0</outputInterval>",
                            saves({"p.x", "p.mass", "p.velocity", "p.stress", "p.porepressure",
                                   "p.porepressureFilter", "p.fluidvelocity", "p.fluidmass"})}};
  all.insert(all.end(), more.begin(), more.end());
  return all;
}

// Whatever the drag and the step: w = w_0 e^(-lambda t), with accelerations a w + b the solution of
// that; the momentum of both changes by that of the accelerations alone.
TEST(PoreWater, DragDecaysAsTheClosedFormInAnyStep) {
  for (const double lambda : {0.0, 1e-3, 5.0, 1e9})
    for (const int parts : {1, 7}) {
      PhasePair pair{1200, 400, lambda, 0.3, -1.1};
      const double before = 1200 * 0.3 - 400 * 1.1, apart = -1.4, difference = 4.0 - 9.0;
      for (int n = 0; n < parts; ++n) pair.kick(0.5 / parts, 9, 4);
      const double decay = std::exp(-lambda * 0.5);
      const double exact = apart * decay + difference * (lambda > 0 ? (1 - decay) / lambda : 0.5);
      EXPECT_NEAR(pair.of_water - pair.of_solid, exact, 1e-12) << lambda << ' ' << parts;
      EXPECT_NEAR(1200 * pair.of_solid + 400 * pair.of_water, before + 0.5 * (1200 * 9 + 400 * 4.0),
                  1e-11);
    }
}

// The mean wave between mirrors moves as cos(pi c t), with c of the undrained soil.
TEST(PoreWater, UndrainedWavesHaveTheSpeedOfBothTogether) {
  const double n = 0.4, K_w = 1e7, density = 0.6 * 2000 + 0.4 * 1000;
  const double c = std::sqrt((1e6 + 4.0 / 3 * 5e5 + K_w / n) / density);
  for (const double phase : {0.25, 0.75}) {
    const SolidDeck deck = column(
        "<porosity>0.4</porosity><permeability>1e-9</permeability>"
        "<water_bulk_modulus>1e7</water_bulk_modulus>",
        1e-3);
    const TextRun run(
        deck,
        until(phase / c,
              {{"<timestep_multiplier>",
                "<end_at_max_time_exactly>true</end_at_max_time_exactly><timestep_multiplier>"}}),
        "undrained");
    const auto x = run.particles("p.x"), v = run.particles("p.velocity");
    double mode = 0;
    for (std::size_t p = 0; p < x[0].size(); ++p)
      mode += pi / 2 * v[0][p] * std::sin(pi * x[0][p]) / static_cast<double>(x[0].size());
    const double exact = 1e-3 * std::cos(pi * phase);
    RecordProperty(fmt::format("of_{}", phase), fmt::format("{:.5f}", mode / exact));
    EXPECT_NEAR(mode, exact, 0.02e-3) << phase;
  }
}

// A free soil that its water drives apart: momentum of both stays to round-off; so does the mass.
TEST(PoreWater, MomentumOfBothIsConserved) {
  SolidDeck deck = column(
      "<porosity>0.4</porosity><permeability>1e-3</permeability>"
      "<water_bulk_modulus>1e7</water_bulk_modulus>"
      "<initial_pore_pressure>20000</initial_pore_pressure>");
  deck.upper = "[1,1,1]";
  deck.cells = "[16,16,16]";
  deck.flags += "<PorePressureFilter>true</PorePressureFilter>";
  deck.objects =
      "<geom_object><sphere><origin>[0.4,0.5,0.5]</origin><radius>0.2</radius></sphere>"
      "<res>[2,2,2]</res><velocity>[1,2,3]</velocity><temperature>300</temperature></geom_object>";
  const TextRun run(deck, until(0.01), "momentum");
  const auto m_s = run.particles("p.mass"), m_w = run.particles("p.fluidmass"),
             v_s = run.particles("p.velocity"), v_w = run.particles("p.fluidvelocity");
  double mass = 0, apart = 0;
  Vec3 momentum{};
  for (std::size_t p = 0; p < m_s[0].size(); ++p) {
    mass += m_s[0][p] + m_w[0][p];
    for (int d = 0; d < 3; ++d) {
      momentum[d] += m_s[0][p] * v_s[d][p] + m_w[0][p] * v_w[d][p];
      apart = std::max(apart, std::fabs(v_s[d][p] - v_w[d][p]));
    }
  }
  EXPECT_GT(apart, 0.005);  // something happens
  EXPECT_NEAR(m_s[0][0] / m_w[0][0], 0.6 * 2000 / (0.4 * 1000), 1e-12);
  for (int d = 0; d < 3; ++d) EXPECT_NEAR(momentum[d] / mass, d + 1, 2e-13);
}

// Terzaghi: see the deck. Means of cells, of which both particles have one pressure.
TEST(PoreWater, AColumnConsolidatesAsTerzaghiSays) {
  const SolidRun run("consolidation");
  const double M = 1e6 + 4.0 / 3 * 5e5, c_v = 0.001 / (1000 * 9.80665) / (1 / M + 0.5 / 1e8);
  const Archive archive = run.archive();
  for (const char* which : {"#1", "#2", "#4"}) {
    const ParticleTable t = run.particles(which);
    const double T = c_v * archive.select_output(which).time;
    std::array<double, 20> error{};
    for (std::size_t p = 0; p < t.size(); ++p) {
      double exact = 0;
      for (int m = 0; m < 40; ++m) {
        const double a = pi * (m + 0.5);
        exact += 2 / a * std::sin(a * (1 - t.position(p).x)) * std::exp(-a * a * T);
      }
      error[static_cast<std::size_t>(t.position(p).x * 20)] +=
          0.5 * (t.find("p.porepressure")->components[0][p] / 1000 - exact);
    }
    double worst = 0;
    for (const double e : error) worst = std::max(worst, std::fabs(e));
    RecordProperty(fmt::format("error_{}", which[1]), fmt::format("{:.4f}", worst));
    EXPECT_LT(worst, which[1] == '1' ? 0.025 : 0.01) << which;
  }
}

// Under gravity a damped column comes to rest: p = rho_w g h, and grains bear their weight less
// that of the water in their place, (1 - n) (rho_s - rho_w) g h, h below the surface.
TEST(PoreWater, AColumnComesToRestWithHydrostaticPressure) {
  SolidDeck deck = column(
      "<porosity>0.4</porosity><permeability>0.05</permeability>"
      "<water_bulk_modulus>1e7</water_bulk_modulus>");
  deck.flags += "<artificial_damping_coeff>60</artificial_damping_coeff>";
  deck.faces.clear();
  for (const std::string side : {"x-", "y-", "y+", "z-", "z+"})
    deck.faces +=
        "<Face side='" + side + "'><BCType id='all' label='Symmetric' var='symmetry'/></Face>\n";
  deck.faces +=
      "<Face side='x+'><BCType id='all' label='Velocity' var='Neumann'><value>[0,0,0]</value>"
      "</BCType></Face>";
  deck.upper = "[1.2,0.05,0.05]";
  deck.cells = "[24,1,1]";
  const TextRun run(deck, until(2, {{"<gravity>[0,0,0]", "<gravity>[-1,0,0]"}}), "rest");
  const auto x = run.particles("p.x"), p = run.particles("p.porepressure"),
             stress = run.particles("p.stress"), v = run.particles("p.velocity");
  double worst_p = 0, worst_s = 0, worst_v = 0;
  for (std::size_t i = 0; i < x[0].size(); ++i) {
    const double h = 1 - x[0][i];
    worst_p = std::max(worst_p, std::fabs(p[0][i] - 1000 * h));
    worst_s = std::max(worst_s, std::fabs(stress[0][i] + 0.6 * 1000 * h));
    worst_v = std::max(worst_v, std::fabs(v[0][i]));
  }
  RecordProperty("pressure", fmt::format("{:.2f}", worst_p));
  RecordProperty("stress", fmt::format("{:.2f}", worst_s));
  EXPECT_LT(worst_p, 20);
  EXPECT_LT(worst_s, 20);
  EXPECT_LT(worst_v, 1e-5);
}

// No bit depends on boxes, threads, or on the filter where nothing varies.
TEST(PoreWater, BoxesAndThreadsChangeNoBit) {
  for (const std::string filter : {"false", "true"}) {
    const std::vector<std::string> flags = {"MPM/PorePressureFilter=" + filter,
                                            "Time/maxTime=0.02"};
    const ParticleTable a = SolidRun("consolidation", flags).particles();
    const ParticleTable b = SolidRun("consolidation", flags, 2, {3, 1, 1}).particles();
    ASSERT_EQ(a.size(), b.size());
    for (const char* label : {"p.porepressure", "p.fluidvelocity", "p.velocity", "p.stress", "p.x"})
      EXPECT_EQ(a.find(label)->components, b.find(label)->components) << label;
  }
}

// Both phases and the pressure, in the order of ids.
std::vector<std::vector<double>> states_of(const std::filesystem::path& archive) {
  const Archive read = Archive::open(archive);
  const ArchiveStep step = read.read_output(read.select_output("last"));
  std::vector<std::vector<double>> columns;
  for (const char* label : {"p.particleID", "p.x", "p.velocity", "p.stress", "p.porepressure",
                            "p.porepressureFilter", "p.fluidvelocity"})
    for (const auto& column : step.read_particles(*step.find_particles(label, 0, 0)))
      columns.push_back(column);
  return columns;
}

// A wave in a column under gravity, stopped half way and gone on from there.
TEST(PoreWater, RestartsGoOnWithTheSameBits) {
  SolidDeck deck = column(
      "<porosity>0.4</porosity><permeability>1e-3</permeability>"
      "<water_bulk_modulus>1e7</water_bulk_modulus>",
      1);
  deck.flags += "<PorePressureFilter>true</PorePressureFilter>";
  TextRun::Rewrites settings =
      until(5e-3, {{"<gravity>[0,0,0]", "<gravity>[-1,0,0]"},
                   {"<save label='p.x'/>", "<save label='p.x'/><save label='p.particleID'/>"}});
  const TextRun whole(deck, settings, "whole");
  std::string text = text_of(deck);
  for (const auto& [from, to] : settings) text.replace(text.find(from), from.size(), to);
  ReadDeck read;
  read.deck = load_deck_text(text, "cut.ups", {}, solid_schema());
  finish_reading(read);
  const TemporaryFolder folder;
  const Mpm solids(read.scene, read.solids);
  RunOptions options;
  options.parent = folder.path();
  options.progress = ProgressMode::none;
  options.deck_xml = text;
  options.limits.max_steps = whole.report().steps / 2;
  const RunReport first = Simulation(read.scene, solids, world(), options).run();
  options.limits.max_steps = {};
  options.restart = *first.archive;
  const RunReport second = Simulation(read.scene, solids, world(), options).run();
  EXPECT_EQ(second.status, RunStatus::done) << second.message;
  EXPECT_EQ(states_of(*second.archive), states_of(*whole.report().archive));
}

// Mean by mass on nodes and back: what alternates from particle to particle does not act.
TEST(PoreWater, TheFilterActsOnWhatActsAlone) {
  SolidDeck deck = column(
      "<porosity>0.4</porosity><permeability>1e-3</permeability>"
      "<water_bulk_modulus>1e7</water_bulk_modulus>"
      "<initial_pore_pressure>500</initial_pore_pressure>");
  deck.flags += "<PorePressureFilter>true</PorePressureFilter>";
  const TextRun run(deck, until(1e-3), "filter");
  for (const char* label : {"p.porepressure", "p.porepressureFilter"}) {
    const auto values = run.particles(label);
    for (const double p : values[0]) EXPECT_NEAR(p, 500, 1e-9) << label;
  }
}

std::string told_of(const SolidDeck& deck, const TextRun::Rewrites& rewrites) {
  try {
    const TextRun run(deck, rewrites, "refused");
  } catch (const std::exception& e) {
    return e.what();
  }
  return "";
}

TEST(PoreWater, WhatItCannotBeTogetherWithIsRefused) {
  SolidDeck deck = column("<porosity>0.4</porosity>");
  deck.flags += "<transfer>pic</transfer><water_damping_coef>0.1</water_damping_coef>";
  const std::string told = told_of(deck, until(1e-3));
  for (const char* text : {"a material with pore water needs <permeability>",
                           "<transfer> pic with pore water is known to the format",
                           "<water_damping_coef> other than 0 is known to the format"})
    EXPECT_NE(told.find(text), told.npos) << text << "\n" << told;
}

}  // namespace
}  // namespace sluice::mpm::pore_water_test
