#include "framework/run/component/succession.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace sluice {
namespace {

// The same label, kept alike.
const ParticleAttribute* find_like(const ParticleKind& kind, const ParticleAttribute& wanted) {
  for (const ParticleAttribute& a : kind.attributes)
    if (a.label == wanted.label && a.symmetric == wanted.symmetric) return &a;
  return nullptr;
}

std::size_t first_column(const ParticleKind& kind, const ParticleAttribute& wanted) {
  std::size_t column = 0;
  for (const ParticleAttribute& a : kind.attributes) {
    if (&a == &wanted) break;
    column += a.columns();
  }
  return column;
}

}  // namespace

std::string succession_obstacle(const ParticleMethod& from, const ParticleMethod& to) {
  if (from.kinds().size() != to.kinds().size())
    return fmt::format("{} materials, but {} before", to.kinds().size(), from.kinds().size());
  for (std::size_t k = 0; k < to.kinds().size(); ++k)
    if (from.kinds()[k].material != to.kinds()[k].material)
      return fmt::format("material {} where material {} was before", to.kinds()[k].material,
                         from.kinds()[k].material);
  return {};
}

std::vector<PassedOn> passed_on(const ParticleMethod& from, const ParticleMethod& to) {
  std::vector<PassedOn> all;
  for (std::size_t k = 0; k < std::min(from.kinds().size(), to.kinds().size()); ++k) {
    const ParticleKind &before = from.kinds()[k], &after = to.kinds()[k];
    PassedOn& p = all.emplace_back();
    p.kind = after.name;
    for (const ParticleAttribute& a : after.attributes) {
      const bool starts_empty = to.starts_at_zero(static_cast<int>(k), a.label);
      auto& list = find_like(before, a) != nullptr ? p.carried
                   : starts_empty                  ? p.at_start
                                                   : p.lacking;
      list.push_back(a.label.name());
    }
    for (const ParticleAttribute& a : before.attributes)
      if (find_like(after, a) == nullptr) p.dropped.push_back(a.label.name());
  }
  return all;
}

std::vector<std::pair<std::size_t, std::size_t>> common_columns(const ParticleKind& from,
                                                                const ParticleKind& to) {
  std::vector<std::pair<std::size_t, std::size_t>> columns;
  for (const ParticleAttribute& a : to.attributes) {
    const ParticleAttribute* like = find_like(from, a);
    if (like == nullptr) continue;
    const std::size_t of_from = first_column(from, *like), of_to = first_column(to, a);
    for (int c = 0; c < a.columns(); ++c) columns.emplace_back(of_from + c, of_to + c);
  }
  return columns;
}

}  // namespace sluice
