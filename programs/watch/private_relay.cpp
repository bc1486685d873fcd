// SPDX-License-Identifier: Apache-2.0
#include "programs/watch/private_relay.hpp"

#include <arpa/inet.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <netinet/in.h>
#include <signal.h>
#include <sys/file.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <stdexcept>
#include <system_error>
#include <tuple>
#include <utility>
#include <vector>

#include "base/files/unique_fd.hpp"
#include "base/processes/spawn.hpp"

namespace tracing {
namespace {

constexpr const char* kProgram = "lttng-relayd";
constexpr std::chrono::milliseconds kLook{10};  // the daemon does not tell when it listens
constexpr int kAttempts = 3;                    // somebody else may take a free port before the daemon does
constexpr int kMissing = 127;                   // exit code when there is no such program

sockaddr_in local_address(std::uint16_t port) {
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(port);
  address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  return address;
}

launch::UniqueFd make_socket() {
  launch::UniqueFd made(socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0));
  if (!made) {
    throw std::system_error(errno, std::generic_category(), "socket");
  }
  return made;
}

// A port that nobody uses while the socket is open.
std::uint16_t take_port(const launch::UniqueFd& with) {
  sockaddr_in address = local_address(0);
  socklen_t size = sizeof address;
  if (bind(with.get(), reinterpret_cast<const sockaddr*>(&address), size) != 0 ||
      getsockname(with.get(), reinterpret_cast<sockaddr*>(&address), &size) != 0) {
    throw std::system_error(errno, std::generic_category(), "find a free port");
  }
  return ntohs(address.sin_port);
}

bool accepts(std::uint16_t port) {
  const launch::UniqueFd client = make_socket();
  const sockaddr_in address = local_address(port);
  return connect(client.get(), reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0;
}

constexpr const char* kDirectory = "launch-watch-";

launch::UniqueFd open_directory(const std::string& path) {
  return launch::UniqueFd(open(path.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC));
}

// Whose program was killed. A program that lives has a lock on its own.
void remove_left_directories() {
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(std::filesystem::temp_directory_path(), error)) {
    if (!entry.path().filename().string().starts_with(kDirectory)) {
      continue;
    }
    const launch::UniqueFd directory = open_directory(entry.path());
    struct stat status {};
    if (directory && fstat(directory.get(), &status) == 0 && status.st_uid == geteuid() &&
        flock(directory.get(), LOCK_EX | LOCK_NB) == 0) {
      std::filesystem::remove_all(entry.path(), error);
    }
  }
}

// Returns its path, and a lock on it.
std::pair<std::string, launch::UniqueFd> make_directory() {
  while (true) {
    std::string name = (std::filesystem::temp_directory_path() / (std::string(kDirectory) + "XXXXXX")).string();
    if (mkdtemp(name.data()) == nullptr) {
      throw std::system_error(errno, std::generic_category(), "create " + name);
    }
    launch::UniqueFd directory = open_directory(name);
    if (!directory) {
      throw std::system_error(errno, std::generic_category(), "open " + name);
    }
    // A file system without locks keeps what is left. Before this program has the lock, another one may have taken the
    // directory for one that was left.
    struct stat status {};
    if (flock(directory.get(), LOCK_EX) == 0 && fstat(directory.get(), &status) == 0 && status.st_nlink == 0) {
      continue;
    }
    return {std::move(name), std::move(directory)};
  }
}

// In the child: becomes the daemon, which ends when its parent does.
[[noreturn]] void become(std::vector<std::string> words, pid_t parent) {
  prctl(PR_SET_PDEATHSIG, SIGTERM);
  if (getppid() != parent) {
    _exit(0);
  }
  const int nothing = open("/dev/null", O_RDWR);
  for (const int standard : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    dup2(nothing, standard);
  }
  signal(SIGPIPE, SIG_DFL);
  std::vector<char*> argv;
  for (std::string& word : words) {
    argv.push_back(word.data());
  }
  argv.push_back(nullptr);
  execvp(argv[0], argv.data());
  _exit(kMissing);
}

}  // namespace

PrivateRelay::PrivateRelay() {
  remove_left_directories();
  std::tie(directory_, lock_) = make_directory();
  try {
    for (int attempt = 1; pid_ < 0 && attempt <= kAttempts; ++attempt) {
      start();
    }
    if (pid_ < 0) {
      throw std::runtime_error("lttng-relayd ends as soon as it starts");
    }
  } catch (...) {
    end();
    throw;
  }
}

PrivateRelay::~PrivateRelay() {
  end();
}

void PrivateRelay::start() {
  {
    std::array<launch::UniqueFd, kPorts> sockets;
    for (std::size_t i = 0; i < kPorts; ++i) {
      ports_[i] = take_port(sockets[i] = make_socket());
    }
  }
  std::vector<std::string> words = {kProgram, "--output=" + directory_};
  const std::array<const char*, kPorts> options = {"--control-port", "--data-port", "--live-port"};
  for (std::size_t i = 0; i < kPorts; ++i) {
    words.push_back(fmt::format("{}=tcp://127.0.0.1:{}", options[i], ports_[i]));
  }
  const pid_t parent = getpid();
  pid_ = fork();
  if (pid_ < 0) {
    throw std::system_error(errno, std::generic_category(), "fork");
  }
  if (pid_ == 0) {
    become(std::move(words), parent);
  }
  while (!listens()) {
    if (runs_for(kLook)) {
      continue;
    }
    const int status = launch::wait_for(pid_);
    pid_ = -1;
    if (!WIFEXITED(status) || WEXITSTATUS(status) != kMissing) {
      return;
    }
    throw std::runtime_error("there is no 'lttng-relayd' on this machine\n= help: install the package lttng-tools");
  }
}

bool PrivateRelay::listens() const {
  return std::all_of(ports_.begin(), ports_.end(), accepts);
}

bool PrivateRelay::runs_for(std::chrono::milliseconds time) const {
  return !launch::ends_within(pid_, time);
}

void PrivateRelay::end() {
  if (pid_ > 0) {
    constexpr std::chrono::seconds kLongestEnd{5};
    kill(pid_, SIGTERM);
    if (runs_for(kLongestEnd)) {
      kill(pid_, SIGKILL);
    }
    launch::wait_for(pid_);
  }
  std::error_code ignored;
  std::filesystem::remove_all(directory_, ignored);
}

std::string PrivateRelay::session_url() const {
  return fmt::format("net://127.0.0.1:{}:{}", ports_[kControl], ports_[kData]);
}

std::string PrivateRelay::viewer_address() const {
  return fmt::format("127.0.0.1:{}", ports_[kViewers]);
}

}  // namespace tracing
