// The table of models: one row per type, with what is asked of it.
//
// A new model is a file of its own and a row in model_table.cpp.
#pragma once
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "framework/deck/schema.hpp"
#include "models/models.hpp"

namespace sluice::models {

struct ModelReading {
  const std::vector<std::string>& materials;  // fluids
  const MaterialNames& names;
  const GeometryReader& geometry;
  ModelList& list;
  std::vector<Fault>& faults;
};

// One type of model: the word in <Model type=>, the element that holds its parameters, and what it
// is asked; null: it has nothing to say there.
struct ModelRow {
  const char* type;
  TagSpec parameters;
  void (*check)(const DeckNode& parameters, const MaterialNames& names,
                std::vector<Fault>& faults) = nullptr;
  // What it does in fluids.
  void (*read)(const DeckNode& parameters, const ModelReading& to) = nullptr;
  // Where the reactant is a solid: its law of burning.
  std::shared_ptr<const BurnLaw> (*burn)(const DeckNode& parameters,
                                         const MaterialNames& names) = nullptr;
  // Names of variables that it brings.
  std::vector<std::string> (*labels)(const DeckNode& parameters) = nullptr;
  bool mixes_gas = false;
  bool transports_scalar = false;  // by the flow
  // The largest value that it brings, Pa s or W/(m K).
  std::optional<double> (*coefficient)(const DeckNode& parameters, Coefficient) = nullptr;
  // The tag that names the material of which this model may be written once alone, and why.
  const char* once_for = nullptr;
  const char* once_reason = nullptr;
  // Brings older forms of its element up to date, with warnings.
  void (*update)(DeckNode& parameters, std::vector<Fault>& faults) = nullptr;
};

const std::vector<ModelRow>& model_rows();
// Null: there is none of this type.
const ModelRow* find_model(const std::string& type);

}  // namespace sluice::models
