#include "peridynamics/peridigm/mesh.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

namespace sluice::peridynamics {
namespace {

namespace fs = std::filesystem;

std::string path_in(const std::string& folder, const std::string& name) {
  return fs::path(name).is_absolute() ? name : (fs::path(folder) / name).string();
}

const Parameter* need(const Parameter& list, const char* name, std::vector<Fault>& faults) {
  const Parameter* p = list.find(name);
  if (p == nullptr) add_error(faults, list.where, fmt::format("'{}' needs '{}'", list.name, name));
  return p;
}

Mesh quick_grid(const Parameter& discretization, std::vector<Fault>& faults) {
  Mesh mesh;
  const Parameter* list = need(discretization, "TensorProduct3DMeshGenerator", faults);
  if (list == nullptr) return mesh;
  list->find("Type");
  Vec3 origin{};
  IntVec3 count{1, 1, 1};
  for (int d = 0; d < 3; ++d) {
    const std::string axis(1, "XYZ"[d]);
    const Parameter* o = need(*list, (axis + " Origin").c_str(), faults);
    const Parameter* l = need(*list, (axis + " Length").c_str(), faults);
    const Parameter* n = need(*list, ("Number Points " + axis).c_str(), faults);
    if (o == nullptr || l == nullptr || n == nullptr) return mesh;
    origin[d] = number_of(*o, faults);
    const double points = number_of(*n, faults), length = number_of(*l, faults);
    if (!(points >= 1 && points <= 1e6) || points != std::floor(points) || !(length > 0)) {
      add_error(faults, n->where,
                fmt::format("PdQuickGrid: {:g} points on {:g} along {} are no grid", points, length,
                            axis));
      return mesh;
    }
    count[d] = static_cast<int>(points);
    mesh.cell[d] = length / points;
  }
  if (static_cast<double>(count.x) * count.y * count.z > 1e8) {
    add_error(faults, list->where, "PdQuickGrid: more than 1e8 points");
    return mesh;
  }
  for (int k = 0; k < count.z; ++k)
    for (int j = 0; j < count.y; ++j)
      for (int i = 0; i < count.x; ++i)
        mesh.points.push_back({origin + Vec3{i + 0.5, j + 0.5, k + 0.5} * mesh.cell, 1,
                               mesh.cell.x * mesh.cell.y * mesh.cell.z});
  return mesh;
}

// x y z block volume in each row; # begins a comment.
Mesh text_mesh(const Parameter& name, const std::string& folder, std::vector<Fault>& faults) {
  Mesh mesh;
  const std::string file = path_in(folder, name.text);
  std::ifstream in(file);
  if (!in) {
    add_error(faults, name.where, fmt::format("the mesh '{}' cannot be opened", file));
    return mesh;
  }
  int row = 0;
  for (std::string line; std::getline(in, line);) {
    ++row;
    if (const auto comment = line.find('#'); comment != std::string::npos) line.resize(comment);
    std::istringstream text(line);
    MeshPoint p;
    if (!(text >> p.place.x)) continue;
    std::string more;
    if (!(text >> p.place.y >> p.place.z >> p.block >> p.volume) || (text >> more)) {
      add_error(faults, {file, row, 1}, "a row of a text mesh has x y z block volume");
      return mesh;
    }
    if (!(p.volume > 0)) {
      add_error(faults, {file, row, 1},
                fmt::format("point {} has the volume {:g}; it must be above 0",
                            mesh.points.size() + 1, p.volume));
      return mesh;
    }
    mesh.points.push_back(p);
  }
  if (mesh.points.empty()) add_error(faults, {file, 1, 1}, "this mesh has no point");
  return mesh;
}

}  // namespace

double number_of(const Parameter& p, std::vector<Fault>& faults) {
  double value = 0;
  const char* end = p.text.data() + p.text.size();
  const auto [stop, error] = std::from_chars(p.text.data(), end, value);
  if (error != std::errc() || stop != end || !std::isfinite(value))
    add_error(faults, p.where, fmt::format("'{}': '{}' is not a number", p.name, p.text));
  return value;
}

Mesh read_mesh(const Parameter& discretization, const std::string& folder,
               std::vector<Fault>& faults) {
  const Parameter* type = need(discretization, "Type", faults);
  if (type == nullptr) return {};
  if (type->text == "PdQuickGrid") return quick_grid(discretization, faults);
  if (type->text == "Text File") {
    const Parameter* name = need(discretization, "Input Mesh File", faults);
    return name == nullptr ? Mesh{} : text_mesh(*name, folder, faults);
  }
  discretization.find("Input Mesh File");
  add_not_built(faults, type->where, fmt::format("discretization '{}'", type->text),
                "Text File and PdQuickGrid are read");
  return {};
}

std::vector<int> read_node_set(const Parameter& set, const std::string& folder, int points,
                               std::vector<Fault>& faults) {
  std::vector<int> numbers;
  Location where = set.where;
  std::string text = set.text;
  if (text.find_first_not_of("0123456789 \t\n") != std::string::npos) {
    const std::string file = path_in(folder, text);
    std::ifstream in(file);
    if (!in) {
      add_error(faults, set.where, fmt::format("the node set '{}' cannot be opened", file));
      return numbers;
    }
    std::ostringstream all;
    all << in.rdbuf();
    text = all.str();
    where = {file, 1, 1};
  }
  std::istringstream in(text);
  for (int n = 0; in >> n;) {
    if (n < 1 || n > points) {
      add_error(faults, where,
                fmt::format("node set '{}' names point {}; there are {}", set.name, n, points));
      return numbers;
    }
    numbers.push_back(n);
  }
  if (!in.eof()) add_error(faults, where, "a node set holds numbers of points alone");
  return numbers;
}

bool cells_reach_farther(const Mesh& mesh, double horizon) {
  if (!(mesh.cell.x > 0)) return false;
  IntVec3 most{};
  for (int d = 0; d < 3; ++d)
    most[d] = static_cast<int>(std::min(1e3, horizon / mesh.cell[d] + 1.5));
  const Vec3 first = mesh.points.front().place, last = mesh.points.back().place;
  for (int d = 0; d < 3; ++d)
    most[d] = std::min(most[d], static_cast<int>(std::lround((last[d] - first[d]) / mesh.cell[d])));
  for (int k = 0; k <= most.z; ++k)
    for (int j = 0; j <= most.y; ++j)
      for (int i = 0; i <= most.x; ++i) {
        const Vec3 xi = to_real({i, j, k}) * mesh.cell;
        Vec3 near{};
        for (int d = 0; d < 3; ++d) near[d] = std::max(0.0, xi[d] - 0.5 * mesh.cell[d]);
        if (dot(near, near) <= horizon * horizon && dot(xi, xi) > horizon * horizon * (1 + 1e-10))
          return true;
      }
  return false;
}

}  // namespace sluice::peridynamics
