// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "tracing/decode/reader/live_reader.hpp"
#include "tracing/decode/reader/trace_read_error.hpp"
#include "tracing/show/live/live_report.hpp"
#include "tracing/show/live/live_view.hpp"

namespace tracing {

namespace {

using Clock = std::chrono::steady_clock;

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

}  // namespace

bool report_live_session(const std::string& session, const LiveOptions& options) {
  const LiveAddress address = live_address(session);
  LiveScreen screen(options);
  LiveReader reader(address);
  Report report{address.url(), {}, ""};
  if (!attach(reader, address, screen)) {
    return true;
  }
  LiveView view;
  Clock::time_point drawn = Clock::now();
  std::chrono::nanoseconds wait{0};
  std::size_t late_attachments = 0;
  try {
    while (!screen.is_over_after(wait)) {
      if (late_attachments != reader.late_attachments()) {
        late_attachments = reader.late_attachments();
        screen.note(
            "the session has begun before; objects that are older have no names until it is told of them: "
            "lttng regenerate statedump --session=" +
            address.session);
      }
      const LiveReader::State state = read_some(reader, view);
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
    }
  } catch (const TraceReadError& error) {
    report.error = error.what();
  }
  report.results = view.finish();
  screen.finish(report);
  return report.error.empty();
}

}  // namespace tracing
