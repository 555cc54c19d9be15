// Names of the materials of a deck, and what burns into what.
#pragma once
#include <string>
#include <utility>
#include <vector>

#include "framework/base/error.hpp"
#include "framework/deck/deck.hpp"

namespace sluice::models {

// By index among their like. In a run with solids these are numbered first.
struct MaterialNames {
  std::vector<std::string> fluids, solids;

  // NOLINTNEXTLINE(google-explicit-constructor): most runs have fluids alone.
  MaterialNames(std::vector<std::string> of_fluids = {}, std::vector<std::string> of_solids = {})
      : fluids(std::move(of_fluids)), solids(std::move(of_solids)) {}
  // Solids, then fluids.
  std::vector<std::string> all() const;
};

struct Reactant {
  int from = 0;        // among the fluids, or among the solids
  bool solid = false;  // which of both
  int to = 0;          // among the fluids
};

// <fromMaterial> and <toMaterial>: that they exist, that they differ, that the latter is a fluid.
void check_reactant(const DeckNode& parameters, const MaterialNames& names,
                    std::vector<Fault>& faults);
// Also that <fromMaterial> is a solid: of a model that burns surfaces.
void check_solid_reactant(const DeckNode& parameters, const MaterialNames& names,
                          std::vector<Fault>& faults);
// Also that <fromMaterial> is a fluid.
void check_fluid_reactant(const DeckNode& parameters, const MaterialNames& names,
                          std::vector<Fault>& faults);
// Of a deck that has been checked.
Reactant read_reactant(const DeckNode& parameters, const MaterialNames& names);

}  // namespace sluice::models
