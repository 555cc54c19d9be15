// What is told of bad materials, each with its line.
#include "mpm/material/materials.hpp"

#include <gmock/gmock.h>

#include <cstdlib>
#include <filesystem>

#include "framework/scene/deck_values.hpp"
#include "mpm/material/test_support/law_test_support.hpp"

namespace sluice::mpm::materials {
namespace {

using testing::HasSubstr;

std::string told_of(const std::string& type, const std::string& inside,
                    const std::string& beside = "") {
  std::vector<Fault> faults;
  const auto made = law_of_text(type, inside, steel_constants(), faults, beside);
  const bool error = std::any_of(faults.begin(), faults.end(),
                                 [](const Fault& f) { return f.severity == Severity::error; });
  EXPECT_EQ(made == nullptr, error) << told(faults);
  return told(faults);
}

TEST(Materials, UnknownNamesGetTheNearest) {
  EXPECT_THAT(told_of("comp_neohook", ""), HasSubstr("did you mean 'comp_neo_hook'?"));
  EXPECT_THAT(told_of("comp_neohook", ""), HasSubstr("law.ups:2"));
  EXPECT_THAT(told_of("steel", ""), HasSubstr("valid: rigid, comp_neo_hook"));
}

TEST(Materials, ModelsOfTheFormatThatAreNotSupportedAreNamed) {
  for (const char* type : {"HypoplasticB", "kayenta", "VUMAT", "shell_CNH", "soil_foam"})
    EXPECT_THAT(told_of(type, ""), HasSubstr(std::string(type) + "' is known to the format"));
}

TEST(Materials, BadNumbersAreToldWithTheirLine) {
  EXPECT_THAT(told_of("comp_neo_hook",
                      "<bulk_modulus>-6e4</bulk_modulus>\n<shear_modulus>1</shear_modulus>"),
              testing::AllOf(HasSubstr("law.ups:3"), HasSubstr("bulk_modulus"),
                             HasSubstr("greater than 0")));
  EXPECT_THAT(told_of("comp_neo_hook", "<shear_modulus>1</shear_modulus>"),
              HasSubstr("comp_neo_hook needs <bulk_modulus>: K, Pa"));
  EXPECT_THAT(told_of("comp_mooney_rivlin",
                      "<he_constant_1>1</he_constant_1>\n<he_constant_2>1</he_constant_2>\n"
                      "<he_PR>0.5</he_PR>"),
              testing::AllOf(HasSubstr("law.ups:5"), HasSubstr("must be below 1/2")));
  EXPECT_THAT(told_of("hypo_elastic", "<G>1</G><K>stiff</K>"), HasSubstr("stiff"));
  EXPECT_THAT(told_of("comp_neo_hook_plastic",
                      "<bulk_modulus>1</bulk_modulus><shear_modulus>1</shear_modulus>"),
              HasSubstr("needs <yield_stress>"));
}

TEST(Materials, TagsThatAModelNeverReadsAreWarnings) {
  const std::string text =
      told_of("hypo_elastic", "<G>1</G><K>1</K>\n<strain_limit>3</strain_limit>");
  EXPECT_THAT(text, HasSubstr("law.ups:4"));
  EXPECT_THAT(text, HasSubstr("warning"));
  EXPECT_THAT(text, HasSubstr("hypo_elastic never reads <strain_limit>"));
}

// Every material of the public decks of solids is read, or refused for a part that is not
// supported; only a deck whose included files are not where it says lacks numbers.
TEST(Materials, OfThePublicDecksAreRead) {
  const char* decks = std::getenv("SLUICE_DECKS");
  if (decks == nullptr) GTEST_SKIP() << "SLUICE_DECKS is not set";
  int read = 0;
  for (const char* folder : {"/inputs/MPM", "/inputs/UintahRelease/MPM"})
    for (const auto& entry : std::filesystem::directory_iterator(std::string(decks) + folder)) {
      if (entry.path().extension() != ".ups") continue;
      const Deck deck = read_deck(entry.path().string());
      const DeckNode* mpm =
          deck.root == nullptr ? nullptr : deck.root->find("MaterialProperties/MPM");
      if (mpm == nullptr || !deck.good()) continue;
      for (const DeckNode* material : mpm->all("material")) {
        const DeckNode* law = material->child("constitutive_model");
        if (law == nullptr) continue;
        std::vector<Fault> faults;
        MaterialConstants constants = steel_constants();
        constants.density = real_or(*material, "density", constants.density);
        if (make_material(*law, *material, constants, faults) != nullptr) ++read;
        for (const Fault& f : faults)
          EXPECT_TRUE(f.severity != Severity::error || f.not_built) << to_string(f);
      }
    }
  EXPECT_GE(read, 100);
}

TEST(Materials, EveryTagOfEveryModelIsDescribed) {
  const TagSpec spec = constitutive_model_tag();
  for (const MaterialModel& model : material_models())
    for (const TagSpec& t : model.tags) {
      EXPECT_FALSE(t.doc.empty()) << model.name << " " << t.name;
      EXPECT_TRUE(std::any_of(spec.children.begin(), spec.children.end(),
                              [&](const TagSpec& c) { return c.name == t.name; }));
    }
}

}  // namespace
}  // namespace sluice::mpm::materials
