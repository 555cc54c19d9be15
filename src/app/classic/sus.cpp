// sus: its options as those of `sluice run` and `sluice check`.
#include <fmt/format.h>

#include "app/classic/classic_arguments.hpp"
#include "app/classic/classic_tools.hpp"
#include "framework/archive/archive.hpp"
#include "framework/base/communicator.hpp"

namespace sluice {
namespace {

ClassicSpec sus_spec() {
  return {"sus",
          "[options] <deck.ups> | -restart [options] <archive>",
          {{"-h -help", "", "this text"},
           {"-nthreads", "<int>", "threads of each rank"},
           {"-validate", "", "check the deck, run nothing"},
           {"-restart", "", "go on with the run of an archive, from its last checkpoint"},
           {"-t", "<int>", "with -restart: from this checkpoint, counted from 0"},
           {"-nocopy", "", "with -restart: leave earlier outputs where they are"},
           {"-copy", "", "with -restart: copy earlier outputs"},
           {"-solver", "<name>", "linear solver, in place of the deck's"},
           {"-V -version -configCmd -gitStatus -gitDiff", "", "print the version"},
           {"-do_not_validate", "", "accepted: decks are always checked"},
           {"-mpi", "", "accepted, without effect"},
           {"-cpu", "", "accepted, without effect"},
           {"-local_filesystem", "", "accepted, without effect"},
           {"-layout", "<IxJxK>", "accepted, without effect"},
           {"-d -debug", "", "not supported: there are no debug streams"},
           {"-move", "", "not supported: -copy, then remove the earlier archive"},
           {"-uda_suffix", "<int>", "not supported: the smallest free number is taken"},
           {"-emit_taskgraphs", "", "not supported: sluice plan --graph writes them"},
           {"-postProcessUda", "", "not supported"},
           {"-visit", "<file>", "not supported"},
           {"-gpu", "", "not supported"},
           {"-gpucheck", "", "not supported"},
           {"-npartitions", "<int>", "not supported: -nthreads"},
           {"-nthreadsperpartition", "<int>", "not supported: -nthreads"}}};
}

constexpr const char* refused[] = {
    "-d",     "-move", "-uda_suffix", "-emit_taskgraphs", "-postProcessUda",
    "-visit", "-gpu",  "-gpucheck",   "-npartitions",     "-nthreadsperpartition"};

void refuse_unsupported(const ClassicArguments& arguments) {
  for (const char* option : refused) {
    if (!arguments.has(option)) continue;
    for (const ClassicOption& o : sus_spec().options)
      if (o.names.substr(0, o.names.find(' ')) == option)
        throw InputError(fmt::format("{}: {}", option, o.text));
  }
}

// The step of a checkpoint that is counted from 0.
int checkpoint_step(const Archive& archive, int number) {
  const auto& checkpoints = archive.checkpoints();
  if (number >= 0 && static_cast<std::size_t>(number) < checkpoints.size())
    return checkpoints[number].step;
  std::string there;
  for (std::size_t n = 0; n < checkpoints.size(); ++n)
    there +=
        fmt::format("\n  {}: step {} at time {:g}", n, checkpoints[n].step, checkpoints[n].time);
  throw InputError(fmt::format("-t {}: checkpoints are counted from 0; {} has{}", number,
                               archive.folder().string(),
                               there.empty() ? " none" : " these:" + there));
}

std::vector<std::string> run_words(const ClassicArguments& arguments, const std::string& target) {
  std::vector<std::string> words = {"run"};
  if (arguments.has("-restart")) {
    words.insert(words.end(), {"--restart", target, "-o", "."});
    if (arguments.has("-t"))
      words.insert(words.end(),
                   {"--step", std::to_string(checkpoint_step(Archive::open(target),
                                                             arguments.integer("-t", 0)))});
    if (arguments.has("-copy")) words.emplace_back("--copy");
  } else {
    if (arguments.has("-t") || arguments.has("-copy"))
      arguments.refuse("-t and -copy belong to -restart");
    words.push_back(target);
  }
  if (arguments.has("-nthreads"))
    words.insert(words.end(), {"--threads", std::to_string(arguments.integer("-nthreads", 1))});
  if (arguments.has("-solver"))
    words.insert(words.end(), {"--set", "Solver/@type=" + arguments.text("-solver")});
  words.insert(words.end(), {"--last-line", "Sus: going down successfully"});
  return words;
}

}  // namespace

int run_sus(const ClassicCall& call) {
  const ClassicArguments arguments(sus_spec(), call.words);
  if (call.words.empty() || arguments.has("-h")) {
    fmt::print(stderr, "{}", usage_of(sus_spec()));
    return 2;
  }
  if (arguments.has("-V")) return call.sluice({"--version"});
  refuse_unsupported(arguments);
  const bool restart = arguments.has("-restart");
  const std::string& target = arguments.only_positional(restart ? "archive" : "deck");
  if (!arguments.has("-validate")) return call.sluice(run_words(arguments, target));
  if (restart) arguments.refuse("-validate checks a deck, not an archive");
  const int status = call.sluice({"check", target});
  if (status == 0 && world().is_root())
    fmt::print("Validation of .ups File finished... good bye.\n");
  return status;
}

}  // namespace sluice
