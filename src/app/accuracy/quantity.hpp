// What an archive holds at its end that can be compared between resolutions: saved labels of cells
// and particles as means over bins, and histories as functions of time.
#pragma once
#include <string>
#include <vector>

#include "framework/archive/archive.hpp"

namespace sluice {

struct Quantity {
  enum class Kind { cells, particles, history };
  Kind kind = Kind::cells;
  std::string name;  // of the label, or the file of the history
  int material = 0;  // of none for histories
  std::string unit;

  std::string text() const;  // "rho_CC of material 0"
};

// Real labels of the last output, in its order, then the histories. InputError without an output.
std::vector<Quantity> quantities_of(const Archive& archive);

// A box of space cut into bins.
struct Bins {
  Vec3 lower, upper;  // m
  IntVec3 count;

  std::size_t size() const {
    return static_cast<std::size_t>(count.x) * static_cast<std::size_t>(count.y) *
           static_cast<std::size_t>(count.z);
  }
};
// One bin per cell of the coarsest level of a step.
Bins bins_of(const ArchiveStep& step);

// Means over bins, x fastest, in the unit of the label: of cells by volume, finer levels where they
// are; of particles by p.mass (all alike where it is not saved), each in the bin where it was at
// the start (where it is, without p.displacement).
struct BinnedField {
  std::vector<std::vector<double>> means;  // by component and bin
  std::vector<double> weights;             // by bin; 0: it holds nothing
};
BinnedField binned(const ArchiveStep& step, const Quantity& quantity, const Bins& bins);

// A history: times (s) and values by component.
struct History {
  std::vector<double> times;
  std::vector<std::vector<double>> values;
};
// InputError where the file is not there or a line is no row of numbers.
History read_history(const Archive& archive, const Quantity& quantity);

// Mean |a - b| over the bins that both have or over time, summed over components, and mean |b|.
struct MeanDifference {
  double difference = 0, size = 0;  // in the unit of the quantity
};
MeanDifference mean_difference(const BinnedField& a, const BinnedField& b);
// Over the times that both have, both taken as linear between their times.
MeanDifference mean_difference(const History& a, const History& b);

// Of the ends of two runs of one scene, over the cells of the first, which is the coarser one.
MeanDifference mean_difference(const Archive& coarse, const Archive& fine,
                               const Quantity& quantity);

}  // namespace sluice
