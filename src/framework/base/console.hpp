// What a person reads: colour where a terminal shows it, sizes and times in words, tables.
#pragma once
#include <cstdint>
#include <cstdio>
#include <string>
#include <string_view>
#include <vector>

namespace sluice {

// Where a person looks on. Not under a launcher of ranks: it gives its ranks terminals of their own
// and sends what they write there wherever its own output goes, often to a file.
bool is_terminal(std::FILE* stream);
// A terminal, NO_COLOR unset or empty (no-color.org), TERM not "dumb".
bool wants_colour(std::FILE* stream);
// Columns of the terminal; 80 when it does not say.
int terminal_width(std::FILE* stream);

enum class Style { plain, bold, dim, red, green, yellow, blue };
// The text in the style when colour is wanted, else as it is.
std::string styled(std::string_view text, Style style, bool colour);

std::string human_bytes(double bytes);       // 512 B, 1.5 KiB, 2.3 GiB
std::string human_duration(double seconds);  // 350 us, 12.3 s, 4 min 05 s, 3 h 12 min, 2 d 03 h
std::string human_count(std::int64_t n);     // 1,234,567
std::string human_percent(double share);     // 0.042 %, 42 %, 114 %
// Four significant digits: for reading, never for reading back.
std::string human_number(double x);

// Rows of one line each, columns as wide as their widest cell.
class TextTable {
 public:
  enum class Align { left, right };
  struct Column {
    std::string title;
    Align align = Align::left;
  };

  explicit TextTable(std::vector<Column> columns) : columns_(std::move(columns)) {}
  // As many cells as there are columns; else std::logic_error.
  void row(std::vector<std::string> cells);
  bool empty() const { return rows_.empty(); }
  // Title line, rows, each with the indent before it and ending in a newline.
  std::string text(std::string_view indent = "") const;

 private:
  std::string line(const std::vector<std::string>& cells, const std::vector<std::size_t>& widths,
                   std::string_view indent) const;

  std::vector<Column> columns_;
  std::vector<std::vector<std::string>> rows_;
};

}  // namespace sluice
