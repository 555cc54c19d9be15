// Which fields, materials, levels and points a tool looks at; where the points of a label lie.
#pragma once
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "framework/archive/archive.hpp"

namespace sluice {

// Where index c of a label lies, m: cells at centres, faces on their planes, nodes at corners.
Vec3 position(const Level& level, Centring centring, IntVec3 c);
// The cell of a level that holds a point, inside the domain or not.
IntVec3 cell_of(const Level& level, Vec3 point);
// The indices of a label of this centring over the whole domain of a level.
IndexBox index_range(const Level& level, Centring centring);

// Names a user asked for; empty: all.
struct LabelFilter {
  std::vector<std::string> only, ignore;
  bool selects(const std::string& name) const;
};

// Splits "a,b,c" at commas; blanks around names go.
std::vector<std::string> split_names(const std::string& text);

// The fields of a step that a user means, in the order material, level. InputError names what the
// step has when there is none. level < 0: all levels.
std::vector<FieldInfo> select_fields(const ArchiveStep& step, const std::string& name,
                                     std::optional<int> material, int level);

// The states that "all", "A:B" or the words of Archive::select choose. A and B are times, which
// bound a closed range, or words; either may be missing. InputError where there is none, with the
// nearest.
std::vector<StepEntry> select_steps(const Archive& archive, Stored kind, std::string_view text);
// Whether a time is in the range "A:B" of plain times; an end that is missing bounds nothing.
// InputError where it is no such range.
struct TimeRange {
  double first, last;  // s
  bool contains(double time) const;
};
TimeRange parse_time_range(std::string_view text);

}  // namespace sluice
