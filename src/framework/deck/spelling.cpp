// Names in another spelling: what differs from one name of the schema by capitals alone, or has
// underscores in their place, is read as that name, with a warning.
#include "framework/deck/spelling.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "framework/deck/faults.hpp"
#include "framework/deck/format_tags.hpp"

namespace sluice {
namespace {

class Settler {
 public:
  Settler(const Schema& schema, std::vector<Fault>& faults) : schema_(schema), faults_(faults) {}

  void settle(DeckNode& node, const TagSpec& spec, const std::string& path) {
    settle_attributes(node, spec);
    move_elements_to_attributes(node, spec);
    for (const auto& child : node.children) {
      const TagSpec* known = schema_.child(spec, child->name);
      if (known == nullptr) known = settle_name(node, *child, spec, path);
      if (known != nullptr)
        settle(*child, *known, path.empty() ? known->name : path + '/' + known->name);
    }
  }

 private:
  const TagSpec* settle_name(const DeckNode& parent, DeckNode& child, const TagSpec& spec,
                             const std::string& path) {
    if (known_to_format(path, child.name)) return nullptr;
    const TagSpec* meant = nullptr;
    for (const TagSpec* candidate : schema_.children(spec)) {
      if (!same_spelling(child.name, *candidate)) continue;
      if (meant != nullptr) return nullptr;
      meant = candidate;
    }
    // Beside the name itself it is a second one, not another spelling.
    if (meant == nullptr || parent.child(meant->name) != nullptr) return nullptr;
    add_warning(faults_, child.where,
                fmt::format("<{}> is an old spelling; read as <{}>", child.name, meant->name));
    child.name = meant->name;
    return meant;
  }

  void settle_attributes(DeckNode& node, const TagSpec& spec) {
    for (auto& [name, value] : node.attributes) {
      const auto called = [&, &written = name](const AttributeSpec& a) {
        return a.called(written);
      };
      if (std::any_of(spec.attributes.begin(), spec.attributes.end(), called)) continue;
      for (const AttributeSpec& candidate : spec.attributes) {
        if (!same_spelling(name, candidate) || node.attribute(candidate.name)) continue;
        add_warning(faults_, node.where,
                    fmt::format("<{} {}> is an old spelling; read as <{} {}>", node.name, name,
                                node.name, candidate.name));
        name = candidate.name;
        break;
      }
    }
  }

  // <SimulationComponent><type>mpm</type>: what must be an attribute stands in an element.
  void move_elements_to_attributes(DeckNode& node, const TagSpec& spec) {
    std::erase_if(node.children, [&](const std::unique_ptr<DeckNode>& child) {
      const auto is_it = [&](const AttributeSpec& a) {
        return a.need == Need::once && a.called(child->name) && !node.attribute(a.name);
      };
      if (schema_.child(spec, child->name) != nullptr || !child->children.empty()) return false;
      const auto found = std::find_if(spec.attributes.begin(), spec.attributes.end(), is_it);
      if (found == spec.attributes.end()) return false;
      node.attributes.emplace_back(found->name, child->text);
      add_warning(faults_, child->where,
                  fmt::format("<{}> in <{}> is obsolete; read as its attribute {}", child->name,
                              node.name, found->name));
      return true;
    });
  }

  template <class Spec>
  static bool same_spelling(const std::string& name, const Spec& spec) {
    return is_spelling_of(name, spec.name) ||
           std::any_of(spec.aliases.begin(), spec.aliases.end(),
                       [&](const std::string& alias) { return is_spelling_of(name, alias); });
  }

  const Schema& schema_;
  std::vector<Fault>& faults_;
};

}  // namespace

std::string without_capitals(std::string_view name) {
  std::string small(name);
  for (char& c : small) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return small;
}

std::string with_underscores(std::string_view name) {
  std::string snake;
  for (std::size_t i = 0; i < name.size(); ++i) {
    const bool capital = std::isupper(static_cast<unsigned char>(name[i])) != 0;
    const bool behind_small = i > 0 && std::islower(static_cast<unsigned char>(name[i - 1])) != 0;
    const bool before_small =
        i + 1 < name.size() && std::islower(static_cast<unsigned char>(name[i + 1])) != 0;
    const bool begins = capital && i > 0 && name[i - 1] != '_' && (behind_small || before_small);
    if (begins) snake += '_';
    snake += static_cast<char>(std::tolower(static_cast<unsigned char>(name[i])));
  }
  return snake;
}

bool is_spelling_of(std::string_view written, std::string_view name) {
  const std::string small = without_capitals(written);
  return small == without_capitals(name) || small == with_underscores(name);
}

std::string plain_spelling(std::string_view name) {
  std::string plain = without_capitals(name);
  std::erase(plain, '_');
  return plain;
}

void settle_spelling(DeckNode& root, const Schema& schema, std::vector<Fault>& faults) {
  Settler(schema, faults).settle(root, schema.root, "");
}

}  // namespace sluice
