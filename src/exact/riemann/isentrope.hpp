// The states of a fluid along one isentrope, with the velocity that a rarefaction gives them.
//
// With x = ln(density):  de/dx = p/rho,  du/dx = c  (a wave that runs to the right, so that
// expansion lowers u). Gragg's modified midpoint rule with Richardson extrapolation in the squared
// step, step and order by its own error estimate; nodes are kept, and a state between two of them
// is one more step from the upper one, so that all states are as accurate as the nodes.
// Reference: Hairer, Norsett and Wanner, Solving Ordinary Differential Equations I, 2nd ed.
// (Springer, 1993), section II.9.
// Limit: the isentrope ends where c^2 is no longer positive (the law's own end). Pa and m/s.
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "eos/bracketed_root.hpp"
#include "exact/base/fluid_state.hpp"
#include "framework/base/error.hpp"

namespace sluice::exact {

template <eos::Law Law>
class Isentrope {
 public:
  Isentrope(const Law& law, const FluidState& start) : law_(law), rho0_(start.density) {
    nodes_.push_back({0.0, start.energy, 0.0});
  }

  // The state at a pressure below that of the start; nothing where the isentrope ends above it.
  // The velocity is relative to the start. Adds nodes as far as needed.
  std::optional<FluidState> at_pressure(double p) {
    while (state(nodes_.back()).pressure > p) {
      if (!extend()) return std::nullopt;
    }
    const auto below = std::partition_point(nodes_.begin(), nodes_.end(),
                                            [&](const Node& n) { return state(n).pressure > p; });
    if (below == nodes_.begin()) return state(*below);
    const Node upper = *(below - 1);
    return find(upper, *below, [&](const FluidState& s) {
      return eos::ValueAndSlope{s.pressure - p, squared_sound_speed(s)};
    });
  }

  // The state whose velocity plus speed of sound is `speed`: inside a fan that at_pressure() has
  // reached the tail of.
  FluidState at_wave_speed(double speed) const {
    const auto below = std::partition_point(
        nodes_.begin(), nodes_.end(), [&](const Node& n) { return wave_speed(state(n)) > speed; });
    if (below == nodes_.begin()) return state(nodes_.front());
    if (below == nodes_.end()) return state(nodes_.back());
    return find(*(below - 1), *below, [&](const FluidState& s) {
      return eos::ValueAndSlope{wave_speed(s) - speed, wave_speed_slope(s)};
    });
  }

 private:
  struct Node {
    double x, energy, velocity;  // x: logarithm of the density over that of the start
  };
  struct Rates {
    double energy, velocity, squared_speed;
    bool good() const { return squared_speed > 0 && std::isfinite(energy + velocity); }
  };
  static constexpr int rows = 9;  // of the extrapolation table, 2, 4, ... 18 substeps
  static constexpr double tolerance = 1e-14, smallest_step = 1e-11;
  static constexpr double thinnest = -500;        // logarithm of the density
  static constexpr std::size_t max_nodes = 5000;  // else creeping towards c = 0

  FluidState state(const Node& n) const {
    const double rho = rho0_ * std::exp(n.x);
    return {rho, n.velocity, law_.pressure(rho, rho * n.energy), n.energy};
  }
  double squared_sound_speed(const FluidState& s) const {
    return law_.sound_speed_squared(s.density, s.density * s.energy);
  }
  double wave_speed(const FluidState& s) const {
    return s.velocity + std::sqrt(squared_sound_speed(s));
  }
  // d(u + c)/d rho, the derivative of c by differences along the isentrope.
  double wave_speed_slope(const FluidState& s) const {
    constexpr double d = 1e-5;
    const auto moved = [&](double by) {
      return wave_speed({s.density * (1 + by), by * std::sqrt(squared_sound_speed(s)), 0.0,
                         s.energy + by * s.pressure / s.density});
    };
    return 0.5 * (moved(d) - moved(-d)) / (d * s.density);
  }
  Rates rates(const Node& n) const {
    const double rho = rho0_ * std::exp(n.x), rho_e = rho * n.energy;
    const double c2 = law_.sound_speed_squared(rho, rho_e);
    return {law_.pressure(rho, rho_e) / rho, std::sqrt(c2), c2};
  }

