// The file piece: particles given one by one, with values.
#include "framework/geometry/point_file.hpp"

#include <fmt/format.h>

#include <array>
#include <bit>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <fstream>
#include <sstream>

#include "framework/base/data_lines.hpp"
#include "framework/base/error.hpp"
#include "framework/base/packed_text.hpp"

namespace sluice {

namespace {

double decode(const char* bytes, bool swap) {
  std::array<char, sizeof(double)> b{};
  for (std::size_t i = 0; i < b.size(); ++i) b[i] = bytes[swap ? b.size() - 1 - i : i];
  double x;
  std::memcpy(&x, b.data(), sizeof x);
  return x;
}

// Calls row(numbers) for every record of `columns` doubles.
template <class F>
void read_binary(const std::string& name, std::size_t columns, PointFormat format, F&& row) {
  if (!std::ifstream(name))
    throw InputError(
        fmt::format("geometry file '{}' cannot be opened ({})", name, std::strerror(errno)));
  std::istringstream in(unpacked_text(name, "geometry file"));
  const bool little = std::endian::native == std::endian::little;
  const bool swap = (format == PointFormat::binary_little_endian && !little) ||
                    (format == PointFormat::binary_big_endian && little);
  const std::size_t size = columns * sizeof(double);
  std::vector<char> bytes(size);
  std::vector<double> numbers(columns);
  for (int n = 1;; ++n) {
    in.read(bytes.data(), static_cast<std::streamsize>(size));
    if (in.gcount() == 0) return;
    if (in.gcount() != static_cast<std::streamsize>(size))
      throw InputError(
          fmt::format("{}: row {} is cut short; a row has {} doubles", name, n, columns));
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      numbers[i] = decode(bytes.data() + i * sizeof(double), swap);
      if (!std::isfinite(numbers[i]))
        throw InputError(fmt::format("{}: row {}, number {} is {}; is the byte order right?", name,
                                     n, i + 1, numbers[i]));
    }
    row(numbers);
  }
}

}  // namespace

int numbers_of_point_variable(const std::string& name) {
  for (const char* one : {"p.volume", "p.temperature", "p.color"})
    if (name == one) return 1;
  for (const char* three : {"p.externalforce", "p.fiberdir", "p.rvec1", "p.rvec2", "p.rvec3",
                            "p.velocity", "p.loadCurveID", "p.normal", "p.displacement"})
    if (name == three) return 3;
  return 0;
}

PointFile read_point_file(const std::string& file, PointFormat format,
                          const std::vector<std::string>& variables) {
  std::vector<std::string> columns = {"x", "y", "z"};
  for (const std::string& v : variables) {
    const int n = numbers_of_point_variable(v);
    if (n == 0)
      throw InputError(fmt::format(
          "file: unknown variable '{}'; known are p.volume, p.temperature, p.color, "
          "p.externalforce, p.fiberdir, p.rvec1, p.rvec2, p.rvec3, p.velocity, p.loadCurveID, "
          "p.normal and p.displacement",
          v));
    if (n == 1)
      columns.push_back(v);
    else
      for (const char* axis : {"x", "y", "z"}) columns.push_back(v + " " + axis);
  }
  PointFile result;
  const auto take = [&](const auto& x) {
    result.points.push_back({x[0], x[1], x[2]});
    std::size_t at = 3;
    for (const std::string& v : variables)
      if (numbers_of_point_variable(v) == 1) {
        result.scalars[v].push_back(x[at]);
        at += 1;
      } else {
        result.vectors[v].push_back({x[at], x[at + 1], x[at + 2]});
        at += 3;
      }
  };
  if (format == PointFormat::text)
    read_table(file, columns, [&](const TableRow& row) { take(row); });
  else
    read_binary(file, columns.size(), format, take);
  return result;
}

PointFilePiece::PointFilePiece(PointFile file)
    : file_(std::move(file)), bounds_(Bounds::nothing()) {
  if (file_.points.empty()) throw InputError("file: no points");
  for (Vec3 p : file_.points) bounds_ = bounding(bounds_, {p, p});
  bounds_.lower += Vec3::all(-1e-5);
  bounds_.upper += Vec3::all(1e-5);
}

}  // namespace sluice
