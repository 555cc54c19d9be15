// A header with the places of all arrays, written last; blank space; the arrays, one after another.
#include "framework/archive/vtk/vtk_file.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <cstring>
#include <stdexcept>

#include "framework/archive/drawing/replacing_file.hpp"
#include "framework/archive/xml_text.hpp"

namespace sluice {
namespace {

constexpr std::size_t block_bytes = 64 * 1024;

const char* type_name(StoredType type) {
  switch (type) {
    case StoredType::float32:
      return "Float32";
    case StoredType::int16:
      return "Int16";
    case StoredType::int32:
      return "Int32";
    case StoredType::int64:
      return "Int64";
    case StoredType::uint8:
      return "UInt8";
    default:
      return "Float64";
  }
}

}  // namespace

VtkValues::VtkValues(ReplacingFile& file, StoredType stored, std::int64_t count)
    : file_(file),
      stored_(stored),
      begin_(file.appended()),
      block_(block_bytes),
      compressed_(compressBound(block_bytes)),
      missing_(count) {
  const std::uint64_t bytes = count * size_of(stored),
                      blocks = (bytes + block_bytes - 1) / block_bytes;
  header_ = {blocks, block_bytes, bytes % block_bytes};
  header_.resize(3 + blocks);
  file_.append(header_.data(), header_.size() * sizeof(std::uint64_t));
}

template <class T>
void VtkValues::put(T value) {
  std::memcpy(block_.data() + used_, &value, sizeof value);
  used_ += sizeof value;
  if (used_ == block_bytes) flush();
}

void VtkValues::add(double value) {
  --missing_;
  switch (stored_) {
    case StoredType::float64:
      return put(value);
    case StoredType::float32:
      return put(static_cast<float>(value));
    case StoredType::int64:
      return put(static_cast<std::int64_t>(value));
    case StoredType::int32:
      return put(static_cast<std::int32_t>(value));
    case StoredType::int16:
      return put(static_cast<std::int16_t>(value));
    case StoredType::uint8:
      return put(static_cast<std::uint8_t>(value));
  }
}

void VtkValues::add(std::int64_t value) {
  if (stored_ != StoredType::int64) return add(static_cast<double>(value));
  --missing_;
  put(value);
}

void VtkValues::flush() {
  uLongf size = compressed_.size();
  if (blocks_ + 3 >= header_.size() ||
      compress2(reinterpret_cast<Bytef*>(compressed_.data()), &size,
                reinterpret_cast<const Bytef*>(block_.data()), used_, Z_BEST_SPEED) != Z_OK)
    throw std::logic_error("vtk: more values than were announced");
  header_[3 + blocks_++] = size;
  file_.append(compressed_.data(), size);
  used_ = 0;
}

void VtkValues::finish() {
  if (missing_ != 0) throw std::logic_error("vtk: other values than were announced");
  if (used_ > 0) flush();
  file_.file().write_at(begin_, header_.data(), header_.size() * sizeof(std::uint64_t));
}

namespace {

// Places of arrays in the appended data, by number.
using Offsets = std::vector<std::int64_t>;

XmlElement data_array(const VtkArray& a, std::int64_t offset) {
  XmlElement element("DataArray");
  element.set("type", type_name(a.stored))
      .set("Name", a.name)
      .set("NumberOfComponents", std::to_string(a.components))
      .set("format", "appended")
      .set("offset", fmt::format("{:015}", offset));  // of equal length, whatever it is
  return element;
}

XmlElement vtk_root(const char* type) {
  XmlElement root("VTKFile");
  root.set("type", type)
      .set("version", "1.0")
      .set("byte_order", "LittleEndian")
      .set("header_type", "UInt64")
      .set("compressor", "vtkZLibDataCompressor");
  return root;
}

// The text before the arrays, and where their places count from.
//
// VTK's parser reads blocks of 4096 bytes up to the tag of the appended data, and learns of that
// tag only when expat has told it. Since its version 2.6 (in Debian 12 as 2.5.0-1+deb12u2) expat
// waits for more text first and is given the next block: so that must be blank, and the tag must
// lie within one block.
std::pair<std::string, std::int64_t> head_of(const XmlElement& root) {
  constexpr std::size_t parsed = 4096;
  constexpr std::string_view closing = "</VTKFile>\n", tag = "<AppendedData encoding=\"raw\">_";
  std::string text = to_text(root);
  text.resize(text.size() - closing.size());
  const auto to_end_of_block = [&] { return (parsed - text.size() % parsed) % parsed; };
  if (to_end_of_block() < tag.size()) text.append(to_end_of_block(), ' ');
  text += tag;
  const auto origin = static_cast<std::int64_t>(text.size());
  text.append(to_end_of_block() + parsed, ' ');
  return {text, origin};
}

void write_file(const std::filesystem::path& path, const std::vector<const VtkArray*>& arrays,
                const std::function<XmlElement(const Offsets&)>& describe) {
  Offsets offsets(arrays.size());
  ReplacingFile file(path);
  const auto [head, origin] = head_of(describe(offsets));
  file.append(head);
  for (std::size_t n = 0; n < arrays.size(); ++n) {
    offsets[n] = file.appended() - origin;
    VtkValues values(file, arrays[n]->stored, arrays[n]->tuples * arrays[n]->components);
    arrays[n]->put(values);
    values.finish();
  }
  file.append("\n  </AppendedData>\n</VTKFile>\n");
  const std::string told = head_of(describe(offsets)).first;
  file.file().write_at(0, told.data(), told.size());
  file.finish();
}

std::vector<const VtkArray*> pointers(const std::vector<VtkArray>& arrays) {
  std::vector<const VtkArray*> all;
  for (const VtkArray& a : arrays) all.push_back(&a);
  return all;
}

// The <DataArray> elements of one kind.
XmlElement data_element(const char* kind, const std::vector<VtkArray>& arrays, bool on_points,
                        const Offsets& offsets) {
  XmlElement element(kind);
  for (std::size_t n = 0; n < arrays.size(); ++n)
    if (arrays[n].on_points == on_points)
      element.children.push_back(data_array(arrays[n], offsets[n]));
  return element;
}

}  // namespace

void write_vti(const std::filesystem::path& path, const Level& level, const IndexBox& cells,
               bool from_zero, const std::vector<VtkArray>& arrays) {
  const IntVec3 lower = from_zero ? IntVec3{} : cells.lower;
  const IntVec3 upper = from_zero ? cells.size() : cells.upper;
  Vec3 origin = level.anchor;
  for (int d = 0; from_zero && d < 3; ++d) origin[d] += cells.lower[d] * level.spacing[d];
  const std::string extent =
      fmt::format("{} {} {} {} {} {}", lower.x, upper.x, lower.y, upper.y, lower.z, upper.z);
  write_file(path, pointers(arrays), [&](const Offsets& offsets) {
    XmlElement root = vtk_root("ImageData");
    XmlElement& image = root.add("ImageData");
    image.set("WholeExtent", extent)
        .set("Origin", fmt::format("{:.17g} {:.17g} {:.17g}", origin.x, origin.y, origin.z))
        .set("Spacing", fmt::format("{:.17g} {:.17g} {:.17g}", level.spacing.x, level.spacing.y,
                                    level.spacing.z));
    XmlElement& piece = image.add("Piece").set("Extent", extent);
    for (const bool on_points : {true, false})
      piece.children.push_back(
          data_element(on_points ? "PointData" : "CellData", arrays, on_points, offsets));
    return root;
  });
}

void write_vtp(const std::filesystem::path& path, const VtkArray& positions,
               const std::vector<VtkArray>& arrays) {
  const std::int64_t count = positions.tuples;
  // A vertex for each point: without cells nothing is drawn.
  const auto numbers = [&](const char* name, std::int64_t first) {
    return VtkArray{name, StoredType::int64, true, 1, count, [=](VtkValues& values) {
                      for (std::int64_t n = 0; n < count; ++n) values.add(first + n);
                    }};
  };
  const VtkArray vertices = numbers("connectivity", 0), ends = numbers("offsets", 1);
  std::vector<const VtkArray*> all = pointers(arrays);
  all.insert(all.end(), {&positions, &vertices, &ends});
  write_file(path, all, [&](const Offsets& offsets) {
    XmlElement root = vtk_root("PolyData");
    XmlElement& piece = root.add("PolyData").add("Piece");
    for (const char* cells : {"Verts", "Lines", "Strips", "Polys"})
      piece.set(std::string("NumberOf") + cells, std::to_string(cells[0] == 'V' ? count : 0));
    piece.set("NumberOfPoints", std::to_string(count));
    piece.children.push_back(data_element("PointData", arrays, true, offsets));
    const std::int64_t* place = offsets.data() + arrays.size();
    piece.add("Points").children.push_back(data_array(positions, place[0]));
    XmlElement& verts = piece.add("Verts");
    verts.children.push_back(data_array(vertices, place[1]));
    verts.children.push_back(data_array(ends, place[2]));
    return root;
  });
}

}  // namespace sluice
