// SPDX-License-Identifier: Apache-2.0
#include "tracing/show/live/live_report.hpp"

#include <fmt/format.h>
#include <signal.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <memory>
#include <optional>
#include <stdexcept>

#include "tracing/decode/reader/live_reader.hpp"
#include "tracing/decode/reader/trace_read_error.hpp"
#include "tracing/model/findings/quantity_text.hpp"
#include "tracing/show/live/live_view.hpp"
#include "tracing/show/report/launch_filter.hpp"

namespace tracing {

namespace {

using Clock = std::chrono::steady_clock;
namespace fs = std::filesystem;

constexpr const char* kClear = "\033[H\033[2J";  // the cursor to the first line; nothing on the screen

sigset_t ending_signals() {
  sigset_t signals;
  sigemptyset(&signals);
  sigaddset(&signals, SIGINT);
  sigaddset(&signals, SIGTERM);
  return signals;
}

// Where a live report appears: drawn anew on a terminal, a line each time anywhere else. Waits for what ends it: blocks
// SIGINT and SIGTERM, which end a live report, until it is destroyed.
class LiveScreen {
 public:
  explicit LiveScreen(const LiveOptions& options);
  ~LiveScreen();
  LiveScreen(const LiveScreen&) = delete;
  LiveScreen& operator=(const LiveScreen&) = delete;

  bool draws() const { return options_.is_terminal && !options_.json; }
  // `screen` on a terminal, else `line`; with the time. Throws when it can't be written.
  void show(const std::string& title, const std::string& screen, const std::string& line);
  // What is told once, such as that a session is not there yet.
  void note(const std::string& text);
  // The report at the end.
  void finish(const Report& report);

  // Returns whether the user has ended the report. Waits that long at most.
  bool is_over_after(std::chrono::nanoseconds time);

 private:
  void print(const std::string& text, bool to_errors) const;

