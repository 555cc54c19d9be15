// The valid name that a misspelt one most likely means.
#pragma once
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace sluice {

// Number of insertions, deletions, changes and swaps of neighbours; letter case costs nothing,
// nor does '_' against '-'. (Damerau-Levenshtein distance, optimal string alignment.)
std::size_t edit_distance(std::string_view a, std::string_view b);

// The nearest of the candidates, if it is near enough to be a likely misspelling.
std::optional<std::string> nearest_name(std::string_view word,
                                        const std::vector<std::string>& candidates);

// "did you mean 'cfl'?", or a list of a few valid names, or empty.
std::string suggest_name(std::string_view word, const std::vector<std::string>& candidates);

}  // namespace sluice
