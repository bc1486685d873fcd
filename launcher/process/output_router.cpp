// SPDX-License-Identifier: Apache-2.0
#include "launcher/process/output_router.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <signal.h>
#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <system_error>
#include <utility>
#include <vector>

#include "launcher/base/unique_fd.hpp"
#include "launcher/base/utf8.hpp"

namespace launch {
namespace {

// A line longer than this is written in parts, so that a child that never ends a line can't fill the memory.
constexpr std::size_t kLongestLine = 1024 * 1024;

struct LevelStyle {
  const char* name;
  const char* colour;
};

LevelStyle style(LogLevel level) {
  switch (level) {
    case LogLevel::kDebug:
      return {"DEBUG", "\033[2m"};
    case LogLevel::kInfo:
      return {"INFO", ""};
    case LogLevel::kWarning:
      return {"WARNING", "\033[33m"};
    case LogLevel::kError:
      return {"ERROR", "\033[31m"};
    case LogLevel::kCritical:
      return {"CRITICAL", "\033[1;31m"};
  }
  return {"INFO", ""};
}

// The start of each line in launch.log: "1700000000.1234567 ".
std::string time_stamp() {
  timespec now{};
  ::clock_gettime(CLOCK_REALTIME, &now);
  return fmt::format("{}.{:07} ", now.tv_sec, now.tv_nsec / 100);
}

// Writes everything, even if the descriptor is non-blocking: other programs share the terminal and may have made it so.
// Returns 0 or the error number.
int write_all(int fd, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t written = ::write(fd, bytes.data(), bytes.size());
    if (written >= 0) {
      bytes.remove_prefix(static_cast<std::size_t>(written));
    } else if (errno == EAGAIN) {
      pollfd writable{fd, POLLOUT, 0};
      ::poll(&writable, 1, -1);
    } else if (errno != EINTR) {
      return errno;
    }
  }
  return 0;
}

}  // namespace

struct OutputRouter::Impl {
  // One log file. Only its first error is reported; later lines are tried again, since a full disk may get room.
  struct LogFile {
    std::string path;
    UniqueFd fd;
    bool failure_told = false;
  };
  struct Stream {
    std::string prefix;  // "[LABEL] "
    std::string rest;    // bytes of a line that has not ended yet
    LogFile own;         // LABEL-stdout.log or LABEL-stderr.log
  };
  struct Child {
    std::array<Stream, 2> streams;
    LogFile both;  // LABEL.log
  };

  explicit Impl(Options given) : options(std::move(given)) {}

  Child& child(ProcessId process) {
    if (children.size() <= process) {
      children.resize(process + 1);
    }
    if (!children[process]) {
      children[process] = std::make_unique<Child>();
    }
    return *children[process];
  }

  void write_lines(ProcessId process, Child& owner, Stream& stream, const std::string& label, OutputStream which,
                   const OutputTargets& targets, std::string_view text);
  void observe(ProcessId process, OutputStream which, std::string_view text);
  void to_screen(std::string_view text);
  void to_file(LogFile& file, std::string_view text);

  Options options;
  LineObserver line_observer;
  bool screen_gone = false;
  LogFile launch_log;
  std::vector<std::unique_ptr<Child>> children;  // by ProcessId
  // Kept between calls for their memory.
  std::string repaired;
  std::string plain_lines;
  std::string stamped_lines;
};

OutputRouter::OutputRouter(Options options) : impl_(std::make_unique<Impl>(std::move(options))) {
  // Otherwise the end of `launch ... | head` would kill the launcher before it has ended its processes.
  struct sigaction action {};
  if (::sigaction(SIGPIPE, nullptr, &action) == 0 && action.sa_handler == SIG_DFL) {
    action.sa_handler = SIG_IGN;
    ::sigaction(SIGPIPE, &action, nullptr);
  }
  if (!impl_->options.log_directory.empty()) {
    Impl::LogFile& log = impl_->launch_log;
    log.path = impl_->options.log_directory + "/launch.log";
    log.fd.reset(::open(log.path.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666));
    if (!log.fd) {
      throw std::system_error(errno, std::system_category(), fmt::format("cannot create '{}'", log.path));
    }
  }
}

OutputRouter::~OutputRouter() = default;

void OutputRouter::write(ProcessId process, const std::string& label, OutputStream which, const OutputTargets& targets,
                         std::string_view bytes) {
  Impl::Child& child = impl_->child(process);
  Impl::Stream& stream = child.streams[static_cast<std::size_t>(which)];
  const std::size_t last_end = bytes.rfind('\n');
  if (last_end == std::string_view::npos) {
    stream.rest.append(bytes);
    if (stream.rest.size() > kLongestLine) {
      const std::size_t kept = incomplete_utf8_suffix(stream.rest);
      const std::string part = stream.rest.substr(0, stream.rest.size() - kept);
      stream.rest.erase(0, part.size());
      impl_->write_lines(process, child, stream, label, which, targets, part);
    }
    return;
  }
  // A line end is never part of a longer character, so whole lines can be checked without the bytes after them.
  if (stream.rest.empty()) {
    impl_->write_lines(process, child, stream, label, which, targets, bytes.substr(0, last_end));
  } else {
    const std::string begun = std::move(stream.rest.append(bytes.substr(0, last_end)));
    impl_->write_lines(process, child, stream, label, which, targets, begun);
  }
  stream.rest.assign(bytes.substr(last_end + 1));
}

