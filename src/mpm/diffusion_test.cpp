// A concentration that diffuses through solids, against Fourier.
#include <gtest/gtest.h>

#include <cmath>

#include "mpm/test_support/text_run.hpp"

namespace sluice::mpm::diffusion_test {
namespace {

constexpr double pi = 3.14159265358979323846;

std::string part(double from, double to, double concentration) {
  return fmt::format(
      "<geom_object><box><min>[{},0,0]</min><max>[{},1,1]</max></box>"
      "<res>[2,1,1]</res><velocity>[0,0,0]</velocity><temperature>300</temperature>"
      "<concentration>{}</concentration></geom_object>",
      from, to, concentration);
}

SolidDeck bar(int cells) {
  SolidDeck deck;
  deck.upper = "[1,0.05,0.05]";
  deck.cells = fmt::format("[{},1,1]", cells);
  deck.flags = "<interpolator>gimp</interpolator><do_scalar_diffusion>true</do_scalar_diffusion>";
  deck.material = "<diffusion_model type='jg'><diffusivity>0.1</diffusivity></diffusion_model>";
  return deck;
}

TextRun run_until(double time, const SolidDeck& deck, const std::string& name) {
  return {deck,
          {{"<maxTime>1<", fmt::format("<maxTime>{}<", time)},
           {"<outputInterval>0</outputInterval>",
            saves({"p.x", "p.mass", "p.concentration", "g.concentration"})}},
          name};
}

// Nothing passes the sides: the part along cos(pi x) dies out as e^(-D pi^2 t), the sum of m C
// stays.
TEST(ScalarDiffusion, TheFirstModeOfABarDiesOutAndNothingIsLost) {
  SolidDeck deck = bar(20);
  deck.objects = part(0, 0.4999, 1) + part(0.5001, 1, 0);
  const TextRun run = run_until(0.3, deck, "mode");
  const auto x = run.particles("p.x"), C = run.particles("p.concentration"),
             m = run.particles("p.mass");
  double mode = 0, sum = 0, mass = 0;
  for (std::size_t p = 0; p < x[0].size(); ++p) {
    mode += 2.0 / 40 * (C[0][p] - 0.5) * std::cos(pi * x[0][p]);
    sum += m[0][p] * C[0][p];
    mass += m[0][p];
  }
  const double exact = 2 / pi * std::exp(-0.1 * pi * pi * run.time());
  RecordProperty("error", fmt::format("{:.3e}", mode / exact - 1));
  EXPECT_NEAR(mode, exact, 0.01 * exact);
  EXPECT_NEAR(sum / mass, 0.5, 1e-13);
}

// All sides mirrors, but for C at both ends.
std::string ends_at(double low, double high) {
  std::string faces;
  for (const std::string side : {"x-", "x+", "y-", "y+", "z-", "z+"}) {
    faces += "<Face side='" + side + "'><BCType id='all' label='Symmetric' var='symmetry'/>";
    if (side[0] == 'x')
      faces +=
          fmt::format("<BCType id='all' label='SD-Type' var='Dirichlet'><value>{}</value></BCType>",
                      side == "x-" ? low : high);
    faces += "</Face>";
  }
  return faces;
}

// Sides at 1 and 0: C = 1 - x - sum 2/(n pi) sin(n pi x) e^(-n^2 pi^2 D t) in the means of cells:
// of first order in the cells at the ends, and so of order 1.5 over all.
TEST(ScalarDiffusion, BetweenSidesItIsTheSeriesOfFourier) {
  double error[2];
  for (const int n : {20, 40}) {
    SolidDeck deck = bar(n);
    deck.objects = part(0, 1, 0);
    deck.faces = ends_at(1, 0);
    const TextRun run = run_until(1, deck, "sides");
    const auto x = run.particles("p.x"), C = run.particles("p.concentration");
    std::vector<double> mean(n, 0.0);
    for (std::size_t p = 0; p < x[0].size(); ++p)
      mean[static_cast<std::size_t>(x[0][p] * n)] += C[0][p] / 2;
    double squares = 0;
    for (int i = 0; i < n; ++i) {
      const double at = (i + 0.5) / n;
      double exact = 1 - at;
      for (int k = 1; k < 40; ++k)
        exact -=
            2 / (k * pi) * std::sin(k * pi * at) * std::exp(-k * k * pi * pi * 0.1 * run.time());
      const double off = mean[i] - exact;
      squares += off * off / n;
    }
    error[n / 40] = std::sqrt(squares);
    RecordProperty(fmt::format("error_{}", n), fmt::format("{:.3e}", error[n / 40]));
  }
  EXPECT_LT(error[1], 2.5e-3);
  EXPECT_GT(std::log2(error[0] / error[1]), 1.4);
}

// No particle holds more than its material can.
TEST(ScalarDiffusion, StaysWithinTheBoundsOfTheMaterial) {
  SolidDeck deck = bar(20);
  deck.material =
      "<diffusion_model type='jg'><diffusivity>0.1</diffusivity>"
      "<max_concentration>0.4</max_concentration></diffusion_model>";
  deck.objects = part(0, 0.4999, 0.4) + part(0.5001, 1, 0);
  deck.faces = ends_at(1, 0);
  const TextRun run = run_until(0.5, deck, "bounds");
  const auto C = run.particles("p.concentration");
  EXPECT_EQ(*std::max_element(C[0].begin(), C[0].end()), 0.4);
  EXPECT_GE(*std::min_element(C[0].begin(), C[0].end()), 0);
}

// Laws and interfaces that are not supported are refused by name.
TEST(ScalarDiffusion, OtherLawsAndInterfacesAreRefused) {
  SolidDeck deck = bar(20);
  deck.material = "<diffusion_model type='rf1'><diffusivity>0.1</diffusivity></diffusion_model>";
  deck.contacts = "<diffusion_interface><type>common</type></diffusion_interface>";
  deck.objects = part(0, 1, 0);
  std::string told;
  try {
    run_until(0.1, deck, "refused");
  } catch (const std::exception& e) {
    told = e.what();
  }
  for (const char* name : {"'rf1'", "'common'"})
    EXPECT_NE(told.find(std::string(name) + " is known to the format, but not supported yet"),
              told.npos)
        << told;
}

}  // namespace
}  // namespace sluice::mpm::diffusion_test
