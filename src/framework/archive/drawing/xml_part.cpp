// Through libxml2's writer, into memory.
#include "framework/archive/drawing/xml_part.hpp"

#include <libxml/xmlwriter.h>

#include <memory>

namespace sluice {
namespace {

const xmlChar* as_xml(const std::string& s) {
  return reinterpret_cast<const xmlChar*>(s.c_str());
}

bool write(xmlTextWriter* writer, const XmlElement& element) {
  bool good = xmlTextWriterStartElement(writer, as_xml(element.name)) >= 0;
  for (const auto& [name, value] : element.attributes)
    good = good && xmlTextWriterWriteAttribute(writer, as_xml(name), as_xml(value)) >= 0;
  if (!element.text.empty())
    good = good && xmlTextWriterWriteString(writer, as_xml(element.text)) >= 0;
  for (const XmlElement& child : element.children) good = good && write(writer, child);
  return good && xmlTextWriterEndElement(writer) >= 0;
}

}  // namespace

std::string to_part(const XmlElement& element) {
  const std::unique_ptr<xmlBuffer, decltype(&xmlBufferFree)> buffer(xmlBufferCreate(),
                                                                    xmlBufferFree);
  const std::unique_ptr<xmlTextWriter, decltype(&xmlFreeTextWriter)> writer(
      buffer ? xmlNewTextWriterMemory(buffer.get(), 0) : nullptr, xmlFreeTextWriter);
  if (!writer || !write(writer.get(), element) || xmlTextWriterFlush(writer.get()) < 0)
    throw SystemError("cannot write <" + element.name + "> as XML: out of memory");
  return reinterpret_cast<const char*>(xmlBufferContent(buffer.get()));
}

}  // namespace sluice
