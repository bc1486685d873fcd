// SPDX-License-Identifier: Apache-2.0
#include "launcher/control/control_socket.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <pwd.h>
#include <stdio.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/time.h>
#include <sys/un.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <chrono>
#include <cstring>
#include <filesystem>
#include <system_error>
#include <utility>

#include "launcher/process/guardian/guardian.hpp"

namespace launch {
namespace {

namespace fs = std::filesystem;

constexpr int kWaitingClients = 32;  // until the launcher accepts them
constexpr const char* kSuffix = ".sock";
constexpr std::chrono::seconds kConnectPatience{5};  // with a launcher that takes no connection

sockaddr_un socket_address(const RuntimeDirectory& directory, const std::string& name) {
  const std::string path = directory.address(name);
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  if (path.size() >= sizeof address.sun_path) {
    throw std::system_error(ENAMETOOLONG, std::system_category(), path);
  }
  std::memcpy(address.sun_path, path.c_str(), path.size() + 1);
  return address;
}

// "1234" of "1234-0123456789abcdef.sock"; 0 for another name.
pid_t launch_of(const std::string& name) {
  pid_t pid = 0;
  const auto end = std::from_chars(name.data(), name.data() + name.size(), pid);
  return end.ec == std::errc() && *end.ptr == '-' && name.ends_with(kSuffix) ? pid : 0;
}

// Returns 0 or the error. EAGAIN: too many others wait for the launcher already.
int connect_patiently(const UniqueFd& socket, const sockaddr_un& address) {
  const auto* const to = reinterpret_cast<const sockaddr*>(&address);
  if (::connect(socket.get(), to, sizeof address) == 0) {
    return 0;
  }
  if (errno != EAGAIN) {
    return errno;
  }
  const timeval patience{kConnectPatience.count(), 0};
  ::setsockopt(socket.get(), SOL_SOCKET, SO_SNDTIMEO, &patience, sizeof patience);
  ::fcntl(socket.get(), F_SETFL, 0);
  const int error = ::connect(socket.get(), to, sizeof address) == 0 ? 0 : errno;
  ::fcntl(socket.get(), F_SETFL, O_NONBLOCK);
  return error;
}

// A link in a directory of another user could lead to a socket of a third one.
bool belongs_to(const UniqueFd& socket, uid_t owner) {
  ucred peer{};
  socklen_t size = sizeof peer;
  return ::getsockopt(socket.get(), SOL_SOCKET, SO_PEERCRED, &peer, &size) == 0 && peer.uid == owner;
}

std::string name_of_user(uid_t user) {
  const passwd* const entry = ::getpwuid(user);
  return entry == nullptr ? std::to_string(user) : entry->pw_name;
}

}  // namespace

ControlSocket::ControlSocket(RuntimeDirectory directory, Guardian& guardian)
    : directory_(std::move(directory)),
      guardian_(guardian),
      name_(fmt::format("{}-{}{}", guardian.pid(), guardian.id(), kSuffix)),
      fd_(::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0)) {
  // A socket that nobody listens to is taken for that of a dead launch, so it gets its name when it listens.
  const std::string new_name = "." + name_;
  const sockaddr_un address = socket_address(directory_, new_name);
  // The file gets the mode of the descriptor.
  if (!fd_ || ::fchmod(fd_.get(), 0600) != 0 ||
      ::bind(fd_.get(), reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0) {
    throw std::system_error(errno, std::system_category(),
                            fmt::format("cannot make a socket in '{}'", directory_.path));
  }
  clean_up_ = guardian_.add_clean_up({"/bin/rm", "-f", "--", path()});
  if (::listen(fd_.get(), kWaitingClients) != 0 ||
      ::renameat(directory_.fd.get(), new_name.c_str(), directory_.fd.get(), name_.c_str()) != 0) {
    const int failure = errno;
    ::unlinkat(directory_.fd.get(), new_name.c_str(), 0);
    guardian_.remove_clean_up(clean_up_);
    throw std::system_error(failure, std::system_category(), fmt::format("cannot make '{}'", path()));
  }
}

ControlSocket::~ControlSocket() {
  ::unlinkat(directory_.fd.get(), name_.c_str(), 0);
  try {
    guardian_.remove_clean_up(clean_up_);
  } catch (const std::system_error&) {
    // The guardian will find nothing to remove.
  }
}

std::vector<FoundLaunch> find_launches(const Environment& environment, WhoseLaunches whose) {
  std::vector<FoundLaunch> found;
  std::vector<RuntimeDirectory> directories = RuntimeDirectory::find(environment);
  if (whose == WhoseLaunches::kAll && ::geteuid() == 0) {
    for (RuntimeDirectory& directory : RuntimeDirectory::find_of_others()) {
      directories.push_back(std::move(directory));
    }
  }
  for (const RuntimeDirectory& directory : directories) {
    std::error_code unreadable;
    for (const fs::directory_entry& entry : fs::directory_iterator(directory.path, unreadable)) {
      const std::string name = entry.path().filename().string();
      const pid_t pid = launch_of(name);
      if (pid == 0) {
        continue;
      }
      UniqueFd socket(::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
      if (const int error = connect_patiently(socket, socket_address(directory, name)); error == 0 || error == EAGAIN) {
        if (error != 0 || belongs_to(socket, directory.owner)) {
          found.push_back({.pid = pid,
                           .path = entry.path().string(),
                           .socket = std::move(socket),
                           .connected = error == 0,
                           .user = directory.owner == ::geteuid() ? "" : name_of_user(directory.owner)});
        }
      } else if (error == ECONNREFUSED) {
        ::unlinkat(directory.fd.get(), name.c_str(), 0);
      }
    }
  }
  std::sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.pid < b.pid; });
  return found;
}

}  // namespace launch
