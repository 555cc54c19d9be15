// puda: outputs, variables, grids, ranges and particles of an archive.
#include "app/classic/puda.hpp"

#include <fmt/format.h>

#include "app/classic/classic_tools.hpp"

namespace sluice {
namespace {

ClassicSpec puda_spec() {
  ClassicSpec spec{
      "puda",
      "[options] <archive>",
      {{"-h -help", "", "this text"},
       {"-timesteps", "", "list the outputs and their times"},
       {"-listvariables", "", "list the variables and their types"},
       {"-gridstats", "", "print levels and patches of each output"},
       {"-varsummary", "", "print least and largest values, by patch"},
       {"-brief", "", "with -varsummary: by level only"},
       {"-partvar", "<variable>", "print a variable of all particles"},
       {"-mat -matl -material", "<int>", "only this material"},
       {"-timesteplow", "<int>", "from this output on, counted from 0"},
       {"-timestephigh", "<int>", "up to this output"},
       {"-timestepinc", "<int>", "every n-th output, for -gridstats"},
       {"-no_extra_cells", "", "with -varsummary: without the cells around the domain"},
       {"-pic", "<i> <j> <k>", "write the numbers of the particles in a cell to files"},
       {"-pol", "<axis> <int> <int>",
        "with -partvar: write means over the cells of a line to files; true or false behind it: "
        "means or first particles, stresses as pressure and equivalent stress"},
       {"-verbose", "", "accepted, without effect"}}};
  for (ClassicOption& option : puda_motion_options()) spec.options.push_back(std::move(option));
  return spec;
}

// The words true and false behind -pol, which belong to no option.
std::vector<std::string> without_flags(const std::vector<std::string>& words,
                                       std::vector<bool>& flags) {
  std::vector<std::string> rest;
  for (std::size_t n = 0; n < words.size(); ++n) {
    const bool behind = n >= 4 && (words[n - 4] == "-pol" || (n >= 5 && words[n - 5] == "-pol"));
    if (behind && (words[n] == "true" || words[n] == "false"))
      flags.push_back(words[n] == "true");
    else
      rest.push_back(words[n]);
  }
  return rest;
}

ParticleLine line_of(const ClassicArguments& arguments, const std::vector<bool>& flags) {
  const std::vector<std::string> words = arguments.values("-pol");
  ParticleLine line;
  const std::string axes = "xyz";
  if (words[0].size() != 1 || axes.find(words[0]) == axes.npos)
    throw InputError(fmt::format("-pol {}: the axis is x, y or z", words[0]));
  line.axis = static_cast<int>(axes.find(words[0]));
  line.first = parse_int(words[1], "-pol");
  line.second = parse_int(words[2], "-pol");
  if (!flags.empty()) line.average = flags[0];
  if (flags.size() > 1) line.split_stress = flags[1];
  return line;
}

void print_timesteps(const Archive& archive) {
  fmt::print("There are {} timesteps:\n", archive.outputs().size());
  for (const StepEntry& s : archive.outputs())
    fmt::print("{}: {}\n", s.step, number_text(s.time, 16));
}

void print_variables(const Archive& archive) {
  fmt::print("There are {} variables:\n", archive.index().variables.size());
  for (const VariableEntry& v : archive.index().variables)
    fmt::print("{}: {}\n", v.name, v.type_name);
}

}  // namespace

int run_puda(const ClassicCall& call) {
  std::vector<bool> flags;
  const ClassicArguments arguments(puda_spec(), without_flags(call.words, flags));
  if (call.words.empty() || arguments.has("-h")) {
    fmt::print(stderr, "{}", usage_of(puda_spec()));
    return 1;
  }
  const Archive archive = Archive::open(arguments.only_positional("archive"));
  if (arguments.has("-timesteps")) print_timesteps(archive);
  if (arguments.has("-listvariables")) print_variables(archive);
  if (archive.outputs().empty()) return 0;
  PudaRequest request;
  request.outputs =
      outputs_asked(arguments, archive, {"", "-timesteplow", "-timestephigh", "-timestepinc"});
  request.material = arguments.integer("-mat", -1);
  request.brief = arguments.has("-brief");
  request.extra_cells = !arguments.has("-no_extra_cells");
  request.particle_variable = arguments.text("-partvar");
  if (arguments.has("-gridstats")) puda_grid_stats(archive, request);
  if (arguments.has("-pol"))
    puda_particles_on_line(archive, request, line_of(arguments, flags));
  else if (arguments.has("-partvar"))
    puda_particle_variable(archive, request);
  if (arguments.has("-varsummary")) puda_summary(archive, request);
  if (const auto cell = arguments.integers("-pic")) puda_particles_in_cell(archive, request, *cell);
  puda_motions(archive, arguments, request);
  return 0;
}

}  // namespace sluice
