// Tables of a gas's properties over its mixture fraction, as files ".rxn" hold them, or the same
// packed with gzip.
//
//   # comment lines, anywhere
//   number of axes, their names, number of points of each; number of columns, names, units
//   with two axes: the points of the second
//   for each column: the points of the first axis, then a line of values for each point of the
//   second axis
// The first axis is the mixture fraction; with a second one the table is taken at one value of it.
// Values are in the units that the file has.
#pragma once
#include <map>
#include <string>
#include <vector>

namespace sluice::models {

class PropertyTable {
 public:
  // What a deck adds to the columns of the file.
  struct Additions {
    std::map<std::string, double> defaults;      // values of further axes; absent: 0
    std::map<std::string, double> constants;     // columns of one value
    std::map<std::string, std::string> derived;  // columns that are expressions of others
  };

  // InputError names the file, the line, and what it should hold.
  PropertyTable(const std::string& file, Additions additions);

  const std::vector<double>& fractions() const { return fractions_; }
  // One value for each fraction. InputError lists the columns that there are.
  std::vector<double> column(const std::string& name) const;

 private:
  double value(const std::string& name, std::size_t point, int depth) const;

  std::string file_, axis_;
  std::vector<double> fractions_;
  std::map<std::string, std::vector<double>> columns_;
  Additions additions_;
};

}  // namespace sluice::models
