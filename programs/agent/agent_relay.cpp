// SPDX-License-Identifier: Apache-2.0
#include "programs/agent/agent_relay.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <limits.h>
#include <poll.h>
#include <sys/inotify.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <optional>
#include <string_view>
#include <utility>

#include "base/environment/runtime_directory.hpp"
#include "launcher/machines/protocol/agent_protocol.hpp"
#include "programs/agent/agent_door.hpp"

namespace launch {
namespace {

constexpr std::size_t kMostOnTheWay = 256UL * 1024;
constexpr std::chrono::seconds kPatienceWithGuardian{60};

void let_relay_not_block(const UniqueFd& fd) {
  ::fcntl(fd.get(), F_SETFL, ::fcntl(fd.get(), F_GETFL) | O_NONBLOCK);
}

// One direction.
class Way {
 public:
  Way(const UniqueFd& from, const UniqueFd& to) : from_(from), to_(to) {}

  bool wants_to_read() const { return !ended_ && bytes_.size() < kMostOnTheWay; }
  bool wants_to_write() const { return !bytes_.empty(); }
  bool has_carried() const { return carried_; }
  // Nothing more goes this way.
  bool is_over() const { return broken_ || (ended_ && bytes_.empty()); }

  void add(std::string_view bytes) { bytes_ += bytes; }
  void read() {
    std::array<char, 64UL * 1024> bytes;  // not initialised: it is read into
    const ssize_t count = ::read(from_.get(), bytes.data(), bytes.size());
    if (count > 0) {
      bytes_.append(bytes.data(), static_cast<std::size_t>(count));
      carried_ = true;
    } else if (count == 0 || (errno != EAGAIN && errno != EINTR)) {
      ended_ = true;
    }
  }
  void write() {
    const ssize_t count = ::write(to_.get(), bytes_.data(), bytes_.size());
    if (count > 0) {
      bytes_.erase(0, static_cast<std::size_t>(count));
    } else if (count < 0 && errno != EAGAIN && errno != EINTR) {
      broken_ = true;
    }
  }

 private:
  const UniqueFd& from_;
  const UniqueFd& to_;
  std::string bytes_;
  bool carried_ = false;
  bool ended_ = false;
  bool broken_ = false;
};

struct Found {
  RuntimeDirectory directory;
  UniqueFd agent;
};

std::optional<Found> find_agent(const Environment& environment, const std::string& door) {
  for (RuntimeDirectory& directory : RuntimeDirectory::find(environment)) {
    sockaddr_un address{.sun_family = AF_UNIX, .sun_path = {}};
    directory.address(door).copy(address.sun_path, sizeof address.sun_path - 1);
    UniqueFd agent(::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0));
    if (agent && ::connect(agent.get(), reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0 &&
        is_of_this_user(agent.get())) {
      return Found{std::move(directory), std::move(agent)};
    }
  }
  return std::nullopt;
}

void say(const UniqueFd& out, FromAgent kind, std::string_view text) {
  const std::string frame = encode(kind, WireWriter().text(text));
  static_cast<void>(!::write(out.get(), frame.data(), frame.size()));
}

// The guardian removes the socket after all else. A launcher that has gone waits for nothing.
void wait_for_removal(const RuntimeDirectory& directory, const std::string& door, const UniqueFd& launcher) {
  using Clock = std::chrono::steady_clock;
  const std::string path = directory.address(door);
  const UniqueFd watch(::inotify_init1(IN_CLOEXEC | IN_NONBLOCK));
  if (!watch || ::inotify_add_watch(watch.get(), directory.address(".").c_str(), IN_DELETE) < 0) {
    return;
  }
  const Clock::time_point end = Clock::now() + kPatienceWithGuardian;
  while (::access(path.c_str(), F_OK) == 0) {
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(end - Clock::now());
    std::array<pollfd, 2> waits{{{watch.get(), POLLIN, 0}, {launcher.get(), POLLIN, 0}}};
    if (left.count() <= 0 || ::poll(waits.data(), waits.size(), static_cast<int>(left.count())) < 0) {
      return;
    }
    std::array<char, 4096> said;  // not initialised: it is read into
    if (waits[1].revents != 0 && ::read(launcher.get(), said.data(), said.size()) == 0) {
      return;
    }
    alignas(inotify_event) std::array<char, sizeof(inotify_event) + NAME_MAX + 1> event;
    while (::read(watch.get(), event.data(), event.size()) > 0) {
    }
  }
}

}  // namespace

int relay_to_agent(const Environment& environment, const std::string& request, UniqueFd in, UniqueFd out) {
  const std::string door = name_of_door(parse_resume_request(request).id);
  const std::optional<Found> found = find_agent(environment, door);
  if (!found) {
    say(out, FromAgent::kGone, "the agent there has ended");
    return EXIT_FAILURE;
  }
  const UniqueFd& agent = found->agent;
  let_relay_not_block(in);
  let_relay_not_block(out);
  let_relay_not_block(agent);
  Way there(in, agent);
  Way back(agent, out);
  there.add(encode_frame(static_cast<std::uint8_t>(ToAgent::kResume), request));
  while (!back.is_over() && !there.is_over()) {
    // The agent's socket is both read and written.
    const short of_agent =
        static_cast<short>((back.wants_to_read() ? POLLIN : 0) | (there.wants_to_write() ? POLLOUT : 0));
    std::array<pollfd, 3> waits{{{there.wants_to_read() ? in.get() : -1, POLLIN, 0},
                                 {back.wants_to_write() ? out.get() : -1, POLLOUT, 0},
                                 {of_agent != 0 ? agent.get() : -1, of_agent, 0}}};
    if (::poll(waits.data(), waits.size(), -1) < 0) {
      continue;
    }
    if (waits[0].revents != 0) {
      there.read();
    }
    if (waits[1].revents != 0) {
      back.write();
    }
    if ((waits[2].revents & POLLOUT) != 0 && there.wants_to_write()) {
      there.write();
    }
    if ((waits[2].revents & (POLLIN | POLLHUP | POLLERR)) != 0 && back.wants_to_read()) {
      back.read();
    }
  }
  if (!back.is_over()) {
    return EXIT_SUCCESS;  // the launcher has gone, or it comes back in another way
  }
  if (!back.has_carried()) {
    say(out, FromAgent::kGone, "the agent there does not know this launch");
    return EXIT_FAILURE;
  }
  wait_for_removal(found->directory, door, in);
  return EXIT_SUCCESS;
}

}  // namespace launch
