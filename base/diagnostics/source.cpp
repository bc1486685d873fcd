// SPDX-License-Identifier: Apache-2.0
#include "base/diagnostics/source.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <limits>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "base/text/utf8.hpp"

namespace launch {

namespace {

// The path from the working directory if it is below it.
std::string_view shown_path(std::string_view path) {
  std::error_code unknown;
  const std::string here = std::filesystem::current_path(unknown).string() + "/";
  return here != "//" && path.starts_with(here) ? path.substr(here.size()) : path;
}

std::string place(const SourceRange& range, std::string_view path) {
  const SourceFile::Position position = range.file->position(range.begin);
  return fmt::format("{}:{}:{}", path, position.line, position.column);
}

constexpr std::size_t kBlock = 4096;

std::uint32_t count_characters(std::string_view text) {
  return static_cast<std::uint32_t>(
      std::count_if(text.begin(), text.end(), [](char byte) { return !is_continuation_byte(byte); }));
}

}  // namespace

SourceFile::SourceFile(std::string path, std::string text, SourceRange included_from)
    : path_(std::move(path)), text_(std::move(text)), included_from_(std::move(included_from)) {
  if (text_.size() > std::numeric_limits<std::uint32_t>::max()) {
    throw std::length_error(fmt::format("'{}' is larger than 4 GiB", path_));
  }
  line_starts_.push_back(0);
  for (std::size_t end = text_.find_first_of("\r\n"); end != std::string::npos;
       end = text_.find_first_of("\r\n", end + 1)) {
    if (text_[end] == '\r' && end + 1 < text_.size() && text_[end + 1] == '\n') {
      ++end;
    }
    line_starts_.push_back(static_cast<std::uint32_t>(end + 1));
  }
  std::uint32_t characters = 0;
  for (std::size_t begin = 0; begin <= text_.size(); begin += kBlock) {
    block_characters_.push_back(characters);
    characters += count_characters(std::string_view(text_).substr(begin, kBlock));
  }
}

std::uint32_t SourceFile::characters_before(std::size_t offset) const {
  const std::size_t block = offset / kBlock;
  return block_characters_[block] + count_characters(std::string_view(text_).substr(block * kBlock, offset % kBlock));
}

SourceFile::Position SourceFile::position(std::size_t offset) const {
  offset = std::min(offset, text_.size());
  const auto next = std::upper_bound(line_starts_.begin(), line_starts_.end(), offset);
  const std::uint32_t start = *std::prev(next);
  return {static_cast<std::uint32_t>(next - line_starts_.begin()),
          characters_before(offset) - characters_before(start) + 1};
}

std::string_view SourceFile::line(std::uint32_t number) const {
  if (number == 0 || number > line_starts_.size()) {
    return {};
  }
  const std::uint32_t begin = line_starts_[number - 1];
  std::size_t end = number < line_starts_.size() ? line_starts_[number] - 1 : text_.size();
  if (end > begin && text_[end - 1] == '\r') {
    --end;
  }
  return std::string_view(text_).substr(begin, end - begin);
}

std::string to_string(const SourceRange& range) {
  return range ? place(range, shown_path(range.file->path())) : "command line";
}

std::string place_with_path(const SourceRange& range) {
  return range ? place(range, range.file->path()) : "command line";
}

}  // namespace launch
