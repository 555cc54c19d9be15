// What the comparison of two steps finds, for the result of the archives.
#pragma once
#include <string>

#include "framework/archive/compare/compare.hpp"

namespace sluice {

class StepLog {
 public:
  // `first`: the step of the first archive. `across`: the archives are of two formats.
  StepLog(const StepInfo& first, bool across, const CompareOptions& options, CompareResult& result)
      : info_(first), across_(across), options_(options), result_(result) {}

  // The steps are not comparable for a cause, of which only the first step tells the detail.
  void refuse(const std::string& cause, const std::string& detail = "");
  void note(const std::string& text);  // once
  // What only one archive has: between formats that is expected, and a note.
  void only_one(const std::string& what);

  // Counts two values of `where` (label, place, component); a difference is kept in `found`.
  void compare_values(Difference where, double a, double b, FieldDifference& found) const;
  void keep(const FieldDifference& found);

 private:
  const StepInfo& info_;
  bool across_;
  const CompareOptions& options_;
  CompareResult& result_;
};

// "press_CC of material 0 on level 1"
std::string describe(const FieldInfo& f);
// The place of a value, but for its index or particle.
Difference difference_in(const FieldInfo& f);

}  // namespace sluice
