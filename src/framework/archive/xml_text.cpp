// Reading and writing the small XML files of an archive through libxml2.
#include "framework/archive/xml_text.hpp"

#include <fmt/format.h>
#include <libxml/parser.h>
#include <libxml/tree.h>

#include <algorithm>
#include <charconv>
#include <memory>

#include "framework/archive/posix_file.hpp"
#include "framework/base/crc32c.hpp"

namespace sluice {
namespace {

constexpr std::string_view seal_opening = "<!-- crc32c ";
constexpr std::string_view seal_closing = " -->\n";
constexpr std::size_t seal_length = seal_opening.size() + 8 + seal_closing.size();

const xmlChar* as_xml(const std::string& s) {
  return reinterpret_cast<const xmlChar*>(s.c_str());
}
std::string from_xml(const xmlChar* s) {
  return s ? std::string(reinterpret_cast<const char*>(s)) : std::string();
}

struct FreeDocument {
  void operator()(xmlDoc* d) const { xmlFreeDoc(d); }
};
struct FreeText {
  void operator()(xmlChar* s) const { xmlFree(s); }
};

void trim(std::string& s) {
  constexpr const char* blanks = " \t\r\n";
  const std::size_t first = s.find_first_not_of(blanks);
  if (first == std::string::npos) return s.clear();
  s = s.substr(first, s.find_last_not_of(blanks) - first + 1);
}

XmlElement convert(const xmlNode* node, int depth, const std::string& context) {
  if (depth > 32) throw DamageError(context + ": elements are nested more than 32 deep");
  XmlElement element(from_xml(node->name));
  for (const xmlAttr* a = node->properties; a; a = a->next) {
    const std::unique_ptr<xmlChar, FreeText> value(xmlNodeListGetString(node->doc, a->children, 1));
    element.attributes.emplace_back(from_xml(a->name), from_xml(value.get()));
  }
  for (const xmlNode* c = node->children; c; c = c->next) {
    if (c->type == XML_ELEMENT_NODE) element.children.push_back(convert(c, depth + 1, context));
    if (c->type == XML_TEXT_NODE || c->type == XML_CDATA_SECTION_NODE)
      element.text += from_xml(c->content);
  }
  trim(element.text);
  return element;
}

void build(xmlNode* node, const XmlElement& element) {
  for (const auto& [name, value] : element.attributes)
    xmlNewProp(node, as_xml(name), as_xml(value));
  if (!element.text.empty())
    xmlNodeAddContent(node, nullptr), xmlAddChild(node, xmlNewText(as_xml(element.text)));
  for (const XmlElement& c : element.children)
    build(xmlNewChild(node, nullptr, as_xml(c.name), nullptr), c);
}

// The three parts of "[a, b, c]".
std::array<std::string_view, 3> triple_parts(std::string_view text, const std::string& context) {
  const std::size_t first = text.find(',');
  const std::size_t second = first == text.npos ? text.npos : text.find(',', first + 1);
  if (text.size() < 2 || text.front() != '[' || text.back() != ']' || second == text.npos)
    throw DamageError(fmt::format("{}: '{}' is not a triple [a, b, c]", context, text));
  return {text.substr(1, first - 1), text.substr(first + 1, second - first - 1),
          text.substr(second + 1, text.size() - second - 2)};
}

template <class T>
T parse_number(std::string_view text, const std::string& context, const char* kind) {
  const std::string_view whole = text;
  while (!text.empty() && text.front() == ' ') text.remove_prefix(1);
  while (!text.empty() && text.back() == ' ') text.remove_suffix(1);
  T value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size())
    throw DamageError(fmt::format("{}: '{}' is not {}", context, whole, kind));
  return value;
}

}  // namespace

XmlElement& XmlElement::add(std::string child_name, std::string child_text) {
  return children.emplace_back(std::move(child_name), std::move(child_text));
}
XmlElement& XmlElement::set(std::string attribute_name, std::string value) {
  attributes.emplace_back(std::move(attribute_name), std::move(value));
  return *this;
}

const XmlElement* XmlElement::child(std::string_view child_name) const {
  const auto it = std::find_if(children.begin(), children.end(),
                               [&](const XmlElement& c) { return c.name == child_name; });
  return it == children.end() ? nullptr : &*it;
}

std::optional<std::string> XmlElement::attribute(std::string_view attribute_name) const {
  for (const auto& [key, value] : attributes)
    if (key == attribute_name) return value;
  return std::nullopt;
}

