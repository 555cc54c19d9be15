// What a component conserves: totals, what enters, what forces add, and what a run counts beside.
// The defaults are those of a component of one material that conserves nothing.
#pragma once
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "framework/field/warehouse.hpp"
#include "framework/refine/coverage.hpp"
#include "framework/refine/volume_faces.hpp"
#include "framework/run/component/body_energy.hpp"
#include "framework/run/component/conservation.hpp"

namespace sluice {

class Communicator;
class ParticleCloud;

// Totals over the cells of this rank.
struct Totals {
  std::vector<ConservedTotal> mass;     // by material, kg
  ConservedTotal momentum[3];           // kg m/s
  ConservedTotal internal_energy;       // J
  ConservedTotal kinetic_energy;        // J
  std::vector<double> tracked_totals;   // BudgetFacet::tracked_names, since the start; of all ranks
  std::vector<ConservedTotal> amounts;  // what else the component carries, in its own order
  // What the last sweep over each level summed, over levels and ranks; empty before the first.
  std::vector<double> sweep_sums;
};

// What came in through the boundary in one accepted step, and what forces and sources added: kg,
// kg m/s and J.
struct StepBalance {
  std::vector<double> mass;             // by material
  std::vector<double> mass_of_sources;  // by material; empty: none
  Vec3 momentum{}, momentum_of_forces{};
  double energy = 0, energy_of_forces = 0;
};

// Totals of the conserved quantities at the start of a step, over all ranks.
struct StepStart {
  std::vector<double> mass;  // by material, kg
  Vec3 momentum{};           // kg m/s
};

class BudgetFacet {
 public:
  virtual ~BudgetFacet() = default;

  // Over the uncovered cells.
  virtual void add_totals(const Warehouse& state, const LevelCoverage& coverage,
                          Totals& totals) const;
  virtual void add_particle_totals(const ParticleCloud& /*particles*/, Totals& /*totals*/) const {}
  // From the reduced sums of a step of length dt (s) that began with these totals; `start` is null
  // with several levels: then the sums hold all that forces need.
  virtual StepBalance balance(const std::vector<double>& sums, const StepStart* start,
                              double dt) const;
  // Where the sums of a step hold those of control volumes, as many as the scene has volumes;
  // nothing: the component keeps no account of them. One that does sums in the segments of
  // StepVariant::volumes what passes, in the uncovered cells inside what forces add.
  virtual std::optional<VolumeSums> volume_sums() const { return {}; }

  // What a run counts beside what is conserved, from start to end and over restarts; names for
  // checkpoints, and what an accepted step with these sums adds to each, in units of the component.
  virtual std::vector<std::string> tracked_names() const { return {}; }
  virtual std::vector<double> tracked_totals(const std::vector<double>& /*sums*/) const {
    return {};
  }
  // What a tally follows, as far as it follows a total; and what a report says of them, by name.
  virtual std::vector<ConservedTotal> tallied_totals(const Totals& /*totals*/) const { return {}; }
  virtual std::vector<std::pair<std::string, double>> budget(
      const Conservation& /*tallies*/) const {
    return {};
  }

  // Bodies whose energy is watched, from the sums of a step, always in the same order; none: no
  // energy is. Where in an attempted step a body has gained most, for a message (collective).
  virtual std::vector<BodyEnergy> body_energies(const std::vector<double>& /*sums*/) const {
    return {};
  }
  virtual std::string place_of_gain(const ParticleCloud& /*cloud*/, int /*material*/,
                                    Communicator& /*ranks*/) const {
    return "";
  }
  // What a deck would take for their energies to be kept better, "<...> ..."; "": it has it.
  virtual std::string better_for_energy() const { return ""; }
};

}  // namespace sluice
