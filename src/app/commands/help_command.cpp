// sluice help [TAG]: what a tag of the deck means; --markdown writes the whole reference,
// --labels the page of labels.
#include <fmt/format.h>

#include <memory>

#include "app/command/command_line.hpp"
#include "app/loading/label_reference.hpp"
#include "app/loading/sluice_schema.hpp"
#include "framework/deck/deck_help.hpp"

namespace sluice {

void declare_help_command(Command& command) {
  auto tags = std::make_shared<std::vector<std::string>>();
  auto markdown = std::make_shared<bool>(false);
  command.option("TAG", *tags, "Names or paths, as cfl or CFD/ICE/advection");
  auto of_labels = std::make_shared<bool>(false);
  command.flag("--markdown", *markdown, "Write the reference of all tags");
  command.flag("--labels", *of_labels, "Write the page of all labels that decks may save");
  command.action([tags, markdown, of_labels] {
    const Schema schema = sluice_schema();
    if (*markdown) {
      fmt::print("{}", markdown_reference(schema));
    } else if (*of_labels) {
      fmt::print("{}", label_reference());
    } else if (tags->empty()) {
      fmt::print("{}\n{}\n", help_overview(schema), exit_statuses);
    }
    for (const std::string& tag : *tags) fmt::print("{}", help_on(schema, tag));
    return 0;
  });
}

}  // namespace sluice
