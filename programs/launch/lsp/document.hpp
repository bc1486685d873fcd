// SPDX-License-Identifier: Apache-2.0
// A text in an editor, with the positions of the Language Server Protocol: lines from 0, and UTF-16 units from 0. A
// line ends with LF, CR LF or CR.
#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace launch::lsp {

using Json = nlohmann::json;

class Document {
 public:
  explicit Document(std::string text);

  const std::string& text() const { return text_; }

  // {"line": …, "character": …} of a byte, and the byte of a position. What lies outside is moved inside.
  Json position(std::size_t offset) const;
  std::size_t offset(const Json& position) const;
  // The same for a column in characters, as Python counts.
  std::size_t offset_of_character(std::size_t line, std::size_t character) const;
  Json range(std::size_t begin, std::size_t end) const;

  // One item of contentChanges: the whole text, or what stands in place of a range. Throws Json::exception.
  void change(const Json& change);

 private:
  std::string text_;
  std::vector<std::size_t> line_starts_;
};

// "file:///a%20b" and the path; "" when it is no file.
std::string path_of(std::string_view uri);
std::string uri_of(std::string_view path);

}  // namespace launch::lsp
