// The block <Models>: which models there are, how a deck names them, what a deck asks of them.
//
// A model's law, tags, checks and reader stand in a file of its own; its row in the table of
// model_table.cpp makes it known. What the laws do to a state is the component's part.
#pragma once
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "framework/deck/deck.hpp"
#include "framework/scene/geometry_reader.hpp"
#include "models/burn/burn_law.hpp"
#include "models/burn/mass_exchange.hpp"
#include "models/deck/reactant.hpp"
#include "models/gases/mixed_gas.hpp"
#include "models/scalars/passive_scalar.hpp"
#include "models/scalars/tracer_particles.hpp"
#include "models/sources/fixed_values.hpp"

namespace sluice {
struct TagSpec;
}

namespace sluice::models {

// A solid that becomes a fluid.
struct SolidBurn {
  int solid = 0;    // among the solids
  int product = 0;  // among the fluids
  std::shared_ptr<const BurnLaw> law;
  Location where;
};

// What the models of a deck are; plain data.
struct ModelList {
  std::vector<MassExchange> mass_exchanges;  // in the order in which they act
  std::vector<FixedValues> fixed_values;
  std::vector<TransportedScalar> scalars;
  std::optional<MixedGas> mixed;  // of the gas of a run with one material
  std::vector<TracerParticles> tracers;
  Location where;  // of <Models>

  // Does any of them change masses, momenta or energies.
  bool any_source() const { return !mass_exchanges.empty() || !fixed_values.empty(); }
};

// Whether a type of model makes the gas a mixture.
bool mixes_gas(const std::string& type);
// Whether it brings a scalar that the flow transports.
bool transports_scalar(const DeckNode& model);
// The largest value that a model brings of a coefficient (Pa s, W/(m K)); infinity where only its
// table tells.
// Nothing: the material's own holds.
std::optional<double> own_coefficient(const DeckNode& model, Coefficient coefficient);

TagSpec models_tag();
// Old decks write the parameters of "Test" beside its element, not in it: moved, with a warning.
void move_parameters(DeckNode& root, std::vector<Fault>& faults);

// Rules beyond single tags.
void check_models(const DeckNode& root, const MaterialNames& materials, std::vector<Fault>& faults);
// Of a deck that has been checked.
ModelList read_models(const DeckNode& root, const MaterialNames& materials,
                      const GeometryReader& geometry, std::vector<Fault>& faults);
// What of it solids give to fluids: no part of that list.
std::vector<SolidBurn> read_burns(const DeckNode& root, const MaterialNames& materials);

// Declares the labels that models bring, with NAME for the name of a scalar of a deck.
void declare_labels();

// Whether all models that the deck names are built: what others would bring nobody can judge.
bool all_built(const DeckNode& root);
// Variables that the models of this deck bring and that can be saved, beside the component's own.
std::vector<std::string> save_labels(const DeckNode& root);
// Those of them that the flow transports, as "scalar-f": a label with a total over the domain.
std::vector<std::string> scalar_variables(const DeckNode& root);

}  // namespace sluice::models
