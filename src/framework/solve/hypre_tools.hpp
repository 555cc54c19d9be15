// What all solvers of hypre share: its start, its error codes, its objects, and who holds what.
//
// hypre starts MPI, so that it starts with the first system that asks for it. Its error flag is
// global and stays set: it is cleared before each set-up and solve.
#pragma once
#include <HYPRE.h>
#include <HYPRE_utilities.h>

#include <string>
#include <utility>

#include "framework/solve/dense_system.hpp"

namespace sluice::solve {

// Starts MPI and hypre, once.
void start_hypre();
// After a call that must succeed: throws SystemError with hypre's own words.
void check_hypre(HYPRE_Int code, const char* call);
// What hypre says of the error flag, which is cleared; empty when it is not set, or only because
// the solve has not converged.
std::string take_hypre_failure();

// One object of hypre, destroyed with its owner.
template <class T, HYPRE_Int (*Destroy)(T)>
class HypreObject {
 public:
  HypreObject() = default;
  HypreObject(HypreObject&& other) noexcept : object_(std::exchange(other.object_, nullptr)) {}
  HypreObject& operator=(HypreObject&& other) noexcept {
    std::swap(object_, other.object_);
    return *this;
  }
  ~HypreObject() {
    if (object_ != nullptr) Destroy(object_);
  }
  T get() const { return object_; }
  T* out() { return &object_; }  // of an empty one, for a function that creates

 private:
  T object_ = nullptr;
};

// The slices of a window, in its last direction of several cells, that a rank gives to hypre.
struct Slab {
  int direction = 1;
  int begin = 0, end = 0;
  DenseShape shape;

  bool empty() const { return end <= begin; }
  int dimensions() const { return direction + 1; }
  std::array<int, 3> lower() const;
  std::array<int, 3> upper() const;  // the last cell
  std::size_t cells() const;
  std::int64_t first_row() const;  // of cells numbered with direction 0 fastest
  // cell(c) in the order of hypre's boxes: direction 0 fastest.
  template <class F>
  void for_cells(F&& cell) const {
    const std::array<int, 3> from = lower(), to = upper();
    if (empty()) return;
    for (int k = from[2]; k <= to[2]; ++k)
      for (int j = from[1]; j <= to[1]; ++j)
        for (int i = from[0]; i <= to[0]; ++i) cell(shape.at(i, j, k));
  }
};
Slab slab_of(const DenseSystem& system);
// Collective: what the solver has of the own slab, into a vector of the system; of a system that is
// whole on every rank, the slabs of all ranks.
void take_solution(const DenseSystem& system, const Slab& slab, const std::vector<double>& own,
                   DenseVector& v);

}  // namespace sluice::solve
