// Matrices of blocks against dense ones: products, diagonals, coarse matrices, numbers of nodes.
#include "framework/solve/block/block_rows.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "framework/solve/block/block_coarsening.hpp"
#include "framework/solve/block/block_diagonal.hpp"
#include "framework/solve/block/block_test_support.hpp"

namespace sluice::solve::block_rows_test {
namespace {

constexpr double round_off = 1e-13;

// Cells in one, two and three directions.
class Dimensions : public testing::TestWithParam<IntVec3> {};

TEST_P(Dimensions, ProductsAreThoseOfTheDenseMatrix) {
  const BlockRows rows = elastic_rows({.cells = GetParam(), .skew = 0.2});
  const std::vector<double> x = right_side(rows);
  std::vector<double> y(x.size());
  multiply(rows, {}, x, y);
  EXPECT_LT(distance(y, product(dense(rows), x)), round_off * size_of(y));
}

TEST_P(Dimensions, RoundedProductsAreThoseOfRoundedNumbers) {
  BlockRows rows = elastic_rows({.cells = GetParam(), .bulk = 1.0 / 3, .shear = 0.3});
  const std::vector<double> x = right_side(rows);
  std::vector<double> y(x.size()), exact(x.size());
  RoundedRows rounded;
  rounded.round(rows, {});
  rounded.multiply({}, x, y);
  multiply(rows, {}, x, exact);
  EXPECT_GT(distance(y, exact), 0);
  EXPECT_LT(distance(y, exact), 1e-7 * size_of(exact));
  for (double& v : rows.value) v = static_cast<float>(v);
  multiply(rows, {}, x, exact);
  EXPECT_EQ(y, exact);
}

TEST_P(Dimensions, DiagonalBlocksAreInverted) {
  const BlockRows rows = elastic_rows({.cells = GetParam(), .held = false});
  BlockDiagonal diagonal;
  diagonal.invert(rows);
  const std::vector<double> x = right_side(rows);
  std::vector<double> y(x.size());
  diagonal.apply({}, x, y);
  const auto w = static_cast<std::size_t>(rows.width);
  for (std::size_t i = 0; i < rows.count(); ++i) {
    const double* block = rows.find(i, static_cast<std::int32_t>(i));
    for (std::size_t a = 0; a < w; ++a) {
      double back = 0;
      for (std::size_t b = 0; b < w; ++b) back += block[w * a + b] * y[w * i + b];
      EXPECT_NEAR(back, x[w * i + a], 10 * round_off);
    }
  }
}

TEST_P(Dimensions, CoarseMatricesAreProductsOfDenseOnes) {
  const BlockRows rows = elastic_rows({.cells = GetParam(), .skew = 0.1});
  const Interpolation between = interpolation_between(rows.place);
  const std::size_t coarse = static_cast<std::size_t>(rows.width) * between.coarse.size();
  Dense P(rows.unknowns(), coarse);
  std::vector<double> one(coarse);
  for (std::size_t c = 0; c < coarse; ++c) {
    std::vector<double> fine(rows.unknowns());
    one[c] = 1;
    between.add_to_fine({}, rows.width, one, fine);
    one[c] = 0;
    for (std::size_t i = 0; i < fine.size(); ++i) P(i, c) = fine[i];
  }
  const Dense A = dense(rows), exact = product(transposed(P), product(A, P)),
              found = dense(galerkin_product(rows, between, {}));
  EXPECT_LT(distance(found.value, exact.value), round_off * size_of(A.value));
  std::vector<double> sums(coarse);
  const std::vector<double> x = right_side(rows);
  between.sum_to_coarse({}, rows.width, x, sums);
  EXPECT_LT(distance(sums, product(transposed(P), x)), round_off * size_of(x));
}

INSTANTIATE_TEST_SUITE_P(BlockRows, Dimensions,
                         testing::Values(IntVec3{9, 0, 0}, IntVec3{5, 4, 0}, IntVec3{3, 4, 5}));

// A field that is linear in space is the same on the fine and on the coarse grid.
TEST(Interpolation, LinearFieldsAreExact) {
  const std::vector<IntVec3> fine = nodes_of({5, 4, 3});
  const Interpolation between = interpolation_between(fine);
  const auto field = [](IntVec3 i, int spacing) {
    return 1 + 0.5 * spacing * i.x - 0.25 * spacing * i.y + 2.0 * spacing * i.z;
  };
  std::vector<double> coarse, x(fine.size());
  for (const IntVec3 i : between.coarse) coarse.push_back(field(i, 2));
  between.add_to_fine({}, 1, coarse, x);
  for (std::size_t i = 0; i < fine.size(); ++i) EXPECT_EQ(x[i], field(fine[i], 1));
}

// Directions without stiffness have the inverse 0.
TEST(BlockDiagonal, BlocksWithoutFullRankGetAPseudoInverse) {
  BlockRows rows;
  rows.place = {{0, 0, 0}};
  rows.begin = {0, 1};
  rows.column = {0};
  constexpr double a[3] = {1, 2, 2};  // of length 3: 4 a a^T has the inverse a a^T/324
  rows.value.resize(9);
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) rows.value[3 * i + j] = 4 * a[i] * a[j];
  BlockDiagonal diagonal;
  diagonal.invert(rows);
  std::vector<double> y(3);
  diagonal.apply({}, std::vector<double>{1, 2, 2}, y);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(y[i], a[i] / 36, round_off);
  diagonal.apply({}, std::vector<double>{2, -1, 0}, y);  // normal to it
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(y[i], 0, round_off);
}

TEST(NodeNumbers, RiseAlongXYZAndKnowWhatIsMarked) {
  NodeNumbers numbers({-3, 2, 0}, {30, 20, 1});
  for (const IntVec3 i : {IntVec3{29, 2, 0}, {-3, 19, 0}, {5, 2, 0}, {5, 2, 0}}) numbers.mark(i);
  const std::vector<IntVec3> nodes = numbers.number();
  EXPECT_EQ(nodes, (std::vector<IntVec3>{{5, 2, 0}, {29, 2, 0}, {-3, 19, 0}}));
  EXPECT_EQ(numbers({29, 2, 0}), 1);
  EXPECT_EQ(numbers({-3, 19, 0}), 2);
  for (const IntVec3 i : {IntVec3{6, 2, 0}, {-4, 19, 0}, {5, 2, 1}, {30, 2, 0}})
    EXPECT_EQ(numbers(i), -1);
}

TEST(BlockRows, SymmetricPartIsThatOfTheDenseMatrix) {
  const BlockRows rows = elastic_rows({.cells = {3, 3, 0}, .skew = 0.3});
  const Dense A = dense(rows), half = dense(symmetric_part(rows));
  for (std::size_t i = 0; i < A.rows; ++i)
    for (std::size_t j = 0; j < A.columns; ++j) EXPECT_EQ(half(i, j), 0.5 * (A(i, j) + A(j, i)));
}

}  // namespace
}  // namespace sluice::solve::block_rows_test
