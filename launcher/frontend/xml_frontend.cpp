// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <tinyxml2.h>

#include <algorithm>
#include <string>
#include <string_view>
#include <utility>

#include "launcher/frontend/frontend.hpp"
#include "launcher/frontend/read_xml_markup.hpp"
#include "launcher/frontend/xml_nesting.hpp"
#include "launcher/frontend/xml_value.hpp"

namespace launch {

namespace {

std::size_t count_attributes(const tinyxml2::XMLElement& element) {
  std::size_t count = 0;
  for (const auto* attribute = element.FirstAttribute(); attribute != nullptr; attribute = attribute->Next()) {
    ++count;
  }
  return count;
}

std::size_t count_children(const tinyxml2::XMLElement& element) {
  std::size_t count = 0;
  for (const auto* child = element.FirstChildElement(); child != nullptr; child = child->NextSiblingElement()) {
    ++count;
  }
  return count;
}

// Makes entities of the elements of tinyxml2, and adds their places. Elements and places are both in document order.
class XmlEntityBuilder {
 public:
  explicit XmlEntityBuilder(const XmlMarkup& markup) : markup_(markup) {}

  Entity build(const tinyxml2::XMLElement& element) {
    Entity entity;
    entity.type_name = element.Name();
    entity.where = next(markup_.tags, next_tag_, entity.type_name);
    entity.attributes.reserve(count_attributes(element));
    for (const auto* attribute = element.FirstAttribute(); attribute != nullptr; attribute = attribute->Next()) {
      add(entity, attribute->Name(), attribute->Value());
    }
    entity.children.reserve(count_children(element));
    for (const auto* child = element.FirstChildElement(); child != nullptr; child = child->NextSiblingElement()) {
      entity.children.push_back(build(*child));
    }
    return entity;
  }

 private:
  SourceRange range(XmlSpan span) const { return {markup_.file, span.begin, span.end}; }

  // The next place. `name` must stand there.
  SourceRange next(const std::vector<XmlSpan>& places, std::size_t& index, std::string_view name) const {
    if (index == places.size() || markup_.view(places[index]) != name) {
      throw LaunchError(fmt::format("the XML parser reads '{}' where none was found", name), {markup_.file, 0, 0});
    }
    return range(places[index++]);
  }

  void add(Entity& entity, std::string_view name, std::string_view value) {
    const std::size_t index = next_attribute_;
    SourceRange name_where = next(markup_.attribute_names, next_attribute_, name);
    // Namespace declarations are not attributes.
    if (name == "xmlns" || name.starts_with("xmlns:")) {
      return;
    }
    SourceRange where = range(markup_.attribute_values[index]);
    Scalar scalar{.text = locate_xml_value(where, value)};
    if (where.begin == where.end) {  // errors point at the quotes of an empty value
      --where.begin;
      ++where.end;
    }
    entity.attributes.push_back({std::string(name), std::move(name_where), {std::move(scalar), std::move(where)}});
  }

  const XmlMarkup& markup_;
  std::size_t next_tag_ = 0;
  std::size_t next_attribute_ = 0;
};

// The text of the file, with blanks in place of the parts that tinyxml2 can't read.
std::string readable_text(const XmlMarkup& markup) {
  std::string text = markup.file->text();
  for (const XmlSpan& hidden : markup.hidden) {
    std::replace_if(
        text.begin() + hidden.begin, text.begin() + hidden.end, [](char c) { return c != '\n'; }, ' ');
  }
  // tinyxml2 takes "\n\r" for one line end. In XML it is two line ends.
  for (std::size_t at = text.find("\n\r"); at != std::string::npos; at = text.find("\n\r", at + 1)) {
    text[at + 1] = text.compare(at + 2, 1, "\n") == 0 ? '\r' : '\n';
  }
  return text;
}

// The error if tinyxml2 refuses a file and no other check has found the cause.
Diagnostic refusal(const tinyxml2::XMLDocument& document, const std::shared_ptr<const SourceFile>& file) {
  const auto line = static_cast<std::uint32_t>(std::max(document.ErrorLineNum(), 1));
  const std::string_view text = file->line(line);
  const auto begin = static_cast<std::uint32_t>(text.empty() ? 0 : text.data() - file->text().data());
  return {Severity::kError,
          fmt::format("the XML can't be read: {}", document.ErrorName()),
          {file, begin, begin + static_cast<std::uint32_t>(text.size())},
          {}};
}

}  // namespace

Entity parse_xml(const std::shared_ptr<const SourceFile>& file) {
  XmlMarkup markup = read_xml_markup(file);
  tinyxml2::XMLDocument document;
  const std::string text = readable_text(markup);
  document.Parse(text.data(), text.size());
  if (!markup.errors.empty() || document.Error() || markup.is_doubtful) {
    XmlNesting nesting;
    markup = read_xml_markup(file, &nesting);
    if (markup.errors.empty() && document.Error()) {
      markup.errors.push_back(refusal(document, markup.file));
    }
  }
  if (!markup.tags.empty()) {
    const XmlSpan root = markup.tags.front();
    const std::string_view name = markup.view(root);
    if (name != "launch") {
      markup.errors.insert(markup.errors.begin(), {Severity::kError,
                                                   fmt::format("expected 'launch' as root tag, found '{}'", name),
                                                   {markup.file, root.begin, root.end},
                                                   "a launch file is <launch> ... </launch>"});
    }
  }
  if (!markup.errors.empty()) {
    throw LaunchError(std::move(markup.errors));
  }
  return XmlEntityBuilder(markup).build(*document.RootElement());
}

}  // namespace launch
