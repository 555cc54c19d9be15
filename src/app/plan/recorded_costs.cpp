#include "app/plan/recorded_costs.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <limits>

namespace sluice {
namespace {

struct ComponentCosts {
  const char* component;
  std::array<double, 3> cell_ns, particle_ns;  // by dimension
  double step_s;
};

// Fluids: tubes, blasts in two and three dimensions. Solids: GIMP. Coupled runs: foam and bodies in
// gases, whose particles cost more by the cells that they cut.
constexpr ComponentCosts recorded_components[] = {
    {"ice", {19, 41, 98}, {0, 0, 0}, 1e-5},
    {"mpm", {30, 30, 10}, {120, 190, 190}, 2e-4},
    {"impm", {0, 0, 0}, {3000, 6000, 8000}, 1e-3},
    {"mpmice", {40, 80, 250}, {300, 400, 2000}, 3e-4},
};

// Particles of other shape functions over those of GIMP.
struct InterpolatorCosts {
  const char* name;
  double particles;
};
constexpr InterpolatorCosts interpolators[] = {{"linear", 0.6}, {"cpdi", 2.1}, {"cpti", 2.1}};

// What an effect multiplies the costs by, and adds to those of a cell.
struct EffectCosts {
  const char* effect;
  double cells = 1, particles = 1, cell_ns = 0;
};
constexpr EffectCosts effects_known[] = {
    {"momentum exchange", 1.5, 1, 0},  // of two or more fluids: not every cell holds all
    {"viscous stress", 1.25, 1, 0},     {"pressure solve", 1, 1, 430}, {"contact", 1, 1.5, 0},
    {"heat of lost energy", 1, 1.8, 0}, {"open faces", 1.1, 1, 0},
};

constexpr double levels_factor = 4.2;

using CalibrationRow = std::array<double, 1024>;

// As tools/bench/calibration.cpp, whose figure of the recorded machine this is.
constexpr double recorded_calibration_ns = 0.677;

double sweep_seconds(CalibrationRow& a, CalibrationRow& b) {
  constexpr int sweeps = 400;
  const auto start = std::chrono::steady_clock::now();
  for (int s = 0; s < sweeps; ++s)
    for (std::size_t i = 0; i < a.size(); ++i) {
      const double sum = a[i] * 0.5 + b[i] * 0.25;
      const double quotient = (a[i] - b[i]) / (8.0 + a[i] * a[i]);
      b[i] = sum > 0.1 ? sum - quotient : sum + quotient;
    }
  const std::chrono::duration<double> elapsed = std::chrono::steady_clock::now() - start;
  return elapsed.count() / (sweeps * static_cast<double>(a.size()));
}

}  // namespace

UnitCosts recorded_costs(const std::string& component, int dimensions,
                         const std::vector<std::string>& effects, bool levels,
                         const std::string& interpolator) {
  UnitCosts costs;
  const auto d = static_cast<std::size_t>(std::clamp(dimensions, 1, 3) - 1);
  for (const ComponentCosts& c : recorded_components)
    if (component == c.component) costs = {c.cell_ns[d], c.particle_ns[d], c.step_s};
  for (const InterpolatorCosts& i : interpolators)
    if (interpolator == i.name) costs.particle_ns *= i.particles;
  double added = 0;
  for (const EffectCosts& e : effects_known) {
    if (std::find(effects.begin(), effects.end(), e.effect) == effects.end()) continue;
    costs.cell_ns *= e.cells;
    costs.particle_ns *= e.particles;
    added += e.cell_ns;
  }
  costs.cell_ns = (costs.cell_ns + added) * (levels ? levels_factor : 1);
  return costs;
}

double machine_factor() {
  static const double factor = [] {
    CalibrationRow a{}, b{};
    for (std::size_t i = 0; i < a.size(); ++i) {
      a[i] = 0.0009 * static_cast<double>(i);
      b[i] = 1.0 - 0.0005 * static_cast<double>(i);
    }
    double least = std::numeric_limits<double>::infinity();
    for (int n = 0; n < 7; ++n) least = std::min(least, sweep_seconds(a, b));
    return std::clamp(1e9 * least / recorded_calibration_ns, 0.2, 10.0);
  }();
  return factor;
}

}  // namespace sluice
