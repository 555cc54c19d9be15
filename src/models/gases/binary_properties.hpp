// Model "BinaryProperties": an ideal gas that is a mixture of two, by mass fraction.
//
//   cv = f cv_B + (1 - f) cv_A,  R = f R_B + (1 - f) R_A,  mu and k alike
// f is the mass fraction of gas B. What the scalar needs beside it is as for "PassiveScalar".
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "framework/deck/deck.hpp"
#include "models/gases/mixed_gas.hpp"

namespace sluice {
struct TagSpec;
}

namespace sluice::models {

TagSpec binary_properties_tag();
void check_binary_properties(const DeckNode& parameters, const std::vector<std::string>& materials,
                             std::vector<Fault>& faults);
// The larger of both gases; nothing where the deck has none.
std::optional<double> largest_binary_coefficient(const DeckNode& parameters, Coefficient);
MixedGas read_binary_properties(const DeckNode& parameters,
                                const std::vector<std::string>& materials);

}  // namespace sluice::models
