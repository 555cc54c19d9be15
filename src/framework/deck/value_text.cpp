// Parsing of the values in a deck. Numbers go through std::from_chars: no locale, no rounding
// surprises, no partial reads.
#include "framework/deck/value_text.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>

namespace sluice {
namespace {

constexpr std::string_view blanks = " \t\r\n\v\f";

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(blanks);
  if (first == std::string_view::npos) return {};
  const auto last = text.find_last_not_of(blanks);
  return text.substr(first, last - first + 1);
}

template <class T>
ParsedValue<T> good(T value) {
  return {std::move(value), {}};
}

template <class T>
ParsedValue<T> bad(std::string problem) {
  return {std::nullopt, std::move(problem)};
}

// The pieces between separators; blanks around a piece are cut, empty pieces are kept.
std::vector<std::string_view> split(std::string_view text, char separator) {
  std::vector<std::string_view> pieces;
  for (;;) {
    const auto at = text.find(separator);
    pieces.push_back(trimmed(text.substr(0, at)));
    if (at == std::string_view::npos) return pieces;
    text.remove_prefix(at + 1);
  }
}

// The inside of one pair of brackets around the whole text.
std::optional<std::string_view> inside_brackets(std::string_view text) {
  text = trimmed(text);
  if (text.size() < 2 || text.front() != '[' || text.back() != ']') return std::nullopt;
  return text.substr(1, text.size() - 2);
}

template <class T, class ParseComponent>
ParsedValue<Triple<T>> parse_triple(std::string_view text, ParseComponent parse_component,
                                    std::string_view example) {
  const auto inside = inside_brackets(text);
  if (!inside) {
    return bad<Triple<T>>(
        fmt::format("{} is not a vector; write it as {}", in_quotes(text), example));
  }
  const auto pieces = split(*inside, ',');
  if (pieces.size() != 3) {
    return bad<Triple<T>>(fmt::format("{} has {} component{} between commas; a vector has 3, as {}",
                                      in_quotes(text), pieces.size(), pieces.size() == 1 ? "" : "s",
                                      example));
  }
  Triple<T> triple;
  for (int d = 0; d < 3; ++d) {
    const auto component = parse_component(pieces[d]);
    if (!component) {
      return bad<Triple<T>>(
          fmt::format("component {} of {}: {}", d + 1, in_quotes(text), component.problem));
    }
    triple[d] = *component.value;
  }
  return good(triple);
}

// List elements: brackets optional; commas and blanks both separate.
std::vector<std::string_view> list_elements(std::string_view text) {
  text = trimmed(text);
  if (!text.empty() && text.front() == '[') text.remove_prefix(1);
  if (!text.empty() && text.back() == ']') text.remove_suffix(1);
  std::vector<std::string_view> elements;
  constexpr std::string_view separators = ", \t\r\n\v\f";
  for (;;) {
    const auto first = text.find_first_not_of(separators);
    if (first == std::string_view::npos) return elements;
    text.remove_prefix(first);
    const auto last = std::min(text.find_first_of(separators), text.size());
    elements.push_back(text.substr(0, last));
    text.remove_prefix(last);
  }
}

template <class T, class ParseElement>
ParsedValue<std::vector<T>> parse_list(std::string_view text, ParseElement parse_element) {
  std::vector<T> values;
  for (const auto element : list_elements(text)) {
    const auto parsed = parse_element(element);
    if (!parsed) {
      return bad<std::vector<T>>(
          fmt::format("element {} of the list: {}", values.size() + 1, parsed.problem));
    }
    values.push_back(*parsed.value);
  }
  return good(std::move(values));
}

}  // namespace

std::string collapse_blanks(std::string_view text) {
  std::string collapsed;
  collapsed.reserve(text.size());
  bool pending_blank = false;
  for (const char c : text) {
    if (blanks.find(c) != std::string_view::npos) {
      pending_blank = !collapsed.empty();
      continue;
    }
    if (pending_blank) collapsed += ' ';
    pending_blank = false;
    collapsed += c;
  }
  return collapsed;
}

std::string in_quotes(std::string_view text) {
  constexpr std::size_t longest = 60;
  std::string shown = "'";
  for (const char c : text.substr(0, longest)) {
    const bool control = static_cast<unsigned char>(c) < 0x20 || c == 0x7f;
    shown += control ? ' ' : c;
  }
  if (text.size() > longest) {
    // A multi-byte character cut in the middle would make the message invalid UTF-8.
    while (!shown.empty() && (static_cast<unsigned char>(shown.back()) & 0xc0) == 0x80) {
      shown.pop_back();
    }
    if (static_cast<unsigned char>(shown.back()) >= 0xc0) shown.pop_back();
    shown += "...";
  }
  return shown + "'";
}

