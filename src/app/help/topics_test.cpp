// sluice help NAME: every kind of name, every law with an example that is good.
#include "app/help/topics.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "app/help/ending_messages.hpp"
#include "app/help/law_examples.hpp"
#include "app/loading/sluice_schema.hpp"
#include "framework/base/error.hpp"
#include "framework/deck/help/laws.hpp"
#include "ice/deck/fluid_laws.hpp"
#include "mpm/material/materials.hpp"
#include "sluice_source_dir.hpp"

namespace sluice::topics_test {
namespace {

using testing::HasSubstr;
using testing::Not;

std::string told(const std::string& name) {
  try {
    return help_on(name, {"run", "plot"});
  } catch (const InputError& problem) {
    return problem.what();
  }
}

TEST(Help, FindsTagsByNameByPathAndByAlias) {
  EXPECT_THAT(told("CFD/cfl"), HasSubstr("greater than 0 and at most 1"));
  EXPECT_THAT(told("material/gamma"), HasSubstr("MaterialProperties/ICE/material/gamma"));
  EXPECT_THAT(told("max_Timestep"), HasSubstr("Time/max_Timesteps"));
  EXPECT_THAT(told("MaterialProperties/ICE/material/geom_object/union/box"), HasSubstr("min"));
}

TEST(Help, ShowsTheNumbersOfALawAndAnExample) {
  const std::string text = told("JWL");
  EXPECT_THAT(text, HasSubstr("<EOS type=\"JWL\">"));
  EXPECT_THAT(text, HasSubstr("pressure of the first exponential, Pa (real number, greater than 0; "
                              "required)"));
  EXPECT_THAT(text, HasSubstr("<A>371.2e9</A>"));
  EXPECT_THAT(text, Not(HasSubstr("JWLC: ")));
  EXPECT_THAT(told("johnson_cook"), HasSubstr("T_r                    temperature without "
                                              "softening, K (real number, greater than 0; "
                                              "default 298)"));
  EXPECT_THAT(told("Sutherland"), HasSubstr("1.458e-6"));
}

TEST(Help, KnowsLabelsAndMessages) {
  EXPECT_THAT(told("press_CC"), HasSubstr("save it with <save label=\"press_CC\"/>"));
  EXPECT_THAT(told("step 12 at t = 0.1: task 'update' left 3 cells inadmissible even with dt = 1"),
              HasSubstr("exit status 1"));
  EXPECT_THAT(told("time cannot advance"), HasSubstr("What to do"));
}

TEST(Help, NamesTheNearestNameAndWhatIsNotBuilt) {
  EXPECT_THAT(told("gama"), HasSubstr("did you mean 'gamma'"));
  EXPECT_THAT(told("JWLD"), HasSubstr("did you mean 'JWL"));
  EXPECT_THAT(told("pres_CC"), HasSubstr("did you mean 'press_CC'"));
  EXPECT_THAT(told("plt"), HasSubstr("did you mean 'plot'"));
  EXPECT_THAT(told("RMCRT"), HasSubstr("not supported yet"));
}

// A phrase that no message has would help nobody.
TEST(EndingMessages, AreWrittenByTheProgram) {
  std::string sources;
  for (const char* folder : {"framework", "ice", "mpm", "mpmice", "app/plan"})
    for (const auto& entry : std::filesystem::recursive_directory_iterator(
             SLUICE_SOURCE_DIR "/src/" + std::string(folder))) {
      if (entry.path().extension() != ".cpp") continue;
      std::ifstream in(entry.path());
      bool in_text = false;
      // Literals that follow each other are one text.
      for (char c = 0, before = 0; in.get(c); before = c)
        if (c == '"' && before != '\\')
          in_text = !in_text;
        else if (in_text)
          sources += c;
    }
  for (const EndingMessage& m : ending_messages())
    EXPECT_THAT(sources, HasSubstr(std::string(m.phrase)));
}

TEST(EndingMessages, PageIsUpToDate) {
  std::ifstream file(SLUICE_SOURCE_DIR "/docs/when_it_stops.md");
  EXPECT_EQ((std::string{std::istreambuf_iterator<char>(file), {}}), page_of_messages())
      << "write it anew: sluice help --messages > docs/when_it_stops.md";
}

// inputs/laws.xml: each law of a fluid and of a solid, each readable.
TEST(LawExamples, AreThereForEveryLawAndGood) {
  const LawExamples examples(SLUICE_SOURCE_DIR "/inputs/laws.xml");
  const Schema schema = sluice_schema();
  int laws = 0;
  for (const TagPlace& place : all_places(schema)) {
    if (place.spec->laws.empty() || !place.path.starts_with("MaterialProperties")) continue;
    for (const auto& [word, tags] : place.spec->laws) {
      ++laws;
      const std::string text = examples.find(place.spec->name, "type", word);
      EXPECT_EQ(text.empty() && !tags.empty(), false) << place.path << ' ' << word;
      for (const TagSpec& tag : tags) {
        if (tag.need != Need::once) continue;
        EXPECT_THAT(text, HasSubstr('<' + tag.name)) << place.path << ' ' << word;
      }
    }
  }
  EXPECT_GT(laws, 70);
}

TEST(LawExamples, OfSolidsMakeMaterials) {
  const LawExamples examples(SLUICE_SOURCE_DIR "/inputs/laws.xml");
  mpm::MaterialConstants constants;
  constants.density = 7800;
  constants.specific_heat = 383;
  for (const DeckNode* node : examples.root()->all("constitutive_model")) {
    std::vector<Fault> faults;
    DeckNode material;
    material.name = "material";
    const auto law = mpm::make_material(*node, material, constants, faults);
    for (const Fault& fault : faults) ADD_FAILURE() << to_string(fault);
    EXPECT_NE(law, nullptr) << node->attribute("type").value_or("");
  }
}

}  // namespace
}  // namespace sluice::topics_test
