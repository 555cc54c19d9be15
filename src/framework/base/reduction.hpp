// What the ranks agree upon once a step: minima, maxima, exact sums, counts, flags; one message.
// Values may have any unit.
//
//   Reduction step;
//   auto dt = step.add_minimum(local_dt, limit_id);
//   auto mass = step.add_sum(local_mass);
//   auto reject = step.add_any(bad_cell);
//   world().reduce(step);
//   if (!step.any(reject)) advance(step.minimum(dt), step.sum(mass).value());
//
// Every operation is associative and commutative to the bit: the result does not depend on the
// number of ranks or the order of arrival. A NaN given to a minimum or maximum wins.
// All ranks add the same kinds in the same order; otherwise reduce() throws.
#pragma once
#include <cstddef>
#include <cstdint>
#include <vector>

#include "framework/base/exact_sum.hpp"

namespace sluice {

class Reduction {
 public:
  struct Minimum {
    std::size_t word;
  };
  struct Maximum {
    std::size_t word;
  };
  struct Sum {
    std::size_t word;
  };
  struct Count {
    std::size_t word;
  };
  struct Any {
    std::size_t word;
  };

  // The tag travels with the value (which cell, which limit); the smallest one among equals.
  Minimum add_minimum(double value, std::int64_t tag = 0);
  Maximum add_maximum(double value, std::int64_t tag = 0);
  Sum add_sum(const ExactSum& value);
  Count add_count(std::int64_t value);
  Any add_any(bool value);

  double minimum(Minimum slot) const;
  std::int64_t tag(Minimum slot) const;
  double maximum(Maximum slot) const;
  std::int64_t tag(Maximum slot) const;
  ExactSum sum(Sum slot) const;
  std::int64_t count(Count slot) const;
  bool any(Any slot) const;

  // Ready to be filled again; keeps its memory.
  void clear() { words_.clear(); }

  // For the communicator: self-describing words, and the operation on two such records.
  // False when the records do not hold the same slots.
  std::vector<std::int64_t>& words() { return words_; }
  static bool combine(const std::int64_t* from, std::int64_t* into, std::size_t count);
  // False after a combination of records that did not hold the same slots.
  bool is_consistent() const;

 private:
  std::vector<std::int64_t> words_;
};

}  // namespace sluice
