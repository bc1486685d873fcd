// SPDX-License-Identifier: Apache-2.0
#include "launcher/process/output/journal.hpp"

#include <fmt/format.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <syslog.h>

#include <array>
#include <cstring>
#include <utility>

namespace launch {
namespace {

constexpr const char* kSocket = "/run/systemd/journal/socket";

void add(std::string& entry, std::string_view name, std::string_view value) {
  if (!value.empty()) {
    entry.append(name).append("=").append(value).push_back('\n');
  }
}

}  // namespace

int journal_priority(std::string_view line) {
  constexpr std::array<std::pair<std::string_view, int>, 7> kLevels = {{{"[DEBUG]", LOG_DEBUG},
                                                                        {"[INFO]", LOG_INFO},
                                                                        {"[WARN]", LOG_WARNING},
                                                                        {"[WARNING]", LOG_WARNING},
                                                                        {"[ERROR]", LOG_ERR},
                                                                        {"[FATAL]", LOG_CRIT},
                                                                        {"[CRITICAL]", LOG_CRIT}}};
  for (const auto& [level, priority] : kLevels) {
    if (line.starts_with(level)) {
      return priority;
    }
  }
  return LOG_INFO;
}

std::shared_ptr<const Journal> Journal::behind(int fd, const Environment& environment) {
  const auto stream = environment.find("JOURNAL_STREAM");
  struct stat status {};
  if (stream == environment.end() || ::fstat(fd, &status) != 0 ||
      stream->second != fmt::format("{}:{}", status.st_dev, status.st_ino)) {
    return nullptr;
  }
  UniqueFd socket(::socket(AF_UNIX, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  std::strncpy(address.sun_path, kSocket, sizeof address.sun_path - 1);
  if (!socket || ::connect(socket.get(), reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0) {
    return nullptr;
  }
  return std::shared_ptr<const Journal>(new Journal(std::move(socket)));
}

bool Journal::write(std::string_view line, int priority, const Origin& origin) const {
  std::string entry;
  add(entry, "MESSAGE", line);
  add(entry, "PRIORITY", std::to_string(priority));
  add(entry, "SYSLOG_IDENTIFIER", "launch");
  add(entry, "LAUNCH_PROCESS", origin.process);
  add(entry, "LAUNCH_NODE", origin.node);
  add(entry, "CODE_FILE", origin.file);
  add(entry, "CODE_LINE", origin.line_number == 0 ? "" : std::to_string(origin.line_number));
  return ::send(fd_.get(), entry.data(), entry.size(), MSG_NOSIGNAL) == static_cast<ssize_t>(entry.size());
}

}  // namespace launch
