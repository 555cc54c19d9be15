// Temporary folders come, are one's own, and go.
#include "framework/base/temporary_folder.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "framework/base/error.hpp"
#include "framework/base/test_support/with_variable.hpp"

namespace sluice::temporary_folder_test {
namespace {

namespace fs = std::filesystem;
using Place = TemporaryFolder::Place;

TEST(TemporaryFolder, goes_away_with_all_that_is_in_it) {
  fs::path path;
  for (const Place place : {Place::memory, Place::disk}) {
    {
      const TemporaryFolder one(place), other(place);
      path = one.path();
      EXPECT_NE(path, other.path());
      fs::create_directories(one / "deep" / "er");
      std::ofstream(one / "file") << "text";
      EXPECT_TRUE(fs::exists(path / "file"));
    }
    EXPECT_FALSE(fs::exists(path));
  }
}

TEST(TemporaryFolder, lies_where_TMPDIR_says) {
  const TemporaryFolder outer;
  const WithVariable tmpdir("TMPDIR", outer.path());
  const TemporaryFolder inner(Place::disk);
  EXPECT_EQ(inner.path().parent_path(), outer.path());
}

TEST(TemporaryFolder, says_which_folder_is_missing) {
  const TemporaryFolder outer;
  const WithVariable tmpdir("TMPDIR", outer / "nowhere");
  EXPECT_THAT([] { TemporaryFolder folder(Place::disk); },
              testing::ThrowsMessage<SystemError>(
                  testing::AllOf(testing::HasSubstr("nowhere"), testing::HasSubstr("set TMPDIR"))));
}

}  // namespace
}  // namespace sluice::temporary_folder_test
