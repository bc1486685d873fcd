// SPDX-License-Identifier: Apache-2.0
#include "tracing/record/session/free_name.hpp"

#include <fmt/format.h>
#include <sys/socket.h>
#include <sys/un.h>

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <system_error>
#include <utility>

namespace tracing {

namespace {

constexpr int kMostNames = 1000;

// A socket with a name that is no file: the kernel gives it to one process at a time. `taken` tells whether another
// one has it.
launch::UniqueFd claim(const std::string& directory, bool& taken) {
  launch::UniqueFd socket(::socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC, 0));
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  // The name of the directory may be longer than that of a socket.
  const std::string name = fmt::format("launch-trace-{:016x}", std::hash<std::string>{}(directory));
  std::copy(name.begin(), name.end(), address.sun_path + 1);
  const auto size = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + 1 + name.size());
  const bool bound = socket && ::bind(socket.get(), reinterpret_cast<const sockaddr*>(&address), size) == 0;
  taken = !bound && errno == EADDRINUSE;
  return bound ? std::move(socket) : launch::UniqueFd();
}

}  // namespace

launch::UniqueFd claim_free_name(TraceConfig& config) {
  if (!config.has_timestamp || config.append_trace || config.over_network()) {
    return {};
  }
  const std::string stamped = config.session_name;
  for (int number = 2; number < kMostNames; ++number) {
    std::error_code unknown;
    bool taken = std::filesystem::exists(config.trace_directory(), unknown);
    if (!taken) {
      launch::UniqueFd claimed = claim(config.trace_directory(), taken);
      if (!taken) {
        return claimed;
      }
    }
    config.session_name = fmt::format("{}-{}", stamped, number);
  }
  config.session_name = stamped;
  return {};
}

}  // namespace tracing
