// SPDX-License-Identifier: Apache-2.0
#include "programs/agent/agent_door.hpp"

#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <optional>
#include <system_error>
#include <utility>

namespace launch {
namespace {

constexpr std::size_t kMostVisitors = 8;
constexpr std::size_t kLongestKnock = 1024;
constexpr std::chrono::seconds kPatience{5};

// Takes as long for a wrong text as for the right one.
bool is_same(const std::string& left, const std::string& right) {
  unsigned char different = left.size() == right.size() ? 0 : 1;
  for (std::size_t i = 0; i < left.size() && i < right.size(); ++i) {
    different |= static_cast<unsigned char>(left[i] ^ right[i]);
  }
  return different == 0;
}

[[noreturn]] void fail(const std::string& what) {
  throw std::system_error(errno, std::system_category(), what);
}

}  // namespace

std::string name_of_door(const std::string& id) {
  return "agent-" + id;
}

bool is_of_this_user(int socket) {
  ucred other{};
  socklen_t size = sizeof other;
  return ::getsockopt(socket, SOL_SOCKET, SO_PEERCRED, &other, &size) == 0 && other.uid == ::geteuid();
}

AgentDoor::AgentDoor(EventLoop& loop, const Environment& environment, const std::string& id, std::string key,
                     Enter enter)
    : loop_(loop), key_(std::move(key)), enter_(std::move(enter)) {
  const RuntimeDirectory directory = RuntimeDirectory::make(environment);
  path_ = directory.path + "/" + name_of_door(id);
  sockaddr_un address{.sun_family = AF_UNIX, .sun_path = {}};
  const std::string short_path = directory.address(name_of_door(id));
  if (short_path.size() >= sizeof address.sun_path) {
    errno = ENAMETOOLONG;
    fail("cannot listen at '" + path_ + "'");
  }
  short_path.copy(address.sun_path, sizeof address.sun_path - 1);
  socket_ = UniqueFd(::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
  // Only this user can enter the directory, so nobody is faster than the change of the mode.
  if (!socket_ || ::bind(socket_.get(), reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0 ||
      ::chmod(short_path.c_str(), S_IRUSR | S_IWUSR) != 0 || ::listen(socket_.get(), kMostVisitors) != 0) {
    fail("cannot listen at '" + path_ + "'");
  }
  source_ = loop_.on_readable(socket_.get(), [this] { open_for_one(); });
}

void AgentDoor::open_for_one() {
  UniqueFd connection(::accept4(socket_.get(), nullptr, nullptr, SOCK_CLOEXEC | SOCK_NONBLOCK));
  if (!connection || visitors_.size() >= kMostVisitors || !is_of_this_user(connection.get())) {
    return;
  }
  const auto visitor = visitors_.insert(visitors_.end(), {.connection = std::move(connection)});
  visitor->source = loop_.on_readable(visitor->connection.get(), [this, visitor] { listen_to(visitor); });
  visitor->patience = loop_.after(kPatience, [this, visitor] { visitors_.erase(visitor); });
}

void AgentDoor::listen_to(std::list<Visitor>::iterator visitor) {
  std::array<char, kLongestKnock> bytes;  // not initialised: it is read into
  const ssize_t count = ::read(visitor->connection.get(), bytes.data(), bytes.size() - visitor->frames.held());
  if (count < 0 && (errno == EAGAIN || errno == EINTR)) {
    return;
  }
  std::uint64_t received = 0;
  try {
    if (count <= 0) {
      throw WireError("it says nothing more");
    }
    visitor->frames.add({bytes.data(), static_cast<std::size_t>(count)});
    const std::optional<Frame> frame = visitor->frames.take();
    if (!frame && visitor->frames.held() < kLongestKnock) {
      return;
    }
    if (!frame || frame->kind != static_cast<std::uint8_t>(ToAgent::kResume) || visitor->frames.held() > 0) {
      throw WireError("it does not say what it wants");
    }
    const ResumeRequest request = parse_resume_request(frame->content);
    if (!is_same(request.key, key_)) {
      throw WireError("it does not know the key");
    }
    received = request.received;
  } catch (const WireError&) {
    visitors_.erase(visitor);
    return;
  }
  UniqueFd connection = std::move(visitor->connection);
  visitors_.erase(visitor);
  enter_(std::move(connection), received);
}

}  // namespace launch
