// Which rows of a table of cases ./dev test runs, by name; the others are instantiated as Full.
#pragma once
#include <algorithm>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace sluice {

using CaseNames = std::vector<std::string_view>;

template <class Case>
std::vector<Case> cases_where(std::span<const Case> all, const CaseNames& names, bool named) {
  std::vector<Case> found;
  std::size_t known = 0;
  for (const Case& c : all) {
    const bool is_named = std::find(names.begin(), names.end(), c.name) != names.end();
    known += is_named;
    if (is_named == named) found.push_back(c);
  }
  if (known != names.size()) throw std::logic_error("a case that is named is not in its table");
  return found;
}

template <class Case, std::size_t n>
std::vector<Case> cases_named(const Case (&all)[n], const CaseNames& names) {
  return cases_where(std::span<const Case>(all), names, true);
}
template <class Case, std::size_t n>
std::vector<Case> cases_besides(const Case (&all)[n], const CaseNames& names) {
  return cases_where(std::span<const Case>(all), names, false);
}

}  // namespace sluice
