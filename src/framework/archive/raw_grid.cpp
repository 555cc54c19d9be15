// Levels as their files give them, and what follows: ratios, domains, sides without neighbour.
#include "framework/archive/raw_grid.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "framework/archive/raw_bytes.hpp"
#include "framework/grid/box_list.hpp"

namespace sluice {
namespace {

constexpr double most_cells = 1e15;  // of a level: products of extents stay within 64 bits

IndexBox bounds_of(const RawLevel& level) {
  IndexBox all = level.patches.front().interior;
  for (const RawPatch& p : level.patches) all = bounding(all, p.interior);
  return all;
}

void check_extent(const IndexBox& box, const std::string& context) {
  double cells = 1;
  for (int d = 0; d < 3; ++d) cells *= double(box.upper[d]) - double(box.lower[d]);
  if (!(cells <= most_cells))
    throw DamageError(fmt::format("{}: cells {} to {} are more than any archive has", context,
                                  triple_text(box.lower), triple_text(box.upper)));
}

void check_patch(const RawPatch& p, const std::string& context) {
  checked_box(p.interior.lower, p.interior.upper, context);
  checked_box(p.outer.lower, p.outer.upper, context);
  if (!p.outer.contains(p.interior))
    throw DamageError(fmt::format("{}: the interior of patch {} lies outside it", context, p.id));
}

// A patch beyond a side begins where this one ends, over a part of the side; with periodic sides
// also a period away.
class Neighbours {
 public:
  explicit Neighbours(const RawLevel& level) : level_(level), domain_(level.level.domain) {
    for (std::size_t n = 0; n < level.patches.size(); ++n)
      for (int d = 0; d < 3; ++d) {
        begins_[d].emplace(level.patches[n].interior.lower[d], n);
        ends_[d].emplace(level.patches[n].interior.upper[d], n);
      }
  }

  bool any(const RawPatch& patch, int d, bool high) const {
    const auto& places = high ? begins_[d] : ends_[d];
    const int edge = high ? patch.interior.upper[d] : patch.interior.lower[d];
    const int period = high ? -domain_.size()[d] : domain_.size()[d];
    const bool around =
        level_.level.periodic[d] && edge == (high ? domain_.upper[d] : domain_.lower[d]);
    return touches(places, edge, patch, d) || (around && touches(places, edge + period, patch, d));
  }

 private:
  using Places = std::multimap<int, std::size_t>;
  bool touches(const Places& places, int edge, const RawPatch& patch, int d) const {
    const auto [from, to] = places.equal_range(edge);
    return std::any_of(from, to, [&](const auto& place) {
      const IndexBox& other = level_.patches[place.second].interior;
      for (int e = 0; e < 3; ++e)
        if (e != d && (other.lower[e] >= patch.interior.upper[e] ||
                       other.upper[e] <= patch.interior.lower[e]))
          return false;
      return true;
    });
  }

