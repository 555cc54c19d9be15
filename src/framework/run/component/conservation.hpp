// What must not change: mass of each material, momentum, total energy, followed exactly.
//
//   drift = (now - start - through the boundary - from sources) / scale
//   scale = max(sum |q| at the start, sum |q| now, sum of |what passed| boundary and sources)
//
// The components of a vector have one scale, the largest of theirs: what is round-off where nothing
// moves along y is no scale for itself. Where the whole vector is round-off, in a flow at rest, its
// scale is what it would be if all the energy moved.
//
// All sums are exact: the drift is the round-off of the scheme, not of the book-keeping, and the
// same on any number of ranks and threads. What passes in a rejected step is never recorded.
// Masses in kg, momenta in kg m/s, energies in J; a drift has no unit.
#pragma once
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "framework/base/exact_sum.hpp"

namespace sluice {

class Json;

// A total over the grid, cell by cell: q and |q|.
struct ConservedTotal {
  ExactSum sum;
  ExactSum magnitude;

  void add(double q) {
    sum.add(q);
    magnitude.add(q < 0 ? -q : q);
  }
  void add(const double* q, std::size_t count);  // a row at the speed of ExactSum's arrays
  void merge(const ConservedTotal& other) {
    sum.merge(other.sum);
    magnitude.merge(other.magnitude);
  }
};

class Conservation {
 public:
  Conservation() = default;
  // Names in the order of the indices below: "mass of gas", "momentum x", "total energy".
  explicit Conservation(std::vector<std::string> names);

  int count() const { return static_cast<int>(budgets_.size()); }
  const std::string& name(int quantity) const;

  // The totals at the start of the run (all ranks' sum); clears what has passed.
  void set_start(int quantity, const ConservedTotal& total);
  void set_now(int quantity, const ConservedTotal& total);
  // What came in through the boundary (negative: left), and what sources such as gravity,
  // reactions or heating added, in one accepted step.
  void add_boundary(int quantity, const ConservedTotal& inflow);
  void add_sources(int quantity, const ConservedTotal& added);

  // The quantities from `first` on are components of a vector, `at_rest` the size that it would
  // have if things moved; a scale below 1e-10 of that is itself round-off.
  void set_vector(int first, int components, double at_rest);

  double start(int quantity) const;
  double now(int quantity) const;
  double boundary(int quantity) const;
  double sources(int quantity) const;
  // now - start - boundary - sources, rounded once.
  double defect(int quantity) const;
  double scale(int quantity) const;
  // defect / scale; 0 when there is nothing at all.
  double drift(int quantity) const;
  // The quantity that drifts most, as its share of the scale; 0 without quantities.
  double worst_drift() const;

  // {name: {start, now, boundary, sources, defect, scale, drift}}
  Json to_json() const;
  std::string table() const;

  // Exact state for a checkpoint: a run that goes on keeps its books.
  Json checkpoint() const;
  // InputError when the names differ or the text is damaged.
  void restore(const Json& json);

 private:
  struct Budget {
    std::string name;
    ConservedTotal start, now, boundary, sources;
  };
  struct Vector {
    int first = 0, components = 0;
    double at_rest = 0;
  };
  double own_scale(int quantity) const;
  Budget& budget_of(int quantity);
  const Budget& budget_of(int quantity) const;

  std::vector<Budget> budgets_;
  Vector vector_;
};

}  // namespace sluice
