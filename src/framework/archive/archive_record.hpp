// What the XML files of an archive say: the index of steps, one step, and one rank's data file.
//
// Element names and conventions (t%05d, p%05d, 17 digits, oldDelt) are those that scripts written
// for .uda archives expect; <outputFormat> says HDF5, so that a reader of the raw layout stops.
#pragma once
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "framework/archive/xml_text.hpp"
#include "framework/field/label.hpp"
#include "framework/grid/level.hpp"

namespace sluice {

// The scalars of one archived state. Doubles survive to the last bit. Times in s.
struct StepInfo {
  int step = 0;                              // number of steps taken
  double time = 0;                           // at the end of the step
  double old_delt = 0;                       // the step just taken
  double next_delt = 0;                      // the step to take next
  std::map<std::string, std::string> state;  // what components need for a restart, as UTF-8 text
};

// A line of index.xml; times as in StepInfo.
struct StepEntry {
  int step = 0;
  double time = 0;
  double old_delt = 0;
  std::filesystem::path href;  // of timestep.xml, relative to the folder of the index, or absolute
};

// A variable as the whole archive sees it.
struct VariableEntry {
  std::string name;
  ValueType type = ValueType::real;
  Centring centring = Centring::cell;
  std::string unit;
  int materials = 0;
  std::string type_name = {};  // as in the index: CCVariable<double>
  bool readable = true;        // false: a type of the raw layout whose values are not read
};

struct HistoryEntry {  // a .dat file
  std::string name, file, type;
};

struct RestartEntry {
  std::string from;
  int step = 0;
};

// How the values of an archive are stored: in HDF5, as Sluice writes them, or in the raw binary
// files of Uintah, which Sluice only reads.
enum class ArchiveFormat { hdf5, raw };
struct ArchiveStorage {
  ArchiveFormat format = ArchiveFormat::hdf5;
  // Of raw files, where a step does not say otherwise.
  bool big_endian = false;
  int word_bits = 64;
  std::string position_name = "p.x";  // what the positions of particles are called
};

struct ArchiveIndex {
  ArchiveStorage storage;
  int ranks = 1;
  std::string program;  // "sluice 0.1.0"
  std::string created;  // ISO 8601, UTC
  std::vector<RestartEntry> restarts;
  std::vector<HistoryEntry> histories;
  std::vector<VariableEntry> variables;
  std::vector<StepEntry> steps;  // by time
};

// How one label of one material and level lies in a rank's data file.
enum class StoredType { float64, float32, int32, int64, int16, uint8 };  // the last two: raw files
struct StoredVariable {
  std::string name;
  ValueType type = ValueType::real;
  Centring centring = Centring::cell;
  std::string unit;
  int level = 0;
  int material = 0;
  StoredType stored = StoredType::float64;
  bool gzip = false;
  std::int64_t offset = -1;   // of the values in the file; -1 when compressed
  std::int64_t bytes = 0;     // of the values, uncompressed
  std::string group() const;  // its HDF5 group: "/l0/press_CC/m0"
};

struct DataFileRecord {
  std::string href;                // p00000.h5, in the folder of the record
  std::int64_t bytes = 0;          // of the whole file
  std::uint32_t metadata_crc = 0;  // of every byte that is not a stored value
  std::vector<StoredVariable> variables;
};

// A patch as its file knows it: a box of a level, with the extra cells that a raw archive stores
// around it where no patch of the level is beside it.
struct PatchRecord {
  int id = 0;
  IndexBox interior, outer;
};

struct StepRecord {
  StepInfo info;
  Grid grid;
  std::vector<std::vector<PatchRecord>> patches;  // by level, in the order of Level::boxes
  std::vector<int> level_ids;                     // by level; they differ in raw archives only
  int ranks = 1;
  std::vector<std::string> data_files;  // p00000.xml, in the folder of the step
};

XmlElement to_xml(const ArchiveIndex&);
XmlElement to_xml(const StepRecord&);
XmlElement to_xml(const DataFileRecord&);
// DamageError where a number, a name or a size is not one that an archive has; of parse_index
// InputError where it is the index of another format.
ArchiveIndex parse_index(const XmlElement&, const std::string& context);
StepRecord parse_step(const XmlElement&, const std::string& context);
DataFileRecord parse_data_file(const XmlElement&, const std::string& context);

// InputError naming the archive in which the step is, where this one only refers to it and it is
// not there.
void require_referenced_archive(const StepEntry&, const std::filesystem::path& archive);

// A box of indices as read from a file: not empty, and small enough to compute with; else
// DamageError.
IndexBox checked_box(IntVec3 lower, IntVec3 upper, const std::string& context);

std::string step_folder_name(int step);  // t00012
std::string_view name_of(StoredType);
std::size_t size_of(StoredType);
// CCVariable<double> and so on: the type names of .uda files.
std::string type_text(ValueType, Centring);

}  // namespace sluice
