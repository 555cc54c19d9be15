// The closed table of obsolete tags and values: each maps to today's form, is dropped, or stays and
// does nothing, with one warning that names its place. What is in no row and no schema is an error.
#include <fmt/format.h>

#include <algorithm>
#include <cstring>

#include "framework/deck/faults.hpp"
#include "framework/deck/load_deck.hpp"
#include "framework/deck/spelling.hpp"
#include "framework/deck/value_text.hpp"

namespace sluice {
namespace {

enum class Action { drop, rename, off, change_value, change_attribute, whole_number, no_effect };

struct Row {
  const char* path;  // the last parts of the tag's path
  Action action;
  const char* from;  // value, attribute=value or attribute that must be there; off: values, as a|b
  const char* to;    // new name, value or attribute=value
  const char* reason;
};

constexpr const char* measured_cost = "boxes are dealt out to ranks by measured cost";
constexpr const char* all_materials = "materials are all in the deck";
constexpr const char* renamed = "the present name";
constexpr const char* tiles = "flagged tiles are refined";
constexpr const char* cracks_at_the_flux = "cracks burn at the mass flux of surfaces";

// clang-format off
constexpr Row table[] = {
#include "framework/deck/obsolete_tags.inc"
};
// clang-format on

// Whether the slash-separated path ends with these parts, in any spelling.
bool ends_with(std::string_view path, const std::string& parts) {
  const std::string tail = plain_spelling(parts);
  if (path.size() < tail.size() || path.substr(path.size() - tail.size()) != tail) return false;
  return path.size() == tail.size() || path[path.size() - tail.size() - 1] == '/';
}

// Of values written as a|b; numbers by value.
bool is_one_of(const std::string& text, std::string_view values) {
  const auto number = parse_real(text);
  for (;;) {
    const std::string_view value = values.substr(0, values.find('|'));
    const auto listed = parse_real(value);
    if (text == value || (number && listed && *number.value == *listed.value)) return true;
    if (value.size() == values.size()) return false;
    values.remove_prefix(value.size() + 1);
  }
}

class Updater {
 public:
  explicit Updater(std::vector<Fault>& faults) : faults_(faults) {}

  // `path` is in its plain spelling.
  void update(DeckNode& node, const std::string& path) {
    for (auto child = node.children.begin(); child != node.children.end();) {
      const std::string child_path = path + '/' + plain_spelling((*child)->name);
      if (update_one(**child, child_path)) {
        child = node.children.erase(child);
        continue;
      }
      update(**child, child_path);
      ++child;
    }
  }

 private:
  void warn(const DeckNode& node, std::string message, const char* reason) {
    add_warning(faults_, node.where, std::move(message), reason);
  }

  // True when the node is to be dropped.
  bool update_one(DeckNode& node, const std::string& path) {
    for (const Row& row : table) {
      if (!ends_with(path, row.path)) continue;
      switch (row.action) {
        case Action::drop:
          if (row.from != nullptr && node.text != row.from) break;
          warn(node, fmt::format("<{}> is obsolete; dropped", node.name), row.reason);
          return true;
        case Action::rename:
          warn(node, fmt::format("<{}> is obsolete; read as <{}>", node.name, row.to), row.reason);
          node.name = row.to;
          return false;
        case Action::off:
          return drop_when_off(node, row);
        case Action::change_value:
          if (node.text != row.from) break;
          warn(node,
               fmt::format("<{}>: {} is obsolete; read as {}", node.name, in_quotes(row.from),
                           in_quotes(row.to)),
               row.reason);
          node.text = row.to;
          break;
        case Action::change_attribute:
          change_attribute(node, row);
          break;
        case Action::whole_number:
          make_whole(node, row);
          break;
        case Action::no_effect:
          tell_of_no_effect(node, row);
          break;
      }
    }
    return false;
  }

  // Physics that is not there may be switched off, and not on.
  bool drop_when_off(const DeckNode& node, const Row& row) {
    if (!is_one_of(node.text, row.from)) {
      add_not_built(faults_, node.where, fmt::format("<{}> {}", node.name, node.text), row.reason);
      return true;
    }
    warn(node, fmt::format("<{}> is obsolete; dropped", node.name), row.reason);
    return true;
  }

  void change_attribute(DeckNode& node, const Row& row) {
    const std::string_view from = row.from;
    const std::string_view name = from.substr(0, from.find('='));
    const std::string_view value = from.substr(from.find('=') + 1);
    for (auto& [attribute, text] : node.attributes) {
      if (attribute != name || collapse_blanks(text) != value) continue;
      warn(node,
           fmt::format("<{} {}>: {} is obsolete; read as {}", node.name, attribute,
                       in_quotes(value), in_quotes(row.to)),
           row.reason);
      text = row.to;
    }
  }

  // A tag, or one attribute of it.
  void tell_of_no_effect(const DeckNode& node, const Row& row) {
    if (row.from != nullptr && !node.attribute(row.from)) return;
    const std::string attribute = row.from == nullptr ? "" : " " + std::string(row.from);
    warn(node, fmt::format("<{}{}> has no effect", node.name, attribute), row.reason);
  }

  // An integer attribute written as a real number: 4.0.
  void make_whole(DeckNode& node, const Row& row) {
    for (auto& [attribute, text] : node.attributes) {
      if (attribute != row.from || parse_integer(text)) continue;
      const auto value = parse_real(text);
      if (!value || *value.value != static_cast<int>(*value.value)) continue;
      const std::string whole = fmt::format("{}", static_cast<int>(*value.value));
      warn(node,
           fmt::format("<{} {}>: {} is an integer; read as {}", node.name, attribute,
                       in_quotes(text), whole),
           row.reason);
      text = whole;
    }
  }

  std::vector<Fault>& faults_;
};

}  // namespace

void drop_obsolete(DeckNode& root, std::vector<Fault>& faults) {
  Updater(faults).update(root, "");
}

}  // namespace sluice
