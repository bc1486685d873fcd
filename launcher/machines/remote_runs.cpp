// SPDX-License-Identifier: Apache-2.0
#include "launcher/machines/remote_runs.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include <cerrno>
#include <utility>

#include "base/files/pipe.hpp"
#include "base/text/quoted_text.hpp"
#include "launcher/machines/protocol/spec_wire.hpp"
#include "launcher/process/process_runner.hpp"

namespace launch {
namespace {

UniqueFd make_event() {
  UniqueFd event(::eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK));
  if (!event) {
    throw std::system_error(errno, std::system_category(), "cannot make a descriptor for a process");
  }
  return event;
}

UniqueFd copy_of(const UniqueFd& fd) {
  UniqueFd copy(::fcntl(fd.get(), F_DUPFD_CLOEXEC, 0));
  if (!copy) {
    throw std::system_error(errno, std::system_category(), "cannot make a descriptor for a process");
  }
  return copy;
}

void let_not_block(const UniqueFd& fd) {
  ::fcntl(fd.get(), F_SETFL, ::fcntl(fd.get(), F_GETFL) | O_NONBLOCK);
}

std::size_t stream_number(WireReader& reader) {
  const std::uint8_t which = reader.u8();
  if (which > 1) {
    throw WireError("a stream is neither standard output nor standard error");
  }
  return which;
}

}  // namespace

Process RemoteRuns::start(const ProcessSpec& spec) {
  if (lost_) {
    throw NeverStarts(ECONNABORTED, *lost_);
  }
  WireWriter content;
  const std::uint32_t number = numbers_ + 1;
  content.u32(number);
  try {
    put(content, spec);
    if (content.bytes().size() > kLongestFrame) {
      throw WireError("the process has more words, variables and parameters than a connection takes");
    }
  } catch (const WireError& error) {
    throw std::system_error(E2BIG, std::system_category(), error.what());
  }
  auto run = std::make_unique<Run>();
  run->label = spec.label.empty() ? spec.name : spec.label;
  run->event = make_event();
  Process process;
  process.machine = spec.machine;
  process.run = number;
  process.starting = true;
  process.pidfd = copy_of(run->event);
  for (const auto& [stream, end] :
       {std::pair{&run->streams[0], &process.out}, std::pair{&run->streams[1], &process.err}}) {
    Pipe pipe = make_pipe();
    let_not_block(pipe.read);
    let_not_block(pipe.write);
    stream->pipe = std::move(pipe.write);
    *end = std::move(pipe.read);
  }
  numbers_ = number;
  runs_.emplace(number, std::move(run));
  send_(ToAgent::kStart, content);
  return process;
}

void RemoteRuns::confirm(Process& process) {
  Run& run = find(process.run);
  std::uint64_t count = 0;
  static_cast<void>(!::read(run.event.get(), &count, sizeof count));
  if (run.failure) {
    const std::system_error failure = *run.failure;
    const bool lost = lost_.has_value();
    runs_.erase(process.run);
    if (lost) {
      throw NeverStarts(failure.code().value(), *lost_);
    }
    throw failure;
  }
  run.confirmed = true;
  process.starting = false;
  process.pid = run.pid;
  tell_exit(run);
}

RemoteRuns::Run& RemoteRuns::find(std::uint32_t number) {
  const auto found = runs_.find(number);
  if (found == runs_.end()) {
    throw WireError("a message is about a process that is not there");
  }
  return *found->second;
}

void RemoteRuns::tell(Run& run) {
  const std::uint64_t one = 1;
  static_cast<void>(!::write(run.event.get(), &one, sizeof one));
}

void RemoteRuns::signal(const Process& process, int signal) {
  send_(ToAgent::kSignal, WireWriter().u32(process.run).i32(signal));
}

ProcessExit RemoteRuns::outcome(const Process& process) const {
  const auto found = runs_.find(process.run);
  return found != runs_.end() && found->second->exit ? *found->second->exit : ProcessExit{};
}

ProcessExit RemoteRuns::reap(const Process& process) {
  const ProcessExit exit = outcome(process);
  if (runs_.erase(process.run) > 0) {
    send_(ToAgent::kRelease, WireWriter().u32(process.run));
  }
  return exit;
}

std::vector<bool> RemoteRuns::groups_live(const std::vector<const Process*>& leaders) {
  std::vector<bool> live;
  WireWriter question;
  question.u32(static_cast<std::uint32_t>(leaders.size()));
  for (const Process* const leader : leaders) {
    const auto found = runs_.find(leader->run);
    live.push_back(!lost_ && found != runs_.end() && found->second->group_lives);
    question.u32(leader->run);
  }
  send_(ToAgent::kGroups, question);
  return live;
}

