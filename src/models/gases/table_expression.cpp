// Recursive descent over sums, products and factors.
#include "models/gases/table_expression.hpp"

#include <fmt/format.h>

#include <cctype>
#include <charconv>

#include "framework/base/error.hpp"

namespace sluice::models {
namespace {

class Parser {
 public:
  Parser(const std::string& text, const ColumnLookup& lookup) : text_(text), lookup_(lookup) {}

  double all() {
    const double value = sum();
    if (next() != '\0') fail("an operator");
    return value;
  }

 private:
  [[noreturn]] void fail(const char* expected) const {
    throw InputError(fmt::format("expression '{}': expected {} at '{}'", text_, expected,
                                 at_ < text_.size() ? text_.substr(at_) : "its end"));
  }
  char next() {
    while (at_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[at_])) != 0) ++at_;
    return at_ < text_.size() ? text_[at_] : '\0';
  }
  bool take(char c) {
    if (next() != c) return false;
    ++at_;
    return true;
  }

  double sum() {
    double value = product();
    while (true) {
      if (take('+'))
        value += product();
      else if (take('-'))
        value -= product();
      else
        return value;
    }
  }
  double product() {
    double value = factor();
    while (true) {
      if (take('*'))
        value *= factor();
      else if (take('/'))
        value /= factor();
      else
        return value;
    }
  }
  double factor() {
    if (take('-')) return -factor();
    if (take('(')) {
      const double value = sum();
      if (!take(')')) fail("')'");
      return value;
    }
    if (take('[')) return lookup_(name(']'), false);
    if (take('{')) return lookup_(name('}'), true);
    double value = 0;
    next();
    const char* begin = text_.data() + at_;
    const auto [end, error] = std::from_chars(begin, text_.data() + text_.size(), value);
    if (error != std::errc()) fail("a number, [column], {axis} or '('");
    at_ += end - begin;
    return value;
  }
  std::string name(char end) {
    const std::size_t close = text_.find(end, at_);
    if (close == std::string::npos) fail("a name and its closing bracket");
    const std::string found = text_.substr(at_, close - at_);
    at_ = close + 1;
    return found;
  }

  const std::string& text_;
  const ColumnLookup& lookup_;
  std::size_t at_ = 0;
};

}  // namespace

double evaluate_expression(const std::string& text, const ColumnLookup& lookup) {
  return Parser(text, lookup).all();
}

}  // namespace sluice::models
