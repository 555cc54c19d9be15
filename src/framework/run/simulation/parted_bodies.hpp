// Numerical fracture: bodies whose particles no longer reach their neighbours through the grid
// although no law lets them break, and since when.
#pragma once
#include <string>
#include <vector>

namespace sluice {

class Json;
struct BodyEnergy;  // framework/run/simulation/energy_guard.hpp

class SeparatedBodies {
 public:
  struct Parting {
    std::string name;
    int material = 0;
    int since = 0;                         // step
    double since_time = 0;                 // s
    double largest = 0, largest_time = 0;  // share of the particles
  };

  // Takes account of an accepted step that ends at `time` (s).
  void accept(const std::vector<BodyEnergy>& step, int number, double time);
  // In the order in which bodies came apart.
  const std::vector<Parting>& all() const { return all_; }
  bool any() const { return !all_.empty(); }
  // One line for each, with what to do about it.
  std::string summary() const;

  // Exact state for a checkpoint.
  Json checkpoint() const;
  void restore(const Json& json);

 private:
  std::vector<Parting> all_;
};

}  // namespace sluice
