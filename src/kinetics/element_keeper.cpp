#include "kinetics/element_keeper.hpp"

#include <algorithm>

namespace sluice::kinetics {

ElementKeeper::ElementKeeper(const Mechanism& mechanism)
    : species_(mechanism.species.size()), elements_(mechanism.elements.size()) {
  atoms_.resize(elements_ * species_);
  matrix_.resize(elements_ * elements_);
  excess_.resize(elements_);
  for (std::size_t k = 0; k < species_; ++k)
    for (std::size_t e = 0; e < mechanism.species[k].atoms.size(); ++e)
      atoms_[e * species_ + k] = mechanism.species[k].atoms[e];
}

void ElementKeeper::correct(double* c, double* change) {
  constexpr int passes = 2;  // the second takes what the round-off of the first left
  for (int pass = 0; pass < passes; ++pass) {
    for (std::size_t e = 0; e < elements_; ++e) {
      const double* a = &atoms_[e * species_];
      excess_[e] = 0;
      for (std::size_t k = 0; k < species_; ++k) excess_[e] += a[k] * change[k];
      for (std::size_t f = 0; f <= e; ++f) {
        const double* b = &atoms_[f * species_];
        double sum = 0;
        for (std::size_t k = 0; k < species_; ++k) sum += a[k] * b[k] * c[k];
        matrix_[e * elements_ + f] = sum;
      }
    }
    solve();
    for (std::size_t k = 0; k < species_; ++k) {
      double share = 0;
      for (std::size_t e = 0; e < elements_; ++e) share += atoms_[e * species_ + k] * excess_[e];
      const double correction = c[k] * share;
      c[k] -= correction;
      change[k] -= correction;
    }
  }
}

// Cholesky's decomposition. The matrix is singular where an element is absent, or all its atoms are
// in molecules of one composition: such a pivot has nothing of its own to correct and is left out.
void ElementKeeper::solve() {
  const auto at = [&](std::size_t e, std::size_t f) -> double& {
    return matrix_[e * elements_ + f];
  };
  constexpr double nothing = 1e-10;
  for (std::size_t e = 0; e < elements_; ++e) {
    const double whole = at(e, e);
    for (std::size_t f = 0; f < e; ++f) {
      double sum = at(e, f);
      for (std::size_t g = 0; g < f; ++g) sum -= at(e, g) * at(f, g) * at(g, g);
      at(e, f) = at(f, f) > 0 ? sum / at(f, f) : 0;
    }
    for (std::size_t f = 0; f < e; ++f) at(e, e) -= at(e, f) * at(e, f) * at(f, f);
    if (!(at(e, e) > nothing * whole)) at(e, e) = 0;
    for (std::size_t f = 0; f < e; ++f) excess_[e] -= at(e, f) * excess_[f];
  }
  for (std::size_t e = elements_; e-- > 0;) {
    excess_[e] = at(e, e) > 0 ? excess_[e] / at(e, e) : 0;
    for (std::size_t f = e + 1; f < elements_; ++f) excess_[e] -= at(f, e) * excess_[f];
    if (!(at(e, e) > 0)) excess_[e] = 0;
  }
}

}  // namespace sluice::kinetics
