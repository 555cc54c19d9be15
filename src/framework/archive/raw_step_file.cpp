// Blocks by variable and patch; their bytes inflated, their order turned, component by component.
#include "framework/archive/raw_step_file.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <numeric>
#include <set>

#include "framework/archive/posix_file.hpp"
#include "framework/archive/raw_bytes.hpp"

namespace sluice {
namespace {

std::string place_of(const RawBlock& b) {
  return fmt::format("{}: {} of material {} on patch {}", b.file.string(), b.variable, b.material,
                     b.patch);
}

// The bytes of a block as they lie in the file.
std::string stored_bytes(const RawBlock& b) {
  const PosixFile file = PosixFile::open_read(b.file);
  if (b.end > file.size())
    throw DamageError(
        fmt::format("{}: {} bytes long, but {} of patch {} reaches to byte {}: the "
                    "file was cut",
                    b.file.string(), file.size(), b.variable, b.patch, b.end));
  std::string bytes(static_cast<std::size_t>(b.end - b.begin), '\0');
  file.read_at(b.begin, bytes.data(), bytes.size());
  return bytes;
}

// A zlib stream after its length when inflated.
std::string inflated(const RawBlock& b, const std::string& stored, std::int64_t expected,
                     bool big_endian, int word_bits) {
  RawBytes head(stored, big_endian, place_of(b));
  const std::uint64_t length =
      word_bits == 32 ? head.read<std::uint32_t>() : head.read<std::uint64_t>();
  if (length != static_cast<std::uint64_t>(expected))
    throw DamageError(
        fmt::format("{}: {} bytes when inflated, {} are expected", place_of(b), length, expected));
  std::string bytes(static_cast<std::size_t>(expected), '\0');
  const std::size_t skipped = static_cast<std::size_t>(word_bits) / 8;
  uLongf made = bytes.size();
  const int status = ::uncompress(reinterpret_cast<Bytef*>(bytes.data()), &made,
                                  reinterpret_cast<const Bytef*>(stored.data() + skipped),
                                  static_cast<uLong>(stored.size() - skipped));
  if (status != Z_OK || made != bytes.size())
    throw DamageError(place_of(b) + ": cannot be inflated: the file is damaged");
  return bytes;
}

template <class Stored, class Value>
void convert_raw(const std::string& bytes, std::size_t components, bool big_endian,
                 std::vector<Value>& values) {
  const std::size_t volume = bytes.size() / sizeof(Stored) / components;
  values.resize(volume * components);
  const char* from = bytes.data();
  for (std::size_t n = 0; n < volume; ++n)
    for (std::size_t c = 0; c < components; ++c, from += sizeof(Stored))
      values[c * volume + n] = static_cast<Value>(raw_number<Stored>(from, big_endian));
}

}  // namespace

RawStepFile::RawStepFile(const RawStepRecord& record, const ArchiveStorage& storage,
                         std::vector<std::string>& damage)
    : big_endian_(record.big_endian), word_bits_(record.word_bits) {
  for (const RawDataFile& file : record.files) {
    try {
      const std::vector<RawBlock> blocks = read_raw_blocks(file);
      std::set<std::string> named;
      for (const RawBlock& b : blocks)
        if (named.insert(b.file.string()).second) PosixFile::open_read(b.file);
      add_blocks(record, blocks, storage.position_name);
    } catch (const Error& e) {
      damage.push_back(e.what());
    }
  }
  sort_boxes();
}

void RawStepFile::add_blocks(const RawStepRecord& record, const std::vector<RawBlock>& blocks,
                             std::string position_name) {
  std::map<int, int> places;  // of patches, by their ids
  const int level = blocks.empty() ? -1 : blocks.front().level;
  if (level >= 0)
    for (const RawPatch& p : record.levels[level].patches)
      places.emplace(p.id, static_cast<int>(places.size()));
  for (const RawBlock& block : blocks) {
    if (block.level < 0 || block.type.centring == Centring::reduction) {
      globals_.emplace(block.variable, block);
      continue;
    }
    const auto place = places.find(block.patch);
    if (place == places.end()) throw DamageError(place_of(block) + ": the grid has no such patch");
    const RawPatch& patch = record.levels[level].patches[place->second];
    const bool particles = block.type.centring == Centring::particle;
    const std::string& name = particles && block.variable == position_name ? "p.x" : block.variable;
    StoredBox box;
    box.patch = place->second;
    if (particles) {
      if (block.particles > (1 << 30))
        throw DamageError(fmt::format("{}: {} particles", place_of(block), block.particles));
      box.stored = {{0, 0, 0}, {static_cast<int>(block.particles), 1, 1}};
      box.interior = box.stored;
    } else {
      box.stored = stored_indices(patch, block.type.centring, block.layers);
      box.interior = intersection(own_indices(patch, block.type.centring), box.stored);
    }
    const auto [entry, is_new] = entries_.try_emplace(Key{name, level, block.material});
    if (is_new) {
      StoredVariable v;
      v.name = name;
      v.type = block.type.type;
      v.centring = block.type.centring;
      v.level = level;
      v.material = block.material;
      v.stored = block.type.stored;
      v.gzip = block.gzip;
      variables_.push_back(std::move(v));
    }
    entry->second.boxes.push_back(box);
    entry->second.blocks.push_back(block);
  }
}

// By patch; where a patch has a variable twice, the first counts.
void RawStepFile::sort_boxes() {
  for (auto& [key, entry] : entries_) {
    std::vector<std::size_t> order(entry.boxes.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    const auto patch = [&e = entry](std::size_t n) { return e.boxes[n].patch; };
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return patch(a) < patch(b); });
    order.erase(std::unique(order.begin(), order.end(),
                            [&](std::size_t a, std::size_t b) { return patch(a) == patch(b); }),
                order.end());
    Entry sorted;
    for (const std::size_t n : order) {
      sorted.boxes.push_back(entry.boxes[n]);
      sorted.blocks.push_back(std::move(entry.blocks[n]));
    }
    entry = std::move(sorted);
  }
}

