// Numbers as text that read back to the same bits, and names that were almost right.
#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace sluice {

// The fewest digits that read back to the same double: 0.1, 1e+22, -inf, nan.
std::string shortest_text(double x);
// 17 significant digits, as archives and tables of values have them: 0.10000000000000001.
std::string exact_text(double x);

// Insertions, deletions, changes and swaps of neighbours that lead from a to b (optimal string
// alignment). Upper and lower case count as equal.
int edit_distance(std::string_view a, std::string_view b);

// The candidate that the writer most likely meant: at most a third of the letters wrong, first
// in the given order among equals; empty when none is near.
std::string nearest_name(std::string_view name, const std::vector<std::string>& candidates);

std::string join(const std::vector<std::string>& parts, std::string_view separator);

}  // namespace sluice
