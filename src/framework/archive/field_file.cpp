// Writing one rank's field file: plan the groups, let HDF5 lay them out, write the values past it.
#include "framework/archive/field_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <stdexcept>

#include "framework/archive/field_gather.hpp"
#include "framework/archive/hdf5_handle.hpp"
#include "framework/archive/hdf5_target.hpp"
#include "framework/archive/posix_file.hpp"
#include "framework/base/crc32c.hpp"

namespace sluice {
namespace {

// All pieces of one label, material and level, box after box, component after component.
struct Group {
  StoredVariable variable;
  std::vector<const FieldPiece*> pieces;
  std::vector<std::int32_t> boxes;                    // six numbers a box
  std::vector<std::uint32_t> sums;                    // one a piece
  std::int64_t values_offset = -1, sums_offset = -1;  // in the file

  std::size_t components() const { return component_count(variable.type); }
  hsize_t box_count() const { return pieces.size() / components(); }
  hsize_t value_count() const {
    return static_cast<hsize_t>(variable.bytes) / size_of(variable.stored);
  }
};

StoredType stored_type(ValueType type, const StorageOptions& options) {
  if (type == ValueType::integer) return StoredType::int32;
  if (type == ValueType::long_integer) return StoredType::int64;
  return options.doubles_as_float ? StoredType::float32 : StoredType::float64;
}

hid_t memory_type(StoredType t) {
  return t == StoredType::float64   ? H5T_NATIVE_DOUBLE
         : t == StoredType::float32 ? H5T_NATIVE_FLOAT
         : t == StoredType::int64   ? H5T_NATIVE_INT64
                                    : H5T_NATIVE_INT32;
}

// Every box must come with all its components over the same cells.
void check_boxes(const Group& g) {
  const std::size_t n = g.components();
  bool good = g.pieces.size() % n == 0;
  for (std::size_t p = 0; good && p < g.pieces.size(); ++p) {
    const FieldPiece& first = *g.pieces[p - p % n];
    good = g.pieces[p]->component == static_cast<int>(p % n) &&
           g.pieces[p]->box_id == first.box_id && g.pieces[p]->cells == first.cells &&
           g.pieces[p]->gzip == g.variable.gzip;
  }
  if (!good)
    throw std::logic_error("archive: the pieces of " + g.variable.name +
                           " must be one per component, over the same cells");
}

std::vector<Group> plan(std::span<const FieldPiece> pieces, const StorageOptions& options) {
  std::map<std::tuple<int, std::string, int>, Group> groups;
  for (const FieldPiece& p : pieces)
    if (!p.cells.empty()) groups[{p.level, p.label.name(), p.material}].pieces.push_back(&p);
  std::vector<Group> planned;
  for (auto& [key, g] : groups) {
    std::stable_sort(
        g.pieces.begin(), g.pieces.end(), [](const FieldPiece* a, const FieldPiece* b) {
          return std::pair(a->box_id, a->component) < std::pair(b->box_id, b->component);
        });
    const LabelInfo& info = g.pieces.front()->label.info();
    g.variable = {info.name,
                  info.type,
                  info.centring,
                  info.unit,
                  std::get<0>(key),
                  std::get<2>(key),
                  stored_type(info.type, options),
                  g.pieces.front()->gzip};
    check_boxes(g);
    for (const FieldPiece* p : g.pieces) {
      g.variable.bytes += p->cells.volume() * static_cast<std::int64_t>(size_of(g.variable.stored));
      if (p->component != 0) continue;
      for (const IntVec3& c : {p->cells.lower, p->cells.upper})
        g.boxes.insert(g.boxes.end(), {c.x, c.y, c.z});
    }
    g.sums.resize(g.pieces.size());
    planned.push_back(std::move(g));
  }
  return planned;
}

void write_text_attribute(hid_t object, const char* name, const std::string& text,
                          const std::string& file) {
  const auto type = checked(H5Tcopy(H5T_C_S1), H5Tclose, "make a text type", file);
  checked(H5Tset_size(type.get(), std::max<std::size_t>(text.size(), 1)), "size a text", file);
  const auto space = checked(H5Screate(H5S_SCALAR), H5Sclose, "make a space", file);
  const auto attribute =
      checked(H5Acreate2(object, name, type.get(), space.get(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose,
              "create an attribute", file);
  const std::string padded = text.empty() ? std::string(1, '\0') : text;
  checked(H5Awrite(attribute.get(), type.get(), padded.data()), "write an attribute", file);
}

// A data set whose bytes are placed in the file now and written later, or compressed in chunks.
Hdf5Handle create_data_set(hid_t group, const char* name, hid_t type,
                           const std::vector<hsize_t>& extent, bool gzip, const std::string& file) {
  const auto space =
      checked(H5Screate_simple(static_cast<int>(extent.size()), extent.data(), nullptr), H5Sclose,
              "make a space", file);
  const auto list = checked(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, "make a list", file);
  checked(H5Pset_obj_track_times(list.get(), false), "set the times", file);
  checked(H5Pset_fill_time(list.get(), H5D_FILL_TIME_NEVER), "set the fill time", file);
  if (gzip) {
    const hsize_t chunk = std::min<hsize_t>(extent[0], gather_chunk_bytes / H5Tget_size(type));
    checked(H5Pset_chunk(list.get(), 1, &chunk), "set the chunk", file);
    checked(H5Pset_shuffle(list.get()), "set the shuffle filter", file);
    checked(H5Pset_deflate(list.get(), 4), "set the gzip filter", file);
  } else {
    checked(H5Pset_alloc_time(list.get(), H5D_ALLOC_TIME_EARLY), "set the allocation", file);
  }
  return checked(H5Dcreate2(group, name, type, space.get(), H5P_DEFAULT, list.get(), H5P_DEFAULT),
                 H5Dclose, "create a data set", file);
}

std::int64_t place_of(const Hdf5Handle& data_set, const std::string& file) {
  const haddr_t offset = H5Dget_offset(data_set.get());
  if (offset == HADDR_UNDEF) fail_hdf5("place a data set", file);
  return static_cast<std::int64_t>(offset);
}

// Compressed values go through HDF5, one gathered chunk at a time.
std::int64_t write_compressed(Group& g, const Hdf5Handle& values, const Hdf5Target& target,
                              const std::string& file) {
  const auto space = checked(H5Dget_space(values.get()), H5Sclose, "ask for a space", file);
  const hid_t type = memory_type(g.variable.stored);
  hsize_t start = 0;
  std::int64_t overflows = 0;
  for (std::size_t p = 0; p < g.pieces.size(); ++p) {
    const GatherResult r =
        gather(*g.pieces[p], g.variable.stored, [&](const void* bytes, std::size_t size) {
          const hsize_t count = size / size_of(g.variable.stored);
          const auto memory =
              checked(H5Screate_simple(1, &count, nullptr), H5Sclose, "make a space", file);
          checked(
              H5Sselect_hyperslab(space.get(), H5S_SELECT_SET, &start, nullptr, &count, nullptr),
              "select a range", file);
          checked(H5Dwrite(values.get(), type, memory.get(), space.get(), H5P_DEFAULT, bytes),
                  "write values", file);
          target.check();  // a full disk takes no more chunks
          start += count;
        });
    g.sums[p] = r.crc;
    overflows += r.float_overflows;
  }
  return overflows;
}

// Opens or creates the group at an absolute path, and all above it.
Hdf5Handle make_group(hid_t file_id, const std::string& path, const std::string& file) {
  const auto list = checked(H5Pcreate(H5P_GROUP_CREATE), H5Pclose, "make a list", file);
  checked(H5Pset_obj_track_times(list.get(), false), "set the times", file);
  Hdf5Handle group;
  for (std::size_t end = path.find('/', 1);; end = path.find('/', end + 1)) {
    const std::string part = path.substr(0, end);
    const htri_t exists = H5Lexists(file_id, part.c_str(), H5P_DEFAULT);
    if (exists < 0) fail_hdf5("look for a group", file);
    group =
        checked(exists ? H5Gopen2(file_id, part.c_str(), H5P_DEFAULT)
                       : H5Gcreate2(file_id, part.c_str(), H5P_DEFAULT, list.get(), H5P_DEFAULT),
                H5Gclose, "create a group", file);
    if (end == path.npos) return group;
  }
}

std::int64_t lay_out(Group& g, hid_t file_id, const Hdf5Target& target, const std::string& file) {
  const Hdf5Handle group = make_group(file_id, g.variable.group(), file);
  write_text_attribute(group.get(), "type", std::string(name_of(g.variable.type)), file);
  write_text_attribute(group.get(), "centring", std::string(name_of(g.variable.centring)), file);
  write_text_attribute(group.get(), "unit", g.variable.unit, file);
  const auto boxes =
      create_data_set(group.get(), "boxes", H5T_STD_I32LE, {g.box_count(), 6}, false, file);
  checked(H5Dwrite(boxes.get(), H5T_NATIVE_INT32, H5S_ALL, H5S_ALL, H5P_DEFAULT, g.boxes.data()),
          "write the boxes", file);
  const auto sums = create_data_set(group.get(), "crc32c", H5T_STD_U32LE,
                                    {g.box_count(), g.components()}, false, file);
  const auto values = create_data_set(group.get(), "values", memory_type(g.variable.stored),
                                      {g.value_count()}, g.variable.gzip, file);
  g.sums_offset = place_of(sums, file);
  if (g.variable.gzip) return write_compressed(g, values, target, file);
  g.values_offset = g.variable.offset = place_of(values, file);
  return 0;
}

// HDF5's part: structure, boxes and compressed values. Leaves room for the rest.
std::int64_t write_structure(PosixFile& disk, std::vector<Group>& groups) {
  const std::string file = disk.path().string();
  Hdf5Target target(disk);
  const auto access = checked(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, "make a list", file);
  target.attach(access.get());
  // Structures with checksums of their own, readable since HDF5 1.8; large values on whole pages.
  checked(H5Pset_libver_bounds(access.get(), H5F_LIBVER_V18, H5F_LIBVER_V18), "set the version",
          file);
  checked(H5Pset_alignment(access.get(), 64 * 1024, 4096), "set the alignment", file);
  // No time stamps: equal data make equal files.
  const auto creation = checked(H5Pcreate(H5P_FILE_CREATE), H5Pclose, "make a list", file);
  checked(H5Pset_obj_track_times(creation.get(), false), "set the times", file);
  auto file_id = checked(H5Fcreate(file.c_str(), H5F_ACC_TRUNC, creation.get(), access.get()),
                         H5Fclose, "create the file", file);
  std::int64_t overflows = 0;
  for (Group& g : groups) {
    overflows += lay_out(g, file_id.get(), target, file);
    target.check();
  }
  if (!file_id.close()) fail_hdf5("close the file", file);
  target.check();
  return overflows;
}

// Our part: gathered, summed and written values, and the sums.
std::int64_t write_values(PosixFile& file, std::vector<Group>& groups) {
  std::int64_t overflows = 0;
  for (Group& g : groups) {
    std::int64_t offset = g.values_offset;
    for (std::size_t p = 0; offset >= 0 && p < g.pieces.size(); ++p) {
      const GatherResult r =
          gather(*g.pieces[p], g.variable.stored, [&](const void* bytes, std::size_t size) {
            file.write_at(offset, bytes, size);
            offset += static_cast<std::int64_t>(size);
          });
      g.sums[p] = r.crc;
      overflows += r.float_overflows;
    }
    file.write_at(g.sums_offset, g.sums.data(), g.sums.size() * sizeof(std::uint32_t));
  }
  return overflows;
}

}  // namespace

std::int64_t stored_bytes(std::span<const FieldPiece> pieces, const StorageOptions& options) {
  std::int64_t bytes = 0;
  for (const FieldPiece& p : pieces)
    bytes += p.cells.volume() *
             static_cast<std::int64_t>(size_of(stored_type(p.label.info().type, options)));
  return bytes;
}

std::uint32_t metadata_checksum(const std::filesystem::path& path, const DataFileRecord& record) {
  std::vector<std::pair<std::int64_t, std::int64_t>> values;
  for (const StoredVariable& v : record.variables)
    if (v.offset >= 0) values.emplace_back(v.offset, v.bytes);
  std::sort(values.begin(), values.end());
  const PosixFile file = PosixFile::open_read(path);
  values.emplace_back(file.size(), 0);
  std::vector<char> buffer(gather_chunk_bytes);
  std::uint32_t sum = 0;
  std::int64_t at = 0;
  for (const auto& [start, length] : values) {
    while (at < start) {
      const std::size_t count =
          std::min<std::int64_t>(start - at, static_cast<std::int64_t>(buffer.size()));
      file.read_at(at, buffer.data(), count);
      sum = crc32c(sum, buffer.data(), count);
      at += static_cast<std::int64_t>(count);
    }
    at = std::max(at, start + length);
  }
  return sum;
}

FieldFileResult write_field_file(const std::filesystem::path& folder, int rank,
                                 std::span<const FieldPiece> pieces,
                                 const StorageOptions& options) {
  silence_hdf5();
  const std::filesystem::path path = folder / fmt::format("p{:05}.h5", rank);
  std::vector<Group> groups = plan(pieces, options);
  FieldFileResult result;
  PosixFile file = PosixFile::create(path);
  result.float_overflows = write_structure(file, groups);
  result.float_overflows += write_values(file, groups);
  file.flush();
  result.record.href = path.filename().string();
  result.record.bytes = file.size();
  file.close();
  for (const Group& g : groups) result.record.variables.push_back(g.variable);
  result.record.metadata_crc = metadata_checksum(path, result.record);
  write_sealed(folder / fmt::format("p{:05}.xml", rank), to_xml(result.record));
  return result;
}

}  // namespace sluice
