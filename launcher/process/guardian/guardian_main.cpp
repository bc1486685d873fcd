// launch-guardian GRACE_MILLISECONDS: ends what a launcher leaves behind when it is killed.
//
// Standard input is a socket to the launcher, which tells of each process group that it starts and of each that it has
// ended. When the launcher disappears, also by kill -9, the socket closes. Groups still known then get SIGTERM, and
// SIGKILL when their leader has ended or the grace period is over.
#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <set>
#include <vector>

#include "launcher/base/unique_fd.hpp"
#include "launcher/process/guardian/guardian_protocol.hpp"

namespace {

using Clock = std::chrono::steady_clock;
using launch::GuardianRecord;
using launch::UniqueFd;

// Returns the groups that are left when the launcher has gone.
std::set<pid_t> follow_launcher(int socket) {
  std::set<pid_t> groups;
  while (true) {
    GuardianRecord record{};
    const ssize_t size = ::recv(socket, &record, sizeof record, 0);
    if (size < 0 && errno == EINTR) {
      continue;
    }
    if (size != sizeof record) {
      return groups;
    }
    if (record.group <= 1) {
      continue;  // kill(2) would take it for everybody
    }
    if (record.kind == GuardianRecord::Kind::kAttach) {
      groups.insert(record.group);
    } else {
      groups.erase(record.group);
    }
  }
}

void end_groups(std::set<pid_t> groups, std::chrono::milliseconds grace) {
  std::vector<pid_t> leaders;
  std::vector<UniqueFd> pidfds;
  std::vector<pollfd> descriptors;
  for (const pid_t group : groups) {
    UniqueFd pidfd(static_cast<int>(::syscall(SYS_pidfd_open, group, 0)));
    if (pidfd) {
      descriptors.push_back({pidfd.get(), POLLIN, 0});
      pidfds.push_back(std::move(pidfd));
      leaders.push_back(group);
    }
    ::kill(-group, SIGTERM);
    ::kill(-group, SIGCONT);  // a stopped group would not see the signal
  }
  const auto deadline = Clock::now() + grace;
  std::size_t running = leaders.size();
  while (running > 0) {
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(deadline - Clock::now()).count();
    if (left <= 0 || (::poll(descriptors.data(), descriptors.size(), static_cast<int>(left)) < 0 && errno != EINTR)) {
      break;
    }
    for (std::size_t i = 0; i < descriptors.size(); ++i) {
      if (descriptors[i].fd >= 0 && descriptors[i].revents != 0) {
        // Descendants that outlive the leader go at once, before the number of the group can get a new meaning.
        ::kill(-leaders[i], SIGKILL);
        groups.erase(leaders[i]);
        descriptors[i].fd = -1;
        --running;
      }
    }
  }
  for (const pid_t group : groups) {
    ::kill(-group, SIGKILL);
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    fmt::print(stderr, "launch-guardian is started by launch, not by hand\n");
    return EXIT_FAILURE;
  }
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGPIPE, SIGTSTP}) {
    ::signal(signal, SIG_IGN);
  }
  const std::set<pid_t> groups = follow_launcher(STDIN_FILENO);
  if (!groups.empty()) {
    fmt::print(stderr, "launch-guardian: the launcher has gone and left {} process group{}: ending {}\n", groups.size(),
               groups.size() == 1 ? "" : "s", groups.size() == 1 ? "it" : "them");
    end_groups(groups, std::chrono::milliseconds(std::atol(argv[1])));
  }
  return EXIT_SUCCESS;
}
