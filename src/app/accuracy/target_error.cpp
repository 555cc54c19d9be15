#include "app/accuracy/target_error.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "framework/base/console.hpp"
#include "framework/base/error.hpp"
#include "framework/deck/nearest_name.hpp"

namespace sluice {
namespace {

constexpr double finest_factor = 4;  // of the deck's resolution
constexpr double far_beyond = 2;     // factor from the ladder's finest rung to the choice
constexpr int coarsest_cells = 16;   // along a direction
constexpr int most_halvings = 4;     // below the deck's own resolution
constexpr double step_of_choice = 1.189207115002721;  // 2^(1/4): factors that may be chosen

struct Worst {
  double bar = 0, order = 1;  // at the finest rung
  std::string quantity;
};

// The quantity that needs the finest grid for the target.
Worst worst_of(const DeckLadder& ladder, double target, const std::string& wanted) {
  Worst worst;
  double most = -1;
  std::set<std::string> known;
  for (const QuantityBar& q : ladder.bars()) {
    known.insert(q.quantity.name);
    if (!wanted.empty() && q.quantity.name != wanted) continue;
    const double factor = std::pow(q.error.bar / target, 1 / q.error.used_order());
    if (factor <= most) continue;
    most = factor;
    worst = {q.error.bar, q.error.used_order(), q.quantity.text()};
  }
  if (most >= 0) return worst;
  const std::vector<std::string> names(known.begin(), known.end());
  throw InputError(wanted.empty()
                       ? "the deck saves nothing that changes: there is no error to reach"
                       : fmt::format("--quantity {}: nothing of this name is saved ({})", wanted,
                                     suggest_name(wanted, names)));
}

// The smallest factor that may be chosen and is not below `factor`.
double rounded_up(double factor) {
  return std::pow(step_of_choice, std::ceil(std::log(factor) / std::log(step_of_choice) - 1e-9));
}

}  // namespace

ResolutionChoice choose_resolution(DeckLadder& ladder, double target, const std::string& quantity) {
  double factor = 1;
  for (int n = 0; n < most_halvings && ladder.fewest_cells() * factor / 2 >= coarsest_cells; ++n)
    factor /= 2;
  for (int n = 0; n < 3; ++n, factor *= 2) ladder.run(factor);
  for (;;) {
    const Worst worst = worst_of(ladder, target, quantity);
    const double finest = ladder.rungs().back().factor;
    const double needed = finest * std::pow(worst.bar / target, 1 / worst.order);
    if (needed > far_beyond * finest && 2 * finest <= finest_factor / 2) {
      ladder.run(2 * finest);
      continue;
    }
    const double chosen = rounded_up(std::max(needed, ladder.rungs().front().factor));
    if (chosen > finest_factor * (1 + 1e-9))
      throw InputError(fmt::format(
          "--target-error {:g}: {} would need {:.1f} times the cells of the deck along each "
          "direction, at most {:g} times are tried; its error bar at {:g} times is {}",
          target, worst.quantity, needed, finest_factor, finest, human_percent(worst.bar)));
    const double promised = worst.bar * std::pow(finest / chosen, worst.order);
    return {chosen,           promised,
            worst.quantity,   ladder.predicted_seconds(chosen),
            ladder.seconds(), ladder.resolution(chosen)};
  }
}

}  // namespace sluice
