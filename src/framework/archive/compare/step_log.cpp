#include "framework/archive/compare/step_log.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace sluice {

std::string describe(const FieldInfo& f) {
  return fmt::format("{} of material {} on level {}", f.name, f.material, f.level);
}

Difference difference_in(const FieldInfo& f) {
  Difference d;
  d.label = f.name;
  d.level = f.level;
  d.material = f.material;
  d.components = f.components();
  return d;
}

void StepLog::refuse(const std::string& cause, const std::string& detail) {
  const auto same = std::find_if(result_.refused.begin(), result_.refused.end(),
                                 [&](const RefusedCause& r) { return r.cause == cause; });
  if (same == result_.refused.end()) {
    result_.refused.push_back({cause, detail, info_.step, info_.time, 1, info_.step});
  } else if (same->last_step != info_.step) {
    ++same->steps;
    same->last_step = info_.step;
  }
}

void StepLog::note(const std::string& text) {
  if (std::find(result_.notes.begin(), result_.notes.end(), text) == result_.notes.end())
    result_.notes.push_back(text);
}

void StepLog::only_one(const std::string& what) {
  if (across_)
    note(what);
  else
    refuse(what);
}

void StepLog::compare_values(Difference where, double a, double b, FieldDifference& found) const {
  ++found.values;
  if (!numbers_differ(a, b, options_.absolute, options_.relative)) return;
  where.step = info_.step;
  where.time = info_.time;
  where.a = a;
  where.b = b;
  if (found.differing++ == 0) found.first = found.largest = found.largest_relative = where;
  if (where.size() > found.largest.size()) found.largest = where;
  if (where.relative() > found.largest_relative.relative()) found.largest_relative = where;
}

void StepLog::keep(const FieldDifference& found) {
  result_.values += found.values;
  result_.differing += found.differing;
  if (found.differing > 0) result_.fields.push_back(found);
}

}  // namespace sluice