RawStepFile::Entry& RawStepFile::entry_of(const StoredVariable& v) {
  return entries_.at(Key{v.name, v.level, v.material});
}

const std::vector<StoredBox>& RawStepFile::boxes(const StoredVariable& variable) {
  return entry_of(variable).boxes;
}

std::string RawStepFile::read_bytes(const RawBlock& block, std::int64_t expected) const {
  std::string bytes = stored_bytes(block);
  // Deflate shrinks at most about a thousandfold: more is damage, and is not allocated.
  constexpr std::int64_t most_inflated = 2000;
  if (block.gzip) {
    if (expected / most_inflated > static_cast<std::int64_t>(bytes.size()))
      throw DamageError(fmt::format("{}: {} bytes in place of the compressed {}", place_of(block),
                                    bytes.size(), expected));
    return inflated(block, bytes, expected, big_endian_, word_bits_);
  }
  if (static_cast<std::int64_t>(bytes.size()) != expected)
    throw DamageError(fmt::format("{}: {} bytes, where {} are expected", place_of(block),
                                  bytes.size(), expected));
  return bytes;
}

template <class Value>
std::vector<Value> RawStepFile::read_values(const StoredVariable& variable, std::size_t box) {
  const Entry& entry = entry_of(variable);
  const RawBlock& block = entry.blocks[box];
  const RawType& type = block.type;
  if (type.type != variable.type || type.stored != variable.stored)
    throw DamageError(place_of(block) + ": has another type than on other patches");
  const std::int64_t volume = entry.boxes[box].stored.volume();
  // Blocks without any bytes hold nothing, as old archives say it.
  const bool empty = volume == 0 && block.begin == block.end;
  const std::string bytes =
      empty ? std::string()
            : read_bytes(block, volume * static_cast<std::int64_t>(type.element_bytes()));
  std::vector<Value> values;
  const std::size_t components = component_count(type.type);
  switch (type.stored) {
    case StoredType::float64:
      convert_raw<double>(bytes, components, big_endian_, values);
      break;
    case StoredType::float32:
      convert_raw<float>(bytes, components, big_endian_, values);
      break;
    case StoredType::int32:
      convert_raw<std::int32_t>(bytes, components, big_endian_, values);
      break;
    case StoredType::int64:
      convert_raw<std::int64_t>(bytes, components, big_endian_, values);
      break;
    case StoredType::int16:
      convert_raw<std::int16_t>(bytes, components, big_endian_, values);
      break;
    case StoredType::uint8:
      convert_raw<std::uint8_t>(bytes, components, big_endian_, values);
      break;
  }
  return values;
}

std::vector<double> RawStepFile::read_box(const StoredVariable& variable, std::size_t box) {
  return read_values<double>(variable, box);
}

std::vector<std::int64_t> RawStepFile::read_integers(const StoredVariable& variable,
                                                     std::size_t box) {
  if (variable.type != ValueType::integer && variable.type != ValueType::long_integer)
    throw DamageError(variable.name + ": is stored as numbers that are not integers");
  return read_values<std::int64_t>(variable, box);
}

double RawStepFile::global(const std::string& name, double fallback) const {
  const auto found = globals_.find(name);
  if (found == globals_.end()) return fallback;
  const RawBlock& block = found->second;
  if (block.type.type != ValueType::real || block.type.stored != StoredType::float64)
    return fallback;
  std::vector<double> values;
  convert_raw<double>(read_bytes(block, sizeof(double)), 1, big_endian_, values);
  return values.front();
}

}  // namespace sluice
