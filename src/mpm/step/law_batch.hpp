// Columns of particle sets as a constitutive model takes them: a batch at a time.
#pragma once
#include <vector>

#include "mpm/step/columns.hpp"

namespace sluice::mpm {

// Keeps the lists of history columns that its batch points into, and their memory from batch to
// batch.
class LawBatch {
 public:
  // Particles at, ..., at + n - 1: old columns from one set, new ones of another, which may be the
  // same where a law only starts. Time, dt, L, wave speed and heating are the caller's.
  Batch& between(const ParticleSet& from, ParticleSet& to, const Carried& carried, std::size_t at,
                 int n) {
    return between(from, at, to, at, carried, n);
  }
  // The new ones at another place of their set.
  Batch& between(const ParticleSet& from, std::size_t at, ParticleSet& to, std::size_t to_at,
                 const Carried& carried, int n);

 private:
  Batch batch_;
  std::vector<const double*> old_history_;
  std::vector<double*> history_;
};

}  // namespace sluice::mpm
