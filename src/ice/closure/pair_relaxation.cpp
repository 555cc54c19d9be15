// Two materials by the exponential, more by two stages.
#include "ice/closure/pair_relaxation.hpp"

#include <cmath>

#include "ice/fluid/material_set.hpp"

namespace sluice::ice::mixture {
namespace {

// Factors of C + g K, eliminated from the last node to the first.
class Elimination {
 public:
  // k is changed: after it, row i holds what node i passes to the nodes before it.
  Elimination(int n, const double* capacity, double* k) : n_(n), k_(k) {
    for (int i = 0; i < n; ++i) capacity_[i] = capacity[i];
    for (int last = n - 1; last >= 0; --last) {
      double sum = capacity_[last];
      for (int j = 0; j < last; ++j) sum += k_[last * n_ + j];
      diagonal_[last] = sum;
      for (int i = 0; i < last; ++i) {
        const double share = k_[i * n_ + last] / sum;
        capacity_[i] += share * capacity_[last];
        for (int j = 0; j < last; ++j)
          if (j != i) k_[i * n_ + j] += share * k_[last * n_ + j];
      }
    }
  }
  // (C + g K) v = right, in place.
  void solve(double* right) const {
    for (int last = n_ - 1; last > 0; --last)
      for (int i = 0; i < last; ++i) right[i] += k_[i * n_ + last] / diagonal_[last] * right[last];
    for (int i = 0; i < n_; ++i) {
      double sum = right[i];
      for (int j = 0; j < i; ++j) sum += k_[i * n_ + j] * right[j];
      right[i] = sum / diagonal_[i];
    }
  }

 private:
  int n_;
  double* k_;
  double capacity_[max_materials], diagonal_[max_materials];
};

}  // namespace

void solve_pairs(int n, const double* capacity, double* k, double* right) {
  Elimination(n, capacity, k).solve(right);
}

void relax_pairs(int n, const double* capacity, const double* value, double* k, double* gain,
                 const double* push) {
  if (n == 2) {
    const double reduced = 1.0 / (1.0 / capacity[0] + 1.0 / capacity[1]);
    const double z = k[1] / reduced, lost = -std::expm1(-z);
    gain[1] = lost * reduced * (value[0] - value[1]);
    if (push != nullptr) gain[1] += (z > 0.0 ? lost / z : 1.0) * push[1];
    gain[0] = -gain[1];
    return;
  }
  const double g = 1.0 - std::sqrt(0.5);
  for (int i = 0; i < n * n; ++i) k[i] *= g;
  const Elimination system(n, capacity, k);
  double mean = 0, total = 0;  // values about their mean keep their digits
  int largest = 0;
  for (int m = 0; m < n; ++m) {
    mean += capacity[m] * value[m];
    total += capacity[m];
    if (capacity[m] > capacity[largest]) largest = m;
  }
  mean /= total;
  double stage[max_materials];
  for (int m = 0; m < n; ++m) {
    stage[m] = capacity[m] * (value[m] - mean);
    if (push != nullptr) stage[m] += g * push[m];
  }
  system.solve(stage);
  for (int m = 0; m < n; ++m) {
    const double about = value[m] - mean;
    stage[m] = capacity[m] * (about + (1.0 - g) / g * (stage[m] - about));
    if (push != nullptr) stage[m] += g * push[m];
  }
  system.solve(stage);
  double others = 0;
  for (int m = 0; m < n; ++m) {
    gain[m] = capacity[m] * (stage[m] - (value[m] - mean));
    if (m != largest) others += gain[m];
  }
  gain[largest] = -others;
}

}  // namespace sluice::ice::mixture
