// Where the elements of an XML text begin and end, and edits there that keep every other byte.
#pragma once
#include <cstddef>
#include <initializer_list>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace sluice {

struct XmlValueSpan {
  std::string name, value;
  std::size_t begin = 0, end = 0;  // of the value, between its quotes
};

struct XmlSpan {
  std::string name;
  std::size_t begin = 0, end = 0;              // from < of the start tag to behind the end tag
  std::size_t inner_begin = 0, inner_end = 0;  // between the tags; equal to `end` if there is one
  bool empty_tag = false;                      // <a/>
  std::vector<XmlValueSpan> attributes;
  std::vector<XmlSpan> children;

  const XmlSpan* child(const std::string& name) const;
  const XmlSpan* find(std::initializer_list<std::string> path) const;
  std::optional<XmlValueSpan> attribute(const std::string& name) const;
};

// The root of a well-formed text. Throws InputError where it is none.
XmlSpan xml_elements(const std::string& text);

// Collects edits of one text.
class XmlEdits {
 public:
  explicit XmlEdits(const std::string& text) : text_(text) {}
  void set_attribute(const XmlValueSpan& attribute, const std::string& value);
  // Blanks and comments around the old text stay.
  void set_text(const XmlSpan& element, const std::string& value);
  // On a line of its own behind the last child, indented as that is.
  void add_child(const XmlSpan& parent, const std::string& xml);
  // On a line of its own before it, indented as it is.
  void add_before(const XmlSpan& element, const std::string& xml);
  std::string result() const;

 private:
  struct Edit {
    std::size_t begin, end;
    std::string text;
  };
  std::string indent_of(std::size_t place) const;

  const std::string& text_;
  std::vector<Edit> edits_;
};

}  // namespace sluice
