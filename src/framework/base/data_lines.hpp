// The text files that a deck names, word by word: tables, points, triangles, motions, loads.
//
// One reader for all of them, as strict as the reader of decks:
// - lines end with LF, CR LF or CR; a byte order mark of UTF-8 is skipped; gzipped or not
// - blanks separate words, and a comma where the format has them
// - a word that begins with # begins a comment
// - a number is read to its last letter; d begins an exponent as e does (1.5d-3)
// InputError says FILE:LINE:COLUMN, what was found there, and what was expected.
#pragma once
#include <cstddef>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace sluice {

enum class Separators { blanks, blanks_and_commas };

class DataLines {
 public:
  struct Word {
    std::string_view text;
    int column = 0;  // in characters, from 1
  };

  // `what` the file is, for messages: "table", "flame".
  DataLines(const std::string& file, const std::string& what, Separators separators);
  DataLines(const DataLines&) = delete;
  DataLines& operator=(const DataLines&) = delete;

  // The next line that is not blank; false at the end. A line that is a comment alone has no words.
  bool next();
  // The next line with words.
  bool next_row();

  const std::string& file() const { return file_; }
  int line() const { return line_; }
  const std::vector<Word>& words() const { return words_; }
  std::string_view comment() const { return comment_; }  // behind the #

  // Word n as a number; `expected` says what it is: "number 2 of 4 (velocity x)".
  double number(std::size_t n, const std::string& expected) const;

  // At word n, or behind the last one.
  [[noreturn]] void refuse(std::size_t n, const std::string& message) const;

 private:
  void split(std::string_view line);
  int column_of(std::string_view line, std::size_t at) const;

  std::string file_, text_;
  Separators separators_;
  std::size_t next_ = 0;  // where the next line begins
  int line_ = 0;
  int end_column_ = 1;  // behind the last word of the line
  std::vector<Word> words_;
  std::string_view comment_;
};

// A row of a table.
class TableRow {
 public:
  TableRow(const DataLines& lines, const std::vector<double>& numbers)
      : lines_(lines), numbers_(numbers) {}
  double operator[](std::size_t n) const { return numbers_[n]; }
  int line() const { return lines_.line(); }
  // InputError with the place of number n.
  [[noreturn]] void refuse(std::size_t n, const std::string& message) const {
    lines_.refuse(n, message);
  }

 private:
  const DataLines& lines_;
  const std::vector<double>& numbers_;
};

// Calls row(numbers) for every line that is neither blank nor a comment: as many numbers as there
// are names of columns, no more, no fewer. A file without a row is refused, too.
void read_table(const std::string& file, const std::vector<std::string>& columns,
                const std::function<void(const TableRow& row)>& row);

}  // namespace sluice
