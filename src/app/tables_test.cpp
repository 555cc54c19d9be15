// The tables of what decks may name: every row is described in the reference, and a bad deck is
// refused with the line of the fault.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "app/loading/components.hpp"
#include "app/loading/sluice_schema.hpp"
#include "framework/deck/help/deck_pages.hpp"
#include "framework/deck/load_deck.hpp"
#include "ice/conditions/face_conditions.hpp"
#include "ice/deck/fluid_laws.hpp"
#include "ice/deck/scheme.hpp"
#include "models/models.hpp"
#include "mpm/deck/bases.hpp"
#include "mpm/material/materials.hpp"
#include "sluice_source_dir.hpp"

namespace sluice::tables_test {
namespace {

using testing::HasSubstr;

const Schema& schema() {
  static const Schema whole = sluice_schema();
  return whole;
}

std::string good_deck(const char* name) {
  std::ifstream file(std::string(SLUICE_SOURCE_DIR "/src/framework/deck/bad_decks/") + name);
  return {std::istreambuf_iterator<char>(file), {}};
}

// The good deck with the first `from` replaced.
std::string edited(std::string deck, const std::string& from, const std::string& to) {
  const auto at = deck.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return at == std::string::npos ? deck : deck.replace(at, from.size(), to);
}

int line_of(const std::string& deck, const std::string& text) {
  const auto at = deck.find(text);
  return 1 + static_cast<int>(std::count(deck.begin(), deck.begin() + static_cast<long>(at), '\n'));
}

// "line: message" of every error of a deck, one a line.
std::string errors_of(const std::string& deck) {
  std::string text;
  for (const Fault& fault : load_deck_text(deck, "deck.ups", {}, schema()).faults)
    if (fault.severity == Severity::error)
      text += std::to_string(fault.where.line) + ": " + fault.message + '\n';
  return text;
}

// Where the element of a row is, a tag that it does not know is refused with its line.
void expect_unknown_tag_refused(const std::string& deck, const std::string& row) {
  SCOPED_TRACE(row);
  const std::string place = std::to_string(line_of(deck, "<no_such_tag/>")) + ": ";
  const std::string errors = errors_of(deck);
  EXPECT_THAT(errors, HasSubstr(place));
  EXPECT_THAT(errors, HasSubstr("no_such_tag"));
}

std::vector<std::string> words_of(const char* path, const char* attribute = nullptr) {
  const TagSpec* tag = schema().at(path);
  EXPECT_NE(tag, nullptr) << path;
  if (tag == nullptr) return {};
  if (attribute == nullptr) return tag->value.words;
  for (const AttributeSpec& a : tag->attributes)
    if (a.name == attribute) return a.value.words;
  ADD_FAILURE() << path << " has no attribute " << attribute;
  return {};
}

TEST(TableOfConstitutiveModels, EveryRowRefusesWhatItDoesNotKnow) {
  const std::string good = good_deck("good_solid.ups");
  const std::string old = R"(<constitutive_model type="comp_neo_hook">
          <bulk_modulus>1.0e6</bulk_modulus>
          <shear_modulus>5.0e5</shear_modulus>)";
  ASSERT_GE(mpm::material_models().size(), 20U);
  for (const mpm::MaterialModel& row : mpm::material_models())
    expect_unknown_tag_refused(
        edited(good, old, "<constitutive_model type=\"" + row.name + "\">\n<no_such_tag/>"),
        row.name);
}

TEST(TableOfEquationsOfState, EveryRowRefusesWhatItDoesNotKnow) {
  const std::string good = good_deck("good.ups");
  const std::vector<std::string> laws = words_of("MaterialProperties/ICE/material/EOS", "type");
  ASSERT_GE(laws.size(), 10U);
  for (const std::string& law : laws)
    expect_unknown_tag_refused(edited(good, "<EOS type=\"ideal_gas\"/>",
                                      "<EOS type=\"" + law + "\">\n<no_such_tag/></EOS>"),
                               law);
}

TEST(TableOfModels, EveryRowRefusesWhatItDoesNotKnow) {
  const std::string good = good_deck("good.ups");
  const std::vector<std::string> types = words_of("Models/Model", "type");
  ASSERT_GE(types.size(), 10U);
  const TagSpec& model = *schema().at("Models/Model");
  for (const std::string& type : types) {
    const auto element =
        std::find_if(model.children.begin(), model.children.end(), [&](const TagSpec& tag) {
          const auto& values = tag.applies.second;
          return std::find(values.begin(), values.end(), type) != values.end();
        });
    ASSERT_NE(element, model.children.end()) << type;
    expect_unknown_tag_refused(
        edited(good, "<PhysicalConstants>",
               "<Models><Model type=\"" + type + "\"><" + element->name + ">\n<no_such_tag/></" +
                   element->name + "></Model></Models><PhysicalConstants>"),
        type);
  }
}

// A condition of a variable that it is not for, without a value, or without its block.
TEST(TableOfFaceConditions, EveryRowRefusesABadUse) {
  const std::string good = good_deck("good.ups");
  const std::string old =
      "<BCType id=\"0\" label=\"Velocity\" var=\"Neumann\"><value>[0.0,0.0,0.0]</value></BCType>";
  for (const ice::FaceCondition& row : ice::face_conditions()) {
    const std::string word(row.word);
    SCOPED_TRACE(word);
    const bool for_volume = row.is_for("SpecificVol");
    const std::string deck =
        edited(good, old,
               "<BCType id=\"0\" label=\"" + std::string(for_volume ? "Velocity" : "SpecificVol") +
                   "\" var=\"" + word + "\"/>");
    const std::string place = std::to_string(line_of(deck, "var=\"" + word + "\"/>")) + ": ";
    EXPECT_THAT(errors_of(deck), HasSubstr(place));
    EXPECT_THAT(errors_of(deck), HasSubstr(word));
  }
  EXPECT_EQ(words_of("Grid/BoundaryConditions/Face/BCType", "var").size(),
            ice::face_conditions().size());
}

// What a basis has no form of is refused, and nothing else is.
TEST(TableOfBases, ColumnsAreWhatDecksMayAsk) {
  const std::string good = good_deck("good_solid.ups");
  struct Question {
    const char* tags;
    bool mpm::BasisRow::*column;
    const char* refusal;
  };
  const Question questions[] = {
      {"<axisymmetric>true</axisymmetric>", &mpm::BasisRow::axisymmetric,
       "<axisymmetric> is not supported with"},
      {"<total_lagrangian>true</total_lagrangian>", &mpm::BasisRow::total_lagrangian,
       "shape functions are those of the initial positions"},
      {"<transfer>apic</transfer>", &mpm::BasisRow::one_second_moment, "a constant second moment"},
  };
  for (const mpm::BasisRow& row : mpm::basis_rows())
    for (const Question& q : questions) {
      const std::string errors =
          errors_of(edited(good, "<interpolator>gimp</interpolator>",
                           "<interpolator>" + std::string(row.word) + "</interpolator>" + q.tags));
      const bool refused = errors.find(q.refusal) != std::string::npos;
      EXPECT_EQ(refused, !(row.*q.column)) << row.word << ' ' << q.tags << '\n' << errors;
    }
  EXPECT_EQ(words_of("MPM/interpolator"), mpm::basis_words());
}

TEST(Tables, EveryRowStandsInTheReference) {
  std::string page;
  for (const ReferencePage& one : reference_pages(schema())) page += one.text;
  std::vector<std::string> words = words_of("MaterialProperties/ICE/material/EOS", "type");
  const auto add = [&](const std::vector<std::string>& more) {
    words.insert(words.end(), more.begin(), more.end());
  };
  add(words_of("Models/Model", "type"));
  add(mpm::basis_words());
  add(ice::scheme_words());
  add(words_of("MPM/transfer"));
  for (const mpm::MaterialModel& row : mpm::material_models()) words.push_back(row.name);
  for (const ice::FaceCondition& row : ice::face_conditions()) words.emplace_back(row.word);
  for (const ComponentWord& row : component_words()) words.push_back(row.word);
  for (const std::string& word : words) EXPECT_THAT(page, HasSubstr(word));
}

}  // namespace
}  // namespace sluice::tables_test
