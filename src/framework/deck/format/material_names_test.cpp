// Names of materials in models and analyses.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "framework/deck/faults.hpp"
#include "framework/deck/format/framework_schema.hpp"

namespace sluice::material_names_test {
namespace {

std::unique_ptr<DeckNode> node(const std::string& name, const std::string& text = {}) {
  auto made = std::make_unique<DeckNode>();
  made->name = name;
  made->text = text;
  return made;
}

// A deck whose materials are called so, with a model that names one.
struct Settled {
  std::string name, told;
};
Settled settled(const std::vector<std::string>& materials, const std::string& named) {
  DeckNode root;
  auto method = node("ICE");
  for (const std::string& m : materials) {
    auto material = node("material");
    material->attributes.push_back({"name", m});
    method->children.push_back(std::move(material));
  }
  auto properties = node("MaterialProperties");
  properties->children.push_back(std::move(method));
  auto models = node("Models");
  models->children.push_back(node("fromMaterial", named));
  root.children.push_back(std::move(properties));
  root.children.push_back(std::move(models));
  std::vector<Fault> faults;
  settle_material_names(root, faults);
  Settled s{root.children.back()->children.front()->text, ""};
  for (const Fault& f : faults) s.told += f.message;
  return s;
}

TEST(MaterialNames, AreReadWithoutRegardToCapitals) {
  const Settled s = settled({"Reactant", "product"}, "reactanT");
  EXPECT_EQ(s.name, "Reactant");
  EXPECT_THAT(s.told, testing::HasSubstr("'reactanT' is read as the material 'Reactant'"));
}

TEST(MaterialNames, ThatAreExactStayWithoutAWord) {
  for (const char* name : {"gas", "GAS"}) {
    const Settled s = settled({"gas", "GAS"}, name);
    EXPECT_EQ(s.name, name);
    EXPECT_EQ(s.told, "");
  }
}

TEST(MaterialNames, ThatCouldBeTwoAreLeftToBeRefused) {
  const Settled s = settled({"gas", "GAS"}, "Gas");
  EXPECT_EQ(s.name, "Gas");
  EXPECT_EQ(s.told, "");
}

}  // namespace
}  // namespace sluice::material_names_test
