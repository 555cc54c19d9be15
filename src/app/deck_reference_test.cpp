// docs/deck_reference.md is what the schema says, and the schema's own defaults are valid.
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <set>

#include "app/loading/sluice_schema.hpp"
#include "framework/deck/deck_help.hpp"
#include "framework/deck/schema_check.hpp"
#include "sluice_source_dir.hpp"

namespace sluice::deck_reference_test {
namespace {

TEST(DeckReference, PageIsUpToDate) {
  std::ifstream file(SLUICE_SOURCE_DIR "/docs/deck_reference.md");
  const std::string page{std::istreambuf_iterator<char>(file), {}};
  EXPECT_EQ(page, markdown_reference(sluice_schema()))
      << "write it anew: sluice help --markdown > docs/deck_reference.md";
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

TEST(DeckHelp, FindsTagsByNameByPathAndByAlias) {
  const Schema schema = sluice_schema();
  EXPECT_NE(help_on(schema, "CFD/cfl").find("greater than 0 and at most 1"), std::string::npos);
  EXPECT_NE(help_on(schema, "material/gamma").find("MaterialProperties/ICE/material/gamma"),
            std::string::npos);
  EXPECT_NE(help_on(schema, "max_Timestep").find("Time/max_Timesteps"), std::string::npos);
  EXPECT_NE(help_on(schema, "MaterialProperties/ICE/material/geom_object/union/box").find("min"),
            std::string::npos);
}

TEST(DeckHelp, NamesTheNearestTagAndWhatIsNotBuilt) {
  const Schema schema = sluice_schema();
  const auto message = [&](const char* name) {
    try {
      return help_on(schema, name);
    } catch (const std::exception& problem) {
      return std::string(problem.what());
    }
  };
  EXPECT_NE(message("gama").find("did you mean 'gamma'"), std::string::npos);
  EXPECT_NE(message("RMCRT").find("not supported yet"), std::string::npos);
}

}  // namespace
}  // namespace sluice::deck_reference_test
