// A law without a grid: particles that follow a given deformation. Units as in material.hpp: s, K,
// Pa, m/s, kg/m^3; tensors row after row, symmetric ones xx, yy, zz, yz, xz, xy.
#pragma once
#include <array>
#include <functional>
#include <memory>
#include <vector>

#include "mpm/material/base/material.hpp"
#include "mpm/material/base/tensor.hpp"

namespace sluice::mpm {

// Columns of some particles of one material, at the start and at the end of a step.
class MaterialSample {
 public:
  // All particles have the volume 1 m^3 and the mass rho_0 at the start, and lie at one place.
  MaterialSample(std::shared_ptr<const Material> material, const MaterialConstants& constants,
                 int count, double temperature, const std::array<double, 3>& place = {});

  // From the present F to these, one for each particle, in dt. A fault leaves the state as it was.
  std::optional<BatchFault> step(const std::vector<Matrix>& F, double dt);
  std::optional<BatchFault> step(const Matrix& F, double dt) {
    return step(std::vector<Matrix>(count_, F), dt);
  }
  // Whether heat that the law makes warms the particles (the default).
  void keep_temperature(bool keep) { isothermal_ = keep; }
  void set_temperature(double temperature) {
    temperature_.assign(temperature_.size(), temperature);
  }

  double time() const { return time_; }
  Matrix F(int i = 0) const;
  std::array<double, 6> stress(int i = 0) const;
  double pressure(int i = 0) const;    // -tr sigma/3
  double equivalent(int i = 0) const;  // sqrt(3 J2), von Mises
  double energy(int i = 0) const;      // J per m^3 at the start
  double wave_speed(int i = 0) const;
  double temperature(int i = 0) const { return temperature_[i]; }
  // A column of the law's history, component after component.
  double history(int column, int i = 0) const;
  int history_columns() const { return history_columns_; }
  double volume_ratio(int i = 0) const;

 private:
  struct State {
    std::vector<double> values;  // column after column
  };
  double* column(State& state, int k) {
    return state.values.data() + static_cast<std::size_t>(k) * count_;
  }
  double value(int k, int i) const { return now_.values[k * count_ + i]; }
  Batch batch();

  std::shared_ptr<const Material> material_;
  int count_, history_columns_ = 0;
  double time_ = 0;
  bool isothermal_ = false;
  State now_, next_;
  std::vector<double> L_, temperature_, mass_, volume_0_, heating_;
  std::vector<std::int64_t> id_;
  std::vector<const double*> old_history_;
  std::vector<double*> history_;
};

// F as a function of time.
using Motion = std::function<Matrix(double time)>;

// Takes `steps` equal steps along the motion and calls `see` at the start and after each.
// PhysicsError with the reason where the law refuses a step.
void follow(MaterialSample& sample, const Motion& motion, double end, int steps,
            const std::function<void(const MaterialSample&)>& see = nullptr);

}  // namespace sluice::mpm
