// The values of a step of a raw archive: all files of all levels and ranks as one.
//
// Blocks of bytes, as raw_record.hpp tells, gzip or not, in either byte order. The raw layout has
// no checksums: what is checked are the places and lengths of blocks, and the sum of zlib.
#pragma once
#include <map>
#include <tuple>

#include "framework/archive/raw_record.hpp"
#include "framework/archive/step_file.hpp"

namespace sluice {

class RawStepFile : public StepFile {
 public:
  // Files that cannot be read are named in `damage`, and their patches are left out.
  RawStepFile(const RawStepRecord& record, const ArchiveStorage& storage,
              std::vector<std::string>& damage);

  const std::vector<StoredVariable>& variables() const override { return variables_; }
  // In the order of the patches of the level.
  const std::vector<StoredBox>& boxes(const StoredVariable& variable) override;
  std::vector<double> read_box(const StoredVariable& variable, std::size_t box) override;
  std::vector<std::int64_t> read_integers(const StoredVariable& variable, std::size_t box) override;

  // The one number that all ranks share, as the length of the next step (s); `fallback` where the
  // step holds no such number.
  double global(const std::string& name, double fallback) const;

 private:
  using Key = std::tuple<std::string, int, int>;  // name, level, material
  struct Entry {
    std::vector<StoredBox> boxes;
    std::vector<RawBlock> blocks;
  };
  void add_blocks(const RawStepRecord& record, const std::vector<RawBlock>& blocks,
                  std::string position_name);
  void sort_boxes();
  Entry& entry_of(const StoredVariable& variable);
  std::string read_bytes(const RawBlock& block, std::int64_t expected) const;
  template <class Value>
  std::vector<Value> read_values(const StoredVariable& variable, std::size_t box);

  bool big_endian_ = false;
  int word_bits_ = 64;
  std::vector<StoredVariable> variables_;
  std::map<Key, Entry> entries_;
  std::map<std::string, RawBlock> globals_;
};

}  // namespace sluice
