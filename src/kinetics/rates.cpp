#include "kinetics/rates.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace sluice::kinetics {

Rates::Law Rates::law_of(const Arrhenius& rate) {
  return {std::log(rate.A), rate.b, rate.E / molar_gas_constant};
}

void Rates::add_changes(const Reaction& reaction, Step& step) {
  const auto side = [&](const std::vector<Participant>& participants) {
    Span span{molecules_.size(), 0};
    for (const Participant& p : participants)
      molecules_.insert(molecules_.end(), p.count, p.species);
    span.end = molecules_.size();
    return span;
  };
  step.left = side(reaction.reactants);
  step.right = side(reaction.products);
  std::vector<double> net(count_, 0.0);
  for (std::size_t n = step.left.begin; n < step.left.end; ++n) net[molecules_[n]] -= 1;
  for (std::size_t n = step.right.begin; n < step.right.end; ++n) net[molecules_[n]] += 1;
  step.changes.begin = changes_.size();
  for (std::size_t k = 0; k < count_; ++k)
    if (net[k] != 0) changes_.push_back({k, net[k]});
  step.changes.end = changes_.size();
  step.bodies.begin = bodies_.size();
  for (std::size_t k = 0; k < reaction.efficiency.size(); ++k)
    if (reaction.efficiency[k] != 1) bodies_.push_back({k, reaction.efficiency[k] - 1});
  step.bodies.end = bodies_.size();
  for (std::size_t n = step.changes.begin; n < step.changes.end; ++n)
    step.moles += changes_[n].count;
}

Rates::Rates(const SpeciesGas& gas) : count_(gas.count()), potentials_(gas) {
  for (const Reaction& reaction : gas.mechanism().reactions) {
    Step step;
    step.law = law_of(reaction.rate);
    step.reversible = reaction.reversible;
    if (reaction.third_body) step.form = Form::third_body;
    if (reaction.falloff) {
      step.form = Form::falloff;
      step.low = law_of(reaction.falloff->low);
      step.falloff = falloffs_.size();
      falloffs_.push_back(*reaction.falloff);
    }
    add_changes(reaction, step);
    steps_.push_back(step);
  }
  forward_.resize(steps_.size());
  backward_.resize(steps_.size());
  forward_slope_.resize(steps_.size());
  backward_slope_.resize(steps_.size());
  ratio_.resize(falloffs_.size());
  ratio_slope_.resize(falloffs_.size());
  centre_.resize(falloffs_.size());
}

void Rates::at(double T) {
  if (T == T_) return;
  T_ = T;
  potentials_.at(T);
  const double* g = potentials_.gibbs();
  const double* h = potentials_.enthalpy();
  const double inverse = 1 / T, log_T = std::log(T);
  const double log_density = std::log(reference_pressure / (molar_gas_constant * T));
  constexpr double largest = 690;  // of an exponent, that products with concentrations are finite
  for (std::size_t r = 0; r < steps_.size(); ++r) {
    const Step& step = steps_[r];
    const double log_forward = step.law.log(log_T, inverse);
    forward_[r] = std::exp(std::min(log_forward, largest));
    forward_slope_[r] = step.law.log_slope(inverse);
    if (step.reversible) {
      double log_K = step.moles * log_density, energy = -step.moles;  // of Kc; of reaction/(R T)
      for (std::size_t n = step.changes.begin; n < step.changes.end; ++n) {
        log_K -= changes_[n].count * g[changes_[n].species];
        energy += changes_[n].count * h[changes_[n].species];
      }
      backward_[r] = std::exp(std::min(log_forward - log_K, largest));
      backward_slope_[r] = forward_slope_[r] - energy * inverse;
    }
    if (step.form == Form::falloff) {
      const std::size_t n = step.falloff;
      ratio_[n] = std::exp(step.low.log(log_T, inverse) - log_forward);
      ratio_slope_[n] = step.low.log_slope(inverse) - forward_slope_[r];
      if (falloffs_[n].troe) centre_[n] = log_centre(falloffs_[n], T);
    }
  }
}

