// SPDX-License-Identifier: Apache-2.0
// The elements of a launch file as they stand in the text, also of a file that is being written and has errors.
//
// The launcher's own readers (launcher/frontend/) refuse what is not well-formed. An editor asks in the middle of a
// word, so this reads what is there, of XML and of the block style of YAML, and takes what is missing as it is.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace launch::lsp {

// Bytes of the text.
struct Span {
  std::size_t begin = 0;
  std::size_t end = 0;

  // An end counts as inside: there the cursor stands behind what has been typed.
  bool holds(std::size_t offset) const { return begin <= offset && offset <= end; }
};

struct OutlineAttribute {
  std::string name;
  Span name_span;
  std::optional<Span> value;  // without quotes
};

struct OutlineElement {
  std::string tag;
  Span tag_span;
  Span head;        // XML: the start tag, without "<" and ">"; YAML: the lines of its attributes
  Span whole;       // with what it holds
  int parent = -1;  // its number in Outline::elements
  std::vector<OutlineAttribute> attributes;

  const OutlineAttribute* find(std::string_view name) const;
};

struct Outline {
  bool yaml = false;
  std::vector<OutlineElement> elements;  // in the order of the text

  // The number of the innermost element that holds the place; -1 for none.
  int element_at(std::size_t offset) const;
};

// By the content, as launch::load_entity_tree() does: XML begins with "<".
Outline outline_of(std::string_view text);

Outline outline_of_xml(std::string_view text);
Outline outline_of_yaml(std::string_view text);

// The value of an attribute as it stands in the text; "" without one.
std::string_view value_of(const OutlineElement& element, std::string_view attribute, std::string_view text);

}  // namespace launch::lsp
