// Restriction and the correction of fluxes.
#include "ice/test_support/transfer.hpp"

namespace sluice::ice::restrict_test {
namespace {

constexpr double round_off = 2e-15;

class Restricted : public testing::TestWithParam<TransferCase> {
 protected:
  IndexBox cells() const { return coarse_cells(GetParam(), 5); }
  IndexBox fine_cells() const { return refine(cells(), GetParam().ratio); }
  void run(const BoxState& fine, const BoxState& coarse) const { run(fine, coarse, cells()); }
  void run(const BoxState& fine, const BoxState& coarse, const IndexBox& part) const {
    IceTransfer(GetParam().components, false)
        .restrict_to(fine.views(), coarse.views(), part, GetParam().geometry());
  }
};

TEST_P(Restricted, KeepsMassMomentumAndTotalEnergyOfWildStates) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    BoxState fine(fine_cells(), GetParam()), coarse(cells(), GetParam());
    fill_wildly(fine, seed);
    run(fine, coarse);
    for_each_cell(cells(), [&](IntVec3 cell) {
      const IndexBox children = children_of(cell, GetParam());
      EXPECT_LT(worst_difference(mean_of(coarse, {cell, cell + IntVec3::all(1)}),
                                 mean_of(fine, children)),
                round_off);
      double least = fine.energy(children.lower);
      for_each_cell(children, [&](IntVec3 child) { least = std::min(least, fine.energy(child)); });
      EXPECT_GE(coarse.energy(cell), least);
    });
  }
}

TEST_P(Restricted, KeepsTheBitsOfUniformFlow) {
  BoxState fine(fine_cells(), GetParam()), coarse(cells(), GetParam());
  const double u[3] = {1234.1, -0.37, 1e-5};
  for_each_cell(fine.box(), [&](IntVec3 cell) { fine.fill(1.3, u, 0.0071, cell); });
  run(fine, coarse);
  int changed = 0;
  for_each_cell(cells(), [&](IntVec3 cell) {
    for (int q = 0; q < fine.quantities(); ++q)
      changed += !same_bits(coarse.at(q, cell), fine.at(q, fine.box().lower));
  });
  EXPECT_EQ(changed, 0);
}

TEST_P(Restricted, UndoesProlongation) {
  for (int order = 0; order <= 2; ++order) {
    BoxState before(with_layer(cells(), GetParam()), GetParam());
    BoxState fine(fine_cells(), GetParam()), after(cells(), GetParam());
    fill_wildly(before, 5);
    IceTransfer(GetParam().components, false)
        .prolong(before.views(), fine.views(), fine.box(), GetParam().geometry(), order);
    run(fine, after);
    for_each_cell(cells(), [&](IntVec3 cell) {
      const IndexBox one{cell, cell + IntVec3::all(1)};
      Conserved wanted = mean_of(before, one);
      wanted.magnitude = mean_of(fine, children_of(cell, GetParam())).magnitude;
      EXPECT_LT(worst_difference(wanted, mean_of(after, one)), round_off);
    });
  }
}

TEST_P(Restricted, DependsOnNeitherCutsNorMirrors) {
  BoxState fine(fine_cells(), GetParam()), image(fine_cells(), GetParam());
  BoxState whole(cells(), GetParam()), part(cells(), GetParam()), turned(cells(), GetParam());
  fill_wildly(fine, 9);
  run(fine, whole);
  int component = 0;
  for (int d = 0; d < 3; ++d) {
    if (!GetParam().active[d]) continue;
    IndexBox thin = cells();
    thin.upper[d] = thin.lower[d] + 1;
    run(fine, part, thin);
    EXPECT_EQ(different(whole, part, thin), 0);
    const auto reflect = [&](IntVec3 cell, const IndexBox& box) {
      cell[d] = box.lower[d] + box.upper[d] - 1 - cell[d];
      return cell;
    };
    const auto sign = [&](int q) { return q == 1 + component ? -1.0 : 1.0; };
    for_each_cell(fine.box(), [&](IntVec3 cell) {
      for (int q = 0; q < fine.quantities(); ++q)
        image.at(q, reflect(cell, fine.box())) = sign(q) * fine.at(q, cell);
    });
    run(image, turned);
    int changed = 0;
    for_each_cell(cells(), [&](IntVec3 cell) {
      for (int q = 0; q < fine.quantities(); ++q)
        changed += !same_bits(turned.at(q, reflect(cell, cells())), sign(q) * whole.at(q, cell));
    });
    EXPECT_EQ(changed, 0) << "mirrored along " << d;
    ++component;
  }
}

INSTANTIATE_TEST_SUITE_P(Ice, Restricted, testing::ValuesIn(transfer_cases()));

