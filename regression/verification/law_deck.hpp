// Decks of one material with any equation of state, written for a test.
#pragma once
#include <filesystem>
#include <ostream>
#include <span>
#include <string>

#include "ice/fluid/fluid.hpp"

namespace sluice::verification {

// A material at a state where its law is used, and a speed that makes a shock of some strength.
struct LawCase {
  const char* name;
  const char* eos;  // <EOS .../> with its tags, and <SpecificHeatModel> where there is one
  double gamma, specific_heat;
  double density, temperature;
  double speed;  // of two streams that collide, m/s
};

inline std::ostream& operator<<(std::ostream& out, const LawCase& law) {
  return out << law.name;
}

// At least one of each equation of state that decks name, and of each specific heat.
std::span<const LawCase> law_cases();

// The thermodynamics of that material, as the program reads it.
ice::Fluid fluid_of(const LawCase& law);

// Material with velocity `speed` to the left of 0 and -`speed` to the right, in [-0.5, 0.5];
// periodic, or with open ends. `finer`: further levels. Returns the file.
std::filesystem::path write_law_deck(const std::filesystem::path& folder, const LawCase& law,
                                     double speed_left, double speed_right, double end_time,
                                     bool periodic, const std::string& finer = "");

}  // namespace sluice::verification
