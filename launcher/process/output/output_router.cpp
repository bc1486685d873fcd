// SPDX-License-Identifier: Apache-2.0
#include "launcher/process/output/output_router.hpp"

#include <fmt/format.h>
#include <signal.h>
#include <sys/stat.h>
#include <syslog.h>
#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <optional>
#include <system_error>
#include <utility>
#include <vector>

#include "base/text/utf8.hpp"
#include "launcher/process/output/log_file.hpp"

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

double seconds_since_1970() {
  timespec now{};
  ::clock_gettime(CLOCK_REALTIME, &now);
  return static_cast<double>(now.tv_sec) + static_cast<double>(now.tv_nsec) * 1e-9;
}

// Whether lines of both would get mixed up if each had a queue of its own.
bool is_same_file(int one, int other) {
  struct stat first {};
  struct stat second {};
  return ::fstat(one, &first) == 0 && ::fstat(other, &second) == 0 && first.st_dev == second.st_dev &&
         first.st_ino == second.st_ino && !S_ISREG(first.st_mode);
}

}  // namespace

struct OutputRouter::Impl {
  struct Stream {
    std::string prefix;  // "[LABEL] "
    std::string rest;    // bytes of a line that has not ended yet
    LogFile own;         // LABEL-stdout.log or LABEL-stderr.log
  };
  struct Child {
    std::array<Stream, 2> streams;
    LogFile both;  // LABEL.log
  };

  explicit Impl(Options given);

  Child& child(ProcessId process) {
    if (children.size() <= process) {
      children.resize(process + 1);
    }
    if (!children[process]) {
      children[process] = std::make_unique<Child>();
      Child& created = *children[process];
      for (LogFile* const file : {&created.streams[0].own, &created.streams[1].own, &created.both}) {
        file->set_limits({options.rotation.size, options.rotation.files});
      }
    }
    return *children[process];
  }

  void write_lines(ProcessId process, Child& owner, Stream& stream, const std::string& label, OutputStream which,
                   const OutputTargets& targets, std::string_view text);
  void observe(ProcessId process, OutputStream which, std::string_view text);
  // False: the lines are not shown. `logged`: they are in launch.log. `prefix` is what all of them begin with.
  bool to_screen(std::string_view text, bool logged, ProcessId process = 0, std::string_view prefix = {});
  // Returns the lines that the journal did not take.
  std::string to_journal(std::string_view lines, ProcessId process, std::string_view prefix,
                         std::optional<int> known_priority = {});
  void finish_screens();
  // Takes whole lines as they would stand on the screen.
  void to_launch_log(std::string_view lines);
  void to_file(LogFile& file, std::string_view text);

  Options options;
  LineObserver line_observer;
  std::function<Journal::Origin(ProcessId process)> origin_of;
  LogFile launch_log;
  std::vector<std::unique_ptr<Child>> children;  // by ProcessId
  Screen screen;
  std::optional<Screen> error_screen;  // unless errors go where the other lines go
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
    LogFile& log = impl_->launch_log;
    log.set_path(impl_->options.log_directory + "/" + impl_->options.log_name);
    if (!log.open()) {
      throw std::system_error(errno, std::system_category(), fmt::format("cannot create '{}'", log.path()));
    }
  }
}

OutputRouter::~OutputRouter() {
  impl_->finish_screens();
}

OutputRouter::Impl::Impl(Options given)
    : options(std::move(given)), screen(options.screen_fd, options.loop, options.screen_limits) {
  const Screen::Notice notice = [this](std::size_t lines) {
    const std::string place = launch_log.is_open() ? fmt::format(", all are in {}", launch_log.path()) : std::string();
    return fmt::format("[WARNING] [launch]: {} {} dropped on the screen{}\n", lines, lines == 1 ? "line" : "lines",
                       place);
  };
  launch_log.set_limits({options.rotation.size, options.rotation.files});
  screen.tell_of_dropped(notice);
  if (options.error_fd >= 0 && !is_same_file(options.screen_fd, options.error_fd)) {
    error_screen.emplace(options.error_fd, options.loop, options.screen_limits);
    error_screen->tell_of_dropped(notice);
  }
}

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
  stream.own.close();
  if (!child.streams[0].own.is_open() && !child.streams[1].own.is_open()) {
    child.both.close();
  }
}

void OutputRouter::describe_processes(std::function<Journal::Origin(ProcessId process)> origin_of) {
  impl_->origin_of = std::move(origin_of);
}

void OutputRouter::observe_lines(LineObserver observer) {
  impl_->line_observer = std::move(observer);
}

void OutputRouter::message(LogLevel level, std::string_view logger, std::string_view text) {
  const LevelStyle look = style(level);
  std::string repaired;
  append_as_utf8(repaired, text);
  const FormattedMessage message{seconds_since_1970(), (static_cast<int>(level) + 1) * 10, look.name, logger, repaired};
  const std::string usual = fmt::format("[{}] [{}]: {}", look.name, logger, repaired);
  const Options& options = impl_->options;
  if (level >= options.screen_level) {
    const bool colour = options.colour && *look.colour != '\0';
    const std::string line = options.screen_format ? options.screen_format->line(message)
                             : options.timestamps  ? time_stamp() + usual
                                                   : usual;
    impl_->to_screen(fmt::format("{}{}{}\n", colour ? look.colour : "", line, colour ? "\033[0m" : ""), true);
  }
  if (impl_->launch_log.is_open()) {
    const std::string line = options.log_format ? options.log_format->line(message) : time_stamp() + usual;
    impl_->to_file(impl_->launch_log, line + "\n");
  }
}

