// Header and arrays in one XML text, each array as base64 behind its length.
//
// Raw appended data would be a quarter smaller, but the VTK of Debian 12 cannot read them: its XML
// parser (expat 2.5.0-1+deb12u2 and later) reports the start of that section too late.
#include "framework/archive/vtk/vtk_image.hpp"

#include <fmt/format.h>

#include <cstdint>

#include "framework/archive/posix_file.hpp"
#include "framework/archive/xml_text.hpp"

namespace sluice {
namespace {

std::size_t value_bytes(const VtkArray& a) {
  switch (a.type) {
    case VtkType::integer:
      return 4;
    case VtkType::byte:
      return 1;
    default:
      return 8;
  }
}

std::string base64(const void* data, std::size_t size) {
  constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  const auto* bytes = static_cast<const unsigned char*>(data);
  std::string text;
  text.reserve((size + 2) / 3 * 4);
  for (std::size_t i = 0; i < size; i += 3) {
    const std::size_t rest = size - i;
    const unsigned group = static_cast<unsigned>(bytes[i]) << 16 |
                           (rest > 1 ? static_cast<unsigned>(bytes[i + 1]) << 8 : 0u) |
                           (rest > 2 ? static_cast<unsigned>(bytes[i + 2]) : 0u);
    text += digits[group >> 18];
    text += digits[group >> 12 & 63];
    text += rest > 1 ? digits[group >> 6 & 63] : '=';
    text += rest > 2 ? digits[group & 63] : '=';
  }
  return text;
}

// The values as they are stored.
template <class Number>
std::string base64_as(const std::vector<double>& values) {
  std::vector<Number> numbers;
  numbers.reserve(values.size());
  for (const double v : values) numbers.push_back(static_cast<Number>(v));
  return base64(numbers.data(), numbers.size() * sizeof(Number));
}

const char* type_name(VtkType type) {
  constexpr const char* names[] = {"Float64", "Int32", "Int64", "UInt8"};
  return names[static_cast<int>(type)];
}

std::string array_text(const VtkArray& a) {
  const std::uint64_t length = a.values.size() * value_bytes(a);
  const std::string head = base64(&length, sizeof length);
  if (a.type == VtkType::real) return head + base64(a.values.data(), length);
  if (a.type == VtkType::long_integer) return head + base64_as<std::int64_t>(a.values);
  return head + (a.type == VtkType::integer ? base64_as<std::int32_t>(a.values)
                                            : base64_as<std::uint8_t>(a.values));
}

void add_array(XmlElement& element, const VtkArray& a) {
  element.add("DataArray", array_text(a))
      .set("type", type_name(a.type))
      .set("Name", a.name)
      .set("NumberOfComponents", std::to_string(a.components))
      .set("format", "binary");
}

// The <DataArray> elements of one kind.
XmlElement data_element(const char* kind, const std::vector<VtkArray>& arrays, bool on_points) {
  XmlElement element(kind);
  for (const VtkArray& a : arrays)
    if (a.on_points == on_points) add_array(element, a);
  return element;
}

XmlElement vtk_file(const char* type) {
  XmlElement root("VTKFile");
  root.set("type", type)
      .set("version", "1.0")
      .set("byte_order", "LittleEndian")
      .set("header_type", "UInt64");
  return root;
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
  XmlElement root = vtk_file("ImageData");
  XmlElement& image = root.add("ImageData");
  image.set("WholeExtent", extent)
      .set("Origin", fmt::format("{:.17g} {:.17g} {:.17g}", origin.x, origin.y, origin.z))
      .set("Spacing", fmt::format("{:.17g} {:.17g} {:.17g}", level.spacing.x, level.spacing.y,
                                  level.spacing.z));
  XmlElement& piece = image.add("Piece").set("Extent", extent);
  for (const bool on_points : {true, false})
    piece.children.push_back(data_element(on_points ? "PointData" : "CellData", arrays, on_points));
  write_text_atomically(path, to_text(root));
}

void write_vtp(const std::filesystem::path& path, const VtkArray& positions,
               const std::vector<VtkArray>& arrays) {
  const std::size_t count = positions.values.size() / 3;
  XmlElement root = vtk_file("PolyData");
  XmlElement& piece = root.add("PolyData").add("Piece");
  for (const char* cells : {"Verts", "Lines", "Strips", "Polys"})
    piece.set(std::string("NumberOf") + cells, std::to_string(cells[0] == 'V' ? count : 0));
  piece.set("NumberOfPoints", std::to_string(count));
  piece.children.push_back(data_element("PointData", arrays, true));
  add_array(piece.add("Points"), positions);
  // A vertex for each point: without cells nothing is drawn.
  VtkArray numbers{"connectivity", VtkType::long_integer, true, 1, {}}, ends = numbers;
  ends.name = "offsets";
  for (std::size_t n = 0; n < count; ++n) {
    numbers.values.push_back(static_cast<double>(n));
    ends.values.push_back(static_cast<double>(n + 1));
  }
  XmlElement& vertices = piece.add("Verts");
  add_array(vertices, numbers);
  add_array(vertices, ends);
  write_text_atomically(path, to_text(root));
}

}  // namespace sluice