double Rates::product(Span side, const double* c) const {
  double product = 1;
  for (std::size_t n = side.begin; n < side.end; ++n) product *= c[molecules_[n]];
  return product;
}

double Rates::third_body(const Step& step, double total, const double* c) const {
  double M = total;
  for (std::size_t n = step.bodies.begin; n < step.bodies.end; ++n)
    M += bodies_[n].count * c[bodies_[n].species];
  return M;
}

Rates::Factor Rates::factor(std::size_t r, double M) const {
  const Step& step = steps_[r];
  if (step.form == Form::third_body) return {M, 1, 0};
  const std::size_t n = step.falloff;
  const double P = ratio_[n] * M;
  const FalloffFactor f = falloff_factor(P, falloffs_[n].troe, centre_[n].value);
  const double by_T = f.by_log_P * ratio_slope_[n] + f.by_centre * centre_[n].slope;
  return {f.value, P > 0 ? f.value / P * f.by_log_P * ratio_[n] : 0, f.value * by_T};
}

void Rates::production(const double* c, double* omega) const {
  double total = 0;
  for (std::size_t k = 0; k < count_; ++k) {
    omega[k] = 0;
    total += c[k];
  }
  for (std::size_t r = 0; r < steps_.size(); ++r) {
    const Step& step = steps_[r];
    double rate = forward_[r] * product(step.left, c);
    if (step.reversible) rate -= backward_[r] * product(step.right, c);
    if (step.form != Form::elementary) rate *= factor(r, third_body(step, total, c)).value;
    for (std::size_t n = step.changes.begin; n < step.changes.end; ++n)
      omega[changes_[n].species] += changes_[n].count * rate;
  }
}

// Of coefficient prod c over one side: the derivative by each c of it, in turn.
void Rates::add_products_slopes(const Step& step, Span side, double coefficient, const double* c,
                                double* by_c) const {
  for (std::size_t m = side.begin; m < side.end; ++m) {
    double slope = coefficient;
    for (std::size_t n = side.begin; n < side.end; ++n)
      if (n != m) slope *= c[molecules_[n]];
    double* column = by_c + molecules_[m] * count_;
    for (std::size_t n = step.changes.begin; n < step.changes.end; ++n)
      column[changes_[n].species] += changes_[n].count * slope;
  }
}

void Rates::derivatives(const double* c, double* by_c, double* by_T) const {
  std::fill(by_c, by_c + count_ * count_, 0.0);
  std::fill(by_T, by_T + count_, 0.0);
  double total = 0;
  for (std::size_t k = 0; k < count_; ++k) total += c[k];
  for (std::size_t r = 0; r < steps_.size(); ++r) {
    const Step& step = steps_[r];
    const double back = step.reversible ? backward_[r] : 0;
    const double forth_rate = forward_[r] * product(step.left, c);
    const double back_rate = back * product(step.right, c);
    Factor s;
    if (step.form != Form::elementary) s = factor(r, third_body(step, total, c));
    add_products_slopes(step, step.left, s.value * forward_[r], c, by_c);
    if (step.reversible) add_products_slopes(step, step.right, -s.value * back, c, by_c);
    const double net = forth_rate - back_rate;
    const double slope =
        s.by_T * net + s.value * (forth_rate * forward_slope_[r] - back_rate * backward_slope_[r]);
    for (std::size_t n = step.changes.begin; n < step.changes.end; ++n) {
      const double count = changes_[n].count;
      by_T[changes_[n].species] += count * slope;
      if (step.form == Form::elementary) continue;
      const double by_M = count * net * s.by_M;
      double* row = by_c + changes_[n].species;
      for (std::size_t j = 0; j < count_; ++j) row[j * count_] += by_M;
      for (std::size_t b = step.bodies.begin; b < step.bodies.end; ++b)
        row[bodies_[b].species * count_] += by_M * bodies_[b].count;
    }
  }
}

}  // namespace sluice::kinetics
