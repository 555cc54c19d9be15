// Reading what ranks have packed.
#include "framework/analysis/sampler.hpp"

#include <fmt/format.h>

#include <cstring>
#include <map>
#include <stdexcept>

namespace sluice {

std::string columns_of(const AnalysedQuantity& q) {
  std::string heads;
  for (int c = 0; c < q.components; ++c)
    heads += fmt::format(" {}_{}{}", q.label.name(), q.material,
                         q.components == 1 ? "" : std::string(".") + "xyz"[c]);
  return heads;
}

std::vector<int> local_numbers(const std::vector<GridBox>& boxes) {
  std::vector<int> numbers;
  std::map<int, int> next;  // by owner
  for (const GridBox& b : boxes) numbers.push_back(next[b.owner]++);
  return numbers;
}

RankNumbers::RankNumbers(const std::vector<std::string>& packed) : next_(packed.size(), 0) {
  for (const std::string& text : packed) {
    std::vector<double>& own = numbers_.emplace_back(text.size() / sizeof(double));
    if (!own.empty()) std::memcpy(own.data(), text.data(), own.size() * sizeof(double));
  }
}

const double* RankNumbers::take(int rank, std::size_t count) {
  if (next_[rank] + count > numbers_[rank].size())
    throw std::logic_error("an analysis reads more numbers than rank " + std::to_string(rank) +
                           " has packed");
  const double* first = numbers_[rank].data() + next_[rank];
  next_[rank] += count;
  return first;
}

}  // namespace sluice
