// SPDX-License-Identifier: Apache-2.0
// Entity trees from text, for the tests of the front ends.
#pragma once

#include <memory>
#include <string>

#include "launcher/frontend/frontend.hpp"

namespace launch {

inline std::shared_ptr<const SourceFile> file_of(std::string path, std::string text) {
  return std::make_shared<const SourceFile>(std::move(path), std::move(text));
}
inline Entity xml(std::string text) {
  return parse_xml(file_of("t.launch.xml", std::move(text)));
}
inline Entity yaml(std::string text) {
  return parse_yaml(file_of("t.launch.yaml", std::move(text)));
}

// The text of the attribute; "(none)" when there is no such attribute.
inline std::string text_of(const Entity& entity, std::string_view name) {
  const Attribute* attribute = entity.find(name);
  return attribute == nullptr ? "(none)" : attribute->value.scalar()->text.text();
}

// The rendered errors of loading a file; empty when it loads.
inline std::string load_error(const std::shared_ptr<const SourceFile>& file) {
  try {
    load_entity_tree(file);
  } catch (const LaunchError& error) {
    return render(error.diagnostics());
  }
  return {};
}

// The bytes of the file that a range covers.
inline std::string raw(const SourceRange& range) {
  return range.file->text().substr(range.begin, range.end - range.begin);
}

}  // namespace launch
