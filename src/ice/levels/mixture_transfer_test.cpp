// Prolongation and restriction of several materials: conservation, equilibrium, purity, images.
#include "ice/test_support/mixture_levels.hpp"

namespace sluice::ice::mixture_transfer_test {
namespace {

constexpr double round_off = 2e-15;
const std::vector<Fluid> fluids = three_fluids();

class MixtureLevels : public testing::TestWithParam<TransferCase> {
 protected:
  IndexBox parents(int n = 9) const { return coarse_cells(GetParam(), n); }
  IndexBox with_neighbours(int n = 9) const { return with_layer(parents(n), GetParam()); }
  IndexBox fine_cells(int n = 9) const { return refine(parents(n), GetParam().ratio); }
  TransferGeometry geometry() const { return GetParam().geometry(); }
  int components() const { return GetParam().components; }
  MixtureTransfer transfer() const { return MixtureTransfer(fluids, components()); }
  void prolong(const MixtureState& coarse, const MixtureState& fine, const IndexBox& cells,
               int order) const {
    transfer().prolong(coarse.views(), fine.views(), cells, geometry(), order);
  }
  void restrict_to(const MixtureState& fine, const MixtureState& coarse) const {
    transfer().restrict_to(fine.views(), coarse.views(), coarse.box(), geometry());
  }
};

TEST_P(MixtureLevels, ProlongationKeepsAllSumsAndRules) {
  for (unsigned seed = 1; seed <= 5; ++seed) {
    MixtureState coarse(with_neighbours(), GetParam(), 3), fine(fine_cells(), GetParam(), 3);
    fill_with_mixtures(coarse, fluids, seed);
    ASSERT_EQ(broken_cells(coarse, fluids, coarse.box()), 0);
    for (int order = 0; order <= 2; ++order) {
      prolong(coarse, fine, fine.box(), order);
      EXPECT_EQ(broken_cells(fine, fluids, fine.box()), 0) << "order " << order;
      double worst = 0;
      for_each_cell(parents(), [&](IntVec3 cell) {
        worst = std::max(worst, worst_difference(mean_of(coarse, {cell, cell + IntVec3::all(1)}),
                                                 mean_of(fine, children_of(cell, GetParam()))));
      });
      EXPECT_LT(worst, round_off) << "order " << order << " seed " << seed;
    }
  }
}

// Within one material fine cells differ from each other as those of a gas do.
TEST_P(MixtureLevels, ProlongsAMaterialAmongItselfAsAGas) {
  MixtureState coarse(with_neighbours(), GetParam(), 3), fine(fine_cells(), GetParam(), 3);
  BoxState gas(coarse.box(), GetParam()), fine_gas(fine.box(), GetParam());
  fill_wildly(gas, 4);
  for_each_cell(coarse.box(), [&](IntVec3 cell) {
    coarse.mass(2, cell) = gas.rho(cell);
    coarse.energy(2, cell) = gas.energy(cell);
    coarse.volume(2, cell) = 1;
    for (int c = 0; c < components(); ++c) coarse.momentum(c, cell) = gas.momentum(c, cell);
  });
  for (int order = 0; order <= 2; ++order) {
    prolong(coarse, fine, fine.box(), order);
    IceTransfer(components(), false)
        .prolong(gas.views(), fine_gas.views(), fine.box(), geometry(), order);
    int changed = 0;
    for_each_cell(fine.box(), [&](IntVec3 cell) {
      changed += !same_bits(fine.mass(2, cell), fine_gas.rho(cell)) ||
                 !same_bits(fine.energy(2, cell), fine_gas.energy(cell)) ||
                 !same_bits(fine.momentum(0, cell), fine_gas.momentum(0, cell));
    });
    EXPECT_EQ(changed, 0);
  }
  MixtureState mean(parents(), GetParam(), 3);
  BoxState gas_mean(parents(), GetParam());
  restrict_to(fine, mean);
  IceTransfer(components(), false)
      .restrict_to(fine_gas.views(), gas_mean.views(), parents(), geometry());
  int changed = 0;
  for_each_cell(parents(), [&](IntVec3 cell) {
    changed += !same_bits(mean.mass(2, cell), gas_mean.rho(cell)) ||
               !same_bits(mean.energy(2, cell), gas_mean.energy(cell)) ||
               mean.volume(2, cell) != 1.0;
  });
  EXPECT_EQ(changed, 0);
  EXPECT_EQ(broken_cells(mean, fluids, parents()), 0);
}

TEST_P(MixtureLevels, UniformPressureAndVelocityStayUniform) {
  const double u[3] = {0.3, -1.7, 0.11}, p = 2.5;
  MixtureState coarse(with_neighbours(), GetParam(), 3), fine(fine_cells(), GetParam(), 3);
  MixtureState mean(parents(), GetParam(), 3);
  fill_with_mixtures(coarse, fluids, 3, u, p);
  const auto worst = [&](const MixtureState& state) {
    double off = 0;
    for_each_cell(state.box(), [&](IntVec3 cell) {
      for (std::size_t c = 0; c < static_cast<std::size_t>(components()); ++c)
        off = std::max(off, std::fabs(state.momentum(c, cell) / state.density(cell) - u[c]));
      for (std::size_t m = 0; m < 3; ++m)
        if (state.mass(m, cell) > 0)
          off = std::max(off, std::fabs(state.pressure(m, fluids[m], cell) - p) /
                                  (p - fluids[m].lowest_pressure()));
    });
    return off;
  };
  for (int order = 0; order <= 2; ++order) {
    prolong(coarse, fine, fine.box(), order);
    EXPECT_LT(worst(fine), 2e-14) << "order " << order;
    restrict_to(fine, mean);
    EXPECT_LT(worst(mean), 2e-14) << "order " << order;
  }
  // Fine cells that differ in composition from one to the next.
  fill_with_mixtures(fine, fluids, 8, u, p);
  restrict_to(fine, mean);
  EXPECT_LT(worst(mean), 2e-14);
}

TEST_P(MixtureLevels, RestrictionKeepsAllSumsAndRules) {
  for (unsigned seed = 1; seed <= 5; ++seed) {
    MixtureState fine(fine_cells(5), GetParam(), 3), coarse(parents(5), GetParam(), 3);
    fill_with_mixtures(fine, fluids, seed);
    restrict_to(fine, coarse);
    EXPECT_EQ(broken_cells(coarse, fluids, coarse.box()), 0);
    for_each_cell(coarse.box(), [&](IntVec3 cell) {
      EXPECT_LT(worst_difference(mean_of(coarse, {cell, cell + IntVec3::all(1)}),
                                 mean_of(fine, children_of(cell, GetParam()))),
                round_off);
    });
  }
}

// Neither what part of the fine cells is asked for shows, nor the direction of an axis.
TEST_P(MixtureLevels, DependOnNeitherCutsNorMirrors) {
  MixtureState coarse(with_neighbours(), GetParam(), 3), image(coarse.box(), GetParam(), 3);
  MixtureState fine(fine_cells(), GetParam(), 3), part(fine.box(), GetParam(), 3);
  MixtureState wanted(fine.box(), GetParam(), 3);
  MixtureState mean(parents(), GetParam(), 3), mean_image(parents(), GetParam(), 3),
      mean_wanted(parents(), GetParam(), 3);
  fill_with_mixtures(coarse, fluids, 6);
  std::size_t component = 0;
  for (int d = 0; d < 3; ++d) {
    if (!GetParam().active[d]) continue;
    const auto mirror = [&](const MixtureState& from, const MixtureState& to) {
      for_each_cell(from.box(), [&](IntVec3 cell) {
        IntVec3 other = cell;
        other[d] = from.box().lower[d] + from.box().upper[d] - 1 - cell[d];
        for (std::size_t q = 0; q < from.layout().quantities(); ++q)
          to.at(q, other) =
              q == from.layout().momentum(component) ? -from.at(q, cell) : from.at(q, cell);
      });
    };
    mirror(coarse, image);
    for (int order = 0; order <= 2; ++order) {
      prolong(coarse, fine, fine.box(), order);
      IndexBox thin = fine.box();
      thin.lower[d] += 1;
      thin.upper[d] = thin.lower[d] + 3;
      prolong(coarse, part, thin, order);
      EXPECT_EQ(different(fine, part, thin), 0) << "order " << order;
      mirror(fine, wanted);
      prolong(image, part, fine.box(), order);
      EXPECT_EQ(different(part, wanted, fine.box()), 0) << "order " << order;
      restrict_to(fine, mean);
      mirror(mean, mean_wanted);
      restrict_to(wanted, mean_image);
      EXPECT_EQ(different(mean_image, mean_wanted, parents()), 0) << "order " << order;
    }
    ++component;
  }
}

INSTANTIATE_TEST_SUITE_P(Ice, MixtureLevels, testing::ValuesIn(transfer_cases()));

// The pressure of a liquid may be far below what its energy suggests.
TEST(ProlongationOfLiquids, LeavesEveryFineCellAStateOfTheLaw) {
  const TransferCase c{{true, true, false}, {2, 2, 1}, 2};
  eos::Jwl law;
  law.A = 800;
  law.B = 20;
  law.R1 = 4.6;
  law.R2 = 1.3;
  law.rho0 = 1.8;
  const Fluid products{law, std::nullopt, 1.3, 1}, liquid = stiffened_gas(4.4, 600);
  for (const Fluid& fluid : {products, liquid}) {
    const IndexBox parents{{0, 0, 0}, {20, 20, 1}};
    BoxState coarse(with_layer(parents, c), c), fine(refine(parents, c.ratio), c);
    std::mt19937 random(2);
    std::uniform_real_distribution<double> rho(0.1, 2.5), power(-3, 2), speed(-3, 3);
    for_each_cell(coarse.box(), [&](IntVec3 cell) {
      const double u[] = {speed(random), speed(random), 0}, density = rho(random);
      const double T = std::pow(10.0, power(random));
      coarse.fill(density, u, fluid.energy_from_temperature(density, T), cell);
      ASSERT_TRUE(fluid.admissible(coarse.rho(cell), coarse.energy(cell)));
    });
    const IceTransfer transfer(2, false, true, fluid);
    for (int order = 1; order <= 2; ++order) {
      transfer.prolong(coarse.views(), fine.views(), fine.box(), c.geometry(), order);
      int outside = 0, varied = 0;
      double worst = 0;
      for_each_cell(fine.box(), [&](IntVec3 cell) {
        outside += !fluid.admissible(fine.rho(cell), fine.energy(cell));
        varied += fine.rho(cell) != coarse.rho(coarsen(cell, c.ratio));
      });
      for_each_cell(parents, [&](IntVec3 cell) {
        worst = std::max(worst, worst_difference(mean_of(coarse, {cell, cell + IntVec3::all(1)}),
                                                 mean_of(fine, children_of(cell, c))));
      });
      EXPECT_EQ(outside, 0);
      EXPECT_GT(varied, fine.box().volume() / 8);
      EXPECT_LT(worst, round_off);
    }
  }
}

}  // namespace
}  // namespace sluice::ice::mixture_transfer_test