void OutputRouter::close_stream(ProcessId process, const std::string& label, OutputStream which,
                                const OutputTargets& targets) {
  Impl::Child& child = impl_->child(process);
  Impl::Stream& stream = child.streams[static_cast<std::size_t>(which)];
  if (!stream.rest.empty()) {
    const std::string last = std::exchange(stream.rest, {});
    impl_->write_lines(process, child, stream, label, which, targets, last);
  }
  stream.own.fd.reset();
  if (!child.streams[0].own.fd && !child.streams[1].own.fd) {
    child.both.fd.reset();
  }
}

void OutputRouter::observe_lines(LineObserver observer) {
  impl_->line_observer = std::move(observer);
}

void OutputRouter::message(LogLevel level, std::string_view logger, std::string_view text) {
  const LevelStyle look = style(level);
  std::string repaired;
  append_as_utf8(repaired, text);
  if (level >= impl_->options.screen_level) {
    const bool colour = impl_->options.colour && *look.colour != '\0';
    impl_->to_screen(fmt::format("{}[{}] [{}]: {}{}\n", colour ? look.colour : "", look.name, logger, repaired,
                                 colour ? "\033[0m" : ""));
  }
  if (impl_->launch_log.fd) {
    impl_->to_file(impl_->launch_log, fmt::format("{}[{}] [{}]: {}\n", time_stamp(), look.name, logger, repaired));
  }
}

// `text` holds one or more lines, without the last line end.
void OutputRouter::Impl::write_lines(ProcessId process, Child& owner, Stream& stream, const std::string& label,
                                     OutputStream which, const OutputTargets& targets, std::string_view text) {
  const bool files = !options.log_directory.empty();
  const bool own_log = targets.own_log && files;
  const bool plain = targets.screen || own_log;
  const bool stamped = targets.log && files;
  if (!plain && !stamped && !line_observer) {
    return;
  }
  if (!is_utf8(text)) {
    repaired.clear();
    append_as_utf8(repaired, text);
    text = repaired;
  }
  if (line_observer) {
    observe(process, which, text);
  }
  if (stream.prefix.empty()) {
    stream.prefix = fmt::format("[{}] ", label);
  }
  const std::string stamp = stamped ? time_stamp() : std::string();
  plain_lines.clear();
  stamped_lines.clear();
  for (bool more = true; more;) {
    const std::size_t end = text.find('\n');
    more = end != std::string_view::npos;
    const std::string_view line = text.substr(0, end);
    if (plain) {
      plain_lines.append(stream.prefix).append(line).push_back('\n');
    }
    if (stamped) {
      stamped_lines.append(stamp).append(stream.prefix).append(line).push_back('\n');
    }
    text.remove_prefix(more ? end + 1 : text.size());
  }
  if (targets.screen) {
    to_screen(plain_lines);
  }
  if (stamped) {
    to_file(launch_log, stamped_lines);
  }
  if (own_log) {
    std::string name = label;
    std::replace(name.begin(), name.end(), '/', '_');
    const std::string base = options.log_directory + "/" + name;
    stream.own.path = base + (which == OutputStream::kOut ? "-stdout.log" : "-stderr.log");
    owner.both.path = base + ".log";
    to_file(stream.own, plain_lines);
    to_file(owner.both, plain_lines);
  }
}

void OutputRouter::Impl::observe(ProcessId process, OutputStream which, std::string_view text) {
  for (bool more = true; more;) {
    const std::size_t end = text.find('\n');
    more = end != std::string_view::npos;
    std::string_view line = text.substr(0, end);
    if (line.ends_with('\r')) {
      line.remove_suffix(1);  // a pseudo-terminal ends lines with "\r\n"
    }
    line_observer(process, which, line);
    text.remove_prefix(more ? end + 1 : text.size());
  }
}

void OutputRouter::Impl::to_screen(std::string_view text) {
  // A screen that has gone (a closed terminal, the end of a pipe) does not come back. The logs go on.
  if (!screen_gone) {
    screen_gone = write_all(options.screen_fd, text) != 0;
  }
}

void OutputRouter::Impl::to_file(LogFile& file, std::string_view text) {
  if (!file.fd) {
    file.fd.reset(::open(file.path.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666));
  }
  const int error = file.fd ? write_all(file.fd.get(), text) : errno;
  if (error != 0 && !file.failure_told) {
    file.failure_told = true;
    to_screen(fmt::format("[WARNING] [launch]: cannot write '{}': {}\n", file.path, std::strerror(error)));
  }
}

}  // namespace launch
