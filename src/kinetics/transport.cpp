#include "kinetics/transport.hpp"

#include <algorithm>
#include <cmath>

namespace sluice::kinetics {
namespace {

constexpr double trifle = 1e-12;  // of a mole fraction

double polynomial(const Fit& a, double x) {
  return (((a[4] * x + a[3]) * x + a[2]) * x + a[1]) * x + a[0];
}

bool has_fits(const Mechanism& mechanism) {
  const std::vector<Species>& all = mechanism.species;
  return mechanism.diffusion.size() == all.size() * all.size() &&
         std::all_of(all.begin(), all.end(),
                     [](const Species& s) { return s.viscosity && s.conductivity; });
}

}  // namespace

Transport::Transport(const SpeciesGas& gas)
    : count_(gas.count()),
      available_(has_fits(gas.mechanism())),
      T_min_(gas.heat_of(0).T_min),
      T_max_(gas.heat_of(0).T_max) {
  if (!available_) return;
  for (const Species& species : gas.mechanism().species) {
    molar_mass_.push_back(species.molar_mass);
    viscosity_.push_back(*species.viscosity);
    conductivity_.push_back(*species.conductivity);
  }
  diffusion_ = gas.mechanism().diffusion;
  for (std::size_t k = 0; k < count_; ++k)
    for (std::size_t j = 0; j < count_; ++j) {
      const double ratio = molar_mass_[k] / molar_mass_[j];
      weight_.push_back(std::pow(ratio, -0.25));
      scale_.push_back(1 / std::sqrt(8 * (1 + ratio)));
    }
  for (std::vector<double>* space : {&root_viscosity_, &lambda_, &X_, &Y_}) space->resize(count_);
  resistance_.resize(count_ * count_);
}

void Transport::fits_at(double T) {
  if (T == T_) return;
  T_ = T;
  const double x = std::log(std::min(std::max(T, T_min_), T_max_));
  const double root = std::sqrt(T), fourth = std::sqrt(root);
  const double inverse = 1 / (T * root);
  for (std::size_t k = 0; k < count_; ++k) {
    root_viscosity_[k] = fourth * polynomial(viscosity_[k], x);
    lambda_[k] = root * polynomial(conductivity_[k], x);
    for (std::size_t j = 0; j < k; ++j) {
      const double of_pair = inverse / polynomial(diffusion_[k * count_ + j], x);
      resistance_[k * count_ + j] = resistance_[j * count_ + k] = of_pair;
    }
  }
}

void Transport::set(double T, const double* Y) {
  fits_at(T);
  double moles = 0;
  for (std::size_t k = 0; k < count_; ++k) {
    X_[k] = std::max(Y[k], 0.0) / molar_mass_[k];
    moles += X_[k];
  }
  const double inverse = 1 / moles;
  double mass = 0;
  for (std::size_t k = 0; k < count_; ++k) {
    X_[k] = X_[k] * inverse + trifle;
    Y_[k] = X_[k] * molar_mass_[k];
    mass += Y_[k];
  }
  for (std::size_t k = 0; k < count_; ++k) Y_[k] /= mass;
}

double Transport::viscosity() const {
  double mu = 0;
  for (std::size_t k = 0; k < count_; ++k) {
    const double* weight = &weight_[k * count_];
    const double* scale = &scale_[k * count_];
    double sum = 0;
    for (std::size_t j = 0; j < count_; ++j) {
      const double root = 1 + root_viscosity_[k] / root_viscosity_[j] * weight[j];
      sum += X_[j] * root * root * scale[j];
    }
    mu += X_[k] * root_viscosity_[k] * root_viscosity_[k] / sum;
  }
  return mu;
}

double Transport::conductivity() const {
  double sum = 0, inverse = 0;
  for (std::size_t k = 0; k < count_; ++k) {
    sum += X_[k] * lambda_[k];
    inverse += X_[k] / lambda_[k];
  }
  return 0.5 * (sum + 1 / inverse);
}

void Transport::diffusion(double p, double* D) const {
  for (std::size_t k = 0; k < count_; ++k) {
    const double* resistance = &resistance_[k * count_];
    double others = 0, by_mole = 0, by_mass = 0;
    for (std::size_t j = 0; j < count_; ++j) {
      if (j == k) continue;
      others += Y_[j];  // 1 - Y_k, without its round-off
      by_mole += X_[j] * resistance[j];
      by_mass += Y_[j] * resistance[j];
    }
    D[k] = 1.0 / (p * (by_mole + X_[k] / others * by_mass));
  }
}

}  // namespace sluice::kinetics
