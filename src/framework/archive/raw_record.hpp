// What the XML files of a raw archive say: index.xml, timestep.xml, and the blocks of a data file.
#pragma once
#include <optional>

#include "framework/archive/archive_record.hpp"
#include "framework/archive/raw_grid.hpp"

namespace sluice {

// "CCVariable<double>": what the bytes of an element mean.
struct RawType {
  Centring centring = Centring::cell;
  ValueType type = ValueType::real;
  StoredType stored = StoredType::float64;
  std::size_t element_bytes() const { return size_of(stored) * component_count(type); }
};
// None: a type that is not read, as those of stencils.
std::optional<RawType> parse_raw_type(std::string_view text);

// One variable of one material on one patch.
struct RawBlock {
  std::string variable;
  RawType type;
  int material = 0;  // -1: of the whole run
  int level = 0;
  int patch = 0;                    // its id
  IntVec3 layers{};                 // of extra cells, where they are not those of the grid
  std::int64_t begin = 0, end = 0;  // bytes in the file
  std::int64_t particles = 0;
  bool gzip = false;
  std::filesystem::path file;
};

struct RawDataFile {
  std::filesystem::path record;  // p00000.xml
  int level = -1;                // -1: of the whole run
};

struct RawStepRecord {
  StepRecord step;
  std::vector<RawLevel> levels;
  std::vector<RawDataFile> files;
  bool big_endian = false;
  int word_bits = 64;
};

// Whether the text of an index.xml is that of a raw archive.
bool is_raw_index(std::string_view text);

// These throw DamageError, which names the file, where something is missing or cannot be.
ArchiveIndex parse_raw_index(const XmlElement& root, const std::string& context);
// Reads timestep.xml, and grid.xml and data.xml beside it where there are such.
RawStepRecord read_raw_step(const std::filesystem::path& timestep_xml,
                            const ArchiveStorage& storage);
// Blocks of types that are not read are left out.
std::vector<RawBlock> read_raw_blocks(const RawDataFile& file);

}  // namespace sluice
