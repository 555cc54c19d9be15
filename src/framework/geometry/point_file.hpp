// The file piece: particles given one by one, with values.
//
// A row holds x y z and then the listed variables: p.volume, p.temperature, p.color one number
// each, p.externalforce, p.fiberdir, p.rvec1 to p.rvec3, p.velocity, p.loadCurveID, p.normal three.
// Points in m, values in SI units: m^3, K, N, m/s.
#pragma once
#include <map>
#include <string>

#include "framework/geometry/piece.hpp"

namespace sluice {

enum class PointFormat { text, binary, binary_little_endian, binary_big_endian };

struct PointFile {
  std::vector<Vec3> points;
  std::map<std::string, std::vector<double>> scalars;  // by variable name
  std::map<std::string, std::vector<Vec3>> vectors;
};

// Numbers a variable has in a row: 1 or 3; 0 when no such variable exists.
int numbers_of_point_variable(const std::string& name);

// InputError names file and row. Binary files hold doubles without a header.
PointFile read_point_file(const std::string& file, PointFormat format,
                          const std::vector<std::string>& variables);

// Its count of a cell is the number of points there. inside() is true in the box around all points,
// widened by 1e-5 as the format has it.
class PointFilePiece final : public GeometryPiece {
 public:
  // InputError where there are no points.
  explicit PointFilePiece(PointFile file);
  bool inside(Vec3 p) const override { return bounds_.contains(p); }
  Bounds bounds() const override { return bounds_; }
  const std::vector<Vec3>* points() const override { return &file_.points; }
  const PointFile& file() const { return file_; }

 private:
  PointFile file_;
  Bounds bounds_;
};

}  // namespace sluice
