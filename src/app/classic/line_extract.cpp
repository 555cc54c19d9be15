// lineextract: values of a variable along a line, or over a block of cells, of one level.
#include <fmt/format.h>

#include <cmath>
#include <fstream>
#include <optional>

#include "app/classic/classic_archive.hpp"
#include "app/classic/classic_tools.hpp"
#include "app/process/text_sink.hpp"
#include "framework/archive/posix_file.hpp"

namespace sluice {
namespace {

ClassicSpec line_spec() {
  return {"lineextract",
          "[options] -uda <archive>",
          {{"-h --help", "", "this text"},
           {"-v --variable", "<name>", "the variable"},
           {"-uda", "<archive>", "the archive"},
           {"-m --material", "<int>", "material (0)"},
           {"-l --level", "<int>", "level (0)"},
           {"-timestep --timestep", "<int>", "only this output, counted from 0"},
           {"-tlow --timesteplow", "<int>", "from this output on (0)"},
           {"-thigh --timestephigh", "<int>", "up to this output (the last)"},
           {"-istart --indexs", "<i> <j> <k>", "first cell (0 0 0)"},
           {"-iend --indexe", "<i> <j> <k>", "last cell (0 0 0)"},
           {"-startPt", "<x> <y> <z>", "a point of the first cell"},
           {"-endPt", "<x> <y> <z>", "a point of the last cell"},
           {"-pr --precision", "<int>", "digits, 1 to 32 (16)"},
           {"-o --out", "<file>", "write into this file"},
           {"-cellCoords --cellCoords", "", "places in front of the values, of cell centres"},
           {"-nodeCoords --nodeCoords", "", "the same, of low corners"},
           {"-ni --noindex", "", "values only"},
           {"-pad --pad", "", "zero where the level has no value"},
           {"--cellIndexFile", "<file>", "cells from a file, [int 1, 2, 3] per line"},
           {"-q --quiet", "", "no head"},
           {"-vv --verbose", "", "list the variables as well"}}};
}

enum class Leader { index, cell, node, none };

struct LineRequest {
  std::string variable;
  int material = 0, level = 0, digits = 16;
  IntVec3 start{}, end{};
  std::vector<IntVec3> cells;  // of a file, in place of start and end
  Leader leader = Leader::index;
  bool pad = false, quiet = false;
};

// "[int 1, 2, 3]" a line.
std::vector<IntVec3> read_cells(const std::string& path) {
  std::ifstream file(path);
  if (!file) throw InputError("cannot open the file of cells " + path);
  std::vector<IntVec3> cells;
  for (std::string line; std::getline(file, line);) {
    if (line.find_first_not_of(" \t\r") == line.npos) continue;
    IntVec3 c;
    if (std::sscanf(line.c_str(), " [int %d , %d , %d ]", &c.x, &c.y, &c.z) != 3)
      throw InputError(fmt::format("{}: '{}' is not a cell [int 1, 2, 3]", path, line));
    cells.push_back(c);
  }
  return cells;
}

LineRequest request_of(const ClassicArguments& a, const Archive& archive,
                       const OutputRange& range) {
  LineRequest r;
  r.variable = a.text("-v");
  r.material = a.integer("-m", 0);
  r.level = a.integer("-l", 0);
  r.digits = digits_asked(a);
  r.start = a.integers("-istart").value_or(IntVec3{});
  r.end = a.integers("-iend").value_or(IntVec3{});
  const std::optional<Vec3> from = a.reals("-startPt"), to = a.reals("-endPt");
  if (from.has_value() != to.has_value()) throw InputError("-startPt and -endPt belong together");
  if (from) {
    const ArchiveStep step = archive.read_output(archive.outputs()[range.first]);
    const Level& level = level_asked(step, r.level);
    r.start = cell_of(level, *from);
    r.end = cell_of(level, *to);
  }
  for (int d = 0; d < 3; ++d)
    if (r.end[d] < r.start[d])
      throw InputError(fmt::format("the end {} lies before the start {}", index_text(r.end),
                                   index_text(r.start)));
  if (a.has("--cellIndexFile")) r.cells = read_cells(a.text("--cellIndexFile"));
  r.leader = a.has("-cellCoords")   ? Leader::cell
             : a.has("-nodeCoords") ? Leader::node
             : a.has("-ni")         ? Leader::none
                                    : Leader::index;
  r.pad = a.has("-pad");
  r.quiet = a.has("-q");
  return r;
}

// Means over the particles of each cell; 0 in cells without any.
DenseField particle_means(const ArchiveStep& step, const LineRequest& r, const IndexBox& cells) {
  const Level& level = step.grid().levels[r.level];
  DenseField means;
  means.cells = cells;
  means.present.assign(cells.volume(), 0);
  for (const GridBox& b : level.boxes)
    for_each_cell(intersection(b.cells, cells),
                  [&](IntVec3 c) { means.present[means.offset(c)] = 1; });
  std::vector<double> count(cells.volume(), 0);
  ParticleLists lists(step);
  for (const PatchParticles& p : particles_by_patch(step, r.material)) {
    if (p.level != r.level) continue;
    const auto& values = lists.values(r.variable, p);
    if (means.components.empty())
      means.components.assign(values.size(), std::vector<double>(cells.volume(), 0));
    for (const std::size_t n : p.places) {
      const IntVec3 c = cell_of(level, lists.position(p, n));
      if (!cells.contains(c)) continue;
      ++count[means.offset(c)];
      for (std::size_t m = 0; m < values.size(); ++m)
        means.components[m][means.offset(c)] += values[m][n];
    }
  }
  for (std::vector<double>& component : means.components)
    for (std::size_t n = 0; n < count.size(); ++n) component[n] /= std::max(count[n], 1.0);
  return means;
}

class LinePrinter {
 public:
  LinePrinter(const VariableEntry& variable, const LineRequest& request, TextSink& sink)
      : variable_(variable), request_(request), sink_(sink) {}

