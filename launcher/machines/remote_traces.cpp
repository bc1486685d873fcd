// SPDX-License-Identifier: Apache-2.0
#include "launcher/machines/remote_traces.hpp"

#include <algorithm>
#include <cstdlib>
#include <system_error>
#include <utility>

#include "base/text/quoted_text.hpp"
#include "launcher/machines/fetched_files.hpp"
#include "launcher/traced/machine_trace.hpp"

namespace launch {
namespace {

constexpr std::size_t kLongestSentence = 4000;

// What an agent says, for people.
std::string sentence(WireReader& reader) {
  return without_control_characters(reader.text()).substr(0, kLongestSentence);
}

}  // namespace

struct RemoteTraces::Trace {
  enum class Waits { kForNothing, kForBegin, kForSnapshot, kForEnd, kForFiles };

  Waits waits = Waits::kForNothing;
  MachineRecorder::Done done;
  std::function<void(const std::string&)> warn;
  MachineRecorder::Wish wish;
  std::unique_ptr<FetchedFiles> files;
  std::uint32_t credit = 0;  // bytes that the agent may still send
  std::uint32_t taken = 0;   // for which no credit has gone back yet
  bool dropped = false;      // what comes of files is no longer of interest
};

// A trace, or a snapshot of one.
template <typename Interface>
class RemoteTraces::Recording : public Interface {
 public:
  using Outcome = MachineRecording::Outcome;
  using Done = MachineRecording::Done;

  explicit Recording(RemoteTraces& traces) : traces_(traces), number_(++traces.numbers_) {
    traces_.traces_.emplace(number_, std::make_unique<Trace>());
  }
  ~Recording() override { traces_.traces_.erase(number_); }

  void hurry() override {
    if (trace().waits == Trace::Waits::kForFiles) {
      trace().dropped = true;
      traces_.answer(trace(), {.well = false, .error = "the launch was to end at once"});
    } else if (!traces_.lost_ && trace().waits == Trace::Waits::kForEnd) {
      traces_.send_(ToAgent::kTraceHurry, WireWriter().u32(number_));
    }
  }

  void fetch(const std::string& directory, Done done) override {
    try {
      trace().files = std::make_unique<FetchedFiles>(directory);
    } catch (const std::system_error& error) {
      trace().done = std::move(done);
      traces_.answer(trace(), {.well = false, .error = error.what()});
      return;
    }
    trace().credit = kTraceWindow;
    ask(Trace::Waits::kForFiles, ToAgent::kTraceFetch, WireWriter().u32(number_).u32(kTraceWindow), std::move(done));
  }

  std::uint64_t fetched() const override { return trace().files ? trace().files->bytes() : 0; }

  void leave(bool remove) override {
    if (!traces_.lost_) {
      traces_.send_(ToAgent::kTraceLeave, WireWriter().u32(number_).flag(remove));
    }
  }

 protected:
  Trace& trace() const { return *traces_.traces_.at(number_); }
  void ask(typename Trace::Waits waits, ToAgent kind, const WireWriter& content, Done done) {
    trace().done = std::move(done);
    trace().waits = waits;
    if (traces_.lost_) {
      traces_.answer(trace(), {.well = false, .lost = true, .error = *traces_.lost_});
    } else {
      traces_.send_(kind, content);
    }
  }

  RemoteTraces& traces_;
  std::uint32_t number_;
};

class RemoteTraces::Snapshot final : public Recording<MachineRecording> {
 public:
  using Recording::Recording;

  void take(std::uint32_t trace_number, tracing::SnapshotOrder order, Done done) {
    const auto clock = traces_.clock_.measured();
    order.moment = order.moment == 0 || !clock ? 0 : order.moment + clock->offset_ns;
    ask(Trace::Waits::kForSnapshot, ToAgent::kTraceSnapshot,
        WireWriter().u32(trace_number).u32(number_).rest(to_wire(order)), std::move(done));
  }
};

class RemoteTraces::Recorder final : public Recording<MachineRecorder> {
 public:
  using Recording::Recording;

  const std::string& machine() const override { return traces_.machine_; }
  std::int64_t clock_ahead() const override {
    const auto clock = traces_.clock_.measured();
    return clock && std::abs(clock->wall_offset_ns) > clock->uncertainty_ns ? clock->wall_offset_ns : 0;
  }

  void begin(const std::string& request, std::function<void(const std::string&)> warn, Wish wish, Done done) override {
    trace().warn = std::move(warn);
    trace().wish = std::move(wish);
    WireWriter content;
    content.u32(number_).rest(request);
    if (content.bytes().size() > kLongestFrame) {
      trace().done = std::move(done);
      traces_.answer(trace(), {.well = false, .error = "the settings are longer than a connection takes"});
      return;
    }
    ask(Trace::Waits::kForBegin, ToAgent::kTraceBegin, content, std::move(done));
  }

  std::unique_ptr<MachineRecording> take_snapshot(tracing::SnapshotOrder order, Done done) override {
    auto snapshot = std::make_unique<Snapshot>(traces_);
    snapshot->take(number_, std::move(order), std::move(done));
    return snapshot;
  }

