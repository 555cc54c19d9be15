// Two fields of different resolutions at the same places: means of the finer one over the cells of
// the coarser one, wherever that is which; of faces over their areas, of nodes the one there.
//
// Means are by volume. Those of equal values are that value to the bit.
#pragma once
#include <cstdint>
#include <functional>

#include "framework/archive/compare/composite_field.hpp"

namespace sluice {

// A cell (face, node) that no finer one of its own archive covers.
struct MeanPlace {
  bool of_first = true;  // whose cell it is
  const Level* level = nullptr;
  IntVec3 index;
};

struct MeansCount {
  std::int64_t compared = 0;
  std::int64_t left_out = 0;  // one of the two is not there in whole, or NaN
};

// f(place, a, b) with the values of all components. InputError where the cells do not nest.
MeansCount visit_coarse_means(
    const CompositeField& a, const CompositeField& b,
    const std::function<void(const MeanPlace&, const double*, const double*)>& f);

// Whether the second grid covers the domain of the first; else InputError.
void require_common_domain(const Level& a, const Level& b);

}  // namespace sluice
