// The table of components.
#include "app/loading/components.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "framework/deck/format/framework_schema.hpp"

namespace sluice::components_test {
namespace {

const AttributeSpec& type_of_component(const Schema& schema) {
  const auto& tags = schema.root.children;
  return std::find_if(tags.begin(), tags.end(),
                      [](const TagSpec& tag) { return tag.name == "SimulationComponent"; })
      ->attributes.front();
}

TEST(Components, NoneIsAlsoAmongThoseThatAreNotSupported) {
  Schema schema;
  add_framework_tags(schema, component_words());
  const ValueSpec& value = type_of_component(schema).value;
  ASSERT_FALSE(value.words_not_built.empty());
  for (const std::string& name : value.words_not_built)
    for (const ComponentWord& c : component_words()) {
      EXPECT_NE(c.word, name);
      EXPECT_EQ(std::count(c.spellings.begin(), c.spellings.end(), name), 0) << c.word;
    }
}

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
