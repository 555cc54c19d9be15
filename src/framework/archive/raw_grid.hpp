// The grid of a step of a raw archive: levels, and patches with the extra cells around them.
//
// Extra cells lie on those sides of a patch beyond which no patch of the level begins: at the
// boundary of the domain and where levels meet. Values of nodes and faces have one more layer on
// such a high side. Between patches, a value belongs to the patch above it.
#pragma once
#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "framework/archive/archive_record.hpp"

namespace sluice {

struct RawPatch {
  int id = 0;    // numbers go on from level to level, and over regrids
  int rank = 0;  // that wrote it
  IndexBox interior, outer;
  std::array<bool, 3> open_low{}, open_high{};  // sides without a neighbour
};

struct RawLevel {
  Level level;  // boxes are the interiors of the patches
  int id = 0;
  std::vector<RawPatch> patches;  // in the order of level.boxes
};

// DamageError where numbers are missing, or are not those of a grid.
std::vector<RawLevel> parse_raw_grid(const XmlElement& grid, const std::string& context);
// The file grid.xml may also be binary: it then begins and ends with the same four bytes.
bool is_binary_grid(std::string_view bytes);
std::vector<RawLevel> parse_binary_grid(std::string_view bytes, bool big_endian,
                                        const std::string& context);

// Which indices a block holds. `layers`: what the block says of itself, in place of extra cells; 0
// where it says nothing.
IndexBox stored_indices(const RawPatch& patch, Centring centring, IntVec3 layers);
// The part that is of this patch alone.
IndexBox own_indices(const RawPatch& patch, Centring centring);

}  // namespace sluice
