// Sums of the finer field in the cells of the coarser one, in both directions: a run may be finer
// here and coarser there.
#include "framework/archive/compare/coarse_means.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <optional>

#include "framework/base/error.hpp"

namespace sluice {
namespace {

using OnLevel = CompositeField::OnLevel;

// What cells of another field lie in each cell of one level. Long double: 2^11 equal doubles are
// summed without rounding.
struct Sums {
  std::vector<std::vector<long double>> components;
  std::vector<std::int64_t> weights;  // in finest indices of the other field
};

std::vector<Sums> empty_sums(const CompositeField& field) {
  std::vector<Sums> all;
  for (const OnLevel& on : field.levels()) {
    const std::size_t n = on.values.present.size();
    all.push_back({std::vector<std::vector<long double>>(on.values.components.size(),
                                                         std::vector<long double>(n)),
                   std::vector<std::int64_t>(n)});
  }
  return all;
}

// How a level of one field lies to one of the other.
struct Relation {
  bool into = false;  // cells of the one are as fine as those of the other, or finer
  bool equal = false;
  Nesting nesting;  // from the finer to the coarser
};

// relations[n][k]: of level n of `fine` to level k of `coarse`.
std::vector<std::vector<Relation>> relations_of(const CompositeField& fine,
                                                const CompositeField& coarse) {
  std::vector<std::vector<Relation>> all;
  for (const OnLevel& f : fine.levels()) {
    std::vector<Relation>& row = all.emplace_back();
    for (const OnLevel& c : coarse.levels()) {
      Relation& r = row.emplace_back();
      r.into = nest(*c.level, *f.level, r.nesting) == Nested::yes;
      r.equal = r.into && r.nesting.equal();
      if (!r.into && nest(*f.level, *c.level, r.nesting) == Nested::no)
        throw InputError(fmt::format(
            "spacing {} and {}: each is finer along another direction; means on the coarser grid "
            "need one that is as coarse along all",
            triple_text(f.level->spacing), triple_text(c.level->spacing)));
    }
  }
  return all;
}

// Whether any value of the finer level `on` lies in cell c of the coarser one.
bool holds_any(const OnLevel& on, const Nesting& nesting, IntVec3 c) {
  const IntVec3 low = nesting.to_fine(c);
  const IntVec3 closing = closing_layers(on.info.centring);
  IndexBox box{low, low + IntVec3{1, 1, 1}};
  for (int d = 0; d < 3; ++d)
    if (closing[d] == 0) box.upper[d] = low[d] + nesting.ratio[d];
  box = intersection(box, on.values.cells);
  for (int k = box.lower.z; k < box.upper.z; ++k)
    for (int j = box.lower.y; j < box.upper.y; ++j)
      for (int i = box.lower.x; i < box.upper.x; ++i)
        if (on.values.has({i, j, k})) return true;
  return false;
}

// The finest level of `coarse` that holds the place of index c of level n of `fine`, where its
// cell is no finer; `index` there.
std::optional<std::size_t> holder_of(const CompositeField& coarse,
                                     const std::vector<Relation>& relations, Centring centring,
                                     IntVec3 c, bool with_equal, IntVec3& index) {
  for (std::size_t k = coarse.levels().size(); k-- > 0;) {
    const OnLevel& on = coarse.levels()[k];
    const Relation& r = relations[k];
    if (!r.into) {
      if (holds_any(on, r.nesting, c)) return std::nullopt;
      continue;
    }
    if (!r.nesting.to_coarse(c, centring, index) || !on.values.has(index)) continue;
    if (r.equal && !with_equal) return std::nullopt;
    return k;
  }
  return std::nullopt;
}

// Adds the values of `fine` to those cells of `coarse` that hold them; equal cells if asked.
void add_into(const CompositeField& fine, const CompositeField& coarse, bool with_equal,
              std::vector<Sums>& sums) {
  const auto relations = relations_of(fine, coarse);
  const Centring centring = fine.info().centring;
  for (std::size_t n = 0; n < fine.levels().size(); ++n) {
    const OnLevel& from = fine.levels()[n];
    for_each_cell(from.values.cells, [&](IntVec3 c) {
      if (!from.values.has(c) || fine.covered(n, c)) return;
      IntVec3 index;
      const auto k = holder_of(coarse, relations[n], centring, c, with_equal, index);
      if (!k) return;
      const std::size_t to = coarse.levels()[*k].values.offset(index);
      Sums& at = sums[*k];
      at.weights[to] += from.weight;
      for (std::size_t m = 0; m < at.components.size(); ++m)
        at.components[m][to] += static_cast<long double>(from.values.at(c, static_cast<int>(m))) *
                                static_cast<long double>(from.weight);
    });
  }
}

// The weight of a whole cell of `on` in the finest indices of the other field.
std::int64_t whole_weight(const OnLevel& on, const CompositeField& other) {
  Nesting nesting;
  nest(*on.level, *other.levels().back().level, nesting);
  std::int64_t weight = 1;
  const IntVec3 closing = closing_layers(on.info.centring);
  for (int d = 0; d < 3; ++d)
    if (closing[d] == 0) weight *= nesting.ratio[d];
  return weight;
}

class Visitor {
 public:
  Visitor(const std::function<void(const MeanPlace&, const double*, const double*)>& f) : f_(f) {}

