// For tests: a law from the text of a deck.
#pragma once
#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

#include "framework/deck/deck.hpp"
#include "framework/deck/faults.hpp"
#include "mpm/material/materials.hpp"
#include "mpm/material/single_particle.hpp"

namespace sluice::mpm {

inline MaterialConstants steel_constants() {
  MaterialConstants c;
  c.density = 7830;
  c.specific_heat = 477;
  c.conductivity = 38;
  c.room_temperature = 298;
  c.melt_temperature = 1793;
  return c;
}

// `inside`: the children of <constitutive_model>; `beside`: those of <material> beside it.
inline std::shared_ptr<const Material> law_of_text(const std::string& type,
                                                   const std::string& inside,
                                                   const MaterialConstants& constants,
                                                   std::vector<Fault>& faults,
                                                   const std::string& beside = "") {
  const Deck deck = read_deck_text("<Uintah_specification><material>\n<constitutive_model type=\"" +
                                       type + "\">\n" + inside + "\n</constitutive_model>\n" +
                                       beside + "</material></Uintah_specification>",
                                   "law.ups");
  const DeckNode* material = deck.root->child("material");
  return make_material(*material->child("constitutive_model"), *material, constants, faults);
}

// One that must be good.
inline std::shared_ptr<const Material> law(const std::string& type, const std::string& inside,
                                           const MaterialConstants& constants = steel_constants(),
                                           const std::string& beside = "") {
  std::vector<Fault> faults;
  auto made = law_of_text(type, inside, constants, faults, beside);
  for (const Fault& f : faults) ADD_FAILURE() << to_string(f);
  return made;
}

// All messages, a line each.
inline std::string told(const std::vector<Fault>& faults) {
  std::string text;
  for (const Fault& f : faults) text += to_string(f) + "\n";
  return text;
}

}  // namespace sluice::mpm
