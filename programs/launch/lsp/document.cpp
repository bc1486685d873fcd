// SPDX-License-Identifier: Apache-2.0
#include "programs/launch/lsp/document.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstdint>

#include "base/text/utf8.hpp"

namespace launch::lsp {

namespace {

std::vector<std::size_t> line_starts_of(std::string_view text) {
  std::vector<std::size_t> starts = {0};
  for (std::size_t end = text.find_first_of("\r\n"); end != std::string_view::npos;
       end = text.find_first_of("\r\n", end + 1)) {
    end += text.substr(end, 2) == "\r\n" ? 1 : 0;
    starts.push_back(end + 1);
  }
  return starts;
}

std::size_t utf16_units(char32_t character) {
  return character > 0xFFFF ? 2 : 1;
}

}  // namespace

Document::Document(std::string text) : text_(std::move(text)), line_starts_(line_starts_of(text_)) {}

Json Document::position(std::size_t offset) const {
  offset = std::min(offset, text_.size());
  const auto next = std::upper_bound(line_starts_.begin(), line_starts_.end(), offset);
  std::size_t units = 0;
  for (std::size_t at = *std::prev(next); at < offset;) {
    const CodePoint point = decode_utf8(std::string_view(text_).substr(at));
    units += utf16_units(point.value);
    at += point.size;
  }
  return {{"line", next - line_starts_.begin() - 1}, {"character", units}};
}

std::size_t Document::offset(const Json& position) const {
  const auto line = position.at("line").get<std::size_t>();
  auto units = position.at("character").get<std::size_t>();
  if (line >= line_starts_.size()) {
    return text_.size();
  }
  std::size_t at = line_starts_[line];
  while (units > 0 && at < text_.size() && text_[at] != '\n' && text_[at] != '\r') {
    const CodePoint point = decode_utf8(std::string_view(text_).substr(at));
    units -= std::min(units, utf16_units(point.value));
    at += point.size;
  }
  return at;
}

std::size_t Document::offset_of_character(std::size_t line, std::size_t character) const {
  std::size_t at = line < line_starts_.size() ? line_starts_[line] : text_.size();
  for (; character > 0 && at < text_.size() && text_[at] != '\n' && text_[at] != '\r'; --character) {
    at += decode_utf8(std::string_view(text_).substr(at)).size;
  }
  return at;
}

Json Document::range(std::size_t begin, std::size_t end) const {
  return {{"start", position(begin)}, {"end", position(std::max(begin, end))}};
}

void Document::change(const Json& change) {
  const auto& text = change.at("text").get_ref<const std::string&>();
  if (!change.contains("range")) {
    text_ = text;
  } else {
    const std::size_t begin = offset(change.at("range").at("start"));
    const std::size_t end = std::max(begin, offset(change.at("range").at("end")));
    text_.replace(begin, end - begin, text);
  }
  line_starts_ = line_starts_of(text_);
}

std::string path_of(std::string_view uri) {
  constexpr std::string_view kFile = "file://";
  if (!uri.starts_with(kFile)) {
    return {};
  }
  uri.remove_prefix(std::min(uri.find('/', kFile.size()), uri.size()));
  std::string path;
  for (std::size_t i = 0; i < uri.size(); ++i) {
    std::uint8_t byte = 0;
    if (uri[i] == '%' && i + 2 < uri.size() &&
        std::from_chars(uri.data() + i + 1, uri.data() + i + 3, byte, 16).ptr == uri.data() + i + 3) {
      path += static_cast<char>(byte);
      i += 2;
    } else {
      path += uri[i];
    }
  }
  return path;
}

std::string uri_of(std::string_view path) {
  constexpr std::string_view kPlain = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-._~/";
  std::string uri = "file://";
  for (const char byte : path) {
    uri += kPlain.find(byte) != std::string_view::npos ? std::string(1, byte)
                                                       : fmt::format("%{:02X}", static_cast<unsigned char>(byte));
  }
  return uri;
}

}  // namespace launch::lsp
