#include "app/command/command_text.hpp"

#include <fmt/format.h>

#include "app/command/command_line.hpp"

namespace sluice {
namespace {

// In single quotes of a shell.
std::string quoted(const std::string& text) {
  std::string out = "'";
  for (const char c : text) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return out + "'";
}

std::string first_line(const std::string& text) {
  return text.substr(0, text.find('\n'));
}

std::string joined(const std::vector<std::string>& words) {
  return fmt::format("{}", fmt::join(words, " "));
}

// A line that begins with a dot or a quote would be a request; a hyphen is printed as one.
std::string troff(const std::string& text) {
  std::string out;
  bool at_start = true;
  for (const char c : text) {
    if (at_start && (c == '.' || c == '\'')) out += "\\&";
    if (c == '\\')
      out += "\\e";
    else if (c == '-')
      out += "\\-";
    else
      out += c;
    at_start = c == '\n';
  }
  return out;
}

}  // namespace

std::string bash_completion(const std::vector<CommandText>& commands) {
  std::string names, cases, values;
  for (const CommandText& command : commands) {
    names += (names.empty() ? "" : " ") + command.name;
    std::vector<std::string> flags;
    for (const OptionText& option : command.options) {
      flags.insert(flags.end(), option.flags.begin(), option.flags.end());
      if (option.words.empty()) continue;
      for (const std::string& flag : option.flags)
        values += fmt::format("    {}:{}) words={} ;;\n", command.name, flag,
                              quoted(joined(option.words)));
    }
    cases +=
        fmt::format("      {}) words={} ;;\n", command.name, quoted(joined(flags) + " --help"));
  }
  return fmt::format(R"(# Completion of sluice for bash, written by `sluice help --completion bash`.
_sluice() {{
  local word=${{COMP_WORDS[COMP_CWORD]}} before=${{COMP_WORDS[COMP_CWORD-1]}} words=
  COMPREPLY=()
  if [[ $COMP_CWORD -eq 1 ]]; then
    mapfile -t COMPREPLY < <(compgen -W {} -- "$word")
    return
  fi
  case "${{COMP_WORDS[1]}}:$before" in
{}  esac
  if [[ -z $words && $word == -* ]]; then
    case "${{COMP_WORDS[1]}}" in
{}    esac
  fi
  [[ -n $words ]] && mapfile -t COMPREPLY < <(compgen -W "$words" -- "$word")
}}
complete -o default -F _sluice sluice
)",
                     quoted(names + " --help --version"), values, cases);
}

std::string zsh_completion(const std::vector<CommandText>& commands) {
  return "#compdef sluice\nautoload -U +X bashcompinit && bashcompinit\n" +
         bash_completion(commands);
}

std::string fish_completion(const std::vector<CommandText>& commands) {
  std::string text =
      "# Completion of sluice for fish, written by `sluice help --completion fish`.\n";
  for (const CommandText& command : commands) {
    text += fmt::format("complete -c sluice -n __fish_use_subcommand -a {} -d {}\n", command.name,
                        quoted(first_line(command.summary)));
    for (const OptionText& option : command.options) {
      if (option.flags.empty()) continue;
      text += fmt::format("complete -c sluice -n '__fish_seen_subcommand_from {}'", command.name);
      for (const std::string& flag : option.flags)
        text += flag.starts_with("--") ? " -l " + flag.substr(2) : " -s " + flag.substr(1);
      if (option.takes_value) text += " -r";
      if (!option.words.empty()) text += " -a " + quoted(joined(option.words));
      text += fmt::format(" -d {}\n", quoted(first_line(option.text)));
    }
  }
  return text;
}

std::string man_page(const std::vector<CommandText>& commands, const std::string& version) {
  std::string text = fmt::format(
      ".TH SLUICE 1 \"\" \"sluice {}\" \"User Commands\"\n.SH NAME\nsluice \\- coupled "
      "fluid-structure simulation with ICE, MPM and MPMICE\n.SH SYNOPSIS\n.B sluice\n"
      "COMMAND [OPTIONS]\n.SH DESCRIPTION\nSluice reads decks (.ups) and writes archives (.uda). "
      "\\fBsluice help\\fR NAME explains a tag, a law, a label or a message.\n.SH COMMANDS\n",
      version);
  for (const CommandText& command : commands) {
    text += fmt::format(".SS \"sluice {}\"\n{}\n", command.name, troff(command.summary));
    for (const OptionText& option : command.options)
      text += fmt::format(".TP\n\\fB{}\\fR\n{}\n", troff(option.names), troff(option.text));
    if (!command.closing.empty()) text += ".PP\n" + troff(command.closing) + "\n";
  }
  return text + ".SH EXIT STATUS\n" + troff(exit_statuses) + "\n";
}

}  // namespace sluice
