// Budgets of control volumes: what they hold, what comes in through their sides, what forces add.
//
//   controlVolFluxes  <label>.dat           time, mass, net mass fluxes x y z, six face fluxes
//   momentumAnalysis  momentumAnalysis.dat  time, momentum, momentum flux, viscous force, pressure
//                                           force, body force (three each), with commas
//   firstLawThermo    1stLawThermo.dat      time, internal energies (ICE, MPM, both), energy that
//                                           leaves, kinetic energy, power of forces
// Rates are means over the time since the line before (the first one's: over its step), summed
// exactly over every substep of every level: they make up all change of what the volume holds,
// to round-off. In the archive's folder, 17 digits, '#' before header lines. s, kg, kg/s, kg m/s,
// N, J and W, those of firstLawThermo times engy_convt_factor.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "framework/analysis/sample_file.hpp"
#include "framework/analysis/sums.hpp"
#include "framework/base/communicator.hpp"
#include "framework/run/levels/hierarchy.hpp"

namespace sluice {

class VolumeBudgets {
 public:
  // The module's volumes are numbers `first`, first + 1, ... among those of the hierarchy.
  VolumeBudgets(const AnalysisModule& module, int first, Hierarchy& hierarchy,
                Communicator& communicator);

  // Boxes are others than before.
  void lay_out();
  // A step of length dt (s) was accepted, with these sums over all ranks.
  void record(double dt, const std::vector<double>& sums);
  // Lines on rank 0. Collective.
  void sample(double time);
  std::size_t lines() const { return volumes_.size(); }
  void flush(const std::filesystem::path& folder);
  void adopt(const std::filesystem::path& earlier, const std::filesystem::path& folder,
             double time) const;
  // What was accounted since the last sample.
  std::vector<std::vector<double>> state() const;
  void restore(const std::vector<std::vector<double>>& state);

 private:
  struct Volume {
    int number = 0;  // in the hierarchy
    AnalysisFile file;
    std::vector<LevelCoverage> coverage;  // by level: what is outside counts as covered
    std::vector<Double2> passed;          // since the last sample
    double seconds = 0;                   // in which it passed
  };

  Totals totals_of(const Volume& volume) const;
  double rate(const Volume& v, int slot) const;
  // Net inflow and force along each direction through sides that have `sign` towards the inside.
  double inflow(const Volume& v, int (VolumeSums::*slot)(int, int) const, int component) const;
  std::string line_of(const Volume& v, const Totals& totals, double time) const;
  std::string fluxes(const Volume& v, const Totals& totals) const;
  std::string momentum(const Volume& v, const Totals& totals) const;
  std::string energy(const Volume& v, const Totals& totals) const;

  const AnalysisModule* module_;
  Hierarchy* hierarchy_;
  Communicator* communicator_;
  VolumeSums slots_;
  int first_slot_, slot_count_;  // of one volume
  std::vector<Volume> volumes_;
  bool sampled_ = false;
};

// Does a module keep budgets of control volumes.
bool keeps_budgets(const AnalysisModule& module);

}  // namespace sluice
