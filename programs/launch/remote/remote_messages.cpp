// SPDX-License-Identifier: Apache-2.0
#include "programs/launch/remote/remote_messages.hpp"

#include <errno.h>
#include <fmt/format.h>
#include <unistd.h>

#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace launch {
namespace {

using RemoteJson = nlohmann::json;

constexpr std::size_t kHead = 5;  // the kind and the length
constexpr unsigned kByte = 8;

}  // namespace

std::string to_text(const RemoteRequest& request) {
  RemoteJson json{{"words", request.words}, {"environment", request.environment}};
  if (request.terminal) {
    json["terminal"] = to_text(*request.terminal);
  }
  if (request.input) {
    json["input"] = true;
  }
  // Words of a command line may be any bytes.
  return json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

RemoteRequest parse_remote_request(std::string_view text) {
  try {
    const RemoteJson json = RemoteJson::parse(text);
    RemoteRequest request;
    json.at("words").get_to(request.words);
    json.at("environment").get_to(request.environment);
    if (json.contains("terminal")) {
      request.terminal = parse_size(json["terminal"].get<std::string>());
    }
    request.input = json.value("input", false);
    return request;
  } catch (const RemoteJson::exception&) {
    throw std::runtime_error("what the other side asks for can't be read");
  }
}

std::string to_text(const TerminalSize& size) {
  return fmt::format("{} {}", size.lines, size.columns);
}

TerminalSize parse_size(std::string_view text) {
  constexpr std::size_t kMost = 10'000;
  std::istringstream stream{std::string(text)};
  TerminalSize size;
  if (!(stream >> size.lines >> size.columns) || size.lines == 0 || size.columns == 0 || size.lines > kMost ||
      size.columns > kMost) {
    size.lines = 24;
    size.columns = 80;
  }
  return size;
}

std::string greeting_line(std::string_view launch_version) {
  return fmt::format("{}{} {}\n", kRemoteGreeting, kRemoteVersion, launch_version);
}

std::optional<Greeting> parse_greeting(std::string_view line) {
  if (line.ends_with('\r')) {
    line.remove_suffix(1);
  }
  if (!line.starts_with(kRemoteGreeting)) {
    return std::nullopt;
  }
  std::istringstream stream{std::string(line.substr(kRemoteGreeting.size()))};
  Greeting greeting;
  std::string more;
  if (!(stream >> greeting.version >> greeting.launch_version) || stream >> more) {
    return std::nullopt;
  }
  return greeting;
}

std::string encode(RemoteKind kind, std::string_view content) {
  std::string message(1, static_cast<char>(kind));
  for (unsigned shift = 3 * kByte;; shift -= kByte) {
    message += static_cast<char>(static_cast<unsigned char>((content.size() >> shift) & 0xFFU));
    if (shift == 0) {
      break;
    }
  }
  return message.append(content);
}

bool write_all(int fd, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t count = ::write(fd, bytes.data(), bytes.size());
    if (count > 0) {
      bytes.remove_prefix(static_cast<std::size_t>(count));
    } else if (errno != EINTR) {
      return false;
    }
  }
  return true;
}

std::optional<RemoteMessage> RemoteMessages::take() {
  if (buffer_.size() < kHead) {
    return std::nullopt;
  }
  std::size_t length = 0;
  for (std::size_t i = 1; i < kHead; ++i) {
    length = (length << kByte) | static_cast<unsigned char>(buffer_[i]);
  }
  if (length > kLongest) {
    throw std::runtime_error("what comes from the other side are no messages of launch");
  }
  if (buffer_.size() < kHead + length) {
    return std::nullopt;
  }
  RemoteMessage message{static_cast<RemoteKind>(buffer_[0]), buffer_.substr(kHead, length)};
  buffer_.erase(0, kHead + length);
  return message;
}

}  // namespace launch
