// Lines and words of data files, with the place of each.
#include "framework/base/data_lines.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <system_error>

#include "framework/base/error.hpp"
#include "framework/base/packed_text.hpp"

namespace sluice {
namespace {

constexpr std::string_view byte_order_mark = "\xef\xbb\xbf";

bool is_blank(char c) {
  return c == ' ' || c == '\t' || c == '\v' || c == '\f';
}

// A word as a message shows it.
std::string shown(std::string_view word) {
  constexpr std::size_t longest = 40;
  std::string text(word.substr(0, longest));
  for (char& c : text)
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = '?';
  return fmt::format("'{}{}'", text, word.size() > longest ? "..." : "");
}

// What is wrong with the word as a number; empty: nothing.
std::string read_number(std::string_view word, double& value) {
  std::string digits(word);
  const std::size_t exponent = digits.find_first_of("dD");
  if (exponent != std::string::npos) digits[exponent] = 'e';
  if (digits.find_first_not_of("0123456789+-.eE") != std::string::npos) return "is not a number";
  const char* first = digits.data();
  const char* const last = first + digits.size();
  if (*first == '+' && last - first > 1 && first[1] != '-') ++first;
  const auto [end, error] = std::from_chars(first, last, value);
  if (error == std::errc::result_out_of_range) return "is outside the range of a double";
  return error == std::errc() && end == last ? "" : "is not a number";
}

std::string read_text(const std::string& file, const std::string& what) {
  std::error_code problem;
  const auto status = std::filesystem::status(file, problem);
  if (!std::filesystem::exists(status))
    throw InputError(
        fmt::format("{} '{}' cannot be opened: no such file; names are relative to "
                    "the working folder or the deck's, without quotation marks",
                    what, file));
  if (std::filesystem::is_directory(status))
    throw InputError(fmt::format("{} '{}' cannot be opened: it is a folder", what, file));
  std::string text = unpacked_text(file, what);
  if (text.starts_with("\xff\xfe") || text.starts_with("\xfe\xff"))
    throw InputError(fmt::format("{} {} is in UTF-16; save it as plain text (UTF-8)", what, file));
  return text;
}

}  // namespace

DataLines::DataLines(const std::string& file, const std::string& what, Separators separators)
    : file_(file), text_(read_text(file, what)), separators_(separators) {
  if (text_.starts_with(byte_order_mark)) next_ = byte_order_mark.size();
}

int DataLines::column_of(std::string_view line, std::size_t at) const {
  // Bytes that go on with a character are none of their own.
  return 1 + static_cast<int>(std::count_if(line.begin(),
                                            line.begin() + static_cast<std::ptrdiff_t>(at),
                                            [](char c) { return (c & '\xc0') != '\x80'; }));
}

void DataLines::split(std::string_view line) {
  words_.clear();
  comment_ = {};
  end_column_ = 1;
  const bool commas = separators_ == Separators::blanks_and_commas;
  const auto ends_word = [&](char c) { return is_blank(c) || (commas && c == ','); };
  bool open = true;  // a comma would have nothing before it
  for (std::size_t at = 0; at < line.size();) {
    if (is_blank(line[at])) {
      ++at;
      continue;
    }
    if (line[at] == '#') {
      comment_ = line.substr(at + 1);
      return;
    }
    if (commas && line[at] == ',') {
      if (open)
        throw InputError(
            fmt::format("{}:{}:{}: there is nothing before this comma; expected a number", file_,
                        line_, column_of(line, at)));
      open = true;
      ++at;
      continue;
    }
    std::size_t end = at;
    while (end < line.size() && !ends_word(line[end])) ++end;
    words_.push_back({line.substr(at, end - at), column_of(line, at)});
    end_column_ = words_.back().column + column_of(words_.back().text, end - at) - 1;
    open = false;
    at = end;
  }
}

bool DataLines::next() {
  while (next_ < text_.size()) {
    const std::size_t end = std::min(text_.find_first_of("\r\n", next_), text_.size());
    const std::string_view line = std::string_view(text_).substr(next_, end - next_);
    next_ = end + (text_.compare(end, 2, "\r\n") == 0 ? 2 : 1);
    ++line_;
    split(line);
    if (!words_.empty() || !comment_.empty()) return true;
  }
  return false;
}

bool DataLines::next_row() {
  while (next())
    if (!words_.empty()) return true;
  return false;
}

void DataLines::refuse(std::size_t n, const std::string& message) const {
  const int column = n < words_.size() ? words_[n].column : end_column_;
  throw InputError(fmt::format("{}:{}:{}: {}", file_, line_, column, message));
}

double DataLines::number(std::size_t n, const std::string& expected) const {
  if (n >= words_.size()) refuse(n, expected + " is missing");
  double value = 0;
  const std::string problem = read_number(words_[n].text, value);
  if (!problem.empty())
    refuse(n, fmt::format("{} {}; expected {}", shown(words_[n].text), problem, expected));
  return value;
}

void read_table(const std::string& file, const std::vector<std::string>& columns,
                const std::function<void(const TableRow& row)>& row) {
  DataLines lines(file, "data file", Separators::blanks_and_commas);
  std::vector<double> numbers(columns.size());
  std::vector<std::string> expected;
  for (std::size_t n = 0; n < columns.size(); ++n)
    expected.push_back(fmt::format("number {} of {} ({})", n + 1, columns.size(), columns[n]));
  int rows = 0;
  while (lines.next_row()) {
    for (std::size_t n = 0; n < columns.size(); ++n) numbers[n] = lines.number(n, expected[n]);
    if (lines.words().size() > columns.size())
      lines.refuse(
          columns.size(),
          fmt::format("{} found after the last number; expected {}: {}",
                      shown(lines.words()[columns.size()].text),
                      columns.size() == 1 ? "one number per line"
                                          : fmt::format("{} numbers per line", columns.size()),
                      fmt::join(columns, ", ")));
    row(TableRow(lines, numbers));
    ++rows;
  }
  if (rows == 0)
    throw InputError(fmt::format("{}: no rows; expected {} numbers per line: {}", file,
                                 columns.size(), fmt::join(columns, ", ")));
}

}  // namespace sluice
