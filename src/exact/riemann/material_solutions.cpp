#include "exact/riemann/material_solutions.hpp"

#include <fmt/format.h>

#include <cmath>
#include <string>

#include "exact/base/law_text.hpp"
#include "framework/base/error.hpp"

namespace sluice::exact {
namespace {

State in_space(const MaterialRiemann::Sample& sample, double temperature, const Placement& place) {
  State out;
  out.density = sample.state.density;
  out.velocity = place.direction * sample.state.velocity;
  out.pressure = sample.state.pressure;
  out.material = place.materials[sample.side];
  out.known_energy = sample.state.energy;
  out.known_temperature = temperature;
  return out;
}

// [density, velocity, pressure], with the temperature where the law needs it: then pressure must be
// the law's own to 1e-6.
FluidState state_of(const SolutionParameters& from, const eos::EquationOfState& law,
                    const std::string& name, const std::string& side) {
  const auto values = from.state(name);
  if (pressure_depends_on_energy(law))
    return state_of_pressure(law, values[0], values[1], values[2]);
  const FluidState state =
      state_of_temperature(law, values[0], values[1], from.positive("temperature_" + side));
  if (std::abs(state.pressure - values[2]) <= 1e-6 * std::abs(values[2])) return state;
  throw InputError(fmt::format(
      "exact solution '{}': <{}> says pressure {}, but {} has {:.12g} at density {}; its pressure "
      "depends on density only",
      from.type(), name, values[2], eos::name_of(law), state.pressure, values[0]));
}

MaterialSide side_of(const SolutionParameters& from, const std::string& side) {
  const eos::EquationOfState law = law_from_text(from.words("eos_" + side));
  return {law, state_of(from, law, side, side)};
}

Placement placement(const SolutionParameters& from, Vec3 direction) {
  Placement place;
  place.direction = direction;
  if (!from.has("materials")) return place;
  const auto indices = from.reals("materials");
  const auto whole = [](double x) { return x == std::floor(x) && x >= 0 && x < 1000; };
  if (indices.size() != 2 || !whole(indices[0]) || !whole(indices[1])) {
    throw InputError(
        fmt::format("exact solution '{}': <materials> must hold the numbers of the left and the "
                    "right material in the deck, such as [0, 1]",
                    from.type()));
  }
  place.materials = {static_cast<int>(indices[0]), static_cast<int>(indices[1])};
  return place;
}

}  // namespace

State TwoMaterials::at(Vec3 x, double t) const {
  const double s = dot(place_.direction, x) - place_.position;
  // At the start only the side counts.
  const auto sample = solution_.sample(t > 0 ? s / t : s < 0 ? -HUGE_VAL : HUGE_VAL);
  return in_space(sample, solution_.temperature(sample), place_);
}

State ShockAtInterface::at(Vec3 x, double t) const {
  const auto sample = solution_.at(dot(place_.direction, x) - place_.position, t);
  return in_space(sample, solution_.temperature(sample), place_);
}

std::unique_ptr<ExactSolution> make_two_materials(const SolutionParameters& from, Vec3 direction) {
  Placement place = placement(from, direction);
  place.position = from.real("position");
  const MaterialRiemann flow(side_of(from, "left"), side_of(from, "right"));
  return std::make_unique<TwoMaterials>(flow, place);
}

std::unique_ptr<ExactSolution> make_shock_at_interface(const SolutionParameters& from,
                                                       Vec3 direction) {
  const MaterialSide first = side_of(from, "left");
  std::optional<MaterialSide> second;
  if (from.has("right")) second = side_of(from, "right");
  const ShockMeetsInterface flow(first, second, from.real("shock_pressure"),
                                 from.real("shock_position"), from.real("position"));
  return std::make_unique<ShockAtInterface>(flow, placement(from, direction));
}

}  // namespace sluice::exact
