// sluice check DECK...: all faults of the decks in one pass; exit status 0 good, 2 bad.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "app/commands.hpp"
#include "framework/deck/deck.hpp"

namespace sluice {

void add_check_command(CLI::App& app, int& exit_status) {
  CLI::App* command = app.add_subcommand("check", "Find all faults of decks without running them");
  auto files = std::make_shared<std::vector<std::string>>();
  command->add_option("DECK", *files, "Deck files (.ups)")->required();
  command->callback([files, &exit_status] {
    for (const std::string& file : *files) {
      const Deck deck = read_deck(file);
      for (const Fault& fault : deck.faults) fmt::print("{}\n", to_string(fault));
      if (!deck.good()) exit_status = 2;
    }
  });
}

}  // namespace sluice
