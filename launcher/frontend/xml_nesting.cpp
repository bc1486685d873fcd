// SPDX-License-Identifier: Apache-2.0
#include "launcher/frontend/xml_nesting.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace launch {

void XmlNesting::text_outside(XmlCursor& cursor, std::size_t begin, std::size_t end) {
  const std::string_view run = cursor.text.substr(begin, end - begin);
  const std::size_t first = run.find_first_not_of(kXmlBlanks);
  if (first != std::string_view::npos) {
    const std::size_t last = std::min(run.find('\n', first), run.find_last_not_of(kXmlBlanks) + 1);
    cursor.error("text outside the root element", begin + first, begin + last,
                 "remove it, or make it a comment: <!-- ... -->");
  }
}

void XmlNesting::begin_start_tag(XmlCursor& cursor, XmlSpan name) {
  if (open_.empty() && std::exchange(has_root_, true)) {
    cursor.error(fmt::format("a second root element <{}>", cursor.markup.view(name)), name.begin, name.end,
                 "an XML file has one root element; put this one inside it");
  }
}

void XmlNesting::end_start_tag(XmlCursor& cursor, std::size_t first_attribute, bool closed) {
  constexpr std::string_view kDeclaration = "xmlns:";
  const XmlSpan name = cursor.markup.tags.back();
  Open element{cursor.markup.view(name), name.begin - 1, {}};
  const std::vector<XmlSpan>& attributes = cursor.markup.attribute_names;
  for (std::size_t i = first_attribute; i < attributes.size(); ++i) {
    const std::string_view attribute = cursor.markup.view(attributes[i]);
    if (attribute.starts_with(kDeclaration)) {
      element.prefixes.push_back(attribute.substr(kDeclaration.size()));
    }
  }
  check_prefix(cursor, element, name);
  for (std::size_t i = first_attribute; i < attributes.size(); ++i) {
    check_prefix(cursor, element, attributes[i]);
  }
  if (closed) {
    last_self_closed_ = std::move(element);
    return;
  }
  open_.push_back(std::move(element));
  if (open_.size() > kMaximumXmlDepth) {
    cursor.fatal(fmt::format("elements are nested more than {} levels deep", kMaximumXmlDepth), name.begin - 1,
                 cursor.position);
  }
}

void XmlNesting::end_tag(XmlCursor& cursor, XmlSpan where) {
  const std::string_view name = cursor.markup.view(where);
  const auto match =
      std::find_if(open_.rbegin(), open_.rend(), [&](const Open& element) { return element.name == name; });
  if (match != open_.rend()) {
    for (; open_.back().name != name; open_.pop_back()) {
      never_closed(cursor, open_.back(),
                   fmt::format("add </{}> before </{}> on line {}", open_.back().name, name, cursor.line(where.begin)));
    }
    open_.pop_back();
  } else if (!open_.empty() && !did_you_mean(name, {std::string(open_.back().name)}).empty()) {
    cursor.error(fmt::format("closing tag </{}> does not match <{}>", name, open_.back().name), where.begin, where.end,
                 fmt::format("<{}> was opened on line {}", open_.back().name, cursor.line(open_.back().begin)));
    open_.pop_back();
  } else {
    const bool already_closed = last_self_closed_ && last_self_closed_->name == name;
    cursor.error(fmt::format("closing tag </{}> without an opening tag", name), where.begin, where.end,
                 already_closed ? fmt::format("the tag <{}> on line {} is already closed by its '/>'", name,
                                              cursor.line(last_self_closed_->begin))
                                : "");
  }
}

void XmlNesting::finish(XmlCursor& cursor) {
  for (; !open_.empty(); open_.pop_back()) {
    never_closed(cursor, open_.back(), fmt::format("add </{}>", open_.back().name));
  }
  if (!has_root_ && cursor.markup.errors.empty()) {
    cursor.error("the file holds no element", cursor.text.size(), cursor.text.size(),
                 "expected <launch> ... </launch>");
  }
}

void XmlNesting::never_closed(XmlCursor& cursor, const Open& element, std::string help) {
  cursor.error(fmt::format("<{}> is never closed", element.name), element.begin,
               element.begin + 1 + element.name.size(), std::move(help));
}

// A name like "a:b" needs xmlns:a on its element or on an enclosing element.
void XmlNesting::check_prefix(XmlCursor& cursor, const Open& element, XmlSpan where) const {
  const std::string_view name = cursor.markup.view(where);
  const std::size_t colon = name.find(':');
  if (colon == std::string_view::npos || name.starts_with("xml:") || name.starts_with("xmlns:")) {
    return;
  }
  const std::string_view prefix = name.substr(0, colon);
  const auto declares = [&](const Open& open) {
    return std::find(open.prefixes.begin(), open.prefixes.end(), prefix) != open.prefixes.end();
  };
  if (!declares(element) && std::none_of(open_.begin(), open_.end(), declares)) {
    cursor.error(fmt::format("the namespace prefix '{}' is not declared", prefix), where.begin, where.end,
                 fmt::format("add xmlns:{}=\"...\" to the element, or drop the prefix", prefix));
  }
}

}  // namespace launch