// In 2-D the axes may be exchanged, there and back through prolongation and restriction.
TEST(Transfer, DoesNotTellTheAxesOfAPlaneApart) {
  for (const int ratio : {2, 4}) {
    const TransferCase c{{true, true, false}, {ratio, ratio, 1}, 2};
    const IndexBox parents{{0, 0, 0}, {6, 6, 1}};
    BoxState coarse(with_layer(parents, c), c), swapped(coarse.box(), c);
    fill_wildly(coarse, 21);
    const auto exchange = [](const BoxState& from, const BoxState& to) {
      constexpr int image[] = {0, 2, 1, 3};
      for_each_cell(from.box(), [&](IntVec3 cell) {
        for (int q = 0; q < 4; ++q) to.at(image[q], {cell.y, cell.x, 0}) = from.at(q, cell);
      });
    };
    exchange(coarse, swapped);
    const IceTransfer transfer(2, false);
    for (int order = 0; order <= 2; ++order) {
      BoxState fine(refine(parents, c.ratio), c), other(fine.box(), c), wanted(fine.box(), c);
      transfer.prolong(coarse.views(), fine.views(), fine.box(), c.geometry(), order);
      transfer.prolong(swapped.views(), other.views(), fine.box(), c.geometry(), order);
      exchange(fine, wanted);
      EXPECT_EQ(different(other, wanted, fine.box()), 0) << "order " << order;
      BoxState mean(parents, c), mean_other(parents, c), mean_wanted(parents, c);
      transfer.restrict_to(fine.views(), mean.views(), parents, c.geometry());
      transfer.restrict_to(other.views(), mean_other.views(), parents, c.geometry());
      exchange(mean, mean_wanted);
      EXPECT_EQ(different(mean_other, mean_wanted, parents), 0) << "order " << order;
    }
  }
}

class Correction : public testing::Test {
 protected:
  Correction() { fill_wildly(state_, 17); }

  // Changes by a share of the density, of it times the speed, of the total energy.
  ConservedChange change(double mass, double momentum, double energy) const {
    ConservedChange x;
    x.amount.resize(4);
    for_each_cell(state_.box(), [&](IntVec3 cell) {
      x.cells.push_back(cell);
      x.amount[0].push_back(mass * state_.rho(cell));
      for (int c = 0; c < 2; ++c) x.amount[1 + c].push_back(momentum * state_.momentum(c, cell));
      x.amount[3].push_back(energy * static_cast<double>(state_.total_energy(cell)));
    });
    return x;
  }

  TransferCase case_{{true, true, false}, {2, 2, 1}, 2};
  BoxState state_{{{0, 0, 0}, {7, 5, 1}}, case_};
};

TEST_F(Correction, AddsMassMomentumAndTotalEnergy) {
  const ConservedChange x = change(0.125, 0.125, 0.125);
  std::vector<double> share(x.cells.size(), -1.0);
  std::vector<Conserved> before;
  for (const IntVec3 cell : x.cells)
    before.push_back(mean_of(state_, {cell, cell + IntVec3::all(1)}));
  IceTransfer(2, false).correct(state_.views(), x, share);
  for (std::size_t n = 0; n < x.cells.size(); ++n) {
    EXPECT_EQ(share[n], 1.0);
    Conserved wanted = before[n];
    for (std::size_t q = 0; q < 4; ++q) wanted.value[q] += x.amount[q][n];
    EXPECT_LT(worst_difference(wanted, mean_of(state_, {x.cells[n], x.cells[n] + IntVec3::all(1)})),
              round_off);
  }
}

// Minus three times all that the cell holds: a quarter of that leaves a quarter.
TEST_F(Correction, GivesEachCellTheShareThatItCanBear) {
  const ConservedChange x = change(-3, -3, -3);
  std::vector<double> share(x.cells.size(), -1.0);
  std::vector<double> before;
  for (const IntVec3 cell : x.cells) before.push_back(state_.rho(cell));
  IceTransfer(2, false).correct(state_.views(), x, share);
  for (std::size_t n = 0; n < x.cells.size(); ++n) {
    EXPECT_EQ(share[n], 0.25);
    EXPECT_DOUBLE_EQ(state_.rho(x.cells[n]), 0.25 * before[n]);
  }
}

TEST_F(Correction, LeavesACellThatCanBearNothingAsItWas) {
  BoxState kept(state_.box(), case_);
  for_each_cell(state_.box(), [&](IntVec3 cell) {
    for (int q = 0; q < 4; ++q) kept.at(q, cell) = state_.at(q, cell);
  });
  for (const double bad : {-1e9, std::nan("")}) {
    const ConservedChange x = change(0, 0, bad);
    std::vector<double> share(x.cells.size(), -1.0);
    IceTransfer(2, false).correct(state_.views(), x, share);
    for (const double s : share) EXPECT_EQ(s, 0.0);
    EXPECT_EQ(different(kept, state_, state_.box()), 0);
  }
}

TEST_F(Correction, OfTheClassicFormChangesInternalEnergyAlone) {
  const ConservedChange x = change(0.25, 0, 0);
  std::vector<double> share(x.cells.size(), -1.0), energy;
  for (const IntVec3 cell : x.cells) energy.push_back(state_.energy(cell));
  IceTransfer(2, true).correct(state_.views(), x, share);
  for (std::size_t n = 0; n < x.cells.size(); ++n) {
    EXPECT_EQ(share[n], 1.0);
    EXPECT_EQ(state_.energy(x.cells[n]), energy[n]);
  }
}

}  // namespace
}  // namespace sluice::ice::restrict_test
