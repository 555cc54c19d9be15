// Rows of numbers as text: CSV, or JSON with one list a row.
//
//   {"label": "press_CC", "unit": "Pa", "columns": ["time", ...], "rows": [[0, ...], ...]}
//
// 17 digits. What is missing is empty in CSV and null in JSON, as is NaN there.
#pragma once
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace sluice {

enum class TextForm { csv, json };
using WriteText = std::function<void(std::string_view)>;

class ValueRows {
 public:
  // Texts are handed to every target in successive pieces, from the first row on.
  void to(TextForm form, WriteText write) { targets_.push_back({form, std::move(write), {}}); }
  // Before the first row; later calls change nothing.
  void head(const std::string& label, const std::string& unit,
            const std::vector<std::string>& columns);

  void add(double x);
  void add(std::int64_t n);
  void add(int n) { add(std::int64_t{n}); }
  void add_nothing();
  void end_row();
  void finish();

  std::int64_t rows() const { return rows_; }

 private:
  struct Target {
    TextForm form;
    WriteText write;
    std::string text;
  };
  void begin_value(Target& target) const;

  std::vector<Target> targets_;
  bool headed_ = false, begun_ = false;  // begun_: the row has a value
  std::int64_t rows_ = 0;
};

}  // namespace sluice
