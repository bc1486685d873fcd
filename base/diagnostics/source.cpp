// SPDX-License-Identifier: Apache-2.0
#include "base/diagnostics/source.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <limits>
#include <stdexcept>
#include <system_error>
#include <utility>

namespace launch {

namespace {

bool is_continuation_byte(char byte) {
  return (static_cast<unsigned char>(byte) & 0xC0U) == 0x80U;
}

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

}  // namespace

SourceFile::SourceFile(std::string path, std::string text, SourceRange included_from)
    : path_(std::move(path)), text_(std::move(text)), included_from_(std::move(included_from)) {
  if (text_.size() > std::numeric_limits<std::uint32_t>::max()) {
    throw std::length_error(fmt::format("'{}' is larger than 4 GiB", path_));
  }
  line_starts_.push_back(0);
  for (std::size_t end = text_.find('\n'); end != std::string::npos; end = text_.find('\n', end + 1)) {
    line_starts_.push_back(static_cast<std::uint32_t>(end + 1));
  }
}

SourceFile::Position SourceFile::position(std::size_t offset) const {
  offset = std::min(offset, text_.size());
  const auto next = std::upper_bound(line_starts_.begin(), line_starts_.end(), offset);
  const std::uint32_t start = *std::prev(next);
  const auto characters = std::count_if(text_.begin() + start, text_.begin() + static_cast<std::ptrdiff_t>(offset),
                                        [](char byte) { return !is_continuation_byte(byte); });
  return {static_cast<std::uint32_t>(next - line_starts_.begin()), static_cast<std::uint32_t>(characters) + 1};
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