  // The cells of one field, of which `sums` are the other's values in them.
  void visit(const CompositeField& own, const CompositeField& other, const std::vector<Sums>& sums,
             bool of_first) {
    for (std::size_t n = 0; n < own.levels().size(); ++n) {
      const OnLevel& on = own.levels()[n];
      const std::int64_t whole = whole_weight(on, other);
      for_each_cell(on.values.cells, [&](IntVec3 c) {
        if (!on.values.has(c) || own.covered(n, c)) return;
        const std::size_t at = on.values.offset(c);
        if (sums[n].weights[at] == 0) return;  // seen from the other side, or nothing there
        if (sums[n].weights[at] != whole || !load(on, sums[n], at)) {
          ++count_.left_out;
          return;
        }
        ++count_.compared;
        f_({of_first, on.level, c}, (of_first ? value_ : mean_).data(),
           (of_first ? mean_ : value_).data());
      });
    }
  }
  const MeansCount& count() const { return count_; }

 private:
  bool load(const OnLevel& on, const Sums& sums, std::size_t at) {
    bool good = true;
    for (std::size_t m = 0; m < sums.components.size(); ++m) {
      value_[m] = on.values.components[m][at];
      mean_[m] =
          static_cast<double>(sums.components[m][at] / static_cast<long double>(sums.weights[at]));
      good = good && !std::isnan(value_[m]) && !std::isnan(mean_[m]);
    }
    return good;
  }

  const std::function<void(const MeanPlace&, const double*, const double*)>& f_;
  std::array<double, 9> value_{}, mean_{};
  MeansCount count_;
};

}  // namespace

MeansCount visit_coarse_means(
    const CompositeField& a, const CompositeField& b,
    const std::function<void(const MeanPlace&, const double*, const double*)>& f) {
  std::vector<Sums> in_a = empty_sums(a), in_b = empty_sums(b);
  add_into(b, a, true, in_a);
  add_into(a, b, false, in_b);
  Visitor visitor(f);
  visitor.visit(a, b, in_a, true);
  visitor.visit(b, a, in_b, false);
  return visitor.count();
}

void require_common_domain(const Level& a, const Level& b) {
  for (int d = 0; d < 3; ++d) {
    if (a.domain.size()[d] == 1 && b.domain.size()[d] == 1) continue;
    const auto ends = [d](const Level& l) {
      return std::pair{l.anchor[d] + l.domain.lower[d] * l.spacing[d],
                       l.anchor[d] + l.domain.upper[d] * l.spacing[d]};
    };
    const auto [a_low, a_high] = ends(a);
    const auto [b_low, b_high] = ends(b);
    const double slack = 1e-6 * std::min(a.spacing[d], b.spacing[d]);
    if (a_low < b_low - slack || a_high > b_high + slack)
      throw InputError(fmt::format(
          "the domain of the first goes from {:g} to {:g} along {}, that of the second from {:g} "
          "to {:g}: it must hold that of the first",
          a_low, a_high, "xyz"[d], b_low, b_high));
  }
}

}  // namespace sluice
