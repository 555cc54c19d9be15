// Tables of the coefficient of a decay.
#include "models/scalars/exponential_decay.hpp"

#include <gtest/gtest.h>

#include <fstream>

#include "framework/base/error.hpp"
#include "framework/base/temporary_folder.hpp"

namespace sluice::models::exponential_decay_test {
namespace {

Level level_of(IntVec3 cells, Vec3 spacing) {
  Level level;
  level.domain = {{0, 0, 0}, cells};
  level.spacing = spacing;
  return level;
}

TEST(CellNumbers, HaveWhatTheFileSaysOfTheirCells) {
  const TemporaryFolder folder;
  const std::string file = (folder.path() / "c.csv").string();
  std::ofstream(file) << "0.5,0.5,0.5,3\n1.5 0.5 0.5 4\n1.25,0.25,0.75,6\n9,9,9,100\n";
  const CellNumbers numbers(level_of({2, 2, 1}, {1, 1, 1}), file);
  EXPECT_EQ(numbers.at({0.1, 0.9, 0.2}), 3);
  EXPECT_EQ(numbers.at({1.9, 0.5, 0.5}), 5);   // the mean of two
  EXPECT_EQ(numbers.at({0.5, 1.5, 0.5}), 0);   // no line
  EXPECT_EQ(numbers.at({-0.5, 0.5, 0.5}), 3);  // beyond: the nearest
}

TEST(CellNumbers, FilesWithoutNumbersAreRefused) {
  const TemporaryFolder folder;
  const std::string file = (folder.path() / "c.csv").string();
  EXPECT_THROW(CellNumbers(level_of({2, 2, 1}, {1, 1, 1}), file), InputError);
  std::ofstream(file) << "1,2,3\n";
  EXPECT_THROW(CellNumbers(level_of({2, 2, 1}, {1, 1, 1}), file), InputError);
}

}  // namespace
}  // namespace sluice::models::exponential_decay_test
