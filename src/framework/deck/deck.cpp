// The deck's tree: finding nodes, reading values, writing messages and XML.
#include "framework/deck/deck.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "framework/base/error.hpp"
#include "framework/deck/value_text.hpp"

namespace sluice {
namespace {

// A value that cannot be read names its place; a checked deck never gets here.
template <class T>
T value_or_fault(const DeckNode& node, ParsedValue<T> parsed) {
  if (!parsed) {
    throw InputError(fmt::format("{}: <{}>: {}", to_string(node.where), node.name, parsed.problem));
  }
  return std::move(*parsed.value);
}

void append_escaped(std::string& xml, std::string_view text, bool in_attribute) {
  for (const char c : text) {
    switch (c) {
      case '&':
        xml += "&amp;";
        break;
      case '<':
        xml += "&lt;";
        break;
      case '>':
        xml += "&gt;";
        break;
      case '"':
        if (in_attribute) {
          xml += "&quot;";
        } else {
          xml += c;
        }
        break;
      default:
        xml += c;
    }
  }
}

void append_xml(std::string& xml, const DeckNode& node, int depth) {
  const std::string indent(2 * depth, ' ');
  xml += indent + '<' + node.name;
  for (const auto& [name, value] : node.attributes) {
    xml += ' ' + name + "=\"";
    append_escaped(xml, value, true);
    xml += '"';
  }
  if (node.text.empty() && node.children.empty()) {
    xml += "/>\n";
    return;
  }
  xml += '>';
  append_escaped(xml, node.text, false);
  if (!node.children.empty()) {
    xml += '\n';
    for (const auto& child : node.children) append_xml(xml, *child, depth + 1);
    xml += indent;
  }
  xml += "</" + node.name + ">\n";
}

}  // namespace

std::string to_string(const Location& where) {
  if (where.line <= 0) return where.file;
  if (where.column <= 0) return fmt::format("{}:{}", where.file, where.line);
  return fmt::format("{}:{}:{}", where.file, where.line, where.column);
}

std::string to_string(const Fault& fault) {
  const char* word = fault.severity == Severity::error     ? "error"
                     : fault.severity == Severity::warning ? "warning"
                                                           : "note";
  std::string line = fmt::format("{}: {}: {}", to_string(fault.where), word, fault.message);
  if (!fault.suggestion.empty()) line += fmt::format(" ({})", fault.suggestion);
  return line;
}

const DeckNode* DeckNode::child(std::string_view child_name) const {
  for (const auto& candidate : children) {
    if (candidate->name == child_name) return candidate.get();
  }
  return nullptr;
}

DeckNode* DeckNode::child(std::string_view child_name) {
  return const_cast<DeckNode*>(std::as_const(*this).child(child_name));
}

const DeckNode* DeckNode::find(std::string_view path) const {
  const DeckNode* node = this;
  while (node != nullptr && !path.empty()) {
    const auto slash = path.find('/');
    node = node->child(path.substr(0, slash));
    path = slash == std::string_view::npos ? std::string_view{} : path.substr(slash + 1);
  }
  return node;
}

std::vector<const DeckNode*> DeckNode::all(std::string_view child_name) const {
  std::vector<const DeckNode*> found;
  for (const auto& candidate : children) {
    if (candidate->name == child_name) found.push_back(candidate.get());
  }
  return found;
}

std::optional<std::string> DeckNode::attribute(std::string_view attribute_name) const {
  for (const auto& [key, value] : attributes) {
    if (key == attribute_name) return value;
  }
  return std::nullopt;
}

bool DeckNode::has(std::string_view child_name) const {
  return std::any_of(children.begin(), children.end(), [&](const auto& candidate) {
    return candidate->name == child_name && !candidate->defaulted;
  });
}

double DeckNode::as_real() const {
  return value_or_fault(*this, parse_real(text));
}
int DeckNode::as_integer() const {
  return value_or_fault(*this, parse_integer(text));
}
bool DeckNode::as_boolean() const {
  return value_or_fault(*this, parse_boolean(text));
}
Vec3 DeckNode::as_vector() const {
  return value_or_fault(*this, parse_vector(text));
}
IntVec3 DeckNode::as_int_vector() const {
  return value_or_fault(*this, parse_int_vector(text));
}
std::vector<double> DeckNode::as_reals() const {
  return value_or_fault(*this, parse_reals(text));
}
std::vector<IntVec3> DeckNode::as_int_vectors() const {
  return value_or_fault(*this, parse_int_vectors(text));
}

const DeckNode& DeckNode::need(std::string_view child_name) const {
  const DeckNode* found = child(child_name);
  if (found == nullptr) {
    throw std::logic_error(
        fmt::format("{}: <{}> has no child <{}>, and the schema defines no default for it",
                    to_string(where), name, child_name));
  }
  return *found;
}

bool Deck::good() const {
  return root != nullptr && std::none_of(faults.begin(), faults.end(), [](const Fault& fault) {
           return fault.severity == Severity::error;
         });
}

std::string element_xml(const DeckNode& node) {
  std::string xml;
  append_xml(xml, node, 0);
  return xml;
}

std::string to_xml(const DeckNode& root) {
  std::string xml = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n";
  append_xml(xml, root, 0);
  return xml;
}

}  // namespace sluice
