// Reading one rank's field file back: nothing is trusted before its checksum fits.
#pragma once
#include <filesystem>
#include <map>
#include <vector>

#include "framework/archive/hdf5_handle.hpp"
#include "framework/archive/step_file.hpp"

namespace sluice {

// Throws DamageError where a size or a checksum does not fit.
class FieldFileReader : public StepFile {
 public:
  // Reads the record (pNNNNN.xml) and checks the size of the data file beside it.
  explicit FieldFileReader(const std::filesystem::path& record_path);

  const std::vector<StoredVariable>& variables() const override { return record_.variables; }
  // Checks the file's structure at the first call.
  const std::vector<StoredBox>& boxes(const StoredVariable& variable) override;
  // With their checksum.
  std::vector<double> read_box(const StoredVariable& variable, std::size_t box) override;
  std::vector<std::int64_t> read_integers(const StoredVariable& variable, std::size_t box) override;

 private:
  struct Table {
    Hdf5Handle values;
    std::vector<StoredBox> boxes;
    std::vector<std::int64_t> starts;  // of each box, in values
    std::vector<std::uint32_t> sums;   // one a box and component
  };
  void open();
  Table& table(const StoredVariable& variable);
  Table read_table(const StoredVariable& variable);
  template <class T, class Value>
  std::vector<Value> read_box_as(const StoredVariable& variable, std::size_t box);
  template <class Value>
  std::vector<Value> read_values(const StoredVariable& variable, std::size_t box);

  std::filesystem::path path_;
  DataFileRecord record_;
  Hdf5Handle file_;
  std::map<std::string, Table> tables_;
};

}  // namespace sluice
