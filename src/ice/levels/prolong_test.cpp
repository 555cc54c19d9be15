// Prolongation: conservation, admissibility, uniform states, contacts, order, independence of cuts.
#include "ice/test_support/transfer.hpp"

namespace sluice::ice::prolong_test {
namespace {

constexpr double round_off = 2e-15;

class Prolongation : public testing::TestWithParam<TransferCase> {
 protected:
  IndexBox parents(int n) const { return coarse_cells(GetParam(), n); }
  IndexBox fine_cells(int n) const { return refine(parents(n), GetParam().ratio); }
  void prolong(const BoxState& coarse, const BoxState& fine, const IndexBox& cells,
               int order) const {
    IceTransfer(GetParam().components, false)
        .prolong(coarse.views(), fine.views(), cells, GetParam().geometry(), order);
  }
};

TEST_P(Prolongation, KeepsMassMomentumAndTotalEnergyOfWildStates) {
  for (unsigned seed = 1; seed <= 20; ++seed) {
    BoxState coarse(with_layer(parents(5), GetParam()), GetParam());
    BoxState fine(fine_cells(5), GetParam());
    fill_wildly(coarse, seed);
    for (int order = 0; order <= 2; ++order) {
      prolong(coarse, fine, fine.box(), order);
      for_each_cell(parents(5), [&](IntVec3 cell) {
        const IndexBox children = children_of(cell, GetParam());
        EXPECT_LT(worst_difference(mean_of(coarse, {cell, cell + IntVec3::all(1)}),
                                   mean_of(fine, children)),
                  round_off)
            << "order " << order << " seed " << seed;
        for_each_cell(children, [&](IntVec3 child) {
          ASSERT_GE(fine.rho(child), 0.24 * coarse.rho(cell));
          ASSERT_GE(fine.energy(child), 0.12 * coarse.energy(cell));
        });
      });
    }
  }
}

TEST_P(Prolongation, KeepsTheBitsOfUniformFlow) {
  BoxState coarse(with_layer(parents(4), GetParam()), GetParam());
  BoxState fine(fine_cells(4), GetParam());
  const double u[3] = {1234.1, -0.37, 1e-5};
  for_each_cell(coarse.box(), [&](IntVec3 cell) { coarse.fill(1.3, u, 0.0071, cell); });
  for (int order = 0; order <= 2; ++order) {
    prolong(coarse, fine, fine.box(), order);
    int changed = 0;
    for_each_cell(fine.box(), [&](IntVec3 cell) {
      for (int q = 0; q < fine.quantities(); ++q)
        changed += !same_bits(fine.at(q, cell), coarse.at(q, parents(4).lower));
    });
    EXPECT_EQ(changed, 0) << "order " << order;
  }
}

TEST_P(Prolongation, KeepsVelocityAndPressureUniformAcrossContacts) {
  BoxState coarse(with_layer(parents(5), GetParam()), GetParam());
  BoxState fine(fine_cells(5), GetParam());
  const double u[3] = {0.3, -1.7, 0.11};
  std::mt19937 random(7);
  std::uniform_real_distribution<double> power(-3, 3);
  for_each_cell(coarse.box(),
                [&](IntVec3 cell) { coarse.fill(std::pow(10.0, power(random)), u, 2.5, cell); });
  for (int order = 0; order <= 2; ++order) {
    prolong(coarse, fine, fine.box(), order);
    for_each_cell(fine.box(), [&](IntVec3 cell) {
      EXPECT_NEAR(fine.energy(cell), 2.5, 2.5 * 4e-15);
      for (int c = 0; c < fine.components(); ++c)
        EXPECT_NEAR(fine.momentum(c, cell) / fine.rho(cell), u[c], 1e-14);
    });
  }
}

// A ghost rectangle must not show in the values: neither its place nor along what it is long.
TEST_P(Prolongation, DependsOnTheCoarseCellsAlone) {
  BoxState coarse(with_layer(parents(9), GetParam()), GetParam());
  BoxState whole(fine_cells(9), GetParam()), part(fine_cells(9), GetParam());
  fill_wildly(coarse, 3);
  for (int order = 0; order <= 2; ++order) {
    prolong(coarse, whole, whole.box(), order);
    for (int d = 0; d < 3; ++d) {
      if (!GetParam().active[d]) continue;
      IndexBox thin = whole.box();
      thin.lower[d] += 1;
      thin.upper[d] = thin.lower[d] + 3;
      prolong(coarse, part, thin, order);
      EXPECT_EQ(different(whole, part, thin), 0) << "order " << order << " direction " << d;
    }
  }
}

// Between two states in time the fine cells come from coarse ones that are blended.
TEST_P(Prolongation, OfTwoStatesIsThatOfTheirBlend) {
  const TransferCase& c = GetParam();
  BoxState before(with_layer(parents(9), c), c), after(before.box(), c), blend(before.box(), c);
  BoxState expected(fine_cells(9), c), fine(fine_cells(9), c);
  fill_wildly(before, 5);
  fill_wildly(after, 6);
  const double share = 0.25;
  for_each_cell(before.box(), [&](IntVec3 cell) {
    for (int q = 0; q < before.quantities(); ++q)
      blend.at(q, cell) = (1 - share) * before.at(q, cell) + share * after.at(q, cell);
  });
  const IceTransfer transfer(c.components, false);
  ASSERT_TRUE(transfer.blends());
  const sluice::Prolongation both{&before.views(), &fine.views(), fine.box(), &after.views(),
                                  share};
  for (int order = 0; order <= 2; ++order) {
    prolong(blend, expected, expected.box(), order);
    transfer.prolong_all({&both, 1}, c.geometry(), order);
    EXPECT_EQ(different(expected, fine, fine.box()), 0) << "order " << order;
  }
}

IntVec3 mirrored(IntVec3 cell, int d, const IndexBox& box) {
  cell[d] = box.lower[d] + box.upper[d] - 1 - cell[d];
  return cell;
}

void mirror(const BoxState& from, const BoxState& to, int d, const TransferCase& c) {
  int component = -1, next = 0;
  for (int e = 0; e < 3; ++e) {
    if (!c.active[e]) continue;
    if (e == d) component = next;
    ++next;
  }
  for_each_cell(from.box(), [&](IntVec3 cell) {
    for (int q = 0; q < from.quantities(); ++q)
      to.at(q, mirrored(cell, d, from.box())) =
          q == 1 + component ? -from.at(q, cell) : from.at(q, cell);
  });
}

TEST_P(Prolongation, OfAMirrorImageIsTheMirrorImage) {
  BoxState coarse(with_layer(parents(6), GetParam()), GetParam());
  BoxState image(coarse.box(), GetParam());
  BoxState fine(fine_cells(6), GetParam()), fine_image(fine.box(), GetParam()),
      wanted(fine.box(), GetParam());
  fill_wildly(coarse, 11);
  for (int d = 0; d < 3; ++d) {
    if (!GetParam().active[d]) continue;
    mirror(coarse, image, d, GetParam());
    for (int order = 0; order <= 2; ++order) {
      prolong(coarse, fine, fine.box(), order);
      prolong(image, fine_image, fine.box(), order);
      mirror(fine, wanted, d, GetParam());
      EXPECT_EQ(different(fine_image, wanted, fine.box()), 0) << "order " << order;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Ice, Prolongation, testing::ValuesIn(transfer_cases()));

// Averages over cells of smooth monotone functions: rho, momenta and total energy.
void fill_smoothly(BoxState& state, double spacing, const TransferCase& c) {
  const double point = std::sqrt(0.6), points[3] = {-point, 0, point};
  const double weights[3] = {5.0 / 18, 8.0 / 18, 5.0 / 18};
  for_each_cell(state.box(), [&](IntVec3 cell) {
    double rho = 0, m[3] = {0, 0, 0}, total = 0;
    for (int j = 0; j < 3; ++j)
      for (int i = 0; i < 3; ++i) {
        if (!c.active[1] && j != 1) continue;
        const double x = (cell.x + 0.5 + 0.5 * points[i]) * spacing;
        const double y = c.active[1] ? (cell.y + 0.5 + 0.5 * points[j]) * spacing : 0.0;
        const double w = weights[i] * (c.active[1] ? weights[j] : 1.0);
        const double r = std::exp(0.6 * x + 0.4 * y), p = 1 + std::exp(0.7 * x + 0.5 * y);
        const double u[3] = {std::exp(0.3 * x + 0.5 * y), std::exp(0.2 * x + 0.7 * y), 0};
        rho += w * r;
        double square = 0;
        for (int q = 0; q < c.components; ++q) {
          m[q] += w * r * u[q];
          square += u[q] * u[q];
        }
        total += w * (p / 0.4 + 0.5 * r * square);
      }
    state.rho(cell) = rho;
    double square = 0;
    for (int q = 0; q < c.components; ++q) {
      state.momentum(q, cell) = m[q];
      square += m[q] * m[q];
    }
    state.energy(cell) = total - 0.5 * square / rho;
  });
}

// Largest error of any quantity on a unit domain of n coarse cells a direction.
double error_of_prolongation(const TransferCase& c, int n, int order) {
  IndexBox parents{{0, 0, 0}, {n, c.active[1] ? n : 1, 1}};
  BoxState coarse(with_layer(parents, c), c);
  BoxState fine(refine(parents, c.ratio), c), exact(fine.box(), c);
  fill_smoothly(coarse, 1.0 / n, c);
  fill_smoothly(exact, 1.0 / (n * c.ratio.x), c);
  IceTransfer(c.components, false)
      .prolong(coarse.views(), fine.views(), fine.box(), c.geometry(), order);
  double worst = 0;
  for_each_cell(fine.box(), [&](IntVec3 cell) {
    for (int q = 0; q < fine.quantities(); ++q)
      worst = std::max(worst, std::fabs(fine.at(q, cell) - exact.at(q, cell)));
  });
  return worst;
}

TEST(ProlongationOrder, IsOneTwoAndThreeOnSmoothData) {
  const TransferCase cases[] = {{{true, false, false}, {2, 1, 1}, 2},
                                {{true, false, false}, {4, 1, 1}, 1},
                                {{true, true, false}, {2, 2, 1}, 2},
                                {{true, true, false}, {4, 4, 1}, 2}};
  for (const TransferCase& c : cases)
    for (int order = 0; order <= 2; ++order) {
      const double coarse = error_of_prolongation(c, 16, order);
      const double fine = error_of_prolongation(c, 32, order);
      EXPECT_GT(std::log2(coarse / fine), order + 0.9)
          << "order " << order << " ratio " << c.ratio.x << ": " << coarse << " " << fine;
    }
}

}  // namespace
}  // namespace sluice::ice::prolong_test
