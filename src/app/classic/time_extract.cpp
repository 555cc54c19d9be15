// timeextract: the value of one cell over the outputs.
#include <fmt/format.h>

#include "app/classic/classic_archive.hpp"
#include "app/classic/classic_tools.hpp"
#include "app/process/text_sink.hpp"

namespace sluice {
namespace {

ClassicSpec time_spec() {
  return {"timeextract",
          "[options] -uda <archive>",
          {{"-h --help", "", "this text"},
           {"-v --variable", "<name>", "the variable"},
           {"-uda", "<archive>", "the archive"},
           {"-m --material", "<int>", "material (0)"},
           {"-l --level", "<int>", "level (0)"},
           {"-tlow --timesteplow", "<int>", "from this output on, counted from 0"},
           {"-thigh --timestephigh", "<int>", "up to this output (the last)"},
           {"-i --index", "<i> <j> <k>", "cell (0 0 0)"},
           {"-p --point", "<x> <y> <z>", "a point of the cell"},
           {"-pr --precision", "<int>", "digits, 1 to 32 (16)"},
           {"-o --out", "<file>", "write into this file"},
           {"-q --quiet", "", "no head"},
           {"-vv --verbose", "", "accepted, without effect"},
           {"-noxml --xml-cache-off", "", "accepted, without effect"}}};
}

IntVec3 cell_asked(const ClassicArguments& arguments, const Archive& archive,
                   const OutputRange& range, int level) {
  const std::optional<Vec3> point = arguments.reals("-p");
  if (!point) return arguments.integers("-i").value_or(IntVec3{});
  const ArchiveStep step = archive.read_output(archive.outputs()[range.first]);
  return cell_of(level_asked(step, level), *point);
}

}  // namespace

int run_time_extract(const ClassicCall& call) {
  const ClassicArguments arguments(time_spec(), call.words);
  if (arguments.has("-h")) {
    fmt::print(stderr, "{}", usage_of(time_spec()));
    return 1;
  }
  const Archive archive = archive_asked(arguments);
  const VariableEntry& variable = need_variable(archive, arguments.text("-v"));
  if (variable.centring == Centring::particle)
    throw InputError(variable.name + " is a variable of particles; partextract prints those");
  const OutputRange range = outputs_asked(arguments, archive, {"", "-tlow", "-thigh", ""});
  const int level = arguments.integer("-l", 0), material = arguments.integer("-m", 0);
  const int digits = digits_asked(arguments);
  const IntVec3 cell = cell_asked(arguments, archive, range, level);
  if (!arguments.has("-q"))
    fmt::print(
        "{}: {} being extracted for material {} at index {}\nThere are {} timesteps:\noutputting "
        "for times[{}] = {:g} to times[{}] = {:g}\n",
        variable.name, variable.type_name, material, index_text(cell), archive.outputs().size(),
        range.first, archive.outputs()[range.first].time, range.last,
        archive.outputs()[range.last].time);
  std::fflush(stdout);
  TextSink sink(arguments.text("-o", "-"));
  for (std::size_t t = range.first; t <= range.last; ++t) {
    const StepEntry& entry = archive.outputs()[t];
    const ArchiveStep step = archive.read_output(entry);
    const FieldInfo* f = step.find(variable.name, material, level);
    const IndexBox one{cell, cell + IntVec3{1, 1, 1}};
    const DenseField value = f == nullptr ? DenseField{} : step.read(*f, one, Layers::extra);
    if (f == nullptr || !value.has(cell))
      throw InputError(fmt::format("{} of material {} on level {} has no value at {} at step {}",
                                   variable.name, material, level, index_text(cell), entry.step));
    std::vector<double> components;
    for (int m = 0; m < f->components(); ++m) components.push_back(value.at(cell, m));
    sink.write(fmt::format("{}  {}\n", number_text(entry.time, digits),
                           value_text(f->type, components, digits)));
  }
  sink.close();
  return 0;
}

}  // namespace sluice
