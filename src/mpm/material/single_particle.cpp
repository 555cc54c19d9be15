// Particles that follow a given deformation.
#include "mpm/material/single_particle.hpp"

#include <fmt/format.h>

#include <cmath>

#include "framework/base/error.hpp"
#include "mpm/material/base/batch_math.hpp"

namespace sluice::mpm {

namespace {

// Columns of a state.
constexpr int F_at = 0, stress_at = 9, energy_at = 15, wave_at = 16, history_at = 17;

}  // namespace

MaterialSample::MaterialSample(std::shared_ptr<const Material> material,
                               const MaterialConstants& constants, int count, double temperature,
                               const std::array<double, 3>& place)
    : material_(std::move(material)), count_(count) {
  for (const HistoryColumn& h : material_->history()) history_columns_ += h.components;
  const std::size_t n = count;
  now_.values.assign(n * (history_at + history_columns_), 0);
  next_ = now_;
  L_.assign(9 * n, 0);
  temperature_.assign(n, temperature);
  mass_.assign(n, constants.density);
  volume_0_.assign(n, 1);
  heating_.assign(n, 0);
  for (int i = 0; i < count; ++i) id_.push_back(i);
  old_history_.resize(history_columns_);
  history_.resize(history_columns_);

  for (int k = 0; k < 9; ++k) std::fill_n(column(next_, F_at + k), count, k % 4 == 0 ? 1.0 : 0.0);
  Batch b = batch();
  b.old_F = {};
  b.old_stress = {};
  b.old_history = {};
  b.old_energy = nullptr;
  std::array<std::vector<double>, 3> position;
  for (std::size_t d = 0; d < 3; ++d) {
    position[d].assign(n, place[d]);
    b.position[d] = position[d].data();
  }
  material_->start(b);
  std::swap(now_, next_);
}

Batch MaterialSample::batch() {
  Batch b;
  b.count = count_;
  b.time = time_;
  for (int k = 0; k < 9; ++k) {
    b.old_F[k] = column(now_, F_at + k);
    b.F[k] = column(next_, F_at + k);
    b.L[k] = L_.data() + k * count_;
  }
  for (int k = 0; k < 6; ++k) {
    b.old_stress[k] = column(now_, stress_at + k);
    b.stress[k] = column(next_, stress_at + k);
  }
  for (int k = 0; k < history_columns_; ++k) {
    old_history_[k] = column(now_, history_at + k);
    history_[k] = column(next_, history_at + k);
  }
  b.old_history = old_history_;
  b.history = history_;
  b.temperature = temperature_.data();
  b.mass = mass_.data();
  b.volume_0 = volume_0_.data();
  b.spacing = 1;
  b.id = id_.data();
  b.old_energy = column(now_, energy_at);
  b.energy = column(next_, energy_at);
  b.wave_speed = column(next_, wave_at);
  std::fill(heating_.begin(), heating_.end(), 0.0);
  b.heating = heating_.data();
  return b;
}

std::optional<BatchFault> MaterialSample::step(const std::vector<Matrix>& F, double dt) {
  for (int i = 0; i < count_; ++i) {
    const Matrix& to = F[i];
    const Matrix f = product(to, inverse(this->F(i)));
    for (int k = 0; k < 9; ++k) {
      column(next_, F_at + k)[i] = to[k];
      L_[k * count_ + i] = (f[k] - (k % 4 == 0 ? 1 : 0)) / dt;
    }
  }
  Batch b = batch();
  b.dt = dt;
  if (const auto fault = material_->update(b)) return fault;
  if (!isothermal_)
    for (std::size_t i = 0; i < temperature_.size(); ++i) temperature_[i] += dt * heating_[i];
  std::swap(now_, next_);
  time_ += dt;
  return std::nullopt;
}

Matrix MaterialSample::F(int i) const {
  Matrix F{};
  for (int k = 0; k < 9; ++k) F[k] = value(F_at + k, i);
  return F;
}
std::array<double, 6> MaterialSample::stress(int i) const {
  std::array<double, 6> s{};
  for (int k = 0; k < 6; ++k) s[k] = value(stress_at + k, i);
  return s;
}
double MaterialSample::pressure(int i) const {
  return -(value(stress_at, i) + value(stress_at + 1, i) + value(stress_at + 2, i)) / 3;
}
double MaterialSample::equivalent(int i) const {
  return 1.5 * eigenvalue_reach(stress(i), -pressure(i));  // reach = 2 sqrt(J2/3)
}
double MaterialSample::energy(int i) const {
  return value(energy_at, i);
}
double MaterialSample::wave_speed(int i) const {
  return value(wave_at, i);
}
double MaterialSample::history(int k, int i) const {
  return value(history_at + k, i);
}
double MaterialSample::volume_ratio(int i) const {
  return determinant(F(i));
}

void follow(MaterialSample& sample, const Motion& motion, double end, int steps,
            const std::function<void(const MaterialSample&)>& see) {
  if (see) see(sample);
  const double start = sample.time(), dt = (end - start) / steps;
  for (int n = 1; n <= steps; ++n) {
    const auto fault = sample.step(motion(start + n * dt), dt);
    if (fault)
      throw PhysicsError(
          fmt::format("the constitutive model refuses the step to t = {:.6g} s: {} ({:.6g})",
                      start + n * dt, fault->reason, fault->value));
    if (see) see(sample);
  }
}

}  // namespace sluice::mpm