  void print(const ArchiveStep& step) {
    const Level& level = step.grid().levels[request_.level];
    IndexBox box{request_.start, request_.end + IntVec3{1, 1, 1}};
    for (std::size_t n = 0; n < request_.cells.size(); ++n) {
      const IntVec3 c = request_.cells[n];
      const IndexBox one{c, c + IntVec3{1, 1, 1}};
      box = n == 0 ? one : bounding(box, one);
    }
    require_patches(step, level, box);
    const DenseField field = values_in(step, box);
    if (request_.cells.empty())
      for_each_cell(box, [&](IntVec3 c) { print_value(level, field, c); });
    else
      for (const IntVec3 c : request_.cells) print_value(level, field, c);
    sink_.write("\n");
  }

 private:
  void require_patches(const ArchiveStep& step, const Level& level, const IndexBox& box) const {
    for (const PatchRecord& p : step.patches()[level.index])
      if (!intersection(p.outer, box).empty()) return;
    throw InputError(
        fmt::format("Could not find any patches on Level {} that contain cells along "
                    "line: {} and {} Double check the starting and ending indices",
                    level.index, index_text(box.lower), index_text(box.upper - IntVec3{1, 1, 1})));
  }

  DenseField values_in(const ArchiveStep& step, const IndexBox& box) const {
    if (variable_.centring == Centring::particle) return particle_means(step, request_, box);
    const FieldInfo* f = step.find(variable_.name, request_.material, request_.level);
    if (f == nullptr)
      throw InputError(fmt::format("{} is not stored for material {} on level {} at step {}",
                                   variable_.name, request_.material, request_.level,
                                   step.info().step));
    return step.read(*f, box);
  }

  void print_value(const Level& level, const DenseField& field, IntVec3 c) {
    const bool there = field.has(c);
    if (!there && !request_.pad) return;
    std::vector<double> value(component_count(variable_.type), 0.0);
    for (std::size_t m = 0; there && m < field.components.size(); ++m)
      value[m] = field.at(c, static_cast<int>(m));
    const std::string text = value_text(variable_.type, value, request_.digits);
    if (request_.leader == Leader::none) return sink_.write(text + "\n");
    if (request_.leader == Leader::index)
      return sink_.write(fmt::format("{} {} {} {}\n", c.x, c.y, c.z, text));
    const double half = request_.leader == Leader::cell ? 0.5 : 0.0;
    const int face = face_direction(variable_.centring);
    std::string place;
    for (int d = 0; d < 3; ++d) {
      const double shift = half - (there && d == face ? 0.5 : 0.0);
      place +=
          number_text(level.anchor[d] + (c[d] + shift) * level.spacing[d], request_.digits) + ' ';
    }
    sink_.write(place + text + "\n");
  }

  const VariableEntry& variable_;
  const LineRequest& request_;
  TextSink& sink_;
};

void warn_of_size(const LineRequest& r) {
  int wide = 0;
  for (int d = 0; d < 3; ++d) wide += r.end[d] > r.start[d];
  if (wide == 3) fmt::print(stderr, "PERFORMANCE WARNING: Outputting over 3 dimensions!\n");
  if (wide == 2) fmt::print(stderr, "PERFORMANCE WARNING: Outputting over 2 dimensions\n");
}

}  // namespace

int run_line_extract(const ClassicCall& call) {
  const ClassicArguments arguments(line_spec(), call.words);
  if (arguments.has("-h")) {
    fmt::print(stderr, "{}", usage_of(line_spec()));
    return 1;
  }
  const Archive archive = archive_asked(arguments);
  const VariableEntry& variable = need_variable(archive, arguments.text("-v"));
  const OutputRange range = outputs_asked(arguments, archive, {"-timestep", "-tlow", "-thigh", ""});
  const LineRequest request = request_of(arguments, archive, range);
  if (arguments.has("-vv"))
    for (const VariableEntry& v : archive.index().variables)
      fmt::print("{} - {}\n", v.name, v.type_name);
  if (!request.quiet)
    fmt::print(
        "{}: {} being extracted for material {}, Level: {}, at index {} to {}\nThere are {} "
        "timesteps\n",
        variable.name, variable.type_name, request.material, request.level,
        index_text(request.start), index_text(request.end), archive.outputs().size());
  std::fflush(stdout);
  warn_of_size(request);
  TextSink sink(arguments.text("-o", "-"));
  LinePrinter printer(variable, request, sink);
  for (std::size_t t = range.first; t <= range.last; ++t) {
    const StepEntry& entry = archive.outputs()[t];
    fmt::print(stderr, "%outputting for times[{}] = {:g}\n", t, entry.time);
    const ArchiveStep step = archive.read_output(entry);
    const std::size_t levels = step.grid().levels.size();
    if (request.level < 0 || static_cast<std::size_t>(request.level) >= levels)
      fmt::print(stderr, " Level {} does not exist at this timestep {}\n", request.level, t);
    else
      printer.print(step);
  }
  sink.close();
  return 0;
}

}  // namespace sluice
