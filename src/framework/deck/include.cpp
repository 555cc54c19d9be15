// <include href= section= .../>: replaced by the elements it names.
//
// href       file, looked up as an absolute path, beside the including file (where that is
//            a link, beside its target too), in the current folder
// section    slash-separated path of elements below the file's root; absent: all of the root's
//            children
// excludeSectionTag  any text: the section's children instead of the section itself
// need_applies_to    accepted, without effect
// any other attribute is a filter: the section's last element must carry it with that value
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>

#include "framework/deck/data_file.hpp"
#include "framework/deck/deck.hpp"
#include "framework/deck/faults.hpp"
#include "framework/deck/value_text.hpp"
#include "framework/deck/xml_reader.hpp"

namespace sluice {
namespace {

namespace fs = std::filesystem;
using Nodes = std::vector<std::unique_ptr<DeckNode>>;

class IncludeResolver {
 public:
  IncludeResolver(ReadBudget& budget, std::vector<Fault>& faults)
      : budget_(budget), faults_(faults) {}

  void resolve(DeckNode& node) {
    const bool any = std::any_of(node.children.begin(), node.children.end(),
                                 [](const auto& child) { return child->name == "include"; });
    if (any) splice(node);
    for (const auto& child : node.children) {
      if (child->name != "include") resolve(*child);
    }
  }

 private:
  void splice(DeckNode& parent) {
    Nodes spliced;
    for (auto& child : parent.children) {
      if (child->name != "include") {
        spliced.push_back(std::move(child));
        continue;
      }
      for (auto& node : load(*child)) spliced.push_back(std::move(node));
    }
    parent.children = std::move(spliced);
  }

  void fault(const DeckNode& include, std::string message, std::string suggestion = {}) {
    add_error(faults_, include.where, std::move(message), std::move(suggestion));
  }

  std::optional<fs::path> locate(const DeckNode& include, const std::string& href) {
    std::vector<fs::path> candidates;
    if (fs::path(href).is_absolute()) {
      candidates.emplace_back(href);
    } else {
      for (const fs::path& folder : search_folders(include.where))
        candidates.push_back(folder / href);
      candidates.emplace_back(href);
    }
    std::error_code problem;
    for (const auto& candidate : candidates) {
      if (fs::is_regular_file(candidate, problem)) return candidate.lexically_normal();
    }
    const bool exists = std::any_of(candidates.begin(), candidates.end(),
                                    [&](const auto& path) { return fs::exists(path, problem); });
    if (exists) {
      fault(include, fmt::format("included {} is not a regular file", in_quotes(href)));
      return std::nullopt;
    }
    fault(include, fmt::format("included file {} does not exist", in_quotes(href)),
          "searched in the folder of the including file and in the current folder");
    return std::nullopt;
  }

  // The elements that replace one include; empty after a fault.
  Nodes load(const DeckNode& include) {
    const std::string href = include.attribute("href").value_or("");
    if (href.empty()) {
      fault(include, "<include> needs href=\"FILE\"");
      return {};
    }
    if (give_up_) return {};
    if (budget_.includes == 0 || stack_.size() >= budget_.include_depth) {
      give_up_ = true;
      fault(include,
            fmt::format("too many includes: {} of {} are nested", stack_.size(), in_quotes(href)));
      return {};
    }
    const auto path = locate(include, href);
    if (!path) return {};

    const std::string key = identity(include, *path);
    if (std::find(stack_.begin(), stack_.end(), key) != stack_.end()) {
      give_up_ = true;
      fault(include, fmt::format("include loop: {} includes itself", in_quotes(href)));
      return {};
    }
    --budget_.includes;
    XmlTree fragment = read_xml_file(path->string(), path->string(), budget_);
    faults_.insert(faults_.end(), fragment.faults.begin(), fragment.faults.end());
    if (fragment.root == nullptr) return {};
    Nodes chosen = select(include, std::move(fragment.root), href);

    stack_.push_back(key);
    DeckNode holder;
    holder.children = std::move(chosen);
    resolve(holder);
    stack_.pop_back();
    return std::move(holder.children);
  }

  static std::string identity(const DeckNode& include, const fs::path& path) {
    std::error_code problem;
    std::string key = fs::weakly_canonical(path, problem).string();
    for (const auto& [name, value] : include.attributes) {
      if (name != "href") key += '\n' + name + '=' + value;
    }
    return key;
  }

  static bool is_filter(std::string_view name) {
    return name != "href" && name != "section" && name != "excludeSectionTag" &&
           name != "need_applies_to";
  }

  static bool passes(const DeckNode& include, const DeckNode& node) {
    return std::all_of(include.attributes.begin(), include.attributes.end(), [&](const auto& a) {
      return !is_filter(a.first) || node.attribute(a.first) == a.second;
    });
  }

  // The first element, in document order, at this path whose attributes pass the filters.
  static DeckNode* search(const DeckNode& include, DeckNode& node, std::string_view path) {
    const auto slash = path.find('/');
    const auto name = path.substr(0, slash);
    for (const auto& child : node.children) {
      if (child->name != name) continue;
      if (slash == std::string_view::npos) {
        if (passes(include, *child)) return child.get();
      } else if (DeckNode* found = search(include, *child, path.substr(slash + 1))) {
        return found;
      }
    }
    return nullptr;
  }

  Nodes select(const DeckNode& include, std::unique_ptr<DeckNode> root, const std::string& href) {
    const std::string section = include.attribute("section").value_or("");
    if (section.empty()) return std::move(root->children);
    DeckNode* found = search(include, *root, section);
    if (found == nullptr) {
      std::string filters;
      for (const auto& [name, value] : include.attributes) {
        if (is_filter(name)) filters += fmt::format(" {}={}", name, in_quotes(value));
      }
      fault(include, fmt::format("{} has no section {}{}{}", in_quotes(href), in_quotes(section),
                                 filters.empty() ? "" : " with", filters));
      return {};
    }
    if (!include.attribute("excludeSectionTag").value_or("").empty()) {
      return std::move(found->children);
    }
    Nodes one;
    one.push_back(std::make_unique<DeckNode>(std::move(*found)));
    return one;
  }

  ReadBudget& budget_;
  std::vector<Fault>& faults_;
  std::vector<std::string> stack_;  // includes being resolved, outermost first
  bool give_up_ = false;
};

}  // namespace

void resolve_includes(DeckNode& root, ReadBudget& budget, std::vector<Fault>& faults) {
  IncludeResolver(budget, faults).resolve(root);
}

}  // namespace sluice
