// Geometry pieces by label: an empty tag with the label of a piece elsewhere becomes a copy of it,
// so that nobody after this has to know about labels.
#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "framework/deck/faults.hpp"
#include "framework/deck/format/framework_schema.hpp"
#include "framework/deck/nearest_name.hpp"
#include "framework/deck/value_text.hpp"

namespace sluice {
namespace {

std::string label_of(const DeckNode& node) {
  const auto label = node.attribute("label");
  return collapse_blanks(label ? *label : node.attribute("name").value_or(""));
}

bool is_empty(const DeckNode& node) {
  return node.children.empty() && node.text.empty();
}

bool same_piece(const DeckNode& a, const DeckNode& b) {
  if (a.name != b.name || a.text != b.text || a.attributes != b.attributes) return false;
  return std::equal(a.children.begin(), a.children.end(), b.children.begin(), b.children.end(),
                    [](const auto& x, const auto& y) { return same_piece(*x, *y); });
}

class LabelResolver {
 public:
  LabelResolver(std::vector<Fault>& faults) : faults_(faults) {}

  // Every piece with content and a label, in document order. Pieces outside <geom_object> (regions
  // of loads) have labels of their own that nobody refers to.
  void collect(const DeckNode& node, bool in_object = false) {
    for (const auto& child : node.children) {
      collect(*child, in_object || child->name == "geom_object");
      if (!in_object || !is_geometry_piece(child->name) || is_empty(*child)) continue;
      const std::string label = label_of(*child);
      if (label.empty()) continue;
      const auto [first, fresh] = pieces_.try_emplace(label, child.get());
      if (fresh) continue;
      if (same_piece(*first->second, *child)) {
        add_warning(faults_, child->where,
                    fmt::format("label {} repeats the piece at {}, word for word", in_quotes(label),
                                to_string(first->second->where)),
                    "write it empty to repeat the piece");
        continue;
      }
      rivals_.try_emplace(label, child.get());
      add_warning(
          faults_, child->where,
          fmt::format("label {} is already used by the piece at {}; this is a separate piece",
                      in_quotes(label), to_string(first->second->where)),
          "give it another label, or write it empty to repeat the first");
    }
  }

  void resolve(DeckNode& node) {
    within_.push_back(&node);
    for (const auto& child : node.children) {
      const bool reference = is_geometry_piece(child->name) && is_empty(*child) &&
                             child->name != "null" && !label_of(*child).empty();
      if (reference) {
        fill(*child);
      } else {
        resolve(*child);
      }
    }
    within_.pop_back();
  }

 private:
  void fault(const DeckNode& node, std::string message, std::string suggestion) {
    add_error(faults_, node.where, std::move(message), std::move(suggestion));
  }

  void fill(DeckNode& reference) {
    const std::string label = label_of(reference);
    const auto found = pieces_.find(label);
    if (found == pieces_.end()) {
      std::vector<std::string> labels;
      for (const auto& [name, piece] : pieces_) labels.push_back(name);
      fault(reference, fmt::format("no piece has the label {}", in_quotes(label)),
            suggest_name(label, labels));
      return;
    }
    const DeckNode& piece = *found->second;
    if (const auto rival = rivals_.find(label); rival != rivals_.end()) {
      fault(reference,
            fmt::format("{} is the label of two pieces, at {} and at {}", in_quotes(label),
                        to_string(piece.where), to_string(rival->second->where)),
            "give one of them another label");
    }
    if (piece.name != reference.name) {
      fault(reference,
            fmt::format("{} is the label of a <{}> at {}, not of a <{}>", in_quotes(label),
                        piece.name, to_string(piece.where), reference.name),
            fmt::format("write <{} label=\"{}\"/>", piece.name, label));
      return;
    }
    if (gave_up_) return;
    const bool inside_itself = std::find(within_.begin(), within_.end(), &piece) != within_.end();
    if (inside_itself || copied_ > max_copied_) {
      fault(reference, fmt::format("label {} repeats pieces endlessly", in_quotes(label)),
            "a piece cannot contain itself");
      gave_up_ = copied_ > max_copied_;
      return;
    }
    copy_children(piece, reference);
    forget_label(reference);
    within_.push_back(&piece);
    resolve(reference);  // the piece may itself hold references
    within_.pop_back();
  }

  // A copy has no label: that stays with the piece itself.
  static void forget_label(DeckNode& node) {
    if (!is_geometry_piece(node.name)) return;
    std::erase_if(node.attributes, [](const auto& attribute) {
      return attribute.first == "label" || attribute.first == "name";
    });
  }

  void copy_children(const DeckNode& from, DeckNode& to) {
    to.text = from.text;
    for (const auto& child : from.children) {
      auto copy = std::make_unique<DeckNode>();
      copy->name = child->name;
      copy->where = child->where;
      copy->attributes = child->attributes;
      ++copied_;
      if (copied_ <= max_copied_) copy_children(*child, *copy);
      if (!is_empty(*copy)) forget_label(*copy);
      to.children.push_back(std::move(copy));
    }
  }

  static constexpr int max_copied_ = 100'000;
  std::vector<Fault>& faults_;
  std::map<std::string, const DeckNode*> pieces_;
  std::map<std::string, const DeckNode*> rivals_;  // second piece of a label, with other content
  std::vector<const DeckNode*> within_;            // what is being resolved, outermost first
  int copied_ = 0;
  bool gave_up_ = false;
};

}  // namespace

void resolve_piece_labels(DeckNode& root, std::vector<Fault>& faults) {
  LabelResolver resolver(faults);
  resolver.collect(root);
  resolver.resolve(root);
}

}  // namespace sluice
