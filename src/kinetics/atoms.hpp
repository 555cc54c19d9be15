// Molar masses of elements: the conventional atomic weights of IUPAC (2021).
#pragma once
#include <optional>
#include <string_view>

namespace sluice::kinetics {

// kg/mol of the element of this symbol, capitals or not; none where it is not in the table.
std::optional<double> atomic_mass(std::string_view symbol);

}  // namespace sluice::kinetics
