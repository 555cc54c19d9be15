// A deformation that a file prescribes for all particles: rows t, F (9, row after row), angle in
// degrees, axis (3).
//
// Between two rows F is straight in time, while the body turns steadily by the angle of the
// later row
// about its axis, on top of the turns before: A(t) = Q(t) Q_before F(t). Places go from x to
// A(t + dt) A(t)^-1 x, about the origin; after the last row nothing moves. Times in s.
#pragma once
#include <array>
#include <string>
#include <vector>

namespace sluice::mpm {

using Matrix3 = std::array<double, 9>;

class PrescribedMotion {
 public:
  struct Row {
    double time = 0;
    Matrix3 F{};
    double angle = 0;  // degrees
    std::array<double, 3> axis{};
  };
  // std::invalid_argument: fewer than two rows, times that do not rise, an axis without length.
  explicit PrescribedMotion(std::vector<Row> rows);
  // InputError with file and line.
  static PrescribedMotion read(const std::string& file);

  Matrix3 at(double time) const;  // A
  // (A(t + dt) A(t)^-1 - I)/dt, 1/s: velocities of a step are this times the place.
  Matrix3 rate(double time, double dt) const;

 private:
  std::vector<Row> rows_;
  std::vector<Matrix3> turned_;  // turns before each row
};

}  // namespace sluice::mpm
