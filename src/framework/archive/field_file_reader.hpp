// Reading one rank's field file back: nothing is trusted before its checksum fits.
#pragma once
#include <filesystem>
#include <map>
#include <vector>

#include "framework/archive/archive_record.hpp"
#include "framework/archive/hdf5_handle.hpp"
#include "framework/grid/index_box.hpp"

namespace sluice {

// Throws DamageError where a size or a checksum does not fit.
class FieldFileReader {
 public:
  // Reads the record (pNNNNN.xml) and checks the size of the data file beside it.
  explicit FieldFileReader(const std::filesystem::path& record_path);

  const std::vector<StoredVariable>& variables() const { return record_.variables; }
  const std::filesystem::path& path() const { return path_; }
  const StoredVariable* find(std::string_view name, int level, int material) const;

  // The boxes of a variable, in stored order. Checks the file's structure at the first call.
  const std::vector<IndexBox>& boxes(const StoredVariable& variable);
  // The values of box number `box`, component after component, x fastest; checksum verified.
  std::vector<double> read_box(const StoredVariable& variable, std::size_t box);

 private:
  struct Table {
    Hdf5Handle values;
    std::vector<IndexBox> boxes;
    std::vector<std::int64_t> starts;  // of each box, in values
    std::vector<std::uint32_t> sums;   // one a box and component
  };
  void open();
  Table& table(const StoredVariable& variable);
  Table read_table(const StoredVariable& variable);
  template <class T>
  std::vector<double> read_box_as(const StoredVariable& variable, const Table& t, std::size_t box);

  std::filesystem::path path_;
  DataFileRecord record_;
  Hdf5Handle file_;
  std::map<std::string, Table> tables_;
};

}  // namespace sluice
