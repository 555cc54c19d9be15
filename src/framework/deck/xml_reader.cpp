// XML to DeckNodes through libxml2's SAX2 interface, which knows line and column of each tag.
#include "framework/deck/xml_reader.hpp"

#include <fmt/format.h>
#include <libxml/parser.h>
#include <libxml/parserInternals.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "framework/deck/faults.hpp"
#include "framework/deck/value_text.hpp"

namespace sluice {
namespace {

// An element whose end tag has not come yet.
struct OpenElement {
  DeckNode* node;
  std::string text;
  int text_pieces = 0;
  bool in_piece = false;
};

struct ReaderState {
  xmlParserCtxtPtr context = nullptr;
  std::string shown_name;
  ReadBudget* budget = nullptr;
  XmlTree tree;
  std::vector<OpenElement> open;
  bool stopped = false;
};

// The parser calls back at the end of a start tag; '<' cannot occur inside one, so the tag's own
// place is found by going back to it.
Location place_of_tag(const ReaderState& state) {
  const xmlParserInputPtr input = state.context->input;
  Location where{state.shown_name, input->line, 0};
  const xmlChar* at = input->cur;
  while (at > input->base && *at != '<') {
    if (*at == '\n' && at != input->cur) --where.line;
    --at;
  }
  if (*at != '<') return {state.shown_name, input->line, input->col};
  // Count characters from the line's start; on a very long line trust the parser's own count.
  constexpr std::ptrdiff_t farthest = 1024;
  const xmlChar* line_start = at;
  int characters = 1;
  while (line_start > input->base && line_start[-1] != '\n' && at - line_start < farthest) {
    --line_start;
    characters += (*line_start & 0xc0) != 0x80 ? 1 : 0;
  }
  const bool reached = line_start == input->base ? where.line == 1 : line_start[-1] == '\n';
  const int own_count = input->col - static_cast<int>(input->cur - at);
  where.column = reached ? characters : where.line == input->line ? own_count : 0;
  return where;
}

void stop_with(ReaderState& state, const Location& where, std::string message,
               std::string suggestion) {
  if (state.stopped) return;
  state.stopped = true;
  add_error(state.tree.faults, where, std::move(message), std::move(suggestion));
  xmlStopParser(state.context);
}

std::string qualified(const xmlChar* prefix, const xmlChar* local) {
  std::string name = reinterpret_cast<const char*>(local);
  if (prefix != nullptr) name = std::string(reinterpret_cast<const char*>(prefix)) + ':' + name;
  return name;
}

void on_start(void* user, const xmlChar* local, const xmlChar* prefix, const xmlChar*, int,
              const xmlChar**, int attribute_count, int, const xmlChar** attributes) {
  auto& state = *static_cast<ReaderState*>(user);
  if (state.stopped) return;
  auto node = std::make_unique<DeckNode>();
  node->name = qualified(prefix, local);
  node->where = place_of_tag(state);
  if (state.open.size() >= static_cast<std::size_t>(deepest_element)) {
    stop_with(state, node->where,
              fmt::format("<{}> is nested deeper than {} elements", node->name, deepest_element),
              "");
    return;
  }
  if (state.budget->elements == 0) {
    stop_with(state, node->where, "the deck has too many elements (limit 200,000)", "");
    return;
  }
  --state.budget->elements;
  for (int a = 0; a < attribute_count; ++a) {
    const xmlChar** fields = attributes + static_cast<std::ptrdiff_t>(5) * a;
    node->attributes.emplace_back(
        qualified(fields[1], fields[0]),
        std::string(reinterpret_cast<const char*>(fields[3]), fields[4] - fields[3]));
  }
  DeckNode* const raw = node.get();
  if (state.open.empty()) {
    state.tree.root = std::move(node);
  } else {
    state.open.back().in_piece = false;
    state.open.back().node->children.push_back(std::move(node));
  }
  state.open.push_back({raw, {}, 0, false});
}

void on_end(void* user, const xmlChar*, const xmlChar*, const xmlChar*) {
  auto& state = *static_cast<ReaderState*>(user);
  if (state.stopped || state.open.empty()) return;
  OpenElement& element = state.open.back();
  element.node->text = collapse_blanks(element.text);
  if (element.text_pieces > 1) {
    add_error(state.tree.faults, element.node->where,
              fmt::format("the value of <{}> is split into {} pieces by comments or other tags",
                          element.node->name, element.text_pieces),
              "write the value in one piece");
  }
  state.open.pop_back();
}

void on_text(void* user, const xmlChar* text, int length) {
  auto& state = *static_cast<ReaderState*>(user);
  if (state.stopped || state.open.empty()) return;
  const std::string_view piece(reinterpret_cast<const char*>(text), length);
  OpenElement& element = state.open.back();
  element.text += piece;
  if (piece.find_first_not_of(" \t\r\n") != std::string_view::npos && !element.in_piece) {
    element.in_piece = true;
    ++element.text_pieces;
  }
}

void on_comment(void* user, const xmlChar*) {
  auto& state = *static_cast<ReaderState*>(user);
  if (state.open.empty()) return;
  state.open.back().in_piece = false;
  state.open.back().text += ' ';
}

xmlEntityPtr on_get_entity(void*, const xmlChar* name) {
  return xmlGetPredefinedEntity(name);
}

void on_entity_declaration(void* user, const xmlChar* name, int, const xmlChar*, const xmlChar*,
                           xmlChar*) {
  auto& state = *static_cast<ReaderState*>(user);
  stop_with(state, {state.shown_name, state.context->input->line, state.context->input->col},
            fmt::format("entity {} is declared; decks may not declare entities",
                        in_quotes(reinterpret_cast<const char*>(name))),
            "write the text itself, or use <include href=\"...\"/> for another file");
}

void on_reference(void* user, const xmlChar* name) {
  auto& state = *static_cast<ReaderState*>(user);
  stop_with(state, {state.shown_name, state.context->input->line, state.context->input->col},
            fmt::format("entity {} is not defined",
                        in_quotes(std::string("&") + reinterpret_cast<const char*>(name) + ";")),
            "only &lt; &gt; &amp; &quot; &apos; and numeric references are known");
}

void on_error(void* user, xmlErrorPtr error) {
  auto& state = *static_cast<ReaderState*>(user);
  if (state.stopped || error->level < XML_ERR_ERROR) return;
  // The first error is the cause; those after it are its echo.
  state.stopped = true;
  std::string message = error->message != nullptr ? collapse_blanks(error->message) : "unreadable";
  add_error(state.tree.faults, {state.shown_name, error->line, error->int2}, "XML: " + message);
  xmlStopParser(state.context);
}

xmlSAXHandler callbacks() {
  xmlSAXHandler handler{};
  handler.initialized = XML_SAX2_MAGIC;
  handler.startElementNs = on_start;
  handler.endElementNs = on_end;
  handler.characters = on_text;
  handler.ignorableWhitespace = on_text;
  handler.comment = on_comment;
  handler.getEntity = on_get_entity;
  handler.entityDecl = on_entity_declaration;
  handler.reference = on_reference;
  handler.serror = on_error;
  return handler;
}

// CR LF and CR as LF, so that lines are counted whatever ends them. Texts of two bytes a character
// are left to the parser.
std::string with_plain_line_ends(std::string_view xml) {
  std::string text(xml);
  if (text.find('\r') == std::string::npos || text.find('\0') != std::string::npos) return text;
  std::size_t to = 0;
  for (std::size_t at = 0; at < text.size(); ++at) {
    const bool before_line_feed = text[at] == '\r' && text.compare(at, 2, "\r\n") == 0;
    if (!before_line_feed) text[to++] = text[at] == '\r' ? '\n' : text[at];
  }
  text.resize(to);
  return text;
}

XmlTree unreadable(const std::string& shown_name, std::string message, std::string suggestion) {
  XmlTree tree;
  add_error(tree.faults, {shown_name, 0, 0}, std::move(message), std::move(suggestion));
  return tree;
}

}  // namespace

XmlTree read_xml_text(std::string_view xml, const std::string& shown_name, ReadBudget& budget) {
  if (xml.size() > largest_deck_file || xml.size() > budget.bytes) {
    return unreadable(shown_name,
                      fmt::format("the file has {} bytes, more than the limit of {}", xml.size(),
                                  largest_deck_file),
                      "");
  }
  budget.bytes -= xml.size();
  if (xml.find_first_not_of(" \t\r\n") == std::string_view::npos) {
    return unreadable(shown_name, "the file is empty", "");
  }
  ReaderState state;
  state.shown_name = shown_name;
  state.budget = &budget;
  const std::string plain = with_plain_line_ends(xml);
  state.context = xmlCreateMemoryParserCtxt(plain.data(), static_cast<int>(plain.size()));
  if (state.context == nullptr) return unreadable(shown_name, "XML: parser cannot start", "");
  *state.context->sax = callbacks();
  state.context->userData = &state;
  xmlCtxtUseOptions(state.context, XML_PARSE_NONET | XML_PARSE_NOENT | XML_PARSE_NOCDATA);
  xmlParseDocument(state.context);
  if (state.context->wellFormed == 0 && state.tree.faults.empty()) {
    add_error(state.tree.faults, {shown_name, 0, 0}, "XML: not well formed");
    state.stopped = true;
  }
  if (state.stopped) state.tree.root.reset();
  if (state.context->myDoc != nullptr) xmlFreeDoc(state.context->myDoc);
  state.context->myDoc = nullptr;
  xmlFreeParserCtxt(state.context);
  return std::move(state.tree);
}

XmlTree read_xml_file(const std::string& path, const std::string& shown_name, ReadBudget& budget) {
  namespace fs = std::filesystem;
  std::error_code problem;
  const auto status = fs::status(path, problem);
  if (!fs::exists(status)) {
    return unreadable(shown_name, "no such file",
                      "paths are relative to the current folder: check the spelling");
  }
  if (!fs::is_regular_file(status)) {
    return unreadable(shown_name, "not a regular file; a deck is an XML file", "");
  }
  const auto size = fs::file_size(path, problem);
  if (!problem && size > largest_deck_file) {
    return unreadable(
        shown_name,
        fmt::format("the file has {} bytes, more than the limit of {}", size, largest_deck_file),
        "");
  }
  std::ifstream stream(path, std::ios::binary);
  std::string xml;
  if (stream) xml.assign(std::istreambuf_iterator<char>(stream), {});
  if (!stream || stream.bad()) {
    return unreadable(shown_name, "the file cannot be read", "check its permissions");
  }
  return read_xml_text(xml, shown_name, budget);
}

}  // namespace sluice
