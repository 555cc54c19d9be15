// Runs of peridynamic solids: conserved quantities, order in time, splits, mirror images, faults.
#include "peridynamics/peridynamics.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "peridynamics/test_support/peri_run.hpp"

namespace sluice::peridynamics::peridynamics_test {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

const char* const lps =
    "<density>2000</density><material_model type=\"linear_elastic_state\"><bulk_modulus>5e9"
    "</bulk_modulus><shear_modulus>3e9</shear_modulus></material_model>";

std::string box(const std::string& min, const std::string& max, const std::string& velocity,
                const std::string& res = "[1,1,1]") {
  return "<geom_object><box label=\"" + min + max + "\"><min>" + min + "</min><max>" + max +
         "</max></box><res>" + res + "</res><velocity>" + velocity + "</velocity></geom_object>";
}

// Two halves of a block that move against each other, in a domain that they do not fill.
PeriDeck two_halves() {
  PeriDeck d;
  d.settings = "";
  d.material = lps + box("[0.1,0.3,0.3]", "[0.5,0.7,0.7]", "[5,1,0]") +
               box("[0.5,0.3,0.3]", "[0.9,0.7,0.7]", "[-5,0,2]");
  d.cells = {20, 20, 20};
  d.end = 2e-4;
  d.save += "<save label=\"TotalMomentum\"/>";
  return d;
}

// The same in a plane, where bonds break.
PeriDeck breaking() {
  PeriDeck d;
  d.settings = "<plane>stress</plane>";
  d.material = std::string(lps) +
               "<damage_model type=\"spherical_strain_energy\"><G_Ic>40</G_Ic></damage_model>" +
               box("[-0.375,0,0]", "[0.375,0.375,0.05]", "[0,4,0]") +
               box("[-0.375,-0.375,0]", "[0.375,0,0.05]", "[0,-4,0]");
  d.beside = "<precrack><segment><p1>[-0.375,0,0]</p1><p2>[-0.0625,0,0]</p2></segment></precrack>";
  d.lower = {-0.5, -0.5, 0};
  d.upper = {0.5, 0.5, 0.03125};
  d.cells = {32, 32, 1};
  d.periodic = {0, 0, 1};
  d.multiplier = 0.4;
  d.end = 4e-4;
  d.save +=
      "<save label=\"p.damage\"/><save label=\"p.neighborcount\"/>"
      "<save label=\"BrokenBonds\"/><save label=\"BrokenEnergy\"/>";
  return d;
}

template <class Run>
void expect_same(const Run& a, const Run& b, const std::string& label) {
  EXPECT_EQ(a.last(label), b.last(label)) << label;
}

TEST(Runs, KeepMomentumAndEnergy) {
  PeriDeck deck = two_halves();
  deck.multiplier = 0.3;  // velocities jump at the start: of the order of the step's square
  const PeriRun run(deck.text());
  const auto v = run.last("p.velocity");
  Vec3 sum{}, start{};
  double size = 0;
  for (const auto& [id, own] : v) {
    for (int d = 0; d < 3; ++d) sum[d] += own[static_cast<std::size_t>(d)];
    size += std::hypot(own[0], own[1], own[2]);
  }
  const double half = static_cast<double>(v.size()) / 2;
  start = {0, half * 1, half * 2};
  for (int d = 0; d < 3; ++d) EXPECT_NEAR(sum[d], start[d], 1e-13 * size);
  const auto kinetic = run.history("KineticEnergy"), strain = run.history("StrainEnergy");
  const double before = 0.5 * 2000 * 0.05 * 0.05 * 0.05 * 8 * 8 * 8 * (26 + 29);
  for (std::size_t n = 0; n < kinetic.size(); ++n)
    EXPECT_NEAR(kinetic[n] + strain[n], before, 1e-2 * before);
}

// A smooth start: the energy of velocity Verlet is that of the start but for dt^2.
TEST(Runs, KeepTheirEnergyToSecondOrder) {
  const auto worst = [](double dt) {
    PeriDeck d = two_halves();
    d.dt = dt;
    d.end = 1e-4;
    const PeriRun run(d.text());
    const auto kinetic = run.history("KineticEnergy"), strain = run.history("StrainEnergy");
    double most = 0;
    const double start = 0.5 * 2000 * 0.05 * 0.05 * 0.05 * 8 * 8 * 8 * (26 + 29);
    for (std::size_t n = 0; n < kinetic.size(); ++n)
      most = std::max(most, std::fabs(kinetic[n] + strain[n] - start) / start);
    return most;
  };
  const double coarse = worst(4e-6), fine = worst(2e-6);
  EXPECT_NEAR(std::log2(coarse / fine), 2, 0.15);
  EXPECT_LT(fine, 1e-3);
}

TEST(Runs, HaveTheSameBitsOnBoxesAndThreads) {
  const std::string deck = two_halves().text();
  const PeriRun whole(deck), boxes(deck, {{3, 2, 1}, 1}), threads(deck, {{1, 1, 2}, 3});
  for (const char* label : {"p.displacement", "p.velocity", "p.dilatation"}) {
    expect_same(whole, boxes, label);
    expect_same(whole, threads, label);
  }
}

TEST(Runs, BreakTheSameBondsOnBoxesAndThreads) {
  const std::string deck = breaking().text();
  const PeriRun whole(deck), boxes(deck, {{3, 2, 1}, 1}), threads(deck, {{1, 3, 1}, 3});
  ASSERT_GT(whole.history("BrokenBonds").back(), 20);
  for (const char* label : {"p.displacement", "p.velocity", "p.damage", "p.neighborcount"}) {
    expect_same(whole, boxes, label);
    expect_same(whole, threads, label);
  }
  EXPECT_EQ(whole.history("BrokenEnergy"), boxes.history("BrokenEnergy"));
}

// What the elastic energy loses where bonds break, and no more.
TEST(Runs, KeepTheBooksOfBrokenBonds) {
  const PeriRun run(breaking().text());
  const auto K = run.history("KineticEnergy"), W = run.history("StrainEnergy"),
             broken = run.history("BrokenEnergy");
  const double start = 0.5 * 2000 * 0.75 * 0.75 * 0.03125 * 16;
  EXPECT_GT(broken.back(), 0.01 * start);
  for (std::size_t n = 0; n < K.size(); ++n)
    EXPECT_NEAR(K[n] + W[n] + broken[n], start, 1e-2 * start);
}

// Damage of a body and its mirror image.
TEST(Runs, BreakMirrorImages) {
  const PeriRun run(breaking().text());
  const auto damage = run.last("p.damage"), place = run.last("p.referencePlace");
  std::map<std::pair<long, long>, double> by_place;
  const auto key = [](double x, double y) {
    return std::pair(std::lround(x * 1e4), std::lround(y * 1e4));
  };
  for (const auto& [id, X] : place) by_place[key(X[0], X[1])] = damage.at(id)[0];
  double most = 0;
  for (const auto& [id, X] : place) {
    const double other = by_place.at(key(X[0], -X[1]));
    EXPECT_NEAR(damage.at(id)[0], other, 1e-12);
    most = std::max(most, other);
  }
  EXPECT_GT(most, 0.3);
}

// Mirror images at symmetric sides: a quarter of a block moves as the block does.
TEST(Runs, MoveAsTheirMirrorImages) {
  PeriDeck whole;
  whole.settings = "";
  whole.material = lps + box("[-0.4,-0.4,-0.4]", "[0.4,0.4,0.4]", "[0,0,0]") +
                   box("[-0.4,-0.4,0.4]", "[0.4,0.4,0.6]", "[0,0,7]");
  whole.lower = {-1, -1, -1};
  whole.cells = {20, 20, 20};
  whole.end = 1e-4;
  PeriDeck part = whole;
  part.lower = {0, -1, -1};
  part.cells = {10, 20, 20};
  part.sides = "<Face side=\"x-\"><BCType id=\"all\" var=\"symmetry\" label=\"Symmetric\"/></Face>";
  part.material = lps + box("[0,-0.4,-0.4]", "[0.4,0.4,0.4]", "[0,0,0]") +
                  box("[0,-0.4,0.4]", "[0.4,0.4,0.6]", "[0,0,7]");
  const PeriRun all(whole.text()), half(part.text());
  std::map<std::tuple<long, long, long>, std::vector<double>> by_place;
  const auto key = [](const std::vector<double>& X) {
    return std::tuple(std::lround(X[0] * 1e4), std::lround(X[1] * 1e4), std::lround(X[2] * 1e4));
  };
  const auto u = all.last("p.displacement");
  double size = 0;
  for (const auto& [id, X] : all.last("p.referencePlace")) by_place[key(X)] = u.at(id);
  const auto u_half = half.last("p.displacement");
  for (const auto& [id, X] : half.last("p.referencePlace"))
    for (std::size_t d = 0; d < 3; ++d) {
      size = std::max(size, std::fabs(u_half.at(id)[d]));
      EXPECT_NEAR(u_half.at(id)[d], by_place.at(key(X))[d], 1e-13);
    }
  EXPECT_GT(size, 1e-5);
}

// A body that only moves: v = v_0 exp(-gamma t/rho), to second order; what drag takes is what the
// kinetic energy loses.
TEST(Damping, SlowsABodyExponentially) {
  const auto end = [](double dt, double& books) {
    PeriDeck d = two_halves();
    d.settings = "<damping>1e7</damping>";
    d.material = lps + box("[0.3,0.3,0.3]", "[0.7,0.7,0.7]", "[8,0,0]");
    d.dt = dt;
    d.max_steps = static_cast<int>(std::lround(2e-4 / dt));
    d.save += "<save label=\"DampingEnergy\"/>";
    const PeriRun run(d.text());
    const double K0 = 0.5 * 2000 * 0.064 * 64;
    books = run.history("DampingEnergy").back() + run.history("KineticEnergy").back() - K0;
    return run.last("p.velocity").begin()->second[0];
  };
  double coarse_books = 0, fine_books = 0;
  const double exact = 8 * std::exp(-1e7 * 2e-4 / 2000);
  const double coarse = end(2e-5, coarse_books) - exact, fine = end(1e-5, fine_books) - exact;
  EXPECT_NEAR(std::log2(std::fabs(coarse / fine)), 2, 0.05);
  EXPECT_NEAR(std::log2(coarse_books / fine_books), 2, 0.05);
  EXPECT_LT(std::fabs(fine_books), 1e-3 * 0.5 * 2000 * 0.064 * 64);
}

// u = g t^2/2, of which Verlet makes no error; the work of gravity is the kinetic energy.
TEST(Gravity, LetsABodyFall) {
  PeriDeck d = two_halves();
  d.settings = "<gravity>[0,0,-10]</gravity>";
  d.material = lps + box("[0.3,0.3,0.3]", "[0.7,0.7,0.7]", "[0,0,0]");
  d.end = 1e-3;
  d.save += "<save label=\"ExternalWork\"/>";
  const PeriRun run(d.text());
  for (const auto& [id, u] : run.last("p.displacement")) EXPECT_NEAR(u[2], -5e-6, 1e-16);
  const double K = run.history("KineticEnergy").back();
  EXPECT_NEAR(K, 0.5 * 2000 * 0.064 * 1e-4, 1e-9);
  EXPECT_NEAR(run.history("ExternalWork").back(), K, 1e-10 * K);
}

TEST(Damage, LeavesBondsOfRegionsThatDoNotFail) {
  PeriDeck d = breaking();
  const std::string model = "<G_Ic>40</G_Ic>";
  d.material.insert(d.material.find(model) + model.size(),
                    "<no_fail><box label=\"all\"><min>[-1,-1,-1]</min><max>[1,1,1]</max></box>"
                    "</no_fail>");
  const PeriRun run(d.text());
  EXPECT_EQ(run.history("BrokenBonds").back(), 0);
}

// In the first step whose end finds a bond beyond its limit, and not before.
TEST(Damage, BreaksABondAtItsStretch) {
  PeriDeck d;
  d.settings = "<influence>one</influence>";
  d.material =
      "<density>2000</density><horizon>0.08</horizon><material_model type=\"linear_elastic_bond\">"
      "<young_modulus>1e3</young_modulus></material_model>"
      "<damage_model type=\"critical_stretch\"><s0>0.01</s0></damage_model>" +
      box("[0.4,0.45,0.45]", "[0.45,0.5,0.5]", "[-1,0,0]") +
      box("[0.45,0.45,0.45]", "[0.5,0.5,0.5]", "[1,0,0]");
  d.cells = {20, 20, 20};
  d.dt = 1e-5;
  d.end = 1;
  d.max_steps = 24;  // stretch 2e-5 n/0.05: 0.0096
  d.save = "<save label=\"p.displacement\"/><save label=\"BrokenBonds\"/>";
  EXPECT_EQ(PeriRun(d.text()).history("BrokenBonds").back(), 0);
  d.max_steps = 26;
  EXPECT_EQ(PeriRun(d.text()).history("BrokenBonds").back(), 1);
}

TEST(Stages, AreThoseOfTheScene) {
  const auto stages = [](const std::string& text) {
    const Deck deck = load_deck_text(text, "deck.ups", {}, peri_schema());
    const Scene scene = read_scene(deck, SceneOptions{});
    std::vector<Fault> faults;
    const auto component = make(deck, scene, faults);
    StepShape shape;
    component->step().declare_stages(shape);
    std::string names;
    for (const StepShape::Stage& stage : shape.stages())
      names += std::get<StepShape::Solve>(stage).name + "; ";
    return names;
  };
  EXPECT_THAT(stages(two_halves().text()), Not(HasSubstr("break")));
  EXPECT_THAT(stages(two_halves().text()), HasSubstr("dilatations"));
  EXPECT_THAT(stages(breaking().text()), HasSubstr("bonds that break"));
  PeriDeck pmb = two_halves();
  pmb.material =
      "<density>2000</density><material_model type=\"linear_elastic_bond\">"
      "<young_modulus>7e9</young_modulus></material_model>" +
      box("[0.1,0.3,0.3]", "[0.5,0.7,0.7]", "[5,1,0]");
  EXPECT_THAT(stages(pmb.text()), Not(HasSubstr("dilatation")));
}

struct BadDeck {
  std::string name;
  void (*change)(PeriDeck& deck);
  std::string says;
};

TEST(BadDecks, AreRefusedByName) {
  const BadDeck rows[] = {
      {"short horizon", [](PeriDeck& d) { d.material += "<horizon>0.06</horizon>"; },
       "the horizon 0.06 m is 1.2 spacings of points (0.05 m); at least 1.5 are needed"},
      {"across",
       [](PeriDeck& d) {
         d.periodic = {1, 0, 0};
         d.material += "<horizon>0.45</horizon>";
       },
       "the horizon 0.45 m reaches across the domain, 1 m along x, whose sides are periodic"},
      {"law",
       [](PeriDeck& d) {
         d.material.replace(d.material.find("linear_elastic_state"), 20,
                            "elastic_neo_hookean_state");
       },
       "elastic_neo_hookean_state"},
      {"moduli",
       [](PeriDeck& d) {
         d.material.replace(d.material.find("<shear_modulus>3e9</shear_modulus>"), 34, "");
       },
       "needs <bulk_modulus> and <shear_modulus>"},
      {"plane", [](PeriDeck& d) { d.settings = "<plane>strain</plane>"; },
       "<plane> is for two dimensions; this run has 3"},
      {"segment",
       [](PeriDeck& d) {
         d.beside = "<precrack><segment><p1>[0,0,0]</p1><p2>[1,0,0]</p2></segment></precrack>";
       },
       "<segment> cuts bodies in two dimensions only"},
      {"damage", [](PeriDeck& d) { d.material += "<damage_model type=\"critical_stretch\"/>"; },
       "needs one of <s0> and <G_Ic>"},
      {"integrator",
       [](PeriDeck& d) { d.settings = "<time_integrator>backward_euler</time_integrator>"; },
       "backward_euler"},
      {"contact", [](PeriDeck& d) { d.beside = "<ContactModel type=\"short_range\"/>"; },
       "short_range"},
      {"weights", [](PeriDeck& d) { d.settings = "<surface_weights>matched</surface_weights>"; },
       "matched"},
  };
  for (const BadDeck& row : rows) {
    PeriDeck deck = two_halves();
    row.change(deck);
    EXPECT_THAT(faults_of(deck.text()), HasSubstr(row.says)) << row.name;
  }
  EXPECT_EQ(faults_of(two_halves().text()), "");
}

TEST(BadDecks, OfTwoPointsAtOnePlaceNameThem) {
  PeriDeck deck = two_halves();
  deck.material += box("[0.1,0.3,0.3]", "[0.2,0.4,0.4]", "[0,0,0]");
  try {
    const PeriRun run(deck.text());
    FAIL();
  } catch (const InputError& e) {
    EXPECT_THAT(e.what(), HasSubstr("lie at the same place (0.125, 0.325, 0.325)"));
  }
}

}  // namespace
}  // namespace sluice::peridynamics::peridynamics_test
