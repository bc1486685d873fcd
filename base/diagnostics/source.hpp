// SPDX-License-Identifier: Apache-2.0
// Where a piece of text stands in a launch file.
//
// Every Entity, attribute value and template fragment carries a SourceRange, so that errors of any phase can point at
// the line that asked for it. A range holds byte offsets into the kept text of its file; lines and columns are
// computed when a diagnostic is rendered.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace launch {

class SourceFile;

// Bytes [begin, end) of a file. `file` is null for text that comes from no file (the command line).
struct SourceRange {
  std::shared_ptr<const SourceFile> file;
  std::uint32_t begin = 0;
  std::uint32_t end = 0;

  explicit operator bool() const { return file != nullptr; }
};

// The text of one launch file, kept for as long as anything points into it.
class SourceFile {
 public:
  // Line and column, both from 1; columns count characters (UTF-8 code points), not bytes.
  struct Position {
    std::uint32_t line = 1;
    std::uint32_t column = 1;
  };

  // `included_from` is the place of the include that loaded this file, empty for a file given by the user. Throws
  // std::length_error when the text is larger than 4 GiB.
  SourceFile(std::string path, std::string text, SourceRange included_from = {});

  const std::string& path() const { return path_; }
  const std::string& text() const { return text_; }
  const SourceRange& included_from() const { return included_from_; }

  Position position(std::size_t offset) const;
  // The text of a line (from 1) without its line end.
  std::string_view line(std::uint32_t number) const;

 private:
  std::string path_;
  std::string text_;
  SourceRange included_from_;
  // The characters before this byte of the text.
  std::uint32_t characters_before(std::size_t offset) const;

  std::vector<std::uint32_t> line_starts_;
  std::vector<std::uint32_t> block_characters_;  // before each block of 4,096 bytes: a line may be as long as the file
};

// "file:line:column" of the start of a range, for a person: a file below the working directory is named from there.
// "command line" when it has no file.
std::string to_string(const SourceRange& range);

// The same for another program, or for later: with the path as it is.
std::string place_with_path(const SourceRange& range);

// Text as the parser decoded it (entities and quoting resolved), able to say where each of its bytes came from.
class LocatedText {
 public:
  LocatedText() = default;
  // Text that is in the file exactly as it is here (or comes from no file).
  explicit LocatedText(std::string text, SourceRange range = {});

  // Appends decoded bytes that came from [raw_begin, raw_end) of the file.
  void append(std::string_view decoded, std::uint32_t raw_begin, std::uint32_t raw_end);

  const std::string& text() const { return text_; }
  const SourceRange& range() const { return range_; }
  // The range in the file of bytes [position, position + length) of text().
  SourceRange range(std::size_t position, std::size_t length) const;

 private:
  // Decoded bytes from `decoded` on come from the file's bytes from `raw` on, up to the next anchor. `verbatim` is
  // false if the raw bytes are more or fewer than the decoded bytes, as for an entity or an escape. Without anchors
  // the whole text is verbatim.
  struct Anchor {
    std::uint32_t decoded;
    std::uint32_t raw_begin;
    std::uint32_t raw_end;
    bool verbatim;
  };

  std::string text_;
  SourceRange range_;
  std::vector<Anchor> anchors_;
};

}  // namespace launch
