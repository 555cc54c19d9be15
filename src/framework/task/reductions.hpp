// What a sweep accumulates besides fields: maxima, exact sums, counts and inadmissible cells.
// Maxima and sums have the units of the part that registered them.
//
// Every thread has its own; merging them (and those of other ranks) gives the same bits in any
// order, because maxima, exact sums, integer counts and "the lowest cell" do not depend on order.
#pragma once
#include <bit>
#include <cstdint>
#include <vector>

#include "framework/base/exact_sum.hpp"
#include "framework/base/vec3.hpp"
#include "framework/task/places.hpp"
#include "framework/task/reduction_layout.hpp"
#include "framework/task/row.hpp"

namespace sluice {

// The first inadmissible cell of a step, in (level, k, j, i) order.
struct CellFault {
  IntVec3 cell{};
  int level = 0;
  int material = 0;
  int kind = 0;        // which check failed; the component knows the words
  double value = 0.0;  // what was found, in the unit of StepFacet::describe_fault
};
bool before(const CellFault& a, const CellFault& b);

// A non-negative double as an integer of the same order: lets the compiler take a vectorised
// maximum, and makes NaN the largest of all, so that it cannot hide.
inline std::int64_t ordered_bits(double x) {
  return std::bit_cast<std::int64_t>(x);
}
inline double from_ordered_bits(std::int64_t b) {
  return std::bit_cast<double>(b);
}

class Reductions {
 public:
  Reductions() = default;
  Reductions(int maxima, int sums) : maxima_(maxima, 0), sums_(sums) {}

  void maximum(int slot, std::int64_t bits) {
    std::int64_t& m = maxima_[slot];
    m = bits > m ? bits : m;
  }
  void maximum(const MaximumGroup& group, std::int64_t bits) { maximum(group.first(), bits); }
  double maximum(int slot) const { return from_ordered_bits(maxima_[slot]); }
  ExactSum& sum(int slot) { return sums_[slot]; }
  ExactSum& sum(const SumGroup& group, int n = 0) { return sums_[group.first() + n]; }
  const ExactSum& sum(int slot) const { return sums_[slot]; }

  void fault(const CellFault& f);
  std::int64_t fault_count() const { return static_cast<std::int64_t>(faults_.size()); }
  const std::vector<CellFault>& faults() const { return faults_; }

  int maxima_count() const { return static_cast<int>(maxima_.size()); }
  int sum_count() const { return static_cast<int>(sums_.size()); }
  void clear();
  void merge(const Reductions& other);

 private:
  std::vector<std::int64_t> maxima_;
  std::vector<ExactSum> sums_;
  std::vector<CellFault> faults_;
};

// What the kernels of one part add to the reductions of all: plain numbers are the part's own.
class PartReductions {
 public:
  PartReductions(Reductions& all, const ReductionOffsets& places) : all_(&all), places_(places) {}

  void maximum(int slot, std::int64_t bits) const { all_->maximum(slot + places_.maximum, bits); }
  void maximum(const MaximumGroup& group, std::int64_t bits) const { all_->maximum(group, bits); }
  ExactSum& sum(int slot) const { return all_->sum(slot + places_.sum); }
  ExactSum& sum(const SumGroup& group, int n = 0) const { return all_->sum(group, n); }
  void fault(CellFault f) const {
    f.kind += places_.fault;
    if (places_.material != nullptr) f.material = (*places_.material)[f.material];
    all_->fault(f);
  }

 private:
  Reductions* all_;
  ReductionOffsets places_;
};

inline PartReductions Row::reductions() const {
  return {*reductions_, *places_};
}

}  // namespace sluice
