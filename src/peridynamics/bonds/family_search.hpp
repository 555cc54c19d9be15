// The neighbours of one point after the other, in the order of the columns.
#pragma once
#include <vector>

#include "peridynamics/points/point_table.hpp"

namespace sluice::peridynamics {

struct Neighbour {
  int entry = 0;
  float w = 0;
  bool cut = false;  // by a pre-crack
  double r = 0, beta = 0;
};

// Rows of points with the same bins along z and y, which follow each other in the columns.
class PointRows {
 public:
  explicit PointRows(const PointTable& points);

  struct Row {
    int z = 0, y = 0, begin = 0, end = 0;
    double low_y = 0, high_y = 0, low_z = 0, high_z = 0;  // of its points, m
  };
  const std::vector<Row>& all() const { return rows_; }
  int find(int z, int y) const;  // first row that is not before it
  int row_of(int entry) const;

 private:
  std::vector<Row> rows_;
};

// Of a thread: points must be asked for in rising order within a row.
class FamilySearch {
 public:
  FamilySearch(const PointTable& points, const PointRows& rows, const PeriScene& scene);

  // Replaces `found`.
  void find(int entry, std::vector<Neighbour>& found);

 private:
  struct Window {
    int next = 0, end = 0;
    double low_y = 0, high_y = 0, low_z = 0, high_z = 0;
  };
  void open_row(int row);

  const PointTable* points_;
  const PointRows* rows_;
  const PeriScene* scene_;
  BondRule rule_;
  int row_ = -1, last_ = -1;
  std::vector<Window> windows_;
};

}  // namespace sluice::peridynamics
