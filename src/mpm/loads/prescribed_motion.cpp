#include "mpm/loads/prescribed_motion.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "framework/base/data_lines.hpp"
#include "framework/base/error.hpp"

namespace sluice::mpm {
namespace {

constexpr Matrix3 unit = {1, 0, 0, 0, 1, 0, 0, 0, 1};

Matrix3 product(const Matrix3& a, const Matrix3& b) {
  Matrix3 c{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      for (std::size_t k = 0; k < 3; ++k) c[3 * i + j] += a[3 * i + k] * b[3 * k + j];
  return c;
}

Matrix3 inverse(const Matrix3& m) {
  const auto minor = [&](std::size_t i, std::size_t j) {
    const std::size_t a = (i + 1) % 3, b = (i + 2) % 3, c = (j + 1) % 3, d = (j + 2) % 3;
    return m[3 * a + c] * m[3 * b + d] - m[3 * a + d] * m[3 * b + c];
  };
  const double det = m[0] * minor(0, 0) + m[1] * minor(0, 1) + m[2] * minor(0, 2);
  Matrix3 to{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) to[3 * j + i] = minor(i, j) / det;
  return to;
}

// About a unit vector, by Rodrigues' formula.
Matrix3 rotation(const std::array<double, 3>& axis, double degrees) {
  if (degrees == 0) return unit;
  const double length = std::hypot(axis[0], axis[1], axis[2]);
  const double angle = degrees * std::numbers::pi / 180;
  const double c = std::cos(angle), s = std::sin(angle);
  const double x = axis[0] / length, y = axis[1] / length, z = axis[2] / length;
  return {c + x * x * (1 - c),     x * y * (1 - c) - z * s, x * z * (1 - c) + y * s,
          y * x * (1 - c) + z * s, c + y * y * (1 - c),     y * z * (1 - c) - x * s,
          z * x * (1 - c) - y * s, z * y * (1 - c) + x * s, c + z * z * (1 - c)};
}

}  // namespace

PrescribedMotion::PrescribedMotion(std::vector<Row> rows) : rows_(std::move(rows)) {
  if (rows_.size() < 2) throw std::invalid_argument("a prescribed deformation needs two rows");
  turned_.push_back(unit);
  for (std::size_t n = 1; n < rows_.size(); ++n) {
    const Row& row = rows_[n];
    if (!(row.time > rows_[n - 1].time))
      throw std::invalid_argument(
          fmt::format("time {:g} is not after the one before, {:g}", row.time, rows_[n - 1].time));
    if (row.angle != 0 && std::hypot(row.axis[0], row.axis[1], row.axis[2]) == 0)
      throw std::invalid_argument(
          fmt::format("the axis of the row at {:g} is a zero vector", row.time));
    turned_.push_back(product(rotation(row.axis, row.angle), turned_.back()));
  }
}

PrescribedMotion PrescribedMotion::read(const std::string& file) {
  std::vector<Row> rows;
  const std::vector<std::string> columns = {"time",  "F11",    "F12",    "F13",   "F21",
                                            "F22",   "F23",    "F31",    "F32",   "F33",
                                            "angle", "axis x", "axis y", "axis z"};
  read_table(file, columns, [&](const TableRow& v) {
    Row row;
    row.time = v[0];
    for (std::size_t n = 0; n < 9; ++n) row.F[n] = v[1 + n];
    row.angle = v[10];
    for (std::size_t n = 0; n < 3; ++n) row.axis[n] = v[11 + n];
    if (!rows.empty() && !(row.time > rows.back().time))
      v.refuse(0, fmt::format("time {:g} is not after the one before, {:g}", row.time,
                              rows.back().time));
    if (row.angle != 0 && std::hypot(row.axis[0], row.axis[1], row.axis[2]) == 0)
      v.refuse(11, "the axis of this rotation is a zero vector");
    rows.push_back(row);
  });
  try {
    return PrescribedMotion(std::move(rows));
  } catch (const std::invalid_argument& e) {
    throw InputError(fmt::format("{}: {}", file, e.what()));
  }
}

Matrix3 PrescribedMotion::at(double time) const {
  if (time <= rows_.front().time) return rows_.front().F;
  if (time >= rows_.back().time) return product(turned_.back(), rows_.back().F);
  std::size_t n = 1;
  while (rows_[n].time <= time) ++n;
  const Row &a = rows_[n - 1], &b = rows_[n];
  const double share = (time - a.time) / (b.time - a.time);
  Matrix3 F;
  for (std::size_t e = 0; e < 9; ++e) F[e] = a.F[e] + share * (b.F[e] - a.F[e]);
  return product(rotation(b.axis, share * b.angle), product(turned_[n - 1], F));
}

Matrix3 PrescribedMotion::rate(double time, double dt) const {
  Matrix3 step = product(at(time + dt), inverse(at(time)));
  for (std::size_t e = 0; e < 9; ++e) step[e] = (step[e] - unit[e]) / dt;
  return step;
}

}  // namespace sluice::mpm
