// SPDX-License-Identifier: Apache-2.0
// Resolves the merge keys of YAML 1.1 mappings, and finds keys that are given twice.
#pragma once

#include <vector>

#include "base/diagnostics/diagnostic.hpp"
#include "launcher/frontend/yaml_node.hpp"

namespace launch {

// Replaces each entry `<<: MAPPING` by the entries of MAPPING. Keys of the mapping itself take precedence over merged
// keys. Earlier merged mappings take precedence over later ones. A key that is given twice is an error here, although
// yaml-cpp and PyYAML accept it.
void resolve_merge_keys(YamlNode& mapping, std::vector<Diagnostic>& errors);

}  // namespace launch
