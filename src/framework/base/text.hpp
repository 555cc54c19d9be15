// Numbers as text that read back to the same bits.
#pragma once
#include <string>
#include <string_view>
#include <vector>

namespace sluice {

// The fewest digits that read back to the same double: 0.1, 1e+22, -inf, nan.
std::string shortest_text(double x);
// 17 significant digits, as archives and tables of values have them: 0.10000000000000001.
std::string exact_text(double x);

std::string join(const std::vector<std::string>& parts, std::string_view separator);

}  // namespace sluice
