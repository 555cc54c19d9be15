// One value against its description.
#include <fmt/format.h>

#include <algorithm>

#include "framework/deck/nearest_name.hpp"
#include "framework/deck/schema_check.hpp"
#include "framework/deck/spelling.hpp"
#include "framework/deck/value_text.hpp"

namespace sluice {
namespace {

std::string expected(const ValueSpec& spec) {
  std::string text = "expected " + to_string(spec.type);
  if (spec.range.limited()) text += ' ' + spec.range.text();
  return text;
}

ValueVerdict bad(std::string problem, std::string suggestion) {
  return {std::move(problem), std::move(suggestion), false, {}};
}

// "gzip, or empty"
std::string list_of(const std::vector<std::string>& words) {
  std::string list;
  bool empty = false;
  for (const std::string& word : words) {
    empty = empty || word.empty();
    if (!word.empty()) list += (list.empty() ? "" : ", ") + word;
  }
  return empty ? list + ", or empty" : list;
}

bool is_listed(const std::vector<std::string>& words, const std::string& word) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

ValueVerdict judge_word(const ValueSpec& spec, std::string& text) {
  for (const auto& [other, word] : spec.word_spellings) {
    if (text == other) text = word;
  }
  if (is_listed(spec.words, text)) return {};
  const auto same = [&](const std::string& word) { return is_spelling_of(text, word); };
  const auto meant = std::find_if(spec.words.begin(), spec.words.end(), same);
  const bool known = is_listed(spec.words_not_built, text);
  if (!known && !text.empty() && meant != spec.words.end() &&
      std::count_if(spec.words.begin(), spec.words.end(), same) == 1) {
    text = *meant;
    ValueVerdict verdict;
    verdict.read_as = text;
    return verdict;
  }
  if (known) {
    ValueVerdict verdict;
    verdict.not_built = true;
    verdict.problem =
        fmt::format("{} is known to the format, but not supported yet", in_quotes(text));
    verdict.suggestion = "supported: " + list_of(spec.words);
    return verdict;
  }
  std::vector<std::string> all = spec.words;
  all.insert(all.end(), spec.words_not_built.begin(), spec.words_not_built.end());
  std::erase(all, "");  // what nobody can have meant by a word
  std::string suggestion;
  if (const auto nearest = nearest_name(text, all)) {
    suggestion = fmt::format("did you mean '{}'? valid: {}", *nearest, list_of(spec.words));
  } else {
    suggestion = "valid: " + list_of(spec.words);
  }
  if (text.empty()) return bad("empty, expected a word", suggestion);
  return bad(fmt::format("{} is not a valid word", in_quotes(text)), suggestion);
}

// The numbers in a value, for the range check.
struct Numbers {
  std::string problem;
  std::vector<double> values;
};

template <class T>
Numbers numbers_of(const ParsedValue<T>& parsed) {
  Numbers numbers{parsed.problem, {}};
  if (!parsed) return numbers;
  if constexpr (std::is_arithmetic_v<T>) {
    numbers.values.push_back(static_cast<double>(*parsed.value));
  } else if constexpr (std::is_same_v<T, Vec3> || std::is_same_v<T, IntVec3>) {
    for (int d = 0; d < 3; ++d) numbers.values.push_back(static_cast<double>((*parsed.value)[d]));
  } else if constexpr (std::is_same_v<T, std::vector<IntVec3>>) {
    for (const IntVec3& v : *parsed.value) {
      for (int d = 0; d < 3; ++d) numbers.values.push_back(v[d]);
    }
  } else {
    for (const auto v : *parsed.value) numbers.values.push_back(static_cast<double>(v));
  }
  return numbers;
}

Numbers parse_numbers(TagType type, const std::string& text) {
  switch (type) {
    case TagType::integer:
      return numbers_of(parse_integer(text));
    case TagType::real:
      return numbers_of(parse_real(text));
    case TagType::vector:
      return numbers_of(parse_vector(text));
    case TagType::int_vector:
      return numbers_of(parse_int_vector(text));
    case TagType::reals:
      return numbers_of(parse_reals(text));
    case TagType::integers:
      return numbers_of(parse_integers(text));
    case TagType::int_vectors:
      return numbers_of(parse_int_vectors(text));
    case TagType::boolean:
      return {parse_boolean(text).problem, {}};
    case TagType::index_set:
      return {parse_index_set(text).problem, {}};
    default:
      return {};
  }
}

bool may_be_empty(TagType type) {
  return type == TagType::text || type == TagType::index_set || type == TagType::word;
}

}  // namespace

std::vector<std::string> unsupported_words(const ValueSpec& spec) {
  std::vector<std::string> words = spec.words_not_built;
  std::erase_if(words, [&](const std::string& word) {
    const auto is_it = [&](const auto& spelling) { return spelling.first == word; };
    const auto& spellings = spec.word_spellings;
    return is_listed(spec.words, word) || std::any_of(spellings.begin(), spellings.end(), is_it);
  });
  return words;
}

ValueVerdict judge_value(const ValueSpec& spec, std::string& text) {
  if (spec.type == TagType::none) {
    if (text.empty()) return {};
    return bad(fmt::format("{} found, but this takes no value", in_quotes(text)), "");
  }
  if (spec.type == TagType::word) return judge_word(spec, text);
  if (text.empty() && !may_be_empty(spec.type)) return bad("empty", expected(spec));
  const Numbers numbers = parse_numbers(spec.type, text);
  if (!numbers.problem.empty()) return bad(numbers.problem, expected(spec));
  for (const double value : numbers.values) {
    if (!spec.range.contains(value)) {
      return bad(fmt::format("{} is out of range", in_quotes(text)), expected(spec));
    }
  }
  return {};
}

}  // namespace sluice
