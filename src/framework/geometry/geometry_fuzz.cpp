// libFuzzer: no bytes in the files that geometry is read from may crash its readers, or give a
// piece that cannot be asked; only Error may come out.
//
// The first byte chooses the kind of file: points with values (text, binary), points and triangles
// of a surface (parted by a zero byte), an image, or a table of corners.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <fstream>

#include "framework/base/error.hpp"
#include "framework/base/temporary_folder.hpp"
#include "framework/geometry/image.hpp"
#include "framework/geometry/point_file.hpp"
#include "framework/geometry/polygon.hpp"
#include "framework/geometry/triangulation.hpp"

namespace {

using namespace sluice;

void write(const std::string& file, std::string_view bytes) {
  std::ofstream(file, std::ios::binary | std::ios::trunc) << bytes;
}

// A piece must answer for its own corners, its middle and a point outside.
void ask(const GeometryPiece& piece) {
  const Bounds b = piece.bounds();
  const Vec3 middle{(b.lower.x + b.upper.x) / 2, (b.lower.y + b.upper.y) / 2,
                    (b.lower.z + b.upper.z) / 2};
  int found = 0;
  for (const Vec3 p : {b.lower, b.upper, middle, Vec3{1e30, -1e30, 0}}) found += piece.inside(p);
  found += static_cast<int>(piece.cover(b));
  if (found < 0) std::abort();
}

void read(int kind, const std::string& stem, std::string_view bytes) {
  const std::string file = stem + ".pts";
  switch (kind) {
    case 0:
      write(file, bytes);
      return ask(PointFilePiece(read_point_file(file, PointFormat::text, {})));
    case 1:
      write(file, bytes);
      return ask(PointFilePiece(
          read_point_file(file, PointFormat::text, {"p.volume", "p.velocity", "p.loadCurveID"})));
    case 2:
      write(file, bytes);
      return ask(
          PointFilePiece(read_point_file(file, PointFormat::binary_big_endian, {"p.temperature"})));
    case 3: {
      const std::size_t end = std::min(bytes.find('\0'), bytes.size());
      write(file, bytes.substr(0, end));
      write(stem + ".tri", bytes.substr(std::min(end + 1, bytes.size())));
      return ask(TriangulationPiece(read_triangulation(stem)));
    }
    case 4: {
      write(file, bytes);
      const IntVec3 res{4, 4, 1};
      return ask(*read_image(file, res, 1, 200, {{0, 0, 0}, {1, 1, 1}}));
    }
    default:
      write(file, bytes);
      return ask(PolygonPiece(read_polygon(file)));
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const TemporaryFolder folder;
  if (size < 1) return 0;
  try {
    read(data[0] % 6, folder / "piece", {reinterpret_cast<const char*>(data + 1), size - 1});
  } catch (const Error&) {
    // A message to the user: what must come of bad bytes.
  }
  return 0;
}
