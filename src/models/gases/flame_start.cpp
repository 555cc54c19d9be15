#include "models/gases/flame_start.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <sstream>

#include "framework/base/data_lines.hpp"
#include "framework/base/error.hpp"

namespace sluice::models {
namespace {

constexpr std::size_t state_columns = 5;  // x T u rho p

class FlameReader {
 public:
  FlameReader(const std::string& file, int axis, const kinetics::SpeciesGas& gas)
      : lines_(file, "flame", Separators::blanks), gas_(gas) {
    for (std::size_t s = 0; s < gas.count(); ++s) species_.push_back(s);
    FlameStart& state = flame_.state;
    for (StartLine* line : {&state.temperature, &state.velocity, &state.density, &state.pressure})
      line->axis = axis;
    flame_.fractions.resize(gas.carried());
    for (StartLine& line : flame_.fractions) line.axis = axis;
  }

  FlameProfile read() {
    while (lines_.next()) {
      if (lines_.words().empty())
        take_names(lines_.comment());
      else
        take_numbers();
    }
    if (flame_.state.density.x.empty())
      throw InputError(fmt::format("'{}' has no lines", lines_.file()));
    return std::move(flame_);
  }

 private:
  // A comment that names columns has as many words as there are columns.
  void take_names(std::string_view comment) {
    std::istringstream words{std::string(comment)};
    std::vector<std::string> names;
    for (std::string word; words >> word;) names.push_back(word);
    if (names.size() <= state_columns || !names[state_columns].starts_with("Y_")) return;
    species_.clear();
    for (std::size_t n = state_columns; n < names.size(); ++n) {
      const std::string name = names[n].substr(std::min<std::size_t>(2, names[n].size()));
      const auto& all = gas_.mechanism().species;
      const auto found =
          std::find_if(all.begin(), all.end(), [&](const auto& s) { return s.name == name; });
      if (found == all.end())
        lines_.refuse(
            0, fmt::format("the mechanism has no species '{}' (column '{}')", name, names[n]));
      species_.push_back(found - all.begin());
    }
  }

  std::string name_of(std::size_t column) const {
    constexpr const char* names[state_columns] = {"x", "T", "u", "rho", "p"};
    if (column < state_columns) return names[column];
    const std::size_t s = column - state_columns;
    return s < species_.size() ? "Y_" + gas_.mechanism().species[species_[s]].name : "no column";
  }

  void take_numbers() {
    std::vector<double> numbers;
    for (std::size_t n = 0; n < lines_.words().size(); ++n)
      numbers.push_back(lines_.number(n, fmt::format("a number ({})", name_of(n))));
    const std::size_t expected = state_columns + species_.size();
    // The closure, named last, may be left out.
    const bool short_by_one = numbers.size() + 1 == expected && species_.back() == gas_.closure();
    if (numbers.size() != expected && !short_by_one)
      lines_.refuse(std::min(numbers.size(), expected),
                    fmt::format("{} numbers; x, T, u, rho, p and {} mass fractions are {}",
                                numbers.size(), species_.size(), expected));
    FlameStart& state = flame_.state;
    if (!state.density.x.empty() && !(numbers[0] > state.density.x.back()))
      lines_.refuse(0, fmt::format("x = {:g} is not above the previous x, {:g}", numbers[0],
                                   state.density.x.back()));
    if (!(numbers[1] > 0 && numbers[3] > 0 && numbers[4] > 0))
      lines_.refuse(1, "temperature, density and pressure must be above 0");
    const auto add = [&](StartLine& line, double value) {
      line.x.push_back(numbers[0]);
      line.values.push_back(value);
    };
    add(state.temperature, numbers[1]);
    add(state.velocity, numbers[2]);
    add(state.density, numbers[3]);
    add(state.pressure, numbers[4]);
    for (std::size_t k = 0; k < gas_.carried(); ++k) {
      const auto column = std::find(species_.begin(), species_.end(), gas_.species_of(k));
      const std::size_t n = state_columns + (column - species_.begin());
      add(flame_.fractions[k], column == species_.end() ? 0.0 : numbers[n]);
    }
  }

  DataLines lines_;
  const kinetics::SpeciesGas& gas_;
  FlameProfile flame_;
  std::vector<std::size_t> species_;  // of the columns of fractions
};

}  // namespace

FlameProfile read_flame(const std::string& file, int axis, const kinetics::SpeciesGas& gas) {
  return FlameReader(file, axis, gas).read();
}

}  // namespace sluice::models