ParsedValue<double> parse_real(std::string_view text) {
  text = trimmed(text);
  if (text.empty()) return bad<double>("empty, expected a number");
  if (text.find_first_not_of("0123456789+-.eE") != std::string_view::npos) {
    return bad<double>(fmt::format("{} is not a number", in_quotes(text)));
  }
  std::string_view digits = text;
  const bool plus = digits.front() == '+';
  if (plus) digits.remove_prefix(1);
  double value = 0.0;
  const auto result = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (result.ec == std::errc::result_out_of_range) {
    return bad<double>(fmt::format("{} is outside the range of a double", in_quotes(text)));
  }
  const bool whole = result.ptr == digits.data() + digits.size();
  const bool two_signs = plus && (digits.empty() || digits.front() == '-');
  if (result.ec != std::errc() || !whole || !std::isfinite(value) || two_signs) {
    return bad<double>(fmt::format("{} is not a number", in_quotes(text)));
  }
  return good(value);
}

ParsedValue<int> parse_integer(std::string_view text) {
  text = trimmed(text);
  if (text.empty()) return bad<int>("empty, expected an integer");
  int value = 0;
  const auto result = std::from_chars(text.data(), text.data() + text.size(), value);
  if (result.ec == std::errc::result_out_of_range) {
    return bad<int>(fmt::format("{} does not fit into 32 bits", in_quotes(text)));
  }
  if (result.ec != std::errc() || result.ptr != text.data() + text.size()) {
    return bad<int>(fmt::format("{} is not an integer", in_quotes(text)));
  }
  return good(value);
}

ParsedValue<bool> parse_boolean(std::string_view text) {
  text = trimmed(text);
  if (text == "true") return good(true);
  if (text == "false") return good(false);
  return bad<bool>(fmt::format("{} is neither true nor false", in_quotes(text)));
}

ParsedValue<Vec3> parse_vector(std::string_view text) {
  return parse_triple<double>(text, parse_real, "[0.0, 1.0, 2.0]");
}

ParsedValue<IntVec3> parse_int_vector(std::string_view text) {
  return parse_triple<int>(text, parse_integer, "[1, 2, 3]");
}

ParsedValue<std::vector<double>> parse_reals(std::string_view text) {
  return parse_list<double>(text, parse_real);
}

ParsedValue<std::vector<int>> parse_integers(std::string_view text) {
  return parse_list<int>(text, parse_integer);
}

ParsedValue<std::vector<std::string>> parse_words(std::string_view text) {
  return parse_list<std::string>(text,
                                 [](std::string_view word) { return good(std::string(word)); });
}

ParsedValue<std::vector<IntVec3>> parse_int_vectors(std::string_view text) {
  using List = std::vector<IntVec3>;
  auto inside = inside_brackets(text);
  if (!inside) {
    return bad<List>(
        fmt::format("{} is not a list of vectors; write it as [[2,2,1],[4,4,1]]", in_quotes(text)));
  }
  List vectors;
  std::string_view rest = trimmed(*inside);
  while (!rest.empty()) {
    const auto close = rest.find(']');
    if (rest.front() != '[' || close == std::string_view::npos) {
      return bad<List>(fmt::format("{} is not a list of vectors; write it as [[2,2,1],[4,4,1]]",
                                   in_quotes(text)));
    }
    const auto vector = parse_int_vector(rest.substr(0, close + 1));
    if (!vector) return bad<List>(vector.problem);
    vectors.push_back(*vector.value);
    rest = trimmed(rest.substr(close + 1));
    if (!rest.empty() && rest.front() == ',') rest = trimmed(rest.substr(1));
  }
  return good(std::move(vectors));
}

ParsedValue<std::vector<IndexInterval>> parse_index_set(std::string_view text) {
  using Set = std::vector<IndexInterval>;
  Set set;
  for (const auto element : list_elements(text)) {
    // The first '-' after the first character separates low from high: "-3--1" is -3 to -1.
    const auto dash = element.size() > 1 ? element.find('-', 1) : std::string_view::npos;
    const auto low = parse_integer(element.substr(0, dash));
    const auto high =
        dash == std::string_view::npos ? low : parse_integer(element.substr(dash + 1));
    if (!low || !high || *high.value < *low.value) {
      return bad<Set>(fmt::format("{} is not a set of indices such as '0, 2-4'", in_quotes(text)));
    }
    set.push_back({*low.value, *high.value});
  }
  return good(std::move(set));
}

}  // namespace sluice
