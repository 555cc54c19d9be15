// The table of components and the word of decks say the same.
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

TEST(Components, AreTheWordsOfTheDeck) {
  Schema schema;
  add_framework_tags(schema);
  const ValueSpec& value = type_of_component(schema).value;
  std::multiset<std::string> words(value.words.begin(), value.words.end()), kinds;
  for (const ComponentKind& kind : component_kinds()) kinds.insert(kind.type);
  kinds.insert("switcher");  // runs others of them in turn
  EXPECT_EQ(words, kinds);
  for (const std::string& name : value.words_not_built) EXPECT_EQ(kinds.count(name), 0U) << name;
}

}  // namespace
}  // namespace sluice::components_test
