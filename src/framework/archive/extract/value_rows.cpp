#include "framework/archive/extract/value_rows.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <iterator>

#include "framework/base/json.hpp"

namespace sluice {
namespace {

constexpr std::size_t bytes_at_once = 1 << 20;  // bytes

}  // namespace

void ValueRows::head(const std::string& label, const std::string& unit,
                     const std::vector<std::string>& columns) {
  if (headed_) return;
  headed_ = true;
  for (Target& t : targets_)
    if (t.form == TextForm::csv)
      t.text += fmt::format("{}\n", fmt::join(columns, ","));
    else
      t.text += fmt::format("{{\"label\": {}, \"unit\": {}, \"columns\": {}, \"rows\": [",
                            Json(label).dump(), Json(unit).dump(), Json(columns).dump());
}

void ValueRows::begin_value(Target& t) const {
  if (begun_)
    t.text += ',';
  else if (t.form == TextForm::json)
    t.text += rows_ == 0 ? "\n[" : ",\n[";
}

void ValueRows::add(double x) {
  for (Target& t : targets_) {
    begin_value(t);
    if (t.form == TextForm::json && !std::isfinite(x))
      t.text += "null";
    else
      fmt::format_to(std::back_inserter(t.text), "{:.17g}", x);
  }
  begun_ = true;
}

void ValueRows::add(std::int64_t n) {
  for (Target& t : targets_) {
    begin_value(t);
    fmt::format_to(std::back_inserter(t.text), "{}", n);
  }
  begun_ = true;
}

void ValueRows::add_nothing() {
  for (Target& t : targets_) {
    begin_value(t);
    if (t.form == TextForm::json) t.text += "null";
  }
  begun_ = true;
}

void ValueRows::end_row() {
  for (Target& t : targets_) {
    t.text += t.form == TextForm::csv ? "\n" : "]";
    if (t.text.size() < bytes_at_once) continue;
    t.write(t.text);
    t.text.clear();
  }
  begun_ = false;
  ++rows_;
}

void ValueRows::finish() {
  for (Target& t : targets_) {
    if (t.form == TextForm::json) t.text += "\n]}\n";
    t.write(t.text);
    t.text.clear();
  }
}

}  // namespace sluice