const XmlElement& XmlElement::need(std::string_view child_name, const std::string& context) const {
  if (const XmlElement* found = child(child_name)) return *found;
  throw DamageError(fmt::format("{}: <{}> has no <{}>", context, name, child_name));
}

std::string XmlElement::need_attribute(std::string_view attribute_name,
                                       const std::string& context) const {
  if (auto value = attribute(attribute_name)) return *value;
  throw DamageError(fmt::format("{}: <{}> has no attribute {}", context, name, attribute_name));
}

XmlElement parse_xml(std::string_view text, const std::string& context) {
  // No network, no external entities, no entity expansion beyond libxml2's own limits.
  const std::unique_ptr<xmlDoc, FreeDocument> document(
      xmlReadMemory(text.data(), static_cast<int>(text.size()), "archive.xml", nullptr,
                    XML_PARSE_NONET | XML_PARSE_NOERROR | XML_PARSE_NOWARNING));
  const xmlNode* root = document ? xmlDocGetRootElement(document.get()) : nullptr;
  if (!root) {
    const xmlError* error = xmlGetLastError();
    std::string why = error && error->message ? error->message : "no root element";
    trim(why);
    throw DamageError(fmt::format("{}: not readable as XML: {}", context, why));
  }
  // No archive has a DTD; entities are only good for bombs.
  if (document->intSubset) throw DamageError(context + ": a document type is not allowed here");
  return convert(root, 0, context);
}

std::string to_text(const XmlElement& root) {
  const std::unique_ptr<xmlDoc, FreeDocument> document(xmlNewDoc(as_xml("1.0")));
  xmlNode* node = xmlNewDocNode(document.get(), nullptr, as_xml(root.name), nullptr);
  xmlDocSetRootElement(document.get(), node);
  build(node, root);
  xmlChar* bytes = nullptr;
  int count = 0;
  xmlDocDumpFormatMemoryEnc(document.get(), &bytes, &count, "UTF-8", 1);
  const std::unique_ptr<xmlChar, FreeText> owner(bytes);
  if (!bytes) throw SystemError("cannot write <" + root.name + "> as XML: out of memory");
  return std::string(reinterpret_cast<const char*>(bytes), count);
}

std::string seal(std::string xml) {
  const std::uint32_t sum = crc32c(0, xml.data(), xml.size());
  return xml + fmt::format("{}{:08x}{}", seal_opening, sum, seal_closing);
}

void write_sealed(const std::filesystem::path& path, const XmlElement& root) {
  write_text(path, seal(to_text(root)));
}
void publish_sealed(const std::filesystem::path& path, const XmlElement& root) {
  write_text_atomically(path, seal(to_text(root)));
}

XmlElement read_sealed(const std::filesystem::path& path) {
  const std::string text = read_text(path);
  if (text.size() < seal_length)
    throw DamageError(
        fmt::format("{}: the file is too short ({} bytes)", path.string(), text.size()));
  const std::string body = text.substr(0, text.size() - seal_length);
  if (seal(body) != text)
    throw DamageError(fmt::format(
        "{}: its checksum line is missing or does not match: the file is damaged or was edited",
        path.string()));
  return parse_xml(body, path.string());
}

std::string real_text(double value) {
  return fmt::format("{:.17g}", value);
}
std::string triple_text(IntVec3 v) {
  return fmt::format("[{}, {}, {}]", v.x, v.y, v.z);
}
std::string triple_text(Vec3 v) {
  return fmt::format("[{:.17g}, {:.17g}, {:.17g}]", v.x, v.y, v.z);
}

double parse_real(std::string_view text, const std::string& context) {
  return parse_number<double>(text, context, "a number");
}
std::int64_t parse_integer(std::string_view text, const std::string& context) {
  return parse_number<std::int64_t>(text, context, "an integer");
}
int parse_int(std::string_view text, const std::string& context) {
  return parse_number<int>(text, context, "an integer");
}
IntVec3 parse_int_triple(std::string_view text, const std::string& context) {
  const auto [a, b, c] = triple_parts(text, context);
  return {parse_int(a, context), parse_int(b, context), parse_int(c, context)};
}
Vec3 parse_real_triple(std::string_view text, const std::string& context) {
  const auto [a, b, c] = triple_parts(text, context);
  return {parse_real(a, context), parse_real(b, context), parse_real(c, context)};
}

}  // namespace sluice
