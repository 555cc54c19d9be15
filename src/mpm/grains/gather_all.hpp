// Plain records of every rank, in the order of ranks, on all of them.
#pragma once
#include <cstring>
#include <string>
#include <type_traits>
#include <vector>

#include "framework/base/communicator.hpp"

namespace sluice::mpm {

// Collective.
template <class T>
std::vector<T> gather_all(const std::vector<T>& own, Communicator& ranks) {
  static_assert(std::is_trivially_copyable_v<T>);
  if (ranks.size() == 1) return own;
  std::string bytes(own.size() * sizeof(T), '\0');
  if (!own.empty()) std::memcpy(bytes.data(), own.data(), bytes.size());
  std::vector<T> all;
  for (const std::string& of : ranks.gather_to_all(bytes)) {
    const std::size_t before = all.size();
    all.resize(before + of.size() / sizeof(T));
    if (!of.empty()) std::memcpy(&all[before], of.data(), of.size());
  }
  return all;
}

}  // namespace sluice::mpm
