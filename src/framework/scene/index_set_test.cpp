// Index sets: lists, ranges, counting from the end.
#include "framework/scene/index_set.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "framework/base/error.hpp"

namespace sluice::index_set_test {
namespace {

std::vector<int> members(std::string_view text, int count) {
  const IndexSet set = read_index_set(text);
  std::vector<int> found;
  for (int i = 0; i < count; ++i)
    if (set.contains(i, count)) found.push_back(i);
  return found;
}

TEST(IndexSet, ListsRangesAndCountsFromTheEnd) {
  EXPECT_EQ(members("0, 2-4", 8), (std::vector<int>{0, 2, 3, 4}));
  EXPECT_EQ(members("-1", 3), (std::vector<int>{2}));
  EXPECT_EQ(members("0,-1", 4), (std::vector<int>{0, 3}));
  EXPECT_EQ(members("7", 3), (std::vector<int>{}));
}

TEST(IndexSet, EmptyMeansEverything) {
  EXPECT_TRUE(read_index_set("").all());
  EXPECT_EQ(members(" ", 3), (std::vector<int>{0, 1, 2}));
  EXPECT_FALSE(read_index_set("1").all());
}

TEST(IndexSet, FaultsShowTheText) {
  EXPECT_THAT([] { read_index_set("0, x"); },
              testing::ThrowsMessage<InputError>(testing::HasSubstr("'0, x'")));
}

}  // namespace
}  // namespace sluice::index_set_test