  const RawLevel& level_;
  IndexBox domain_;
  std::array<Places, 3> begins_, ends_;
};

void find_open_sides(RawLevel& level) {
  const Neighbours neighbours(level);
  for (RawPatch& p : level.patches)
    for (int d = 0; d < 3; ++d) {
      p.open_low[d] = !neighbours.any(p, d, false);
      p.open_high[d] = !neighbours.any(p, d, true);
    }
}

// How often this level divides the cells of the next coarser one.
IntVec3 ratio_to(const Level& coarse, const Level& fine, const std::string& context) {
  IntVec3 ratio;
  for (int d = 0; d < 3; ++d) {
    const double r = coarse.spacing[d] / fine.spacing[d];
    if (!(r > 0.5 && r < 1024.5) || std::abs(r - std::round(r)) > 1e-5 * r)
      throw DamageError(fmt::format("{}: level {} has spacing {}, the next coarser {}: not a ratio",
                                    context, fine.index, triple_text(fine.spacing),
                                    triple_text(coarse.spacing)));
    ratio[d] = static_cast<int>(std::round(r));
  }
  return ratio;
}

IndexBox refined_domain(const IndexBox& coarse, IntVec3 ratio, const std::string& context) {
  for (int d = 0; d < 3; ++d)
    if (std::max(std::abs(coarse.lower[d]), std::abs(coarse.upper[d])) > (1 << 30) / ratio[d])
      throw DamageError(context + ": a level is finer than indices can count");
  return refine(coarse, ratio);
}

// The levels together, coarse to fine.
void complete(std::vector<RawLevel>& levels, const std::string& context) {
  if (levels.empty()) throw DamageError(context + ": the grid has no level");
  for (std::size_t l = 0; l < levels.size(); ++l) {
    RawLevel& raw = levels[l];
    Level& level = raw.level;
    level.index = static_cast<int>(l);
    if (raw.patches.empty())
      throw DamageError(fmt::format("{}: level {} has no patch", context, l));
    for (int d = 0; d < 3; ++d)
      if (!(level.spacing[d] > 0) || !std::isfinite(level.spacing[d]) ||
          !std::isfinite(level.anchor[d]))
        throw DamageError(fmt::format("{}: level {} has spacing {} and anchor {}", context, l,
                                      triple_text(level.spacing), triple_text(level.anchor)));
    for (const RawPatch& p : raw.patches) {
      check_patch(p, context);
      level.boxes.push_back({p.interior, p.rank, static_cast<int>(level.boxes.size())});
    }
    level.domain = bounds_of(raw);
    if (l > 0) {
      const Level& coarse = levels[l - 1].level;
      level.ratio = ratio_to(coarse, level, context);
      level.domain = bounding(level.domain, refined_domain(coarse.domain, level.ratio, context));
    }
    check_extent(level.domain, context);
    for (int d = 0; d < 3; ++d) level.active[d] = levels[0].level.domain.size()[d] > 1;
    find_open_sides(raw);
  }
}

IntVec3 triple_of(const XmlElement& e, const char* name, const std::string& context) {
  return parse_int_triple(e.need(name, context).text, context);
}

RawPatch parse_raw_patch(const XmlElement& e, const std::string& context) {
  RawPatch p;
  p.id = parse_int(e.need("id", context).text, context);
  const XmlElement* rank = e.child("proc");
  p.rank = rank == nullptr ? -1 : parse_int(rank->text, context);
  p.outer = {triple_of(e, "lowIndex", context), triple_of(e, "highIndex", context)};
  p.interior = p.outer;
  if (e.child("interiorLowIndex")) p.interior.lower = triple_of(e, "interiorLowIndex", context);
  if (e.child("interiorHighIndex")) p.interior.upper = triple_of(e, "interiorHighIndex", context);
  return p;
}

RawLevel parse_raw_level(const XmlElement& e, int number, const std::string& context) {
  RawLevel raw;
  const XmlElement* id = e.child("id");
  raw.id = id == nullptr ? number : parse_int(id->text, context);
  if (e.child("periodic")) {
    const IntVec3 periodic = triple_of(e, "periodic", context);
    for (int d = 0; d < 3; ++d) raw.level.periodic[d] = periodic[d] != 0;
  }
  raw.level.anchor = parse_real_triple(e.need("anchor", context).text, context);
  raw.level.spacing = parse_real_triple(e.need("cellspacing", context).text, context);
  for (const XmlElement& p : e.children)
    if (p.name == "Patch") raw.patches.push_back(parse_raw_patch(p, context));
  return raw;
}

RawPatch read_binary_patch(RawBytes& bytes) {
  RawPatch p;
  p.id = bytes.read<std::int32_t>();
  p.rank = bytes.read<std::int32_t>();
  p.outer.lower = bytes.read_ints();
  p.outer.upper = bytes.read_ints();
  p.interior.lower = bytes.read_ints();
  p.interior.upper = bytes.read_ints();
  bytes.read<std::int32_t>();  // nodes
  bytes.read_reals();          // corners
  bytes.read_reals();
  bytes.read<std::int32_t>();  // cells
  return p;
}

RawLevel read_binary_level(RawBytes& bytes) {
  RawLevel raw;
  const auto patches = bytes.read<std::int32_t>();
  bytes.read<std::int64_t>();  // cells
  bytes.read_ints();           // layers of extra cells
  raw.level.anchor = bytes.read_reals();
  const IntVec3 periodic = bytes.read_ints();
  for (int d = 0; d < 3; ++d) raw.level.periodic[d] = periodic[d] != 0;
  raw.id = bytes.read<std::int32_t>();
  raw.level.spacing = bytes.read_reals();
  for (int n = 0; n < patches; ++n) raw.patches.push_back(read_binary_patch(bytes));
  return raw;
}

}  // namespace

std::vector<RawLevel> parse_raw_grid(const XmlElement& grid, const std::string& context) {
  std::vector<RawLevel> levels;
  for (const XmlElement& e : grid.children)
    if (e.name == "Level")
      levels.push_back(parse_raw_level(e, static_cast<int>(levels.size()), context));
  complete(levels, context);
  return levels;
}

bool is_binary_grid(std::string_view bytes) {
  const std::size_t first = bytes.find_first_not_of(" \t\r\n");
  return first != bytes.npos && bytes[first] != '<';
}

std::vector<RawLevel> parse_binary_grid(std::string_view text, bool big_endian,
                                        const std::string& context) {
  RawBytes bytes(text, big_endian, context);
  const auto mark = bytes.read<std::uint32_t>();
  const auto count = bytes.read<std::int32_t>();
  std::vector<RawLevel> levels;
  for (int l = 0; l < count; ++l) levels.push_back(read_binary_level(bytes));
  if (bytes.read<std::uint32_t>() != mark)
    throw DamageError(context + ": the grid does not end with the number that it begins with");
  complete(levels, context);
  return levels;
}

IndexBox own_indices(const RawPatch& patch, Centring centring) {
  IndexBox box = patch.interior;
  const IntVec3 closing = closing_layers(centring);
  for (int d = 0; d < 3; ++d) box.upper[d] += patch.open_high[d] ? closing[d] : 0;
  return box;
}

IndexBox stored_indices(const RawPatch& patch, Centring centring, IntVec3 layers) {
  IndexBox box = patch.outer;
  if (layers != IntVec3{})
    for (int d = 0; d < 3; ++d) {
      box.lower[d] = patch.interior.lower[d] - (patch.open_low[d] ? layers[d] : 0);
      box.upper[d] = patch.interior.upper[d] + (patch.open_high[d] ? layers[d] : 0);
    }
  const IntVec3 closing = closing_layers(centring);
  for (int d = 0; d < 3; ++d) box.upper[d] += patch.open_high[d] ? closing[d] : 0;
  return box;
}

}  // namespace sluice
