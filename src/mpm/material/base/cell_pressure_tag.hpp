// Which equation of state a cell shared with a fluid sees, in the format.
#pragma once
#include <string>

#include "mpm/material/base/parameters.hpp"

namespace sluice::mpm {

inline TagSpec cell_pressure_tag(std::string name) {
  return choice(std::move(name),
                "accepted, with a warning if true: no solid shares the pressure of a cell", false);
}

}  // namespace sluice::mpm
