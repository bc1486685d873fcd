// SPDX-License-Identifier: Apache-2.0
#include "tracing/record/account/unwritten_data.hpp"

#include <fcntl.h>
#include <fmt/core.h>
#include <fmt/ranges.h>
#include <sys/statvfs.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <map>
#include <set>
#include <thread>
#include <utility>

#include "base/processes/process_stat.hpp"
#include "tracing/record/account/counters/process_ends.hpp"
#include "tracing/record/account/loss_account.hpp"
#include "tracing/record/account/packet_losses.hpp"
#include "tracing/record/account/stream_packets.hpp"

namespace tracing {
namespace {

constexpr std::size_t kRoomLeftByAWorkingConsumer = 65536;  // bytes; it fills a file system to the last block
constexpr const char* kRemedy = "make room there, or choose another base-path";

// Between the ends of the streams of a session that was paused.
constexpr std::uint64_t kBetweenEnds = 1'000'000'000;  // ns
constexpr std::chrono::milliseconds kLongestCommit{1000};
constexpr std::chrono::milliseconds kBetweenLooks{2};
constexpr std::size_t kMostUnfinished = 4;  // streams, processes

std::uint64_t end_of(const Stream& stream) {
  return stream.packets.empty() ? 0 : stream.packets.back().end;
}

// A program that a process has executed: the process, and the folder of the trace.
using Program = std::pair<std::int64_t, std::string>;

Program program_of(const Stream& stream) {
  return {stream.pid.value_or(0), stream.folder};
}

// What is known of a process tells of the last program that it has executed.
std::map<Program, EndOfProcess> ends_of_programs(const std::vector<Stream>& streams, const ProcessEnds& lived_until) {
  std::map<Program, std::vector<const Stream*>> of_programs;
  std::map<std::int64_t, std::pair<std::uint64_t, Program>> last_programs;  // by process, with their ends
  for (const Stream& stream : streams) {
    if (stream.pid) {
      of_programs[program_of(stream)].push_back(&stream);
      auto& last = last_programs[*stream.pid];
      last = std::max(last, std::pair(end_of(stream), program_of(stream)));
    }
  }
  std::map<Program, EndOfProcess> ends;
  for (const auto& [program, of_program] : of_programs) {
    const auto lived = lived_until.find(program.first);
    const bool is_last = last_programs[program.first].second == program;
    ends.try_emplace(program, of_program, is_last && lived != lived_until.end() ? lived->second : ProcessEnd());
  }
  return ends;
}

// A clock of the user's own has other times.
bool has_own_clock() {
  return std::getenv("LTTNG_UST_CLOCK_PLUGIN") != nullptr;
}

std::string why_unfinished(const UnwrittenRange& range, std::vector<std::string> killed) {
  if (range.pid) {
    const std::string pid = fmt::format("[{}]", *range.pid);
    std::erase_if(killed, [&pid](const std::string& process) { return !process.ends_with(pid); });
    if (killed.empty() && range.after_losses && !range.in_doubt) {
      return fmt::format("the buffers of process {} were full to its end", *range.pid);
    }
    if (killed.empty()) {
      killed.push_back(fmt::format("process {}", *range.pid));
    }
    if (range.in_doubt) {
      return fmt::format("{} may have died within an event", killed.front());
    }
  }
  if (killed.size() > kMostUnfinished) {
    return fmt::format("one of {} killed processes died within an event", killed.size());
  }
  if (!killed.empty()) {
    return fmt::format("{} died within an event", fmt::join(killed, " or "));
  }
  return range.after_losses ? "the buffers were full to the end" : "a thread did not complete its event";
}

// The error of writing so many bytes into a new file there; 0 when they fit, or no file can be made.
int error_of_writing(const std::filesystem::path& directory) {
  const std::string path = directory / ".room";
  const int fd = open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0600);
  if (fd < 0) {
    return errno == EDQUOT || errno == ENOSPC ? errno : 0;
  }
  static constexpr std::array<char, 4096> kPage{};
  int error = 0;
  for (std::size_t written = 0; written < kRoomLeftByAWorkingConsumer && error == 0;) {
    const ssize_t count = write(fd, kPage.data(), std::min(kPage.size(), kRoomLeftByAWorkingConsumer - written));
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

std::vector<UnwrittenRange> unfinished_streams(const std::vector<Stream>& streams, std::uint64_t stopped,
                                               const ProcessEnds& lived_until) {
  std::vector<UnwrittenRange> found;
  std::uint64_t latest = stopped;
  std::uint64_t shared_end = stopped;
  if (stopped == 0) {
    for (const Stream& stream : streams) {
      if (stream.domain == "ust") {
        latest = std::max(latest, end_of(stream));
        shared_end = stream.pid ? shared_end : std::max(shared_end, end_of(stream));
      }
    }
    shared_end -= std::min(shared_end, kBetweenEnds);
  }
  if (latest == 0 || has_own_clock()) {
    return found;
  }
  const std::uint64_t origin = std::min(first_time(streams), latest);  // without a packet no time is known
  const std::map<Program, EndOfProcess> ends = ends_of_programs(streams, stopped == 0 ? ProcessEnds() : lived_until);
  for (const Stream& stream : streams) {
    if (stream.domain != "ust") {
      continue;
    }
    const std::uint64_t expected =
        stream.pid ? std::min(latest, ends.at(program_of(stream)).expected_end(stream)) : shared_end;
    const std::uint64_t end = stream.packets.empty() ? origin : end_of(stream);
    const std::uint64_t doubtful =
        stream.pid ? std::min(latest, ends.at(program_of(stream)).doubtful_until(stream)) : 0;
    const bool has_ended = end >= expected && !stream.packets.empty();
    if (has_ended && end >= doubtful) {
      continue;
    }
    found.push_back({.cpu = stream.cpu,
                     .begin_ns = end - origin,
                     .end_ns = std::max({end, expected, doubtful}) - origin,
                     .channel = stream.channel,
                     .pid = stream.pid,
                     .after_losses = discarded_in(stream) != 0,
                     .in_doubt = has_ended});
  }
  return found;
}

void find_unwritten(LossAccount& account, const std::vector<Stream>& streams, std::uint64_t stopped,
                    const ProcessEnds& lived_until) {
  if (account.cut_short) {
    return;
  }
  for (const UnwrittenRange& range : unfinished_streams(streams, stopped, lived_until)) {
    for (ChannelLoss& channel : account.channels) {
      if (channel.domain == "ust" && channel.channel == range.channel) {
        channel.unwritten.push_back(range);
        // Buffers that overwrite are never full.
        channel.unwritten.back().after_losses = range.after_losses && !channel.overwrite;
      }
    }
  }
}

std::vector<std::string> killed_processes(const std::vector<EventCounts>& counts) {
  std::vector<std::string> killed;
  for (const EventCounts& process : counts) {
    const launch::ProcessStat stat = launch::read_process_stat(static_cast<pid_t>(process.pid));
    if (process.end == 0 && (stat.name.empty() || stat.state == 'Z')) {
      killed.push_back(fmt::format("{} [{}]", process.process, process.pid));
    }
  }
  return killed;
}

bool streams_end_after(const std::filesystem::path& directory, const std::set<std::string>& channels_in_files,
                       std::uint64_t stopped) {
  if (stopped == 0 || has_own_clock()) {
    return true;
  }
  const std::vector<std::uint64_t> ends = last_times(directory, channels_in_files);
  return std::all_of(ends.begin(), ends.end(), [stopped](std::uint64_t end) { return end >= stopped; });
}

bool wait_for_last_packets(const std::filesystem::path& directory, const std::set<std::string>& channels_in_files,
                           std::uint64_t stopped, const std::function<bool()>& give_up) {
  const auto latest = std::chrono::steady_clock::now() + kLongestCommit;
  // LTTng tells nobody of a packet that it has written.
  while (!streams_end_after(directory, channels_in_files, stopped)) {
    if ((give_up && give_up()) || std::chrono::steady_clock::now() > latest) {
      return false;
    }
    std::this_thread::sleep_for(kBetweenLooks);
  }
  return true;
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

std::string describe_unfinished(const std::vector<UnwrittenRange>& unfinished, const std::vector<std::string>& killed) {
  std::string text;
  for (std::size_t i = 0; i < std::min(unfinished.size(), kMostUnfinished); ++i) {
    const UnwrittenRange& range = unfinished[i];
    text += fmt::format("{}unfinished: {}, processor {}, since {:.3f} s of {:.3f} s (channel {})", i == 0 ? "" : "; ",
                        why_unfinished(range, killed), range.cpu, to_seconds(range.begin_ns), to_seconds(range.end_ns),
                        range.channel);
  }
  if (unfinished.size() > kMostUnfinished) {
    text += fmt::format("; {} streams more", unfinished.size() - kMostUnfinished);
  }
  return text;
}

std::string describe_damage(const LossAccount& account, const EndOfStreams& known) {
  std::vector<UnwrittenRange> unwritten;
  for (const ChannelLoss& channel : account.channels) {
    unwritten.insert(unwritten.end(), channel.unwritten.begin(), channel.unwritten.end());
  }
  if (known.no_room.empty()) {
    const std::string unfinished = describe_unfinished(unwritten, known.killed);
    if (!account.stuck) {
      return unfinished;
    }
    return fmt::format("LTTng had data left and wrote nothing any more{}{}", unfinished.empty() ? "" : "; ",
                       unfinished);
  }
  if (unwritten.empty()) {
    // As of a session that was paused: when it should have been written to is not known.
    return fmt::format("{}: events are missing, their number is unknown; {}", known.no_room, kRemedy);
  }
  std::uint64_t begin = std::numeric_limits<std::uint64_t>::max();
  std::uint64_t end = 0;
  for (const UnwrittenRange& range : unwritten) {
    begin = std::min(begin, range.begin_ns);
    end = std::max(end, range.end_ns);
  }
  if (end == 0) {
    return fmt::format("{}: no event could be written; {}", known.no_room, kRemedy);
  }
  return fmt::format("{}: events after {:.3f} s of {:.3f} s are missing; {}", known.no_room, to_seconds(begin),
                     to_seconds(end), kRemedy);
}

}  // namespace tracing
