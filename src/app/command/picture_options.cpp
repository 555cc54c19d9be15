#include "app/command/picture_options.hpp"

#include <algorithm>
#include <utility>

#include "app/command/command_line.hpp"

namespace sluice {

PictureOptions::PictureOptions() {
  constexpr int plot = static_cast<int>(PictureCommand::plot);
  constexpr int movie = static_cast<int>(PictureCommand::movie);
  constexpr int both = plot + movie;
  rows_ = {
      {"--var", "--var", Kind::list, both,
       "Label, or a component of it: vel_CC.x, p.stress.xy (a stress without a component: von "
       "Mises)"},
      {"--material", "--material", Kind::value, both,
       "Name or index of a material; absent: density, speed and temperature of the whole, all "
       "particles"},
      {"--time", "--time", Kind::list, plot, "last, first, #N (N-th output) or a time; several"},
      {"--from", "--from", Kind::value, movie, "First output: first, #N or a time"},
      {"--to", "--to", Kind::value, movie, "Last output: last, #N or a time"},
      {"--every", "--every", Kind::value, movie, "Only each N-th output"},
      {"--fps", "--fps", Kind::value, movie, "Frames per second (10)"},
      {"--names", "--names", Kind::value, both, "Names of the archives in the picture: a,b,..."},
      {"--difference", "--difference", Kind::flag, both,
       "The second of two archives (or times) less the first"},
      {"--history", "--history", Kind::list, plot,
       "A .dat file by its label, a probe, line, plane, extreme or budget of DataAnalysis by its "
       "name in sluice info; levels: cells of each level over time; effects: what they cost"},
      {"--checkpoint", "--checkpoint", Kind::flag, both,
       "Draw checkpoints (the state of the run), not outputs; --time selects among them"},
      {"--slice", "--slice", Kind::value, both,
       "Plane of a 3-D run: z=0.5; absent: that with most materials, then particles"},
      {"--line", "--line", Kind::value, both, "Profile between two points, x1,y1,z1:x2,y2,z2, m"},
      {"--radius", "--radius", Kind::flag, both,
       "Every cell of a 2-D or 3-D run against its distance from the origin"},
      {"--levels",
       "--levels",
       Kind::value,
       both,
       "What to draw of finer levels: their outer edges (default), boxes, the regridder's tiles, "
       "or none",
       {"edges", "boxes", "tiles", "none"}},
      {"--exact", "--exact", Kind::value, plot,
       "auto: the solution that the deck names; none; or a CSV file x,LABEL,..."},
      {"--range", "--range", Kind::list, both,
       "Scale LOW:HIGH of all variables, or LABEL=LOW:HIGH of one"},
      {"--log", "--log", Kind::flag, both, "Logarithmic scale of values"},
      {"--cmap", "--cmap", Kind::value, both,
       "A colour map of matplotlib; schlieren: |grad rho| in greys, from the saved density"},
      {"--contours", "--contours", Kind::value, both,
       "Lines of equal value over planes: their number, or values a,b,..."},
      {"--arrows", "--arrows", Kind::value, both,
       "Arrows of the velocity over planes: their number along the longer side"},
      {"--particles", "--particles", Kind::value, both,
       "Particles over a plane, coloured by this particle label; p.x: in the colours of their "
       "materials (the default of coupled runs); none"},
      {"--outline", "--outline", Kind::flag, both, "Outlines of the bodies of each material"},
      {"--paths", "--paths", Kind::value, both,
       "Paths of this number of particles of each material, from the first output on"},
      {"--title", "--title", Kind::value, both, "Title of the picture"},
      {"--size", "--size", Kind::value, both, "Width and height in inches: 8x5"},
      {"--dpi", "--dpi", Kind::value, both, "Pixels per inch (150)"},
      {"--output", "-o,--output", Kind::value, plot, "Picture: .png, .svg or .pdf"},
      {"--output", "-o,--output", Kind::value, movie, "Movie: .gif or .mp4"},
  };
}

void PictureOptions::declare(Command& command, PictureCommand which) {
  for (Row& row : rows_) {
    if ((row.commands & static_cast<int>(which)) == 0) continue;
    if (row.kind == Kind::flag) {
      command.flag(row.names.c_str(), row.on, row.text);
      continue;
    }
    CommandOption option = command.option(row.names.c_str(), row.values, row.text);
    if (row.kind == Kind::list)
      option.quietly_repeatable();
    else
      option.once();
    if (!row.one_of.empty()) option.one_of(row.one_of);
  }
}

std::vector<std::string> PictureOptions::values(const std::string& name) const {
  for (const Row& row : rows_)
    if (row.name == name && (row.on || !row.values.empty()))
      return row.on ? std::vector<std::string>{""} : row.values;
  return {};
}

void PictureOptions::set(const std::string& name, std::vector<std::string> values) {
  const auto row = std::find_if(rows_.begin(), rows_.end(),
                                [&](const Row& candidate) { return candidate.name == name; });
  row->values = std::move(values);
}

// Values as --name=value, so that one that begins with a dash stays a value.
std::vector<std::string> PictureOptions::words(const std::vector<std::string>& without) const {
  std::vector<std::string> words;
  for (const Row& row : rows_) {
    if (std::find(without.begin(), without.end(), row.name) != without.end()) continue;
    if (row.on) words.push_back(row.name);
    for (const std::string& value : row.values) words.push_back(row.name + "=" + value);
  }
  return words;
}

}  // namespace sluice
