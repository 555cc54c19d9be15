#include "ice/deck/scheme.hpp"

namespace sluice::ice {
namespace {

constexpr SchemeRow rows[] = {{.word = "conservative",
                               .several_materials = true,
                               .conducts_heat = true,
                               .transport_models = true,
                               .transports_scalars = true,
                               .implicit = true,
                               .matches_fluxes = true},
                              {.word = "classic", .internal_energy = true}};

}  // namespace

std::vector<std::string> scheme_words() {
  std::vector<std::string> words;
  for (const SchemeRow& row : rows) words.emplace_back(row.word);
  return words;
}

const SchemeRow& scheme_of(const DeckNode& root) {
  const DeckNode* scheme = root.find("CFD/ICE/scheme");
  for (const SchemeRow& row : rows)
    if (scheme != nullptr && scheme->text == row.word) return row;
  return rows[0];
}

}  // namespace sluice::ice
