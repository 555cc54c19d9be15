// docs/deck_reference.md is what the schema says, and the schema's own defaults are valid.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>

#include "app/loading/sluice_schema.hpp"
#include "framework/deck/help/deck_pages.hpp"
#include "framework/deck/schema_check.hpp"
#include "sluice_source_dir.hpp"

namespace sluice::deck_reference_test {
namespace {

TEST(DeckReference, PagesAreUpToDate) {
  std::set<std::string> written;
  for (const ReferencePage& page : reference_pages(sluice_schema())) {
    std::ifstream file(SLUICE_SOURCE_DIR "/docs/" + page.file);
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    EXPECT_EQ(text, page.text) << page.file << ": write it anew with sluice help --markdown docs";
    EXPECT_TRUE(written.insert(page.file).second) << page.file << " twice";
  }
  for (const auto& entry : std::filesystem::directory_iterator(SLUICE_SOURCE_DIR "/docs/deck"))
    EXPECT_EQ(written.count("deck/" + entry.path().filename().string()), 1u) << entry.path();
}

// Visits every tag once, a group's members too.
void check_spec(const Schema& schema, const TagSpec& spec, const std::string& path,
                std::set<std::string>& groups) {
  const auto check_default = [&](const ValueSpec& value, const std::string& name) {
    if (!value.default_text) return;
    std::string text = *value.default_text;
    EXPECT_EQ(judge_value(value, text).problem, "") << path << " " << name;
  };
  EXPECT_FALSE(spec.doc.empty()) << path;
  check_default(spec.value, "");
  std::set<std::string> names;
  for (const AttributeSpec& attribute : spec.attributes) {
    EXPECT_FALSE(attribute.doc.empty()) << path << " @" << attribute.name;
    EXPECT_TRUE(names.insert(attribute.name).second) << path << " @" << attribute.name << " twice";
    check_default(attribute.value, attribute.name);
  }
  names.clear();
  for (const TagSpec* child : schema.children(spec)) {
    EXPECT_TRUE(names.insert(child->name).second) << path << '/' << child->name << " twice";
  }
  for (const TagSpec& child : spec.children) {
    check_spec(schema, child, path + '/' + child.name, groups);
  }
  for (const std::string& group : spec.groups) {
    if (!groups.insert(group).second) continue;
    for (const TagSpec& member : schema.groups.at(group)) {
      check_spec(schema, member, group + '/' + member.name, groups);
    }
  }
}

TEST(DeckReference, EveryTagIsDescribedOnceWithValidDefaults) {
  const Schema schema = sluice_schema();
  std::set<std::string> groups;
  check_spec(schema, schema.root, "", groups);
  EXPECT_EQ(groups, std::set<std::string>{"geometry_piece"});
}

}  // namespace
}  // namespace sluice::deck_reference_test
