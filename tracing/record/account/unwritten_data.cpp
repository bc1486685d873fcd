// SPDX-License-Identifier: Apache-2.0
#include "tracing/record/account/unwritten_data.hpp"

#include <fcntl.h>
#include <fmt/core.h>
#include <sys/statvfs.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <limits>

#include "tracing/record/account/loss_account.hpp"
#include "tracing/record/account/packet_losses.hpp"
#include "tracing/record/account/stream_packets.hpp"

namespace tracing {
namespace {

constexpr std::size_t kRoomLeftByAWorkingConsumer = 65536;  // bytes; it fills a file system to the last block
constexpr const char* kRemedy = "make room there, or choose another base-path";

// The daemon counts more lost events than the last packets know of.
bool ends_with_losses(const ChannelLoss& channel, const std::vector<Stream>& streams) {
  std::uint64_t known = 0;
  for (const Stream& stream : streams) {
    if (stream.domain != channel.domain || stream.channel != channel.channel || stream.packets.empty()) {
      continue;
    }
    known += discarded_in(stream);
  }
  return channel.discarded_events + channel.before_first.discarded_events > known;
}

// The error of writing so many bytes into a new file there; 0 when they fit, or no file can be made.
int error_of_writing(const std::filesystem::path& directory) {
  const std::string path = directory / ".room";
  const int fd = open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0600);
  if (fd < 0) {
    return errno == EDQUOT || errno == ENOSPC ? errno : 0;
  }
  static constexpr std::array<char, kRoomLeftByAWorkingConsumer> kNothing{};
  int error = 0;
  for (std::size_t written = 0; written < kNothing.size() && error == 0;) {
    const ssize_t count = write(fd, kNothing.data() + written, kNothing.size() - written);
    if (count >= 0) {
      written += static_cast<std::size_t>(count);
    } else if (errno != EINTR) {
      error = errno;
    }
  }
  if (close(fd) != 0 && error == 0) {
    error = errno;  // where NFS tells it
  }
  unlink(path.c_str());
  return error;
}

}  // namespace

void find_unwritten(LossAccount& account, const std::vector<Stream>& streams, std::uint64_t stopped, bool no_room) {
  // A clock of the user's own has other times.
  if (stopped == 0 || account.cut_short || std::getenv("LTTNG_UST_CLOCK_PLUGIN") != nullptr) {
    return;
  }
  const std::uint64_t first = first_time(streams);
  const std::uint64_t origin = first < stopped ? first : stopped;  // without a packet no time is known
  for (ChannelLoss& channel : account.channels) {
    if (channel.domain != "ust" || (!no_room && ends_with_losses(channel, streams))) {
      continue;
    }
    for (const Stream& stream : streams) {
      if (stream.domain != channel.domain || stream.channel != channel.channel) {
        continue;
      }
      if (stream.pid || stream.in_archives) {
        continue;
      }
      const std::uint64_t end = stream.packets.empty() ? origin : stream.packets.back().end;
      if (end >= stopped && !stream.packets.empty()) {
        continue;
      }
      channel.unwritten.push_back({.cpu = stream.cpu, .begin_ns = end - origin, .end_ns = stopped - origin});
    }
  }
}

std::string why_no_room(const std::filesystem::path& directory) {
  const int error = error_of_writing(directory);
  if (error == EDQUOT) {
    return fmt::format("the disk quota for {} is used up", directory.string());
  }
  struct statvfs usage {};
  const bool full = statvfs(directory.c_str(), &usage) == 0 &&
                    std::uint64_t{usage.f_bavail} * usage.f_frsize < kRoomLeftByAWorkingConsumer;
  if (error == ENOSPC || full) {
    return fmt::format("the file system of {} is full", directory.string());
  }
  return error == 0 ? "" : fmt::format("{} cannot be written: {}", directory.string(), std::strerror(error));
}

std::string describe_damage(const LossAccount& account, const std::string& no_room,
                            const std::filesystem::path& directory) {
  std::uint64_t begin = std::numeric_limits<std::uint64_t>::max();
  std::uint64_t end = 0;
  bool found = false;
  for (const ChannelLoss& channel : account.channels) {
    for (const UnwrittenRange& range : channel.unwritten) {
      begin = std::min(begin, range.begin_ns);
      end = std::max(end, range.end_ns);
      found = true;
    }
  }
  if (found) {
    const std::string why =
        no_room.empty() ? fmt::format("data could not be written to {}", directory.string()) : no_room;
    if (end == 0) {
      return fmt::format("{}: no event could be written; {}", why, kRemedy);
    }
    return fmt::format("{}: events after {:.3f} s of {:.3f} s are missing; {}", why, to_seconds(begin), to_seconds(end),
                       kRemedy);
  }
  // As of a session that was paused: when it should have been written to is not known.
  if (no_room.empty()) {
    return {};
  }
  return fmt::format("{}: events are missing, their number is unknown; {}", no_room, kRemedy);
}

}  // namespace tracing
