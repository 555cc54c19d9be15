// Structure first (size and CRC of all that is not a value), then boxes, then values box by box.
#include "framework/archive/field_file_reader.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "framework/archive/field_file.hpp"
#include "framework/archive/posix_file.hpp"
#include "framework/base/crc32c.hpp"

namespace sluice {
namespace {

Hdf5Handle open_data_set(const Hdf5Handle& file, const std::string& name, const std::string& path) {
  return checked(H5Dopen2(file.get(), name.c_str(), H5P_DEFAULT), H5Dclose, "open a data set",
                 path);
}

std::size_t value_count(const Hdf5Handle& data_set, const std::string& path) {
  const auto space = checked(H5Dget_space(data_set.get()), H5Sclose, "ask for a space", path);
  const hssize_t count = H5Sget_simple_extent_npoints(space.get());
  if (count < 0) fail_hdf5("ask for an extent", path);
  return count;
}

template <class T>
std::vector<T> read_all(const Hdf5Handle& data_set, hid_t type, const std::string& path) {
  std::vector<T> values(value_count(data_set, path));
  checked(H5Dread(data_set.get(), type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()),
          "read a data set", path);
  return values;
}

}  // namespace

FieldFileReader::FieldFileReader(const std::filesystem::path& record_path) {
  record_ = parse_data_file(read_sealed(record_path), record_path.string());
  path_ = record_path.parent_path() / std::filesystem::path(record_.href).filename();
  const std::int64_t size = PosixFile::open_read(path_).size();
  if (size != record_.bytes)
    throw DamageError(
        fmt::format("{}: {} bytes long, {} were written: the file was cut or replaced",
                    path_.string(), size, record_.bytes));
}

void FieldFileReader::open() {
  if (file_.valid()) return;
  silence_hdf5();
  const std::string file = path_.string();
  if (metadata_checksum(path_, record_) != record_.metadata_crc)
    throw DamageError(fmt::format(
        "{}: the checksum of its structure does not match: damaged outside the values", file));
  const auto access = checked(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, "make a list", file);
  // Archives never change once indexed; locks only fail on read-only and network file systems.
  checked(H5Pset_file_locking(access.get(), false, true), "set the locking", file);
  file_ =
      checked(H5Fopen(file.c_str(), H5F_ACC_RDONLY, access.get()), H5Fclose, "open the file", file);
}

FieldFileReader::Table& FieldFileReader::table(const StoredVariable& variable) {
  const std::string group = variable.group();
  auto it = tables_.find(group);
  if (it == tables_.end()) it = tables_.emplace(group, read_table(variable)).first;
  return it->second;
}

FieldFileReader::Table FieldFileReader::read_table(const StoredVariable& variable) {
  open();
  const std::string file = path_.string(), group = variable.group();
  Table t;
  t.values = open_data_set(file_, group + "/values", file);
  t.sums = read_all<std::uint32_t>(open_data_set(file_, group + "/crc32c", file), H5T_NATIVE_UINT32,
                                   file);
  const auto numbers =
      read_all<std::int32_t>(open_data_set(file_, group + "/boxes", file), H5T_NATIVE_INT32, file);
  const std::int64_t components = component_count(variable.type);
  std::int64_t total = 0;
  for (std::size_t n = 0; n + 6 <= numbers.size(); n += 6) {
    const std::int32_t* b = numbers.data() + n;
    const IndexBox box = checked_box({b[0], b[1], b[2]}, {b[3], b[4], b[5]}, file);
    t.boxes.push_back({box, box});
    t.starts.push_back(total);
    total += box.volume() * components;
  }
  const auto stored = static_cast<std::int64_t>(value_count(t.values, file));
  if (total != stored ||
      total * static_cast<std::int64_t>(size_of(variable.stored)) != variable.bytes ||
      t.sums.size() != t.boxes.size() * components)
    throw DamageError(
        fmt::format("{}: {} has {} values where its boxes hold {}", file, group, stored, total));
  return t;
}

const std::vector<StoredBox>& FieldFileReader::boxes(const StoredVariable& variable) {
  return table(variable).boxes;
}

template <class T, class Value>
std::vector<Value> FieldFileReader::read_box_as(const StoredVariable& variable, std::size_t box) {
  const Table& t = table(variable);
  const std::string file = path_.string();
  const std::size_t components = component_count(variable.type);
  const std::size_t volume = t.boxes[box].stored.volume();
  std::vector<T> stored(volume * components);
  const hsize_t start = static_cast<hsize_t>(t.starts[box]), count = stored.size();
  const auto space = checked(H5Dget_space(t.values.get()), H5Sclose, "ask for a space", file);
  const auto memory = checked(H5Screate_simple(1, &count, nullptr), H5Sclose, "make a space", file);
  checked(H5Sselect_hyperslab(space.get(), H5S_SELECT_SET, &start, nullptr, &count, nullptr),
          "select a range", file);
  const hid_t type = std::is_same_v<T, double>  ? H5T_NATIVE_DOUBLE
                     : std::is_same_v<T, float> ? H5T_NATIVE_FLOAT
                     : sizeof(T) == 8           ? H5T_NATIVE_INT64
                                                : H5T_NATIVE_INT32;
  if (H5Dread(t.values.get(), type, memory.get(), space.get(), H5P_DEFAULT, stored.data()) < 0) {
    H5Eclear2(H5E_DEFAULT);
    throw DamageError(fmt::format("{}: the values of {} cannot be read", file, variable.group()));
  }
  for (std::size_t c = 0; c < components; ++c)
    if (crc32c(0, stored.data() + c * volume, volume * sizeof(T)) != t.sums[box * components + c])
      throw DamageError(fmt::format("{}: the checksum of {}, box {}, component {} does not match",
                                    file, variable.group(), box, c));
  if constexpr (std::is_same_v<T, Value>) return stored;
  std::vector<Value> values(stored.size());
  std::transform(stored.begin(), stored.end(), values.begin(),
                 [](T value) { return static_cast<Value>(value); });
  return values;
}

template <class Value>
std::vector<Value> FieldFileReader::read_values(const StoredVariable& variable, std::size_t box) {
  switch (variable.stored) {
    case StoredType::float64:
      return read_box_as<double, Value>(variable, box);
    case StoredType::float32:
      return read_box_as<float, Value>(variable, box);
    case StoredType::int64:
      return read_box_as<std::int64_t, Value>(variable, box);
    default:
      return read_box_as<std::int32_t, Value>(variable, box);
  }
}

std::vector<double> FieldFileReader::read_box(const StoredVariable& variable, std::size_t box) {
  return read_values<double>(variable, box);
}

std::vector<std::int64_t> FieldFileReader::read_integers(const StoredVariable& variable,
                                                         std::size_t box) {
  return read_values<std::int64_t>(variable, box);
}

}  // namespace sluice
