// SPDX-License-Identifier: Apache-2.0
#include "launcher/health/notify_probe.hpp"

#include <fmt/format.h>
#include <string.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <chrono>
#include <cstdint>
#include <cstring>
#include <optional>
#include <system_error>
#include <vector>

namespace launch {
namespace {

constexpr std::size_t kLongestNews = 4096;
constexpr std::size_t kLongestStatus = 100;  // bytes
constexpr int kMostDescriptors = 253;        // SCM_MAX_FD of the kernel

UniqueFd bound_socket(const std::string& path) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  UniqueFd socket(::socket(AF_UNIX, SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0));
  if (path.size() >= sizeof address.sun_path) {
    throw std::system_error(ENAMETOOLONG, std::system_category(), fmt::format("the socket '{}'", path));
  }
  std::memcpy(address.sun_path, path.data(), path.size());
  if (!socket || ::bind(socket.get(), reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0) {
    throw std::system_error(errno, std::system_category(), fmt::format("cannot make the socket '{}'", path));
  }
  return socket;
}

// Reads one datagram; nothing if there is none. Descriptors that come with it are closed: that is what
// sd_notify_barrier(3) waits for.
std::optional<std::string> next_datagram(const UniqueFd& socket) {
  std::array<char, kLongestNews> text{};
  iovec part{text.data(), text.size()};
  std::vector<char> control(CMSG_SPACE(kMostDescriptors * sizeof(int)));
  msghdr message{};
  message.msg_iov = &part;
  message.msg_iovlen = 1;
  message.msg_control = control.data();
  message.msg_controllen = control.size();
  const ssize_t size = ::recvmsg(socket.get(), &message, MSG_DONTWAIT | MSG_CMSG_CLOEXEC);
  if (size < 0) {
    return std::nullopt;
  }
  for (cmsghdr* header = CMSG_FIRSTHDR(&message); header != nullptr; header = CMSG_NXTHDR(&message, header)) {
    if (header->cmsg_level == SOL_SOCKET && header->cmsg_type == SCM_RIGHTS) {
      for (std::size_t i = 0; i < (header->cmsg_len - CMSG_LEN(0)) / sizeof(int); ++i) {
        int fd = -1;
        std::memcpy(&fd, CMSG_DATA(header) + i * sizeof fd, sizeof fd);
        ::close(fd);
      }
    }
  }
  return std::string(text.data(), static_cast<std::size_t>(size));
}

// One line that fits into a table.
std::string shown(std::string_view status) {
  std::string text(status.substr(0, kLongestStatus));
  while (text.size() < status.size() && (static_cast<unsigned char>(status[text.size()]) & 0xC0U) == 0x80U) {
    text.pop_back();  // not within a character
  }
  std::replace_if(
      text.begin(), text.end(), [](char byte) { return static_cast<unsigned char>(byte) < ' ' || byte == '\x7f'; },
      ' ');
  return text;
}

std::optional<Duration> microseconds(std::string_view text) {
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool is_whole = error == std::errc() && end == text.data() + text.size();
  constexpr std::int64_t kLongest = std::int64_t{1} << 50;  // 35 years
  return is_whole && value > 0 && value < kLongest ? std::optional<Duration>(std::chrono::microseconds(value))
                                                   : std::nullopt;
}

}  // namespace

NotifyProbe::NotifyProbe(EventLoop& loop, std::string socket, bool watchdog, Duration timeout, Callbacks callbacks,
                         ProcessorWait wait)
    : path_(std::move(socket)),
      has_watchdog_(watchdog),
      given_timeout_(timeout),
      callbacks_(std::move(callbacks)),
      wait_(std::move(wait)),
      socket_(bound_socket(path_)),
      readable_(loop.on_readable(socket_.get(), [this] { receive(); })),
      timeout_(timeout) {}

NotifyProbe::~NotifyProbe() {
  readable_.reset();
  ::unlink(path_.c_str());
}

void NotifyProbe::begin(pid_t pid) {
  pid_ = pid;
  timeout_ = given_timeout_;
  is_ready_ = is_ending_ = has_triggered_ = false;
  live();
}

void NotifyProbe::end() {
  pid_ = -1;
  receive();  // nothing of this run belongs to the next one
}

void NotifyProbe::live() {
  age_ = Duration{0};
  wait_.forget();
}

void NotifyProbe::receive() {
  while (const std::optional<std::string> news = next_datagram(socket_)) {
    if (pid_ >= 0) {
      take(*news);
    }
  }
}

void NotifyProbe::take(std::string_view news) {
  while (!news.empty()) {
    const std::size_t end = std::min(news.find('\n'), news.size());
    const std::string_view line = news.substr(0, end);
    news.remove_prefix(std::min(end + 1, news.size()));
    if (const std::size_t equal = line.find('='); equal != std::string_view::npos) {
      take_line(line.substr(0, equal), line.substr(equal + 1));
    }
  }
}

void NotifyProbe::take_line(std::string_view name, std::string_view value) {
  if (name == "READY" && value == "1") {
    is_ready_ = true;
    is_ending_ = false;
    live();
    callbacks_.answer({Look::Result::kGood});
  } else if (name == "STOPPING" && value == "1") {
    is_ending_ = true;
  } else if (name == "WATCHDOG" && value == "1") {
    if (is_ready_ && has_watchdog_) {
      live();
    }
  } else if (name == "WATCHDOG" && value == "trigger") {
    has_triggered_ = true;
    callbacks_.answer(look(Duration{0}, Duration{0}));
  } else if (name == "WATCHDOG_USEC") {
    timeout_ = microseconds(value).value_or(timeout_);
  } else if (name == "EXTEND_TIMEOUT_USEC") {
    // From now on, as systemd.service(5) says of it.
    if (const std::optional<Duration> more = microseconds(value); more && !is_ready_) {
      age_ = std::min(age_, timeout_ - *more);
    }
  } else if (name == "STATUS") {
    callbacks_.status(shown(value));
  }
}

Look NotifyProbe::look(Duration, Duration passed) {
  if (has_triggered_) {
    return {Look::Result::kBad, "it has asked for the action of its watchdog (WATCHDOG=trigger)"};
  }
  if (is_ending_) {
    return {};
  }
  if (is_ready_ && !has_watchdog_) {
    return {Look::Result::kGood};
  }
  // In the first quarter, it is not worth a look into /proc.
  age_ += age_ >= timeout_ / 4 ? passed - wait_.of_process(pid_, passed) : passed;
  if (age_ < timeout_) {
    return {is_ready_ ? Look::Result::kGood : Look::Result::kPending};
  }
  return {Look::Result::kBad, fmt::format("it has not said {} for {:.1f} s",
                                          is_ready_ ? "that it lives (WATCHDOG=1)" : "that it is ready (READY=1)",
                                          std::chrono::duration<double>(age_).count())};
}

}  // namespace launch
