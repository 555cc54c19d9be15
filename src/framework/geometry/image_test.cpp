// Bodies from images: voxels by their places, thresholds, covers that agree with points.
#include "framework/geometry/image.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "framework/base/error.hpp"
#include "framework/geometry/sampling.hpp"

namespace sluice::image_test {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

const Bounds box = {{0, 0, 0}, {3, 2, 1}};

TEST(ImagePiece, HasTheVoxelsBetweenItsThresholds) {
  const ImagePiece piece(std::string("\x00\x64\xff\x32\x65\x80", 6), {3, 2, 1}, 100, 200, box);
  EXPECT_FALSE(piece.inside({0.5, 0.5, 0.5}));
  EXPECT_TRUE(piece.inside({1.5, 0.5, 0.5}));   // 0x64 = 100
  EXPECT_FALSE(piece.inside({2.5, 0.5, 0.5}));  // 0xff
  EXPECT_FALSE(piece.inside({0.5, 1.5, 0.5}));
  EXPECT_TRUE(piece.inside({1.5, 1.5, 0.5}));
  EXPECT_TRUE(piece.inside({3, 2, 1}));  // the upper corner belongs to the last voxel
  EXPECT_FALSE(piece.inside({3.1, 1.5, 0.5}));
}

TEST(ImagePiece, FillsCellsAsItsVoxelsDo) {
  std::string voxels;
  int filled = 0;
  for (int n = 0; n < 16 * 16 * 16; ++n) {
    const bool on = (n / 256 + n % 16 / 3 + n / 16 % 16) % 3 == 0;
    voxels += on ? '\x7f' : '\x00';
    filled += on;
  }
  const ImagePiece piece(voxels, {16, 16, 16}, 1, 255, {{0, 0, 0}, {1, 1, 1}});
  const CellLattice lattice{{0, 0, 0}, {0.25, 0.25, 0.25}};
  int counted = 0;
  for (const auto n : count_inside(piece, lattice, {-1, -1, -1}, {5, 5, 5}, {4, 4, 4}))
    counted += n;
  EXPECT_EQ(counted, filled);
}

TEST(ImagePiece, RefusesWhatDoesNotFit) {
  EXPECT_THAT(
      [] {
        ImagePiece("abc", {2, 2, 1}, 0, 255, box);
      },
      ThrowsMessage<InputError>(HasSubstr("3 bytes, but res [2, 2, 1] needs 4")));
  EXPECT_THAT(
      [] {
        ImagePiece("abcd", {2, 2, 1}, 9, 3, box);
      },
      ThrowsMessage<InputError>(HasSubstr("no grey value lies in the threshold [9, 3]")));
}

}  // namespace
}  // namespace sluice::image_test
