// Header in XML, then the arrays as raw bytes, each behind its length.
#include "framework/archive/vtk_image.hpp"

#include <fmt/format.h>

#include <cstring>

#include "framework/archive/posix_file.hpp"
#include "framework/archive/xml_text.hpp"

namespace sluice {
namespace {

std::size_t value_bytes(const VtkArray& a) {
  return a.type == VtkType::real ? 8 : 4;
}

// The <DataArray> elements of one kind; `offset` runs on through the appended data.
XmlElement data_element(const char* kind, const std::vector<VtkArray>& arrays, bool on_points,
                        std::uint64_t& offset) {
  XmlElement element(kind);
  for (const VtkArray& a : arrays) {
    if (a.on_points != on_points) continue;
    element.add("DataArray")
        .set("type", a.type == VtkType::real ? "Float64" : "Int32")
        .set("Name", a.name)
        .set("NumberOfComponents", std::to_string(a.components))
        .set("format", "appended")
        .set("offset", std::to_string(offset));
    offset += sizeof(std::uint64_t) + a.values.size() * value_bytes(a);
  }
  return element;
}

void append(std::string& bytes, const void* data, std::size_t size) {
  bytes.append(static_cast<const char*>(data), size);
}

void append_array(std::string& bytes, const VtkArray& a) {
  const std::uint64_t length = a.values.size() * value_bytes(a);
  append(bytes, &length, sizeof length);
  if (a.type == VtkType::real) return append(bytes, a.values.data(), length);
  for (const double v : a.values) {
    const auto n = static_cast<std::int32_t>(v);
    append(bytes, &n, sizeof n);
  }
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
  XmlElement root("VTKFile");
  root.set("type", "ImageData")
      .set("version", "1.0")
      .set("byte_order", "LittleEndian")
      .set("header_type", "UInt64");
  XmlElement& image = root.add("ImageData");
  image.set("WholeExtent", extent)
      .set("Origin", fmt::format("{:.17g} {:.17g} {:.17g}", origin.x, origin.y, origin.z))
      .set("Spacing", fmt::format("{:.17g} {:.17g} {:.17g}", level.spacing.x, level.spacing.y,
                                  level.spacing.z));
  XmlElement& piece = image.add("Piece").set("Extent", extent);
  std::uint64_t offset = 0;
  std::string data = "_";
  for (const bool on_points : {true, false}) {
    piece.children.push_back(
        data_element(on_points ? "PointData" : "CellData", arrays, on_points, offset));
    for (const VtkArray& a : arrays)
      if (a.on_points == on_points) append_array(data, a);
  }
  root.add("AppendedData", "@").set("encoding", "raw");
  // The data are bytes, not characters: they go in where the XML text holds the mark.
  std::string text = to_text(root);
  text.replace(text.rfind('@'), 1, data);
  write_text_atomically(path, text);
}

}  // namespace sluice
