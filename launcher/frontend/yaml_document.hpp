// SPDX-License-Identifier: Apache-2.0
// Reads YAML text into a plain tree. As in PyYAML's safe loader, scalars have the types of YAML 1.1, and aliases and
// merge keys are resolved.
#pragma once

#include <functional>
#include <string_view>
#include <vector>

#include "base/diagnostics/diagnostic.hpp"
#include "launcher/frontend/yaml_node.hpp"

namespace launch {

// Takes the items of the list that is the value of the document's first key, if this key is `key`. Each item is handed
// over as soon as it is read, and may be moved from. The memory of one item suffices for a long list. In the document
// the list is then empty.
struct YamlListReader {
  std::string_view key;
  std::function<void(YamlNode& item)> take;
};

// Throws LaunchError for a syntax error. The items that were handed over before must be dropped then. Other errors, for
// instance duplicate keys, are added to `errors`.
YamlNode read_yaml(const LocatedText& source, std::vector<Diagnostic>& errors, const YamlListReader& list = {});

}  // namespace launch