  bool midpoint(const Node& from, double h, int substeps, Node& to) const {
    const double d = h / substeps;
    Node before = from;
    Rates r = rates(from);
    if (!r.good()) return false;
    Node now{from.x + d, from.energy + d * r.energy, from.velocity + d * r.velocity};
    for (int k = 1; k < substeps; ++k) {
      r = rates(now);
      if (!r.good()) return false;
      const Node next{from.x + d * (k + 1), before.energy + 2 * d * r.energy,
                      before.velocity + 2 * d * r.velocity};
      before = now;
      now = next;
    }
    r = rates(now);
    to = {from.x + h, 0.5 * (before.energy + now.energy + d * r.energy),
          0.5 * (before.velocity + now.velocity + d * r.velocity)};
    return r.good();
  }

  // One step; the number of rows that it took, 0 when it did not converge. Steps of the smallest
  // size are taken as they are: the law has a kink there.
  int step(const Node& from, double h, Node& to) const {
    const bool tiny = std::abs(h) <= smallest_step;
    std::array<Node, rows> above, here;  // rows of the table, orders 2, 4, ... along each
    for (int row = 0; row < rows; ++row) {
      if (!midpoint(from, h, 2 * (row + 1), here[0])) return 0;
      double off_energy = 0, off_velocity = 0;
      for (int k = 1; k <= row; ++k) {
        const double ratio = (row + 1.0) / (row + 1.0 - k);
        const double share = 1 / (ratio * ratio - 1);
        off_energy = share * (here[k - 1].energy - above[k - 1].energy);
        off_velocity = share * (here[k - 1].velocity - above[k - 1].velocity);
        here[k] = {from.x + h, here[k - 1].energy + off_energy,
                   here[k - 1].velocity + off_velocity};
      }
      above = here;
      if (row < 2) continue;
      to = here[row];
      const Rates r = rates(to);
      if (!r.good()) return 0;
      if (tiny || (std::abs(off_energy) <= tolerance * (std::abs(to.energy) + r.squared_speed) &&
                   std::abs(off_velocity) <= tolerance * r.velocity))
        return row + 1;
    }
    return 0;
  }

  bool extend() {
    if (nodes_.back().x < thinnest || nodes_.size() > max_nodes) return false;
    for (;;) {
      Node to{};
      const int used = step(nodes_.back(), -next_, to);
      if (used > 0) {
        nodes_.push_back(to);
        next_ *= used <= 5 ? 1.6 : used >= 8 ? 0.7 : 1.0;
        next_ = std::min(next_, 1.0);
        return true;
      }
      if (next_ <= smallest_step) return false;
      next_ = std::max(0.5 * next_, smallest_step);
    }
  }

  Node between(Node from, double x) const {
    double h = x - from.x;
    while (from.x > x) {
      Node to{};
      if (step(from, h, to) > 0) {
        from = to;
        h = x - from.x;
      } else if (std::abs(h) <= smallest_step) {
        throw PhysicsError(
            "isentrope: no state between two that exist; is the equation of state continuous?");
      } else {
        h = -std::max(0.5 * std::abs(h), smallest_step);
      }
    }
    return from;
  }

  // Where f, which rises with the density, is zero between two nodes.
  template <class Function>
  FluidState find(const Node& upper, const Node& lower, const Function& f) const {
    const auto at = [&](double rho) { return state(between(upper, std::log(rho / rho0_))); };
    const double low = rho0_ * std::exp(lower.x), high = rho0_ * std::exp(upper.x);
    const auto excess = [&](double rho) { return f(at(rho)); };
    return at(eos::bracketed_root(excess, low, high, eos::middle_of(low, high)));
  }

  Law law_;
  double rho0_;
  double next_ = 0.05;
  std::vector<Node> nodes_;
};

}  // namespace sluice::exact
