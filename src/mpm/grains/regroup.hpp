// Grains between steps (DoGranularMPM): each cluster of particles gets a material of its own.
#pragma once
#include <vector>

#include "framework/run/component/event_ledger.hpp"
#include "framework/run/levels/particle_cloud.hpp"
#include "mpm/step/columns.hpp"

namespace sluice::mpm {

// What ended with the step that has just been taken.
struct StepEnd {
  double time = 0;                      // s
  std::vector<double>* sums = nullptr;  // of the step; the budgets of masses by material, kg
  EventLedger* events = nullptr;
};

// Of each family of materials: clusters of particles whose boxes overlap (grain_box, clusters),
// their materials (choose_slots), and the particles into them. A particle keeps all that it
// carries, its number too. Materials that do not take part at that time are left alone. On one
// level; particles must be in their boxes. Collective; true: relocate() is next.
bool regroup_grains(const MpmScene& solids, const std::vector<Carried>& carried,
                    ParticleCloud& cloud, Communicator& ranks, const StepEnd& end);

// Grains that have lost touch have no stress, where their material says so. What work it has done
// stays with them. Collective; whether any had some.
bool free_loose_grains(const MpmScene& solids, const std::vector<Carried>& carried,
                       ParticleCloud& cloud, Communicator& ranks);

}  // namespace sluice::mpm
