// SPDX-License-Identifier: Apache-2.0
// Reads YAML text into a plain tree, as PyYAML's safe loader does: YAML 1.1 types, aliases and merge keys resolved.
#pragma once

#include <functional>
#include <string_view>
#include <vector>

#include "launcher/base/diagnostic.hpp"
#include "launcher/frontend/yaml_node.hpp"

namespace launch {

// The list that is the value of the document's first key, when that key is `key`. Each item is handed over as soon as
// it is read, may be taken apart, and makes room for the next, so that a long list costs the memory of one item. In the
// document the list is then empty.
struct YamlListReader {
  std::string_view key;
  std::function<void(YamlNode& item)> take;
};

// Throws LaunchError for a syntax error; what was handed over before does not count then. Other faults (duplicate keys)
// are added to `errors`.
YamlNode read_yaml(const LocatedText& source, std::vector<Diagnostic>& errors, const YamlListReader& list = {});

}  // namespace launch
