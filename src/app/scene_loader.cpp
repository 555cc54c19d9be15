// Loading decks for commands that run or plan them.
#include "app/scene_loader.hpp"

#include <fmt/format.h>

#include <cstdio>

#include "app/sluice_schema.hpp"
#include "framework/base/communicator.hpp"
#include "framework/base/console.hpp"
#include "framework/deck/load_deck.hpp"
#include "ice/ice.hpp"

namespace sluice {
namespace {

void tell(const std::vector<Fault>& faults, bool quiet) {
  if (!world().is_root()) return;
  const bool colour = wants_colour(stderr);
  for (const Fault& f : faults) {
    if (f.severity == Severity::error || quiet) continue;
    fmt::print(stderr, "{}\n", styled(to_string(f), Style::yellow, colour));
  }
}

// All errors as one message; empty when there is none.
std::string errors_of(const std::vector<Fault>& faults) {
  std::string text;
  int count = 0;
  for (const Fault& f : faults)
    if (f.severity == Severity::error) {
      text += "\n" + to_string(f);
      ++count;
    }
  if (count == 0) return {};
  return fmt::format("{} fault{} in the deck:{}", count, count == 1 ? "" : "s", text);
}

}  // namespace

std::unique_ptr<LoadedScene> load_scene(const std::string& file,
                                        const std::vector<std::string>& overrides,
                                        const SceneOptions& options, bool quiet) {
  auto loaded = std::make_unique<LoadedScene>();
  loaded->deck = load_deck(file, overrides, sluice_schema());
  tell(loaded->deck.faults, quiet);
  if (!loaded->deck.good()) throw InputError(errors_of(loaded->deck.faults));
  std::vector<Fault> faults;
  loaded->scene = read_scene(loaded->deck, options, faults);
  ice::IceScene ice_scene;
  if (errors_of(faults).empty())
    ice_scene = ice::read_ice_scene(loaded->deck, loaded->scene, faults);
  tell(faults, quiet);
  if (const std::string errors = errors_of(faults); !errors.empty()) throw InputError(errors);
  loaded->component = std::make_unique<ice::Ice>(loaded->scene, std::move(ice_scene));
  return loaded;
}

}  // namespace sluice
