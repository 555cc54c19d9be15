// What ranks come to behind the exchange: books and rates where all is well, nothing else.
#include "mpmice/step/cells_agreement.hpp"

#include <gtest/gtest.h>

#include "mpmice/test_support/block_in_cells.hpp"

namespace sluice::mpmice::cells_agreement_test {
namespace {

TEST(CellsAgreement, TakesBooksAndRatesOnceAllIsWell) {
  BlockInCells<1> block(16, 1, 5, 8);
  block.give(block.columns().velocity, -3);
  CoupledDeck deck;
  deck.drag = "1";
  const GivenFluid fluid(deck);
  const SurfaceExchange<1> exchange(fluid.part(), block.solids.kinds());
  CellsAgreement<1> agreement(block.solids, exchange);
  CouplingBooks books;
  books.of_work(Booked::work).add(5);
  std::vector<double> sums(10, 0.0);
  const CellRates rates{1, 2, 3};
  EXPECT_TRUE(
      agreement.find(block.sets, {true, false, false}, rates, books, sums, world()).trapped);
  EXPECT_TRUE(
      agreement.find(block.sets, {false, true, false}, rates, books, sums, world()).inadmissible);
  EXPECT_EQ(sums[6], 0);
  EXPECT_TRUE(
      agreement.find(block.sets, {false, false, true}, rates, books, sums, world()).strayed);
  EXPECT_FALSE(agreement.find(block.sets, {}, rates, books, sums, world()).any());
  EXPECT_EQ(sums[6], 5);
  EXPECT_EQ(agreement.rates().flow, 2);
  EXPECT_EQ(block.solids.most[0], -3);  // exchange has changed velocities
  EXPECT_EQ(block.solids.most_negative[0], 3);
}

}  // namespace
}  // namespace sluice::mpmice::cells_agreement_test