  LiveOptions options_;
  sigset_t previous_mask_{};
  bool is_over_ = false;
};

LiveScreen::LiveScreen(const LiveOptions& options) : options_(options) {
  const sigset_t signals = ending_signals();
  pthread_sigmask(SIG_BLOCK, &signals, &previous_mask_);
}

LiveScreen::~LiveScreen() {
  pthread_sigmask(SIG_SETMASK, &previous_mask_, nullptr);
}

void LiveScreen::print(const std::string& text, bool to_errors) const {
  std::FILE* const out = to_errors ? stderr : stdout;
  errno = 0;
  if (std::fwrite(text.data(), 1, text.size(), out) == text.size() && std::fflush(out) == 0) {
    return;
  }
  throw std::runtime_error(fmt::format("cannot write the output: {}", std::strerror(errno)));
}

void LiveScreen::show(const std::string& title, const std::string& screen, const std::string& line) {
  const std::chrono::nanoseconds now = std::chrono::system_clock::now().time_since_epoch();
  if (draws()) {
    print(fmt::format("{}{}  {}\n", kClear, title, format_time(now.count())) + screen +
              "\nCtrl-C ends this view and prints the report.\n",
          false);
  } else {
    print(format_time(now.count()) + "  " + line + "\n", options_.json);
  }
}

void LiveScreen::note(const std::string& text) {
  print("launch report: " + text + "\n", true);
}

void LiveScreen::finish(const Report& report) {
  if (options_.json) {
    return print(json_report(report), false);
  }
  print((draws() ? kClear : "") + text_report(report, options_.text), false);
}

bool LiveScreen::is_over_after(std::chrono::nanoseconds time) {
  if (is_over_) {
    return true;
  }
  constexpr std::int64_t kSecond = 1'000'000'000;
  const timespec wait{static_cast<time_t>(time.count() / kSecond), static_cast<long>(time.count() % kSecond)};
  const sigset_t signals = ending_signals();
  is_over_ = sigtimedwait(&signals, nullptr, &wait) > 0;
  return is_over_;
}

constexpr std::chrono::milliseconds kRetry{10};  // the relay daemon is asked this often; it tells nothing by itself
constexpr std::chrono::milliseconds kRetryAttach{50};

// Returns false when the user has ended the report before.
bool attach(LiveReader& reader, const LiveAddress& address, LiveScreen& screen) {
  bool is_attached = reader.attach();
  if (!is_attached) {
    screen.note(fmt::format("waiting for the session '{}'", address.session));
  }
  while (!is_attached && !screen.is_over_after(kRetryAttach)) {
    is_attached = reader.attach();
  }
  if (!is_attached) {
    return false;
  }
  screen.note(fmt::format("attached to the session '{}'", address.session));
  return true;
}

constexpr std::chrono::seconds kLongestWithoutRelay{10};

// To be called after an error of reading. A relay daemon that ends takes its sessions with it: waits for another one
// that has a session of this name, and attaches. Null when the relay daemon was not the cause, when none answers for 10
// s, or when the user has ended the report.
std::unique_ptr<LiveReader> attach_after_restart(const LiveAddress& address, LiveScreen& screen) {
  RelayState state = ask_relay_daemon(address);
  if (state == RelayState::kSession) {
    return nullptr;
  }
  screen.note(
      fmt::format("the relay daemon has ended, and the session with it; waiting for a session '{}' of another one",
                  address.session));
  Clock::time_point answered = Clock::now();
  while (!screen.is_over_after(kRetryAttach)) {
    state = ask_relay_daemon(address);
    if (state != RelayState::kNoDaemon) {
      answered = Clock::now();
    } else if (Clock::now() - answered > kLongestWithoutRelay) {
      return nullptr;
    }
    if (state == RelayState::kSession) {
      auto reader = std::make_unique<LiveReader>(address);
      if (!attach(*reader, address, screen)) {
        return nullptr;
      }
      screen.note("the view goes on");
      return reader;
    }
  }
  return nullptr;
}

struct Reading {
  Report report;
  Clock::duration took{};
};

// nullopt when there is no trace yet: LTTng writes one when the first traced program has begun.
std::optional<Reading> read(const std::vector<fs::path>& directories, const LiveOptions& options) {
  const Clock::time_point begin = Clock::now();
  std::optional<TraceReader> reader;
  try {
    reader.emplace(directories);
  } catch (const TraceReadError&) {
    return std::nullopt;
  }
  Reading reading{.report = {directories.front(), {}, ""}};
  reading.report.open = reader->open_directories();
  TraceAnalysis analysis(nullptr, options.chains ? options.chains() : std::vector<ChainDefinition>());
  LaunchFilter filter(*reader, directories, analysis, options.text.all);
  try {
    reader->read(filter);
  } catch (const TraceReadError& error) {
    reading.report.error = error.what();
  }
  reading.report.results = analysis.finish();
  reading.report.others = filter.others();
  reading.report.lacks_descriptions = reader->lacks_descriptions();
  reading.took = Clock::now() - begin;
  return reading;
}

}  // namespace

bool report_live_session(const std::string& session, const LiveOptions& options) {
  const LiveAddress address = live_address(session);
  LiveScreen screen(options);
  auto reader = std::make_unique<LiveReader>(address);
  Report report{address.url(), {}, ""};
  if (!attach(*reader, address, screen)) {
    return true;
  }
  LiveView view;
  Clock::time_point drawn = Clock::now();
  std::chrono::nanoseconds wait{0};
  std::size_t late_attachments = 0;
  while (!screen.is_over_after(wait)) {
    try {
      if (late_attachments != reader->late_attachments()) {
        late_attachments = reader->late_attachments();
        screen.note(
            "the session has begun before; objects that are older have no names until it is told of them: "
            "lttng regenerate statedump --session=" +
            address.session);
      }
      const LiveReader::State state = read_some(*reader, view);
      if (state == LiveReader::State::kEnd) {
        break;
      }
      wait = state == LiveReader::State::kItem ? std::chrono::nanoseconds(0) : kRetry;
      const Clock::duration since = Clock::now() - drawn;
      if (since < options.interval || view.events() == 0) {
        continue;
      }
      const double seconds = std::chrono::duration<double>(since).count();
      screen.show("Live       " + address.url(), view.screen(seconds, options.text), view.line(seconds));
      view.clear();
      drawn = Clock::now();
    } catch (const TraceReadError& error) {
      report.error = error.what();
      reader = attach_after_restart(address, screen);
      if (!reader) {
        break;
      }
      report.error = "the relay daemon was restarted: what was recorded meanwhile is missing";
      late_attachments = 0;
    }
  }
  report.results = view.finish();
  screen.finish(report);
  return report.error.empty();
}

bool report_growing_directories(const std::vector<fs::path>& directories, const LiveOptions& options) {
  LiveScreen screen(options);
  bool has_noted = false;
  std::optional<Reading> reading = read(directories, options);
  if (!reading) {
    screen.note("waiting for a trace in " + directories.front().string());
  }
  std::chrono::nanoseconds wait = options.interval;
  while (!reading || !reading->report.open.empty()) {
    if (reading) {
      const TraceOverview& overview = reading->report.results.overview;
      if (reading->report.lacks_descriptions && !has_noted) {
        screen.note("LTTng has not described all events yet; what comes from the first of them on is shown later");
        has_noted = true;
      }
      screen.show("Live", text_report(reading->report, options.text), summary_line(overview));
      // A large trace must not keep a processor busy.
      wait = std::max<std::chrono::nanoseconds>(options.interval, 4 * reading->took);
    }
    const bool is_over = screen.is_over_after(wait);
    std::optional<Reading> next = read(directories, options);
    if (next) {
      reading = std::move(next);
    }
    if (is_over) {
      break;
    }
  }
  if (!reading) {
    return true;
  }
  reading->report.verdict = read_verdicts(directories);
  screen.finish(reading->report);
  return reading->report.error.empty();
}

}  // namespace tracing