void OutputRouter::show_status(std::string_view text) {
  impl_->screen.show_status(text);
}

bool OutputRouter::can_show_status() const {
  return impl_->screen.can_show_status();
}

void OutputRouter::error(std::string_view text) {
  Screen& screen = impl_->error_screen ? *impl_->error_screen : impl_->screen;
  std::string rest;
  if (impl_->options.journal) {
    rest = impl_->to_journal(text, 0, {}, LOG_ERR);
    if (rest.empty()) {
      return;
    }
    text = rest;
  }
  if (!screen.print(text, false)) {
    impl_->to_launch_log(text);
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
  const bool stamps_screen = targets.screen && options.timestamps;
  const std::string stamp = stamped || stamps_screen ? time_stamp() : std::string();
  plain_lines.clear();
  stamped_lines.clear();
  for (bool more = true; more;) {
    const std::size_t end = text.find('\n');
    more = end != std::string_view::npos;
    const std::string_view line = text.substr(0, end);
    if (plain) {
      plain_lines.append(stream.prefix).append(line).push_back('\n');
    }
    if (stamped || stamps_screen) {
      stamped_lines.append(stamp).append(stream.prefix).append(line).push_back('\n');
    }
    text.remove_prefix(more ? end + 1 : text.size());
  }
  const bool shown =
      !targets.screen || to_screen(stamps_screen ? stamped_lines : plain_lines, stamped, process, stream.prefix);
  if (stamped) {
    to_file(launch_log, stamped_lines);
  } else if (!shown) {
    to_launch_log(plain_lines);
  }
  if (own_log) {
    std::string name = label;
    std::replace(name.begin(), name.end(), '/', '_');
    const std::string base = options.log_directory + "/" + name;
    stream.own.set_path(base + (which == OutputStream::kOut ? "-stdout.log" : "-stderr.log"));
    owner.both.set_path(base + ".log");
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

std::string OutputRouter::Impl::to_journal(std::string_view lines, ProcessId process, std::string_view prefix,
                                           std::optional<int> known_priority) {
  const Journal::Origin origin = process != 0 && origin_of ? origin_of(process) : Journal::Origin();
  std::string rest;
  while (!lines.empty()) {
    const std::size_t end = lines.find('\n');
    const std::string_view line = lines.substr(0, end);
    const std::size_t begin = line.starts_with(prefix) ? prefix.size() : 0;
    const int priority = known_priority.value_or(journal_priority(line.substr(begin)));
    if (!options.journal->write(line, priority, origin)) {
      rest += fmt::format("<{}>{}\n", priority, line);  // sd-daemon(3)
    }
    lines.remove_prefix(end == std::string_view::npos ? lines.size() : end + 1);
  }
  return rest;
}

bool OutputRouter::Impl::to_screen(std::string_view text, bool logged, ProcessId process, std::string_view prefix) {
  std::string rest;
  if (options.journal) {
    rest = to_journal(text, process, prefix);
    if (rest.empty()) {
      return true;
    }
    text = rest;
  }
  const bool was_gone = screen.is_gone();
  const bool shown = screen.print(text, logged);
  if (!was_gone && screen.is_gone()) {
    // A closed terminal or the end of a pipe. It does not come back, and the logs go on.
    to_launch_log("[WARNING] [launch]: the screen is gone, its lines follow here\n");
  }
  return shown;
}

void OutputRouter::Impl::finish_screens() {
  for (Screen* const each : {&screen, error_screen ? &*error_screen : nullptr}) {
    if (each == nullptr || each->is_gone()) {
      continue;
    }
    const Screen::Rest rest = each->finish();
    if (!options.timestamps) {
      to_launch_log(rest.unlogged);
    } else if (launch_log.is_open()) {
      to_file(launch_log, rest.unlogged);
    }
    if (rest.lines > 0) {
      to_launch_log(fmt::format("[WARNING] [launch]: the screen has not taken the last {} lines\n", rest.lines));
    }
  }
}

void OutputRouter::Impl::to_launch_log(std::string_view lines) {
  if (!launch_log.is_open() || lines.empty()) {
    return;
  }
  const std::string stamp = time_stamp();
  std::string stamped;
  while (!lines.empty()) {
    const std::size_t size = std::min(lines.find('\n'), lines.size() - 1) + 1;
    stamped.append(stamp).append(lines.substr(0, size));
    lines.remove_prefix(size);
  }
  to_file(launch_log, stamped);
}

void OutputRouter::Impl::to_file(LogFile& file, std::string_view text) {
  if (const int error = file.append(text); error != 0) {
    screen.print(fmt::format("[WARNING] [launch]: cannot write '{}': {}\n", file.path(), std::strerror(error)), true);
  }
}

}  // namespace launch
