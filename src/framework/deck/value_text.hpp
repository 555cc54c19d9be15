// Values written as text in a deck: one function per value type, strict, independent of locale.
//
// The character sets are the format's own: an integer has only digits, '-' and blanks; a real
// number only digits, '+', '-', '.', 'e', 'E' and blanks, with one '.' at most.
#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "framework/base/vec3.hpp"

namespace sluice {

// Either a value, or what is wrong with the text.
template <class T>
struct ParsedValue {
  std::optional<T> value;
  std::string problem;

  explicit operator bool() const { return value.has_value(); }
};

ParsedValue<double> parse_real(std::string_view text);
ParsedValue<int> parse_integer(std::string_view text);
ParsedValue<bool> parse_boolean(std::string_view text);
ParsedValue<Vec3> parse_vector(std::string_view text);         // [1.0, 2.0, 3.0]
ParsedValue<IntVec3> parse_int_vector(std::string_view text);  // [1, 2, 3]

// Brackets optional, separators comma or blank.
ParsedValue<std::vector<double>> parse_reals(std::string_view text);
ParsedValue<std::vector<int>> parse_integers(std::string_view text);
ParsedValue<std::vector<std::string>> parse_words(std::string_view text);
ParsedValue<std::vector<IntVec3>> parse_int_vectors(std::string_view text);  // [[2,2,1],[4,4,1]]

// A set of indices, "0, 2-4, -1" as closed intervals; empty text means everything.
struct IndexInterval {
  int low = 0;
  int high = 0;
};
ParsedValue<std::vector<IndexInterval>> parse_index_set(std::string_view text);

// Runs of blanks become one blank, the ends are trimmed.
std::string collapse_blanks(std::string_view text);

// The text as it appears in a message: quoted, control characters and great lengths cut.
std::string in_quotes(std::string_view text);

}  // namespace sluice
