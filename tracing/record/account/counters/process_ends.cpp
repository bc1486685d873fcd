// SPDX-License-Identifier: Apache-2.0
#include "tracing/record/account/counters/process_ends.hpp"

#include <algorithm>
#include <fstream>

namespace tracing {
namespace {

// All streams of a process are ended within this time: it takes microseconds, unless the consumer is interrupted.
constexpr std::uint64_t kOneGo = 10'000'000;  // ns
// Within this time packets were ended by one tick of the switch timer.
constexpr std::uint64_t kTick = 200'000;  // ns
// A launch on a busy machine sees the end of a process so late, and one on an idle machine sooner than that.
constexpr std::uint64_t kLongestUnseen = 50'000'000;  // ns
constexpr std::uint64_t kSoon = 2'000'000;            // ns

std::string file_of(const std::string& counters) {
  return counters + "/process-ends";
}

std::uint64_t before(std::uint64_t time, std::uint64_t difference) {
  return time - std::min(time, difference);
}

// The first packet may be empty for another reason: the switch timer has ended it.
bool has_an_empty_end(const Stream& stream) {
  return stream.packets.size() > 1 && stream.packets.back().is_empty;
}

}  // namespace

void note_process_end(const std::string& counters, pid_t pid, std::uint64_t time, bool died) {
  if (!counters.empty()) {
    std::ofstream(file_of(counters), std::ios::app)
        << pid << ' ' << before(time, kLongestUnseen) << ' ' << (died ? before(time, kSoon) : 0) << '\n';
  }
}

ProcessEnds read_process_ends(const std::string& counters, const std::vector<EventCounts>& counts) {
  ProcessEnds ends;
  if (!counters.empty()) {
    std::ifstream file(file_of(counters));
    std::int64_t pid = 0;
    for (ProcessEnd end; file >> pid >> end.lived_until >> end.may_have_lived_to;) {
      ends[pid] = end;
    }
  }
  for (const EventCounts& process : counts) {
    if (process.end != 0) {
      ends[process.pid] = {.lived_until = process.end};
    }
  }
  return ends;
}

EndOfProcess::EndOfProcess(const std::vector<const Stream*>& streams, const ProcessEnd& known) {
  std::uint64_t certain = 0;
  for (const Stream* const stream : streams) {
    if (stream->packets.empty()) {
      continue;
    }
    const std::uint64_t end = stream->packets.back().end;
    end_ = std::max(end_, end);
    certain = has_an_empty_end(*stream) ? std::max(certain, end) : certain;
    for (std::size_t i = 0; i + 1 < stream->packets.size(); ++i) {
      earlier_.emplace_back(stream, stream->packets[i].end);
    }
  }
  least_ = certain != 0 ? before(certain, kOneGo) : std::max(before(end_, kOneGo), known.lived_until);
  doubtful_until_ = certain != 0 ? 0 : known.may_have_lived_to;
}

std::uint64_t EndOfProcess::expected_end(const Stream& stream) const {
  if (has_an_empty_end(stream)) {
    return 0;
  }
  const std::uint64_t end = stream.packets.empty() ? 0 : stream.packets.back().end;
  const bool is_tick =
      end + kTick < end_ && std::any_of(earlier_.begin(), earlier_.end(), [&](const auto& earlier) {
        return earlier.first != &stream && earlier.second + kTick >= end && earlier.second <= end + kTick;
      });
  return end < least_ || is_tick ? std::max(least_, end_) : least_;
}

std::uint64_t EndOfProcess::doubtful_until(const Stream& stream) const {
  const bool may_lack =
      !has_an_empty_end(stream) && !stream.packets.empty() && stream.packets.back().end < doubtful_until_;
  return may_lack ? doubtful_until_ : 0;
}

}  // namespace tracing
