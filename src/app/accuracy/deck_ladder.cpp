#include "app/accuracy/deck_ladder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "app/loading/deck_scaling.hpp"
#include "app/loading/sluice_schema.hpp"
#include "app/process/deck_process.hpp"
#include "framework/base/error.hpp"

namespace sluice {
namespace {

constexpr int fewest_useful_cells = 8;  // along a direction, of a run whose error says something

}  // namespace

DeckLadder::DeckLadder(std::filesystem::path executable, std::string deck,
                       std::vector<std::string> overrides, std::filesystem::path folder)
    : executable_(std::move(executable)),
      folder_(std::move(folder)),
      deck_(std::move(deck)),
      overrides_(std::move(overrides)),
      read_(load_good_deck(deck_, overrides_)),
      own_cells_(cells_of_deck(*read_.root)) {
  const DeckNode* title = read_.root->find("Meta/title");
  title_ = title == nullptr ? deck_ : title->text;
  if (resolution(1).empty())
    throw InputError(fmt::format(
        "{}: its grid has neither <resolution> nor <spacing> on its first level: there is nothing "
        "to make a ladder of",
        deck_));
}

int DeckLadder::directions() const {
  return (own_cells_.x > 1) + (own_cells_.y > 1) + (own_cells_.z > 1);
}

int DeckLadder::fewest_cells() const {
  int fewest = std::numeric_limits<int>::max();
  for (int d = 0; d < 3; ++d)
    if (own_cells_[d] > 1) fewest = std::min(fewest, own_cells_[d]);
  return fewest;
}

std::vector<std::string> DeckLadder::resolution(double factor) const {
  return resolution_overrides(*read_.root, factor);
}

const Rung& DeckLadder::run(double factor) {
  DeckRequest request{
      executable_, deck_, overrides_, {}, folder_ / fmt::format("rung_{}", rungs_.size())};
  if (factor != 1)
    for (const std::string& one : resolution(factor)) request.overrides.push_back(one);
  const DeckOutcome outcome = run_deck(request);
  const std::string command = shell_text(run_words(request));
  if (outcome.status() != "done")
    throw PhysicsError(fmt::format("{} did not come to its end: {}", command, outcome.message));
  Rung rung{factor,
            {},
            outcome.report.value("steps", 0),
            outcome.report.value("stepping_s", 0.0),
            outcome.archive(),
            command};
  const Archive archive = Archive::open(rung.archive);
  if (archive.outputs().empty())
    throw InputError(fmt::format("{}: the run wrote no output", deck_));
  rung.cells = archive.read_output(archive.outputs().back()).grid().levels.front().domain.size();
  rungs_.push_back(std::move(rung));
  return rungs_.back();
}

double DeckLadder::seconds() const {
  double sum = 0;
  for (const Rung& rung : rungs_) sum += rung.seconds;
  return sum;
}

std::vector<QuantityBar> DeckLadder::bars() const {
  const std::size_t last = rungs_.size() - 1, first = last < 3 ? last - 2 : last - 3;
  std::vector<Archive> archives;
  for (std::size_t n = first; n <= last; ++n)
    archives.push_back(Archive::open(rungs_.at(n).archive));
  const double ratio = rungs_[last].factor / rungs_[last - 1].factor;
  std::vector<QuantityBar> bars;
  for (const Quantity& quantity : quantities_of(archives.back())) {
    std::vector<double> differences;
    double size = 0;
    for (std::size_t n = 0; n + 1 < archives.size(); ++n) {
      const MeanDifference d = mean_difference(archives[n], archives[n + 1], quantity);
      differences.push_back(d.difference);
      size = d.size;
    }
    if (!(size > 0)) continue;  // zero throughout
    for (double& d : differences) d /= size;
    bars.push_back({quantity, size, error_bar(differences, ratio)});
  }
  return bars;
}

double DeckLadder::predicted_seconds(double factor) const {
  const Rung& fine = rungs_.back();
  const double highest = directions() + 1;  // cells and steps
  double power = highest;
  if (rungs_.size() > 1) {
    const Rung& coarse = rungs_[rungs_.size() - 2];
    power = std::log(fine.seconds / coarse.seconds) / std::log(fine.factor / coarse.factor);
    power = std::clamp(power, 1.0, highest);
  }
  return fine.seconds * std::pow(factor / fine.factor, power);
}

std::vector<double> factors_for(int fewest_cells) {
  if (fewest_cells >= 8 * fewest_useful_cells) return {0.125, 0.25, 0.5, 1};
  if (fewest_cells >= 4 * fewest_useful_cells) return {0.25, 0.5, 1, 2};
  if (fewest_cells >= 2 * fewest_useful_cells) return {0.5, 1, 2};
  return {1, 2, 4};
}

}  // namespace sluice
