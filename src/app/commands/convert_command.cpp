// sluice convert DECK.yaml: a deck of another program becomes a .ups deck that says the same.
#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <memory>

#include "app/command/command_line.hpp"
#include "framework/base/error.hpp"
#include "peridynamics/peridigm/convert.hpp"

namespace sluice {
namespace {

namespace fs = std::filesystem;

struct ConvertRequest {
  std::string deck, folder = ".";
};

void write(const fs::path& path, const std::string& text) {
  std::ofstream out(path, std::ios::binary);
  out << text;
  out.close();
  if (!out) throw SystemError("'" + path.string() + "' cannot be written");
  fmt::print("{}\n", path.string());
}

void convert(const ConvertRequest& r) {
  const fs::path deck = r.deck;
  const peridynamics::ConvertedDeck converted = peridynamics::convert_peridigm(
      peridynamics::read_parameters(r.deck), deck.stem().string(), deck.parent_path().string());
  std::string errors;
  for (const Fault& fault : converted.faults) {
    if (fault.severity == Severity::error)
      errors += (errors.empty() ? "" : "\n") + to_string(fault);
    else
      fmt::print(stderr, "{}\n", to_string(fault));
  }
  if (!converted.good()) throw InputError(errors);
  fs::create_directories(r.folder);
  write(fs::path(r.folder) / (converted.name + ".ups"), converted.ups);
  for (const auto& [name, text] : converted.files) write(fs::path(r.folder) / name, text);
  for (const std::string& rule : converted.rules) fmt::print("  rule of the deck: {}\n", rule);
}

}  // namespace

void declare_convert_command(Command& command) {
  auto r = std::make_shared<ConvertRequest>();
  command.option("DECK", r->deck, "A deck of Peridigm: .yaml or .xml").required();
  command.option("-o,--output", r->folder, "Folder to write into");
  command.action([r] {
    convert(*r);
    return 0;
  });
}

}  // namespace sluice
