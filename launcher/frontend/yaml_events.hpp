// SPDX-License-Identifier: Apache-2.0
// The events that yaml-cpp finds in a text, in order.
//
// All events are stored, and the tree is built afterwards. To build the tree while yaml-cpp reads takes twice the time,
// because the code of both does not fit into the first-level cache of a processor.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/diagnostics/diagnostic.hpp"

namespace launch {

struct YamlEvent {
  enum class Kind : std::uint8_t { kNull, kScalar, kAlias, kSequence, kMapping, kEnd /* of the collection */ };

  Kind kind = Kind::kNull;
  bool is_flow = false;    // a collection in brackets
  bool is_plain = false;   // a scalar without quotes or tag
  std::uint32_t at = 0;    // byte of the source where the node begins
  std::uint32_t text = 0;  // where the text of a scalar begins in YamlEvents::texts
  std::uint32_t tag = 0;   // where the tag of a node begins in `texts`, which is the end of its text
  std::uint32_t tag_end = 0;
  std::size_t anchor = 0;  // the anchor of the node, or of the node that an alias refers to; 0: none
};

struct YamlEvents {
  std::string_view text(const YamlEvent& event) const { return view(event.text, event.tag); }
  std::string_view tag(const YamlEvent& event) const { return view(event.tag, event.tag_end); }

  std::vector<YamlEvent> list;
  std::string texts;

 private:
  std::string_view view(std::size_t begin, std::size_t end) const {
    return std::string_view(texts).substr(begin, end - begin);
  }
};

struct YamlStream {
  YamlEvents document;
  YamlEvents second_document;  // an error in a launch file
  // The reason why yaml-cpp gave up after the last event.
  std::optional<Diagnostic> error;
};

YamlStream read_yaml_events(const LocatedText& source);

}  // namespace launch
