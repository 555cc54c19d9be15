// Decks with scalars, and what becomes of them.
#pragma once
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

#include "ice/test_support/classic.hpp"

namespace sluice::ice {

// The element <Model> of a scalar; `inside`: tags of <scalar> before <initialization>.
inline std::string scalar_model(const std::string& name, const std::string& region = {},
                                const std::string& inside = {}) {
  return fmt::format(
      "<Model type='PassiveScalar'><PassiveScalar><material>gas</material><scalar name='{}'>{}"
      "<initialization><geom_object><box><min>[-99,-99,-99]</min><max>[99,99,99]</max></box>"
      "<scalar>0</scalar></geom_object>{}</initialization></scalar></PassiveScalar></Model>",
      name, inside, region);
}

inline std::string box_region(const char* low, const char* high, const std::string& values) {
  return fmt::format("<geom_object><box><min>{}</min><max>{}</max></box>{}</geom_object>", low,
                     high, values);
}

inline Label scalar_state(const std::string& name) {
  models::TransportedScalar s;
  s.name = name;
  return s.state();
}

// A box of gas with scalars in the conservative scheme.
class ScalarRun : public Stepper {
 public:
  explicit ScalarRun(GasBox box, const SolverOptions& options = {}, IntVec3 boxes = {})
      : Stepper(conservative(box), options, boxes) {
    rates_ = solver().initial_rates();
  }

  double& scalar(const std::string& name, IntVec3 cell) {
    return value_at(scalar_state(name), cell);
  }
  void set(const std::string& name, const std::function<double(Vec3)>& f) {
    for_each_cell(domain(), [&](IntVec3 c) { scalar(name, c) = f(level().centre(c)); });
    solver().mark_modified();
  }
  // Steps as long as the scheme allows, the last one up to `end`; returns how many.
  int run(double end) {
    int steps = 0;
    for (; time() < end; ++steps) {
      const double dt = ice().step().limit(rates_).dt;
      advance_by(time() + dt > end ? end - time() : dt);
    }
    return steps;
  }
  void steps(int count) {
    for (int n = 0; n < count; ++n) advance_by(ice().step().limit(rates_).dt);
  }
  // Mean distance from f at the centres.
  double error(const std::string& name, const std::function<double(Vec3)>& f) {
    double sum = 0;
    for_each_cell(domain(),
                  [&](IntVec3 c) { sum += std::fabs(scalar(name, c) - f(level().centre(c))); });
    return sum / static_cast<double>(domain().volume());
  }
  double amount() const {
    Totals t;
    ice().budgets().add_totals(const_cast<ScalarRun*>(this)->solver().state(), LevelCoverage(), t);
    return t.amounts.front().sum.value();
  }

 private:
  static GasBox conservative(GasBox box) {
    box.scheme = "conservative";
    return box;
  }
  void advance_by(double dt) {
    const StepAttempt& a = attempt(dt);
    if (a.faults > 0) throw PhysicsError("inadmissible step");
    rates_ = a.maxima;
    solver().advance();
    solver().accept();
    pass(dt);
  }

  std::vector<double> rates_;
};

// Kept in the test's report.
inline double recorded_order(double coarse, double fine) {
  const double order = std::log2(coarse / fine);
  testing::Test::RecordProperty(fmt::format("order_at_error_{:.2e}", fine),
                                fmt::format("{}", order));
  return order;
}

}  // namespace sluice::ice
