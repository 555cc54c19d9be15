// Fields and folders for the tests of this room. Numbers have no unit.
#pragma once
#include <cmath>
#include <deque>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>
#include <vector>

#include "framework/archive/archive.hpp"
#include "framework/archive/archive_writer.hpp"
#include "framework/base/temporary_folder.hpp"

namespace sluice::archive_test {

namespace fs = std::filesystem;

inline Grid make_grid(IntVec3 cells, IntVec3 pieces) {
  Level level;
  level.anchor = {-1.0, 0.25, 3.0};
  level.spacing = {0.1, 0.25, 0.5};
  level.domain = {{0, 0, 0}, cells};
  for (int d = 0; d < 3; ++d) level.active[d] = cells[d] > 1;
  int id = 0;
  for (const IndexBox& b : split(level.domain, pieces)) level.boxes.push_back({b, 0, id++});
  return {{level}};
}

// A coarse level of 8 x 6 x nz cells and two fine boxes (ratio 2) over a part of it.
inline Grid make_two_levels(int nz, int ny = 6) {
  Grid grid = make_grid({8, ny, nz}, {2, 1, 1});
  Level fine = grid.levels[0];
  const int ry = ny > 1 ? 2 : 1, rz = nz > 1 ? 2 : 1;
  fine.index = 1;
  fine.ratio = {2, ry, rz};
  fine.spacing = {0.05, 0.25 / ry, 0.5 / rz};
  fine.domain = {{0, 0, 0}, {16, ry * ny, rz * nz}};
  const int low = ny > 1 ? 4 : 0;
  fine.boxes = {{{{4, low, 0}, {8, ny > 1 ? 8 : 1, rz}}, 0, 0},
                {{{8, low, 0}, {12, ny > 1 ? 10 : 1, rz}}, 0, 1}};
  grid.levels.push_back(fine);
  return grid;
}

// Memory for pieces, with two ghost layers that hold NaN.
class Fields {
 public:
  using Function = std::function<double(IntVec3, int)>;

  void add(const Level& level, Label label, int material, const Function& f) {
    const int face = face_direction(label.info().centring);
    for (const GridBox& b : level.boxes) {
      IndexBox cells = b.cells;
      if (face >= 0 && cells.upper[face] == level.domain.upper[face]) ++cells.upper[face];
      if (label.info().centring == Centring::node)
        for (int d = 0; d < 3; ++d) cells.upper[d] += cells.upper[d] == level.domain.upper[d];
      for (int c = 0; c < component_count(label.info().type); ++c)
        pieces_.push_back(piece(cells, label, material, level.index, b.id, c, f));
    }
  }
  std::vector<FieldPiece>& pieces() { return pieces_; }

  // Particles of one box: numbers, positions x = f(id, component), and a value f(id, 3).
  void add_particles(int level, int box, const std::vector<double>& ids,
                     const std::function<double(double, int)>& f, int material = 0) {
    const auto list = [&](Label label, int component, const std::function<double(double)>& value) {
      auto& values = memory_.emplace_back();
      for (const double id : ids) values.push_back(value(id));
      FieldPiece p;
      p.label = label;
      p.material = material;
      p.level = level;
      p.box_id = box;
      p.component = component;
      p.view.data = values.data();
      p.view.box = {{0, 0, 0}, {static_cast<int>(ids.size()), 1, 1}};
      p.cells = p.view.box;
      pieces_.push_back(p);
    };
    const auto label = [](const char* name, ValueType type) {
      return declare_label({name, type, Centring::particle, "1", "a test"});
    };
    for (int d = 0; d < 3; ++d)
      list(label("p.x", ValueType::vector), d, [&](double id) { return f(id, d); });
    list(label("p.particleID", ValueType::long_integer), 0, [](double id) { return id; });
    list(label("p.heat", ValueType::real), 0, [&](double id) { return f(id, 3); });
  }

 private:
  FieldPiece piece(const IndexBox& cells, Label label, int material, int level, int box, int c,
                   const Function& f) {
    const IndexBox with_ghosts = cells.grown({2, 2, 2});
    const IntVec3 n = with_ghosts.size();
    auto& memory = memory_.emplace_back(with_ghosts.volume(), std::nan(""));
    RealView view;
    view.data = memory.data();
    view.box = with_ghosts;
    view.stride[1] = n.x;
    view.stride[2] = static_cast<std::ptrdiff_t>(n.x) * n.y;
    for_each_cell(cells, [&](IntVec3 i) { view(i) = f(i, c); });
    FieldPiece p;
    p.label = label;
    p.material = material;
    p.level = level;
    p.box_id = box;
    p.component = c;
    p.cells = cells;
    p.view = view;
    return p;
  }

  std::deque<std::vector<double>> memory_;
  std::vector<FieldPiece> pieces_;
};

inline double wavy(IntVec3 c, int component) {
  return std::sin(1.0 + c.x + 10.0 * c.y + 100.0 * c.z + 1000.0 * component) / 3;
}

inline ArchiveSetup setup_in(const fs::path& folder) {
  ArchiveSetup setup;
  setup.parent = folder;
  setup.filebase = "box.uda";
  setup.deck_xml = "<Uintah_specification/>\n";
  setup.program = "sluice test";
  return setup;
}

inline Label real_label(const std::string& name, Centring centring = Centring::cell) {
  return declare_label({name, ValueType::real, centring, "Pa", "a test"});
}
inline Label vector_label(const std::string& name) {
  return declare_label({name, ValueType::vector, Centring::cell, "m/s", "a test"});
}

// Turns one bit of a file over.
inline void flip_bit(const fs::path& path, std::int64_t byte, int bit = 3) {
  std::fstream file(path, std::ios::in | std::ios::out | std::ios::binary);
  file.seekg(byte);
  const char c = static_cast<char>(file.get() ^ (1 << bit));
  file.seekp(byte);
  file.put(c);
}

}  // namespace sluice::archive_test
