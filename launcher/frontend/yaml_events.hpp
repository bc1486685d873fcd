// SPDX-License-Identifier: Apache-2.0
// What yaml-cpp reads in a text: its events, one after the other.
//
// They are kept and made a tree afterwards. Building the tree while yaml-cpp reads takes twice the time, because the
// code of both does not fit into a processor's first cache.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "launcher/base/diagnostic.hpp"

namespace launch {

struct YamlEvent {
  enum class Kind : std::uint8_t { kNull, kScalar, kAlias, kSequence, kMapping, kEnd /* of the collection */ };

  Kind kind = Kind::kNull;
  bool is_flow = false;    // of a collection: in brackets
  bool is_plain = false;   // of a scalar: without quotes or tag
  std::uint32_t at = 0;    // byte of the source where the node begins
  std::uint32_t text = 0;  // of a scalar: where its text begins in YamlEvents::texts
  std::uint32_t tag = 0;   // where its tag begins there: behind its text
  std::uint32_t tag_end = 0;
  std::size_t anchor = 0;  // that the node has or, for an alias, refers to; 0 for none
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
  YamlEvents second_document;  // which a launch file may not have
  // Why yaml-cpp gave up behind the last event.
  std::optional<Diagnostic> error;
};

YamlStream read_yaml_events(const LocatedText& source);

}  // namespace launch
