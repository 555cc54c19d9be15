// Transport of mixtures: numbers of handbooks, limits of pure gases, symmetry of pairs.
#include "kinetics/transport.hpp"

#include <gtest/gtest.h>

#include "kinetics/gas_test_support.hpp"

namespace sluice::kinetics::transport_test {
namespace {

using namespace testing_gas;

std::vector<double> all_of(std::initializer_list<std::pair<Place, double>> given) {
  std::vector<double> Y(9, 0.0);
  for (const auto& [k, fraction] : given) Y[k] = fraction;
  return Y;
}

TEST(Transport, HasTheNumbersOfAir) {
  Transport transport(hydrogen());
  ASSERT_TRUE(transport.available());
  const std::vector<double> air = all_of({{O2, 0.233}, {N2, 0.767}});
  transport.set(300, air.data());
  EXPECT_NEAR(transport.viscosity(), 1.85e-5, 0.03 * 1.85e-5);
  EXPECT_NEAR(transport.conductivity(), 0.026, 0.04 * 0.026);
}

TEST(Transport, HasTheDiffusionOfHydrogenInNitrogen) {
  Transport transport(hydrogen());
  std::vector<double> D(9);
  const std::vector<double> trace = all_of({{H2, 1e-8}, {N2, 1 - 1e-8}});
  transport.set(300, trace.data());
  transport.diffusion(101325, D.data());
  EXPECT_NEAR(D[H2], 7.7e-5, 0.05 * 7.7e-5);
  std::vector<double> half(9);
  transport.diffusion(2 * 101325, half.data());
  EXPECT_NEAR(half[H2], D[H2] / 2, 1e-12 * D[H2]);
}

TEST(Transport, OfAPureSpeciesIsItsOwn) {
  Transport transport(hydrogen());
  const double T = 700, x = std::log(T);
  const auto fit = [&](const Fit& a) {
    double sum = 0;
    for (int n = 0; n < 5; ++n) sum += a[n] * std::pow(x, n);
    return sum;
  };
  std::vector<double> D(9);
  for (std::size_t k = 0; k < 9; ++k) {
    std::vector<double> Y(9, 0.0);
    Y[k] = 1;
    transport.set(T, Y.data());
    const Species& species = burke_hydrogen().species[k];
    const double mu = std::sqrt(T) * std::pow(fit(*species.viscosity), 2);
    const double lambda = std::sqrt(T) * fit(*species.conductivity);
    EXPECT_NEAR(transport.viscosity(), mu, 1e-9 * mu);
    EXPECT_NEAR(transport.conductivity(), lambda, 1e-9 * lambda);
    transport.diffusion(1e5, D.data());
    for (std::size_t j = 0; j < 9; ++j) {
      const double pair = std::pow(T, 1.5) * fit(burke_hydrogen().diffusion[j * 9 + k]) / 1e5;
      if (j == k) {
        EXPECT_GT(D[j], 1e-6);
        EXPECT_LT(D[j], 1e-1);
      } else {
        EXPECT_NEAR(D[j], pair, 1e-9 * pair);
      }
    }
  }
}

// With two species both spread along their gradients of mass with the one D of the pair.
TEST(Transport, OfAPairHasOneDiffusion) {
  Transport transport(hydrogen());
  const std::vector<double> Y = all_of({{H2, 0.1}, {O2, 0.9}});
  std::vector<double> D(9);
  transport.set(1200, Y.data());
  transport.diffusion(1e5, D.data());
  EXPECT_NEAR(D[H2], D[O2], 1e-9 * D[H2]);
}

TEST(Transport, DoesNotDependOnEarlierCalls) {
  Transport one(hydrogen()), other(hydrogen());
  const std::vector<double> air = all_of({{O2, 0.233}, {N2, 0.767}}), wet = all_of({{H2O, 1}});
  one.set(400, wet.data());
  one.set(400, air.data());
  other.set(500, air.data());
  other.set(400, air.data());
  EXPECT_EQ(one.viscosity(), other.viscosity());
  EXPECT_EQ(one.conductivity(), other.conductivity());
}

TEST(Transport, IsNotThereWithoutFits) {
  Mechanism bare = burke_hydrogen();
  bare.diffusion.clear();
  EXPECT_FALSE(Transport(SpeciesGas(bare, N2)).available());
  bare = burke_hydrogen();
  bare.species[3].viscosity.reset();
  EXPECT_FALSE(Transport(SpeciesGas(bare, N2)).available());
}

}  // namespace
}  // namespace sluice::kinetics::transport_test
