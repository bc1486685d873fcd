// SPDX-License-Identifier: Apache-2.0
// Reads YAML that is written the ordinary way, many times faster than yaml-cpp.
#pragma once

#include <functional>
#include <optional>
#include <string_view>

#include "launcher/frontend/yaml_document.hpp"

namespace launch {

// The tree that read_yaml() makes of the text, or nothing when the text holds anything out of the ordinary: an error,
// texts over several lines, anchors, tags, empty values, keys given twice. yaml-cpp then has the word. Ordinary are
// block and flow collections, plain and quoted texts of one line, comments.
std::optional<YamlNode> read_simple_yaml(const LocatedText& source);

// The same for a text that is nothing but the key `name` with a block list. Each item is handed over as soon as it is
// read, may be taken apart, and makes room for the next: a long list costs the memory of one item. Gives the key, or
// nothing; what was handed over before does not count then.
std::optional<YamlNode> read_simple_yaml_list(const LocatedText& source, std::string_view name,
                                              const std::function<void(YamlNode& item)>& take);

}  // namespace launch
