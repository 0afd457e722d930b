#pragma once
// A small reader of XML for tests: holds a document against the rules of well-formedness that matter for our pictures.

#include <cctype>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace espalier::testing {

struct XmlElement {
  std::string name, text;  // text: what stands in it, entities resolved, elements inside left out
  std::map<std::string, std::string> attributes;
};

struct XmlDocument {
  std::string fault;  // empty: well-formed
  std::vector<XmlElement> elements;

  std::vector<const XmlElement*> named(const std::string& name) const {
    std::vector<const XmlElement*> found;
    for (const XmlElement& e : elements)
      if (e.name == name) found.push_back(&e);
    return found;
  }
  std::multiset<std::string> texts(const std::string& name = "text") const {
    std::multiset<std::string> found;
    for (const XmlElement* e : named(name)) found.insert(e->text);
    return found;
  }
};

inline bool resolve_entities(std::string& text) {
  static const std::map<std::string, std::string> kEntities = {
      {"amp", "&"}, {"lt", "<"}, {"gt", ">"}, {"quot", "\""}, {"apos", "'"}};
  std::string out;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const unsigned char c = static_cast<unsigned char>(text[i]);
    if (c < 0x20 && c != '\n' && c != '\t') return false;
    if (text[i] == '<') return false;
    if (text[i] != '&') {
      out += text[i];
      continue;
    }
    const std::size_t end = text.find(';', i);
    if (end == std::string::npos || !kEntities.contains(text.substr(i + 1, end - i - 1))) return false;
    out += kEntities.at(text.substr(i + 1, end - i - 1));
    i = end;
  }
  text = out;
  return true;
}

inline XmlDocument read_xml(const std::string& xml) {
  XmlDocument doc;
  std::vector<std::size_t> open;
  std::size_t at = 0, roots = 0;
  const auto fail = [&](const std::string& what) {
    doc.fault = what + " at byte " + std::to_string(at);
    return doc;
  };
  if (xml.starts_with("<?xml")) at = xml.find("?>") + 2;
  while (at < xml.size()) {
    if (xml[at] != '<') {
      const std::size_t end = std::min(xml.find('<', at), xml.size());
      std::string text = xml.substr(at, end - at);
      if (!resolve_entities(text)) return fail("bad text");
      if (!open.empty()) doc.elements[open.back()].text += text;
      else if (text.find_first_not_of("\n ") != std::string::npos) return fail("text outside the root");
      at = end;
      continue;
    }
    if (xml.compare(at, 2, "</") == 0) {
      const std::size_t end = xml.find('>', at);
      if (end == std::string::npos || open.empty()) return fail("stray end");
      if (doc.elements[open.back()].name != xml.substr(at + 2, end - at - 2)) return fail("wrong end");
      open.pop_back();
      at = end + 1;
      continue;
    }
    XmlElement element;
    for (++at; at < xml.size() && std::isalpha(static_cast<unsigned char>(xml[at])); ++at) element.name += xml[at];
    if (element.name.empty()) return fail("no name");
    while (at < xml.size() && xml[at] == ' ') {
      std::string name;
      for (++at; at < xml.size() && (std::isalnum(static_cast<unsigned char>(xml[at])) || xml[at] == '-'); ++at)
        name += xml[at];
      if (xml.compare(at, 2, "=\"") != 0) return fail("no value of " + name);
      const std::size_t end = xml.find('"', at + 2);
      if (end == std::string::npos) return fail("no end of " + name);
      std::string value = xml.substr(at + 2, end - at - 2);
      if (!resolve_entities(value)) return fail("bad value of " + name);
      if (!element.attributes.emplace(name, value).second) return fail(name + " twice");
      at = end + 1;
    }
    const bool closed = xml.compare(at, 2, "/>") == 0;
    if (!closed && xml[at] != '>') return fail("bad tag");
    at += closed ? 2 : 1;
    if (open.empty() && ++roots > 1) return fail("second root");
    doc.elements.push_back(element);
    if (!closed) open.push_back(doc.elements.size() - 1);
  }
  if (!open.empty() || roots != 1) return fail("no end of the document");
  return doc;
}

}  // namespace espalier::testing
