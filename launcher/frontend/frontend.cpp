// SPDX-License-Identifier: Apache-2.0
#include "launcher/frontend/frontend.hpp"

#include <string_view>

#include "base/diagnostics/diagnostic.hpp"
#include "launcher/frontend/input_text.hpp"

namespace launch {

namespace {

// XML must begin with "<". No YAML launch file does.
bool looks_like_xml(std::string_view text) {
  if (text.starts_with(kByteOrderMark)) {
    text.remove_prefix(kByteOrderMark.size());
  }
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  return first != std::string_view::npos && text[first] == '<';
}

}  // namespace

Entity load_entity_tree(const std::shared_ptr<const SourceFile>& file) {
  const std::string_view path = file->path();
  // The content decides, not the suffix. Only for an empty file the suffix decides which error is reported.
  const bool blank = file->text().find_first_not_of(" \t\r\n") == std::string::npos;
  const bool xml_suffix = path.ends_with(".xml") || path.ends_with(".launch");
  const bool is_xml = looks_like_xml(file->text()) || (blank && xml_suffix);
  try {
    return is_xml ? parse_xml(file) : parse_yaml(file);
  } catch (LaunchError& error) {
    error.classify(is_xml ? Finding::kMalformedXml : Finding::kMalformedYaml);
    throw;
  }
}

}  // namespace launch