  void end(bool nothing_to_record, Done done) override {
    ask(Trace::Waits::kForEnd, ToAgent::kTraceEnd, WireWriter().u32(number_).flag(nothing_to_record), std::move(done));
  }
};

RemoteTraces::RemoteTraces(EventLoop& loop, std::string machine, ClockOffset& clock, Send send)
    : loop_(loop), machine_(std::move(machine)), clock_(clock), send_(std::move(send)) {}

RemoteTraces::~RemoteTraces() = default;

std::unique_ptr<MachineRecorder> RemoteTraces::recorder() {
  return std::make_unique<Recorder>(*this);
}

// In a later turn of the loop, because the one who asked may not be ready for the answer.
void RemoteTraces::answer(Trace& trace, MachineRecorder::Outcome outcome) {
  if (trace.files && !outcome.well) {
    trace.files->remove();
  }
  trace.files.reset();
  trace.waits = Trace::Waits::kForNothing;
  loop_.post([done = std::exchange(trace.done, nullptr), outcome = std::move(outcome)] {
    if (done) {
      done(outcome);
    }
  });
}

void RemoteTraces::receive(FromAgent kind, WireReader& reader) {
  const std::uint32_t number = reader.u32();
  if (number == 0 || number > numbers_) {
    throw WireError("a message is about a trace that was never asked for");
  }
  const auto found = traces_.find(number);
  if (found == traces_.end()) {
    return;  // it has ended here meanwhile
  }
  Trace& trace = *found->second;
  switch (kind) {
    case FromAgent::kTraceTold: {
      const std::string text = sentence(reader);
      reader.end();
      if (trace.warn) {
        trace.warn(text);
      }
      return;
    }
    case FromAgent::kTraceWish: {
      MachineRecorder::Reason reason;
      reason.kind =
          reader.flag() ? MachineRecorder::Reason::Kind::kEndOfProcess : MachineRecorder::Reason::Kind::kEvent;
      reason.text = sentence(reader);
      reason.code = reader.i32();
      reader.end();
      if (!trace.wish) {
        throw WireError("it wants a snapshot of a trace that has not begun");
      }
      trace.wish(reason);
      return;
    }
    case FromAgent::kTraceBegun:
    case FromAgent::kTraceEnded: {
      const bool begins = kind == FromAgent::kTraceBegun;
      if (begins ? trace.waits != Trace::Waits::kForBegin
                 : trace.waits != Trace::Waits::kForEnd && trace.waits != Trace::Waits::kForSnapshot) {
        throw WireError("a trace begins or ends unasked");
      }
      MachineRecorder::Outcome outcome;
      outcome.well = reader.flag();
      outcome.error = sentence(reader);
      outcome.help = sentence(reader);
      outcome.directory = sentence(reader);
      reader.end();
      if (begins) {
        clock_.keep_epoch();
      }
      answer(trace, std::move(outcome));
      return;
    }
    case FromAgent::kTraceFile:
    case FromAgent::kTraceBytes:
    case FromAgent::kTraceSum:
    case FromAgent::kTraceAll:
    case FromAgent::kTraceFailed:
      take_file(trace, kind, reader);
      return;
    default:
      throw WireError("it sends a message of an unknown kind");
  }
}

void RemoteTraces::take_file(Trace& trace, FromAgent kind, WireReader& reader) {
  if (trace.dropped) {
    return;
  }
  if (!trace.files) {
    throw WireError("it sends files that nobody has asked for");
  }
  const std::uint32_t number = std::find_if(traces_.begin(), traces_.end(), [&](const auto& each) {
                                 return each.second.get() == &trace;
                               })->first;
  try {
    switch (kind) {
      case FromAgent::kTraceFile: {
        const std::string path = reader.text();
        const std::uint64_t size = reader.u64();
        reader.end();
        trace.files->begin_file(path, size);
        return;
      }
      case FromAgent::kTraceBytes: {
        const std::string_view bytes = reader.rest();
        if (bytes.size() > trace.credit) {
          throw WireError("it sends more of a recording than it may");
        }
        trace.credit -= static_cast<std::uint32_t>(bytes.size());
        trace.taken += static_cast<std::uint32_t>(bytes.size());
        trace.files->add(bytes);
        if (trace.taken >= kTraceWindow / 4) {
          trace.credit += trace.taken;
          send_(ToAgent::kTraceFetch, WireWriter().u32(number).u32(std::exchange(trace.taken, 0)));
        }
        return;
      }
      case FromAgent::kTraceSum: {
        const std::uint64_t sum = reader.u64();
        reader.end();
        trace.files->end_file(sum);
        return;
      }
      case FromAgent::kTraceAll: {
        const std::uint32_t files = reader.u32();
        const std::uint64_t bytes = reader.u64();
        reader.end();
        if (const auto measured = clock_.measured()) {
          trace.files->add_own_file(kClockFile, clock_as_json(machine_, *measured, this_boot()));
        }
        trace.files->finish(files, bytes);
        answer(trace, {});
        return;
      }
      default: {
        const std::string text = sentence(reader);
        reader.end();
        trace.dropped = true;
        answer(trace, {.well = false, .error = text});
        return;
      }
    }
  } catch (const std::system_error& error) {
    // This side can't take it; the connection is as good as before.
    trace.dropped = true;
    answer(trace, {.well = false, .error = error.what()});
  }
}

void RemoteTraces::lose(const std::string& why) {
  lost_ = why;
  for (auto& [number, trace] : traces_) {
    if (trace->wish) {
      loop_.post(
          [wish = std::exchange(trace->wish, nullptr)] { wish({.kind = MachineRecorder::Reason::Kind::kLost}); });
    }
    if (trace->waits != Trace::Waits::kForNothing) {
      answer(*trace, {.well = false, .lost = true, .error = why});
    }
  }
}

}  // namespace launch