void RemoteRuns::receive(FromAgent kind, WireReader& reader) {
  if (kind == FromAgent::kGroups) {
    for (std::uint32_t left = reader.count(sizeof(std::uint32_t) + 1); left > 0; --left) {
      const std::uint32_t number = reader.u32();
      const bool lives = reader.flag();
      if (const auto found = runs_.find(number); found != runs_.end()) {  // else it was reaped meanwhile
        found->second->group_lives = lives;
      }
    }
    reader.end();
    return;
  }
  const std::uint32_t number = reader.u32();
  if (number == 0 || number > numbers_) {
    throw WireError("a message is about a process that was never asked for");
  }
  const auto found = runs_.find(number);
  if (found == runs_.end()) {
    return;  // it was reaped here while the message was on its way
  }
  Run& run = *found->second;
  if (kind != FromAgent::kStarted && kind != FromAgent::kFailed && (!run.answered || run.failure)) {
    throw WireError("a message is about a process that has not been started");
  }
  switch (kind) {
    case FromAgent::kStarted:
    case FromAgent::kFailed: {
      if (run.answered) {
        throw WireError("a process is started twice");
      }
      run.answered = true;
      if (kind == FromAgent::kStarted) {
        run.pid = reader.i32();
        if (run.pid <= 0) {
          throw WireError("a process has a number that is none");
        }
      } else {
        const int error = reader.i32();
        // what() of the exception there has the name of the error, too; it is told as it is.
        std::string text = without_control_characters(reader.text());
        const std::string name = ": " + std::system_category().message(error);
        if (text.ends_with(name)) {
          text.erase(text.size() - name.size());
        }
        run.failure.emplace(error, std::system_category(), text);
      }
      reader.end();
      tell(run);
      return;
    }
    case FromAgent::kOutput: {
      const std::size_t which = stream_number(reader);
      Stream& stream = run.streams[which];
      const std::string_view bytes = reader.rest();
      if (bytes.size() > stream.credit || stream.ends) {
        throw WireError("it sends more output than it may");
      }
      stream.credit -= static_cast<std::uint32_t>(bytes.size());
      stream.waiting += bytes;
      pass_on(number, run, which);
      return;
    }
    case FromAgent::kClosed: {
      const std::size_t which = stream_number(reader);
      reader.end();
      run.streams[which].ends = true;
      pass_on(number, run, which);
      return;
    }
    case FromAgent::kExited:
      if (run.exit) {
        throw WireError("a process ends twice");
      }
      run.exit = get_exit(reader);
      reader.end();
      tell_exit(run);
      return;
    default:
      throw WireError("it sends a message of an unknown kind");
  }
}

void RemoteRuns::pass_on(std::uint32_t number, Run& run, std::size_t which) {
  Stream& stream = run.streams[which];
  std::size_t written = 0;
  bool reads = true;
  while (stream.pipe && written < stream.waiting.size()) {
    const ssize_t count = ::write(stream.pipe.get(), stream.waiting.data() + written, stream.waiting.size() - written);
    if (count >= 0) {
      written += static_cast<std::size_t>(count);
    } else if (errno == EAGAIN) {
      break;
    } else if (errno != EINTR) {
      reads = false;  // the supervisor has closed it
      break;
    }
  }
  if (!stream.pipe || !reads) {
    written = stream.waiting.size();
  }
  stream.waiting.erase(0, written);
  stream.taken += static_cast<std::uint32_t>(written);
  if (stream.waiting.empty()) {
    stream.source.reset();
    give_credit(number, which, stream, false);
    if (stream.ends || !reads) {
      stream.pipe.reset();
    }
    tell_exit(run);
    return;
  }
  give_credit(number, which, stream, false);
  if (!stream.source) {
    stream.source = loop_.on_writable(stream.pipe.get(), [this, number, which] {
      if (const auto found = runs_.find(number); found != runs_.end()) {
        pass_on(number, *found->second, which);
      }
    });
  }
}

void RemoteRuns::give_credit(std::uint32_t number, std::size_t which, Stream& stream, bool at_once) {
  if (stream.ends || stream.taken == 0 || (!at_once && stream.taken < kStreamWindow / 4)) {
    return;
  }
  stream.credit += stream.taken;
  send_(ToAgent::kCredit,
        WireWriter().u32(number).u8(static_cast<std::uint8_t>(which)).u32(std::exchange(stream.taken, 0)));
}

// What it has printed before its end comes before its end.
void RemoteRuns::tell_exit(Run& run) {
  if (run.exit && run.confirmed && !run.exit_told && run.streams[0].waiting.empty() && run.streams[1].waiting.empty()) {
    run.exit_told = true;
    tell(run);
  }
}

void RemoteRuns::lose(const std::string& why) {
  lost_ = why;
  for (auto& [number, run] : runs_) {
    if (!run->answered) {
      run->answered = true;
      run->failure.emplace(ECONNABORTED, std::system_category(), why);
      tell(*run);
    } else if (!run->failure && !run->exit) {
      run->exit = ProcessExit{.code = kExitCodeOfLost, .lost = true};
    }
    for (std::size_t which = 0; which < run->streams.size(); ++which) {
      run->streams[which].ends = true;
      pass_on(number, *run, which);
    }
    tell_exit(*run);
  }
}

std::string RemoteRuns::label(std::uint32_t number) const {
  const auto found = runs_.find(number);
  return found == runs_.end() ? "a process that has ended" : found->second->label;
}

std::string RemoteRuns::running_labels() const {
  constexpr int kShown = 10;
  std::string text;
  int count = 0;
  for (const auto& [number, run] : runs_) {
    if (run->exit || run->failure) {
      continue;
    }
    if (++count <= kShown) {
      text += (text.empty() ? "" : ", ") + run->label;
    }
  }
  return count > kShown ? fmt::format("{} and {} more", text, count - kShown) : text;
}

}  // namespace launch
