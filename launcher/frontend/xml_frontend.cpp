// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <tinyxml2.h>

#include <algorithm>
#include <string>
#include <string_view>
#include <utility>

#include "base/text/utf8.hpp"
#include "launcher/frontend/frontend.hpp"
#include "launcher/frontend/xml_scan.hpp"

namespace launch {

namespace {

constexpr std::string_view kDecoded = "&\t\r\n";

// `raw` begins with one of kDecoded. Returns how many of its bytes stand for one character.
std::size_t size_of_decoded(std::string_view raw) {
  if (raw.front() == '&') {
    return raw.find(';') + 1;
  }
  return raw.starts_with("\r\n") ? 2 : 1;
}

// `decoded` is the value that tinyxml2 reads at `where`, with references resolved and line ends as "\n". In the result,
// each literal tab and line end is a space: XML demands it, and tinyxml2 does not do it. A "&#10;" stays a line end.
LocatedText locate_value(const SourceRange& where, std::string_view decoded, const XmlEntities& entities) {
  const std::string_view raw = std::string_view(where.file->text()).substr(where.begin, where.end - where.begin);
  if (raw == decoded && raw.find_first_of(kDecoded) == std::string_view::npos) {
    return LocatedText(std::string(decoded), where);
  }
  LocatedText value({}, {where.file, where.begin, where.begin});
  for (std::size_t at = 0; at < raw.size();) {
    const auto entity = raw[at] == '&' && !entities.empty()
                            ? entities.find(raw.substr(at + 1, raw.find(';', at) - at - 1))
                            : entities.end();
    if (entity != entities.end()) {  // tinyxml2 leaves the reference as it is
      const std::size_t size = entity->first.size() + 2;
      const auto begin = where.begin + static_cast<std::uint32_t>(at);
      value.append(entity->second, begin, begin + static_cast<std::uint32_t>(size));
      decoded.remove_prefix(std::min(size, decoded.size()));
      at += size;
      continue;
    }
    const bool is_verbatim = kDecoded.find(raw[at]) == std::string_view::npos;
    const std::size_t raw_size =
        is_verbatim ? std::min(raw.find_first_of(kDecoded, at), raw.size()) - at : size_of_decoded(raw.substr(at));
    const std::size_t size = is_verbatim ? raw_size : decoded.empty() ? 1 : decode_utf8(decoded).size;
    const std::string_view text = decoded.substr(0, size);
    if (text.size() < size || (is_verbatim && text != raw.substr(at, raw_size))) {
      throw LaunchError("the XML parser reads this value otherwise than it is written", where);
    }
    const auto begin = where.begin + static_cast<std::uint32_t>(at);
    value.append(!is_verbatim && raw[at] != '&' ? " " : text, begin, begin + static_cast<std::uint32_t>(raw_size));
    decoded.remove_prefix(size);
    at += raw_size;
  }
  return value;
}

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

// Makes entities of the elements of tinyxml2. It keeps one copy of the text, and its names and values are parts of this
// copy. So they tell their places.
class XmlEntityBuilder {
 public:
  XmlEntityBuilder(const XmlScan& scan, const tinyxml2::XMLElement& root)
      : file_(scan.file),
        entities_(scan.entities),
        text_(file_->text()),
        copy_(root.Name() - (scan.root.data() - text_.data())) {}

  Entity build(const tinyxml2::XMLElement& element) const {
    Entity entity;
    entity.type_name = element.Name();
    entity.where = place_of_name(element.Name());
    entity.attributes.reserve(count_attributes(element));
    for (const auto* attribute = element.FirstAttribute(); attribute != nullptr; attribute = attribute->Next()) {
      add(entity, *attribute);
    }
    entity.children.reserve(count_children(element));
    for (const auto* child = element.FirstChildElement(); child != nullptr; child = child->NextSiblingElement()) {
      entity.children.push_back(build(*child));
    }
    return entity;
  }

 private:
  SourceRange range(std::size_t begin, std::size_t end) const {
    return {file_, static_cast<std::uint32_t>(begin), static_cast<std::uint32_t>(end)};
  }

  SourceRange place_of_name(std::string_view name) const {
    const auto begin = static_cast<std::size_t>(name.data() - copy_);
    if (begin >= text_.size() || text_.substr(begin, name.size()) != name) {
      throw LaunchError(fmt::format("the XML parser reads '{}' where none was found", name), range(0, 0));
    }
    return range(begin, begin + name.size());
  }

  void add(Entity& entity, const tinyxml2::XMLAttribute& attribute) const {
    const std::string_view name = attribute.Name();
    // Namespace declarations are not attributes.
    if (name == "xmlns" || name.starts_with("xmlns:")) {
      return;
    }
    SourceRange name_where = place_of_name(name);
    const std::string_view decoded = attribute.Value();
    const auto begin = static_cast<std::size_t>(decoded.data() - copy_);
    SourceRange where = range(begin, text_.find(text_[begin - 1], begin));  // up to the other quote
    Scalar scalar{.text = locate_value(where, decoded, entities_)};
    if (where.begin == where.end) {  // errors point at the quotes of an empty value
      --where.begin;
      ++where.end;
    }
    entity.attributes.push_back({std::string(name), std::move(name_where), {std::move(scalar), std::move(where)}});
  }

  const std::shared_ptr<const SourceFile>& file_;
  const XmlEntities& entities_;
  const std::string_view text_;
  const char* const copy_;  // the first character in the copy of tinyxml2
};

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
  XmlScan scan = scan_xml(file);
  tinyxml2::XMLDocument document;
  document.Parse(scan.readable.data(), scan.readable.size());
  if (scan.errors.empty() && document.Error()) {
    scan.errors.push_back(refusal(document, scan.file));
  }
  if (!scan.root.empty() && scan.root != "launch") {
    const auto begin = static_cast<std::uint32_t>(scan.root.data() - scan.file->text().data());
    const SourceRange where{scan.file, begin, begin + static_cast<std::uint32_t>(scan.root.size())};
    scan.errors.insert(scan.errors.begin(),
                       {Severity::kError, fmt::format("expected 'launch' as root tag, found '{}'", scan.root), where,
                        "a launch file is <launch> ... </launch>"});
  }
  if (!scan.errors.empty()) {
    throw LaunchError(std::move(scan.errors));
  }
  const tinyxml2::XMLElement& root = *document.RootElement();
  return XmlEntityBuilder(scan, root).build(root);
}

}  // namespace launch
