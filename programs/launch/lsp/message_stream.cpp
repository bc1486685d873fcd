// SPDX-License-Identifier: Apache-2.0
#include "programs/launch/lsp/message_stream.hpp"

#include <fmt/format.h>
#include <strings.h>

#include <charconv>
#include <stdexcept>

namespace launch::lsp {

namespace {

constexpr std::size_t kLongestHead = 4096;
constexpr std::size_t kLargestMessage = 256UL << 20U;  // an editor sends whole files

// Throws std::runtime_error.
std::size_t length_of(std::string_view head) {
  constexpr std::string_view kName = "Content-Length:";
  for (std::size_t begin = 0; begin < head.size();) {
    const std::size_t end = std::min(head.find("\r\n", begin), head.size());
    std::string_view line = head.substr(begin, end - begin);
    begin = end + 2;
    if (line.size() < kName.size() || ::strncasecmp(line.data(), kName.data(), kName.size()) != 0) {
      continue;
    }
    line.remove_prefix(kName.size());
    line.remove_prefix(std::min(line.find_first_not_of(' '), line.size()));
    std::size_t length = 0;
    const auto [stop, error] = std::from_chars(line.data(), line.data() + line.size(), length);
    if (error != std::errc() || stop != line.data() + line.size() || length > kLargestMessage) {
      throw std::runtime_error(fmt::format("'{}' is no length of a message", line));
    }
    return length;
  }
  throw std::runtime_error("a message has no Content-Length");
}

}  // namespace

std::optional<Json> MessageReader::next() {
  const std::size_t end = bytes_.find("\r\n\r\n");
  if (end == std::string::npos) {
    if (bytes_.size() > kLongestHead) {
      throw std::runtime_error("what comes is no message of the Language Server Protocol");
    }
    return std::nullopt;
  }
  const std::size_t length = length_of(std::string_view(bytes_).substr(0, end));
  const std::size_t begin = end + 4;
  if (bytes_.size() - begin < length) {
    return std::nullopt;
  }
  Json message = Json::parse(bytes_.begin() + static_cast<std::ptrdiff_t>(begin),
                             bytes_.begin() + static_cast<std::ptrdiff_t>(begin + length), nullptr, false);
  bytes_.erase(0, begin + length);
  return message.is_discarded() ? Json() : std::move(message);
}

std::string framed(const Json& message) {
  const std::string text = message.dump(-1, ' ', false, Json::error_handler_t::replace);
  return fmt::format("Content-Length: {}\r\n\r\n{}", text.size(), text);
}

}  // namespace launch::lsp
