#include "app/tune/tune_xml.hpp"

#include <algorithm>

#include "framework/base/error.hpp"

namespace sluice {
namespace {

constexpr const char* blanks = " \t\r\n";
constexpr std::size_t nowhere = std::string::npos;

// What may come before, in and behind elements; a cursor over the text.
class Scanner {
 public:
  explicit Scanner(const std::string& text) : text_(text) {}

  XmlSpan root() {
    skip_to_tag();
    return element();
  }

 private:
  bool at(const char* what) const {
    return text_.compare(next_, std::char_traits<char>::length(what), what) == 0;
  }
  void pass(const char* what) {
    const std::size_t found = text_.find(what, next_);
    if (found == nowhere) throw InputError("the text is not well-formed XML");
    next_ = found + std::char_traits<char>::length(what);
  }
  // To the next start or end tag, over text, comments, instructions and declarations.
  void skip_to_tag() {
    for (;;) {
      next_ = text_.find('<', next_);
      if (next_ == nowhere) throw InputError("the text is not well-formed XML");
      if (at("<!--"))
        pass("-->");
      else if (at("<![CDATA["))
        pass("]]>");
      else if (at("<?"))
        pass("?>");
      else if (at("<!"))
        pass(">");
      else
        return;
    }
  }
  std::string word(const char* until) {
    const std::size_t from = next_;
    next_ = std::min(text_.find_first_of(until, next_), text_.size());
    return text_.substr(from, next_ - from);
  }
  void skip_blanks() { next_ = std::min(text_.find_first_not_of(blanks, next_), text_.size()); }

  void read_attributes(XmlSpan& e) {
    for (skip_blanks(); next_ < text_.size() && !at(">") && !at("/>"); skip_blanks()) {
      XmlValueSpan a;
      a.name = word(" \t\r\n=");
      next_ = std::min(text_.find_first_of("\"'", next_), text_.size() - 1);
      a.begin = next_ + 1;
      a.end = std::min(text_.find(text_[next_], a.begin), text_.size() - 1);
      a.value = text_.substr(a.begin, a.end - a.begin);
      next_ = a.end + 1;
      e.attributes.push_back(std::move(a));
    }
  }
  XmlSpan element() {
    XmlSpan e;
    e.begin = next_++;
    e.name = word(" \t\r\n/>");
    read_attributes(e);
    e.empty_tag = at("/>");
    pass(">");
    e.inner_begin = e.inner_end = e.end = next_;
    while (!e.empty_tag) {
      skip_to_tag();
      if (at("</")) {
        e.inner_end = next_;
        pass(">");
        e.end = next_;
        break;
      }
      e.children.push_back(element());
    }
    return e;
  }

  const std::string& text_;
  std::size_t next_ = 0;
};

}  // namespace

const XmlSpan* XmlSpan::child(const std::string& wanted) const {
  for (const XmlSpan& c : children)
    if (c.name == wanted) return &c;
  return nullptr;
}

const XmlSpan* XmlSpan::find(std::initializer_list<std::string> path) const {
  const XmlSpan* found = this;
  for (const std::string& step : path)
    if (found != nullptr) found = found->child(step);
  return found;
}

std::optional<XmlValueSpan> XmlSpan::attribute(const std::string& wanted) const {
  for (const XmlValueSpan& a : attributes)
    if (a.name == wanted) return a;
  return std::nullopt;
}

XmlSpan xml_elements(const std::string& text) {
  return Scanner(text).root();
}

void XmlEdits::set_attribute(const XmlValueSpan& attribute, const std::string& value) {
  edits_.push_back({attribute.begin, attribute.end, value});
}

void XmlEdits::set_text(const XmlSpan& element, const std::string& value) {
  if (element.empty_tag) {
    edits_.push_back(
        {element.begin, element.end, "<" + element.name + ">" + value + "</" + element.name + ">"});
    return;
  }
  std::size_t from = text_.find_first_not_of(blanks, element.inner_begin);
  while (text_.compare(from, 4, "<!--") == 0)
    from = text_.find_first_not_of(blanks, text_.find("-->", from) + 3);
  if (from >= element.inner_end) from = element.inner_begin;
  std::size_t to = std::min(text_.find('<', from), element.inner_end);
  while (to > from && std::string(blanks).find(text_[to - 1]) != nowhere) --to;
  edits_.push_back({from, to, value});
}

std::string XmlEdits::indent_of(std::size_t place) const {
  std::size_t line = text_.rfind('\n', place);
  line = line == nowhere ? 0 : line + 1;
  const std::size_t first = std::min(text_.find_first_not_of(" \t", line), place);
  return text_.substr(line, first - line);
}

void XmlEdits::add_child(const XmlSpan& parent, const std::string& xml) {
  if (parent.empty_tag) {
    const std::size_t slash = text_.rfind('/', parent.end - 1);
    edits_.push_back({slash, parent.end, ">" + xml + "</" + parent.name + ">"});
    return;
  }
  if (parent.children.empty()) {
    edits_.push_back({parent.inner_end, parent.inner_end, xml});
    return;
  }
  const XmlSpan& last = parent.children.back();
  edits_.push_back({last.end, last.end, "\n" + indent_of(last.begin) + xml});
}

void XmlEdits::add_before(const XmlSpan& element, const std::string& xml) {
  edits_.push_back({element.begin, element.begin, xml + "\n" + indent_of(element.begin)});
}

std::string XmlEdits::result() const {
  std::vector<Edit> ordered = edits_;
  std::stable_sort(ordered.begin(), ordered.end(),
                   [](const Edit& a, const Edit& b) { return a.begin < b.begin; });
  std::string made;
  std::size_t kept = 0;
  for (const Edit& e : ordered) {
    made += text_.substr(kept, e.begin - kept) + e.text;
    kept = e.end;
  }
  return made + text_.substr(kept);
}

}  // namespace sluice
