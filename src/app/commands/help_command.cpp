// sluice help [NAME]: a command, a tag, a law, a label or a message; and the pages that are written
// from the same tables.
#include <fmt/format.h>

#include <filesystem>
#include <memory>

#include "app/command/command_line.hpp"
#include "app/commands/commands.hpp"
#include "app/help/ending_messages.hpp"
#include "app/help/topics.hpp"
#include "app/loading/label_reference.hpp"
#include "app/loading/sluice_schema.hpp"
#include "app/process/text_sink.hpp"
#include "framework/base/error.hpp"
#include "framework/deck/help/deck_help.hpp"
#include "framework/deck/help/deck_pages.hpp"
#include "sluice_version.hpp"

namespace sluice {
namespace {

namespace fs = std::filesystem;

struct HelpRequest {
  std::vector<std::string> names;
  std::string pages, shell;
  bool labels = false, messages = false, man = false;
};

void write_pages(const fs::path& folder) {
  for (const ReferencePage& page : reference_pages(sluice_schema())) {
    const fs::path file = folder / page.file;
    std::error_code error;
    fs::create_directories(file.parent_path(), error);
    if (error)
      throw SystemError(fmt::format("cannot make the folder {}: {}", file.parent_path().string(),
                                    error.message()));
    write_text(file.string(), page.text);
  }
}

std::string completion_for(const std::string& shell) {
  const std::vector<CommandText> commands = command_texts();
  if (shell == "bash") return bash_completion(commands);
  return shell == "zsh" ? zsh_completion(commands) : fish_completion(commands);
}

std::string overview() {
  std::string text =
      help_overview(sluice_schema()) + "\nCommands (sluice COMMAND --help for more):\n";
  std::vector<std::string> names;
  for (const CommandText& command : command_texts())
    text += fmt::format("  {:<24} {}\n", command.name,
                        command.summary.substr(0, command.summary.find('\n')));
  return text +
         fmt::format(
             "\nAlso a law (sluice help johnson_cook), a label (sluice help press_CC), or "
             "words of a\nmessage that ended a run (sluice help \"time cannot advance\").\n\n"
             "{}\n",
             exit_statuses);
}

int help(const HelpRequest& r) {
  if (!r.pages.empty()) write_pages(r.pages);
  if (r.labels) fmt::print("{}", label_reference());
  if (r.messages) fmt::print("{}", page_of_messages());
  if (!r.shell.empty()) fmt::print("{}", completion_for(r.shell));
  if (r.man) fmt::print("{}", man_page(command_texts(), version::kText));
  const bool writes = !r.pages.empty() || r.labels || r.messages || !r.shell.empty() || r.man;
  if (!writes && r.names.empty()) fmt::print("{}", overview());
  std::vector<std::string> commands;
  for (const CommandKind& kind : command_kinds()) commands.emplace_back(kind.name);
  for (const std::string& name : r.names) fmt::print("{}", help_on(name, commands));
  return 0;
}

}  // namespace

void declare_help_command(Command& command) {
  auto r = std::make_shared<HelpRequest>();
  command.option("NAME", r->names,
                 "A command, a tag (cfl, or by its path: ICE/advection), a law, a label, or words "
                 "of a message");
  command.option("--markdown", r->pages, "Write the reference of all tags to this folder");
  command.flag("--labels", r->labels, "Write the page of all labels that decks may save");
  command.flag("--messages", r->messages, "Write the page of the messages that end a run");
  command.option("--completion", r->shell, "Write the completion of a shell")
      .one_of({"bash", "zsh", "fish"});
  command.flag("--man", r->man, "Write the man page");
  command.action([r] { return help(*r); });
}

}  // namespace sluice
