// SPDX-License-Identifier: Apache-2.0
// The connection of an agent to its launcher, its loss, and its return.
#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <filesystem>
#include <system_error>
#include <utility>
#include <vector>

#include "base/environment/own_environment.hpp"
#include "launcher/process/output/output_router.hpp"
#include "programs/agent/agent.hpp"

namespace launch {
namespace {

// So much may wait for the connection before output is read no further.
constexpr std::size_t kMostWaiting = 1024UL * 1024;

double in_seconds(Duration time) {
  return std::chrono::duration<double>(time).count();
}

}  // namespace

void Agent::listen() {
  in_source_ = loop_.on_readable(in_.get(), [this] { receive(); });
}

void Agent::watch_silence() {
  silence_timer_ = loop_.after(silence_ / 8, [this] {
    pollfd readable{in_.get(), POLLIN, 0};
    if (launcher_stopped_ || ::poll(&readable, 1, 0) == 1) {
      last_heard_ = Clock::now();
    }
    if (Clock::now() - last_heard_ > silence_) {
      const std::string what = fmt::format("nothing has come from the launcher for {} s", in_seconds(silence_));
      if (setup_.wait_milliseconds == 0) {
        note(what + ": ending what runs here");
      }
      lose(what);
    } else {
      watch_silence();
    }
  });
}

void Agent::send(FromAgent kind, const WireWriter& content) {
  std::string frame = encode(kind, content);
  const bool taken = !away_ && out_.add(frame);
  if (kept_ && is_numbered(kind)) {
    kept_->add(std::move(frame));
  }
  if (taken) {
    on_writable();
  }  // else the end of the launcher comes as the end of the other direction
}

void Agent::on_writable() {
  const std::size_t waiting = out_.waiting();
  if (waiting == 0) {
    out_source_.reset();
  } else if (!out_source_) {
    out_source_ = loop_.on_writable(out_.fd(), [this] {
      if (!out_.flush()) {
        out_source_.reset();
        lose("it takes nothing more");
        return;
      }
      on_writable();
    });
  }
  if (waiting > kMostWaiting) {
    stalled_ = true;
  } else if (stalled_ && waiting < kMostWaiting / 2) {
    stalled_ = false;
    // In a later turn: this may be called by the one who reads.
    loop_.post([this] { pump_all(); });
  }
}

void Agent::acknowledge(bool at_once) {
  if (kept_ && !away_ && (at_once ? received_.is_new() : received_.is_much())) {
    send(FromAgent::kAcknowledge, WireWriter().u64(received_.tell()));
  }
}

void Agent::lose(const std::string& why) {
  const Duration wait = std::chrono::milliseconds(setup_.wait_milliseconds);
  if (wait == Duration{0}) {
    end(1);
    return;
  }
  leave_connection();
  note(fmt::format("the connection to the launch is lost ({}): what runs here goes on for {} s{}", why,
                   in_seconds(wait), door_ ? ", or until the launch comes back" : ""));
  wait_timer_ = loop_.after(wait, [this, wait] {
    note(fmt::format("{} for {} s: ending what runs here", door_ ? "nobody has come back" : "the connection is lost",
                     in_seconds(wait)));
    end(1);
  });
  pump_all();  // from now on it is spooled
}

void Agent::leave_connection() {
  in_source_.reset();
  out_source_.reset();
  silence_timer_.reset();
  in_.reset();
  out_.close();
  frames_ = {};
  stalled_ = false;
  away_ = true;
}

void Agent::come_back(UniqueFd connection, std::uint64_t received) {
  try {
    kept_->acknowledge(received);
  } catch (const WireError& error) {
    note(fmt::format("the launch comes back with a wrong number: {}", error.what()));
    return;
  }
  leave_connection();  // the other end of an old one may be cut only there
  away_ = false;
  wait_timer_.reset();
  in_ = UniqueFd(::fcntl(connection.get(), F_DUPFD_CLOEXEC, 0));
  out_.use(std::move(connection));
  WireWriter dropped;
  std::uint32_t count = 0;
  for (auto& [number, run] : runs_) {
    const std::uint64_t lines = run.streams[0].spool.take_dropped() + run.streams[1].spool.take_dropped();
    if (lines > 0) {
      dropped.u32(number).u64(lines);
      ++count;
    }
  }
  out_.add(encode(FromAgent::kResumed, WireWriter().u64(received_.tell()).u32(count).rest(dropped.bytes())));
  for (const std::string& frame : kept_->waiting()) {
    out_.add(frame);
  }
  listen();
  last_heard_ = Clock::now();
  if (silence_ > Duration{0}) {
    watch_silence();
  }
  on_writable();
  note("the launch has come back");
  pump_all();
}

// In a file, because the connection through which standard error goes is the one that is lost.
void Agent::note(const std::string& text) {
  const std::string line = fmt::format("launch agent: {}\n", text);
  static_cast<void>(!::write(STDERR_FILENO, line.data(), line.size()));
  if (log_.empty()) {
    const std::filesystem::path directory =
        std::filesystem::path(LogDirectory::choose(own_environment())).parent_path();
    std::error_code none;
    std::filesystem::create_directories(directory, none);
    log_ = directory / fmt::format("launch-agent-{}-{}.log", setup_.name, ::getpid());
    const UniqueFd made(::open(log_.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666));
    guardian_.set_log(log_);
  }
  const UniqueFd log(::open(log_.c_str(), O_WRONLY | O_APPEND | O_CLOEXEC));
  const auto now = std::chrono::duration<double>(std::chrono::system_clock::now().time_since_epoch()).count();
  const std::string entry = fmt::format("{:.6f} [INFO] [launch.agent]: {}\n", now, text);
  static_cast<void>(!::write(log.get(), entry.data(), entry.size()));
}

}  // namespace launch
