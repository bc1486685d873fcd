// SPDX-License-Identifier: Apache-2.0
#include "launcher/python/script/script_link.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/epoll.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <stdexcept>
#include <string_view>
#include <system_error>

namespace launch {

namespace {

constexpr const char* kVariable = "LAUNCH_OF_SCRIPT";  // "SOCKET:WAKE:PID"

[[noreturn]] void throw_ended() {
  throw std::runtime_error("the program that has started this launch has ended");
}

}  // namespace

std::optional<ScriptOrder> ScriptOrder::take(Environment& environment) {
  const auto found = environment.find(kVariable);
  if (found == environment.end()) {
    return std::nullopt;
  }
  const std::string words = found->second;
  environment.erase(kVariable);
  ::unsetenv(kVariable);
  ScriptOrder order;
  if (std::sscanf(words.c_str(), "%d:%d:%d", &order.socket, &order.wake, &order.script) != 3 ||
      ::fcntl(order.socket, F_SETFD, FD_CLOEXEC) != 0 || ::fcntl(order.wake, F_SETFD, FD_CLOEXEC) != 0) {
    throw std::runtime_error(std::string(kVariable) + " is set by LaunchService of Python only, not by hand");
  }
  return order;
}

ScriptLink::ScriptLink(const ScriptOrder& order)
    : socket_(order.socket),
      wake_(order.wake),
      script_(static_cast<int>(::syscall(SYS_pidfd_open, order.script, 0))),
      epoll_(::epoll_create1(EPOLL_CLOEXEC)) {
  if (!epoll_) {
    throw std::system_error(errno, std::system_category(), "cannot wait for the script");
  }
  for (const int descriptor : {socket_.get(), wake_.get(), script_.get()}) {
    epoll_event event{};
    event.events = EPOLLIN;
    if (descriptor >= 0 && ::epoll_ctl(epoll_.get(), EPOLL_CTL_ADD, descriptor, &event) != 0) {
      throw std::system_error(errno, std::system_category(), "cannot wait for the script");
    }
  }
  ::fcntl(wake_.get(), F_SETFL, O_NONBLOCK);
}

void ScriptLink::send(const Json& message) {
  // Names of files and output may be no UTF-8.
  std::string line = message.dump(-1, ' ', false, Json::error_handler_t::replace);
  line += '\n';
  for (std::string_view left = line; !left.empty();) {
    const ssize_t count = ::send(socket_.get(), left.data(), left.size(), MSG_NOSIGNAL);
    if (count < 0 && errno != EINTR) {
      throw_ended();
    }
    left.remove_prefix(count > 0 ? static_cast<std::size_t>(count) : 0);
  }
}

ScriptLink::Json ScriptLink::receive() {
  std::size_t searched = 0;
  for (;;) {
    const std::size_t end = received_.find('\n', searched);
    if (end != std::string::npos) {
      const std::string line = received_.substr(0, end);
      received_.erase(0, end + 1);
      return Json::parse(line);
    }
    searched = received_.size();
    std::array<pollfd, 2> watched{pollfd{socket_.get(), POLLIN, 0}, pollfd{script_.get(), POLLIN, 0}};
    if (::poll(watched.data(), script_ ? 2 : 1, -1) < 0) {
      continue;
    }
    if ((watched[0].revents & (POLLIN | POLLHUP | POLLERR)) == 0) {
      throw_ended();
    }
    std::array<char, 65536> buffer;  // not initialised: it is read into
    const ssize_t count = ::recv(socket_.get(), buffer.data(), buffer.size(), 0);
    if (count == 0 || (count < 0 && errno != EINTR)) {
      throw_ended();
    }
    received_.append(buffer.data(), count > 0 ? static_cast<std::size_t>(count) : 0);
  }
}

void ScriptLink::take_wishes() {
  std::array<char, 256> buffer;  // not initialised: it is read into
  while (::read(wake_.get(), buffer.data(), buffer.size()) > 0) {
  }
}

}  // namespace launch
