// SPDX-License-Identifier: Apache-2.0
// Tells `launch top --trace` what nodes do. Records them in a live session of its own, and ends it with the input.
//
// A line of input is the width of the terminal in columns. The output consists of texts, each of which ends with a form
// feed. The first line of a text says what it is: `view`, once a second; `report`, the last one; `error`, a last one,
// too. With --metrics there are no views and no report, but `metrics` once a second, from the begin of the recording
// on. With --conditions LAUNCH NEED…, what happens is in condition_program.hpp.
#include <fmt/format.h>
#include <poll.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <charconv>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <exception>
#include <string>
#include <string_view>

#include "programs/watch/condition_program.hpp"
#include "programs/watch/traced_nodes.hpp"
#include "tracing/decode/reader/trace_read_error.hpp"
#include "tracing/show/live/live_metrics.hpp"
#include "tracing/show/live/live_view.hpp"

namespace {

using tracing::LiveReader;
using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;

constexpr Clock::duration kInterval = std::chrono::seconds(1);
constexpr milliseconds kRetry{10};  // the relay daemon is asked this often; it tells nothing by itself
constexpr std::chrono::seconds kLongestEnd{5};

// Nobody may be left to read it; the end of the input says so.
void tell(const std::string& what, const std::string& text) {
  const std::string all = what + "\n" + text + "\f";
  std::fwrite(all.data(), 1, all.size(), stdout);
  std::fflush(stdout);
}

// The widths that come from `launch top`.
class Input {
 public:
  // Waits so long for input. Returns false at its end.
  bool look(milliseconds time) {
    pollfd readable{STDIN_FILENO, POLLIN, 0};
    if (poll(&readable, 1, static_cast<int>(time.count())) <= 0) {
      return true;
    }
    std::array<char, 256> bytes{};
    const ssize_t count = read(STDIN_FILENO, bytes.data(), bytes.size());
    if (count < 0) {
      return errno == EINTR;
    }
    for (ssize_t i = 0; i < count; ++i) {
      take(bytes[static_cast<std::size_t>(i)]);
    }
    return count > 0;
  }
  std::size_t width() const { return width_; }

 private:
  void take(char byte) {
    if (byte != '\n') {
      line_ += byte;
      return;
    }
    std::size_t width = 0;
    const auto [end, error] = std::from_chars(line_.data(), line_.data() + line_.size(), width);
    constexpr std::size_t kLeastWidth = 60;
    if (error == std::errc() && width >= kLeastWidth) {
      width_ = width;
    }
    line_.clear();
  }

  std::string line_;
  std::size_t width_ = 80;
};

class Watch {
 public:
  explicit Watch(bool tells_metrics) : tells_metrics_(tells_metrics) {}

  void run() {
    // The state of lifecycle nodes that are older than the session is no event of ros2. The launcher tells what it does
    // if it has a trace of its own.
    tracing::TracedNodes nodes({.events = {"ros2:*", "ros2_ext:rcl_lifecycle_state", "launch:*"}});
    watch(nodes);
    nodes.end();
    if (tells_metrics_) {
      return;
    }
    read_rest(nodes.reader());
    const tracing::Report report{"what launch top has recorded", view_.finish(), ""};
    tell("report", text_report(report, options()));
  }

 private:
  tracing::ReportOptions options() const { return {.width = input_.width()}; }

  // Until the input ends.
  void watch(tracing::TracedNodes& nodes) {
    if (!tells_metrics_) {
      tell("view", "no events yet\n");
    }
    tracing::TraceSink& sink = tells_metrics_ ? static_cast<tracing::TraceSink&>(metrics_) : view_;
    Clock::time_point drawn = Clock::now();
    milliseconds wait{0};
    while (input_.look(wait)) {
      const LiveReader::State state = read_some(nodes.reader(), sink);
      nodes.catch_up();
      wait = state == LiveReader::State::kItem ? milliseconds(0) : kRetry;
      const Clock::duration since = Clock::now() - drawn;
      if (since < kInterval) {
        continue;
      }
      const double seconds = std::chrono::duration<double>(since).count();
      tracing::ReportOptions all = options();
      all.top = 0;
      if (tells_metrics_) {
        tell("metrics", metrics_.text());
      } else if (view_.events() > 0) {
        tell("view", view_.screen(seconds, all));
      }
      view_.clear();
      drawn = Clock::now();
    }
  }

  void read_rest(LiveReader& reader) {
    const Clock::time_point give_up = Clock::now() + kLongestEnd;
    while (Clock::now() < give_up) {
      const LiveReader::State state = read_some(reader, view_);
      if (state == LiveReader::State::kEnd) {
        return;
      }
      if (state == LiveReader::State::kNothingYet) {
        poll(nullptr, 0, static_cast<int>(kRetry.count()));
      }
    }
  }

  const bool tells_metrics_;
  Input input_;
  tracing::LiveView view_;
  tracing::LiveMetrics metrics_;
};

}  // namespace

int main(int argc, char** argv) {
  std::signal(SIGPIPE, SIG_IGN);
  if (argc > 2 && std::string_view(argv[1]) == "--conditions") {
    return launch::run_condition_program(argv[2], {argv + 3, argv + argc});
  }
  try {
    Watch(argc > 1 && std::string_view(argv[1]) == "--metrics").run();
    return 0;
  } catch (const tracing::TraceReadError& error) {
    tell("error", error.remedy().empty() ? error.what() : fmt::format("{}\n= help: {}", error.what(), error.remedy()));
  } catch (const std::exception& error) {
    tell("error", error.what());
  }
  return 1;
}
