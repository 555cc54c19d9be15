// A variable that names a folder, one that is empty, and one that is not there.
#include "framework/base/test_support/environment.hpp"

#include <gtest/gtest.h>

#include "framework/base/test_support/with_variable.hpp"

namespace sluice::environment_test {
namespace {

constexpr const char* variable = "SLUICE_ENVIRONMENT_TEST";

TEST(Environment, a_variable_names_a_folder) {
  const WithVariable set(variable, "/some/folder");
  EXPECT_EQ(folder_in_environment(variable), std::filesystem::path("/some/folder"));
}

TEST(Environment, an_empty_variable_counts_as_unset) {
  const WithVariable set(variable, "");
  ASSERT_NE(std::getenv(variable), nullptr);
  EXPECT_FALSE(folder_in_environment(variable));
}

TEST(Environment, a_variable_that_is_not_there_names_nothing) {
  { const WithVariable set(variable, "/some/folder"); }
  ASSERT_EQ(std::getenv(variable), nullptr);
  EXPECT_FALSE(folder_in_environment(variable));
}

}  // namespace
}  // namespace sluice::environment_test
