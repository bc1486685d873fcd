// SPDX-License-Identifier: Apache-2.0
// What a mapping of YAML 1.1 comes to: merge keys resolved, no key twice.
#pragma once

#include <vector>

#include "launcher/base/diagnostic.hpp"
#include "launcher/frontend/yaml_node.hpp"

namespace launch {

// Replaces each entry `<<: MAPPING` by the entries of that mapping. Keys of the mapping itself win over merged ones,
// earlier merged mappings over later ones. A key that is given twice is an error, which yaml-cpp and PyYAML let pass.
void resolve_merge_keys(YamlNode& mapping, std::vector<Diagnostic>& errors);

}  // namespace launch
