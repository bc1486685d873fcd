// Reads YAML that is written the ordinary way, many times faster than yaml-cpp.
#pragma once

#include <optional>

#include "launcher/frontend/yaml_document.hpp"

namespace launch {

// The tree that read_yaml() makes of the text, or nothing when the text holds anything out of the ordinary: an error,
// texts over several lines, anchors, tags, empty values, keys given twice. yaml-cpp then has the word. Ordinary are
// block and flow collections, plain and quoted texts of one line, comments.
std::optional<YamlNode> read_simple_yaml(const LocatedText& source);

}  // namespace launch
