// The table of components.
#include "app/loading/components.hpp"

#include <gtest/gtest.h>

#include <set>

namespace sluice::components_test {
namespace {

// Rows of the same tags, labels and histories may leave them to one another; all can be made.
TEST(Components, EachCanBeMadeAndIsNamedOnce) {
  std::set<std::string> words = {"switcher"};
  for (const ComponentKind& kind : component_kinds()) {
    EXPECT_NE(kind.make, nullptr) << kind.type;
    EXPECT_TRUE(words.insert(kind.type).second) << kind.type;
    for (const char* spelling : kind.spellings) EXPECT_TRUE(words.insert(spelling).second);
  }
}

}  // namespace
}  // namespace sluice::components_test
