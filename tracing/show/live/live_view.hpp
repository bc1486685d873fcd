// SPDX-License-Identifier: Apache-2.0
// Rates, durations and latencies since the last time that somebody looked; missed periods and losses since the
// beginning. The memory grows with the number of objects, not with the number of events.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "tracing/decode/reader/live_reader.hpp"
#include "tracing/decode/reader/trace_sink.hpp"
#include "tracing/model/analysis/trace_analysis.hpp"
#include "tracing/model/execution/duration_statistics.hpp"
#include "tracing/show/report/report.hpp"

namespace tracing {

class LiveView : public ExecutionSink, public TraceSink {
 public:
  LiveView() : analysis_(this) { analysis_.keep_last_launcher_events(kLauncherEvents); }
  LiveView(const LiveView&) = delete;  // the analysis tells this object what happens
  LiveView& operator=(const LiveView&) = delete;

  void on_event(const Event& event) override;
  void on_loss(const Loss& loss) override;
  void on_callback(const CallbackInstance& instance) override;
  void on_message(const MessageFlow& message) override;

  // Text of several lines that fits the width, with tables of nodes, subscriptions and callbacks.
  std::string screen(double seconds, const ReportOptions& options) const;
  // "2345 events/s, 200 callbacks/s, 100 messages/s, latency p50 123 us, p99 1.20 ms, none lost"
  std::string line(double seconds) const;
  // Begins the next interval.
  void clear();

  std::uint64_t events() const { return all_events_; }
  // To be called once, at the end.
  TraceResults finish() { return analysis_.finish(); }

 private:
  // What one subscription or callback did in the interval.
  struct Activity {
    // What rests is shown for so many intervals, so that one sees what has stopped.
    static constexpr int kShown = 10;
    std::uint64_t count = 0;
    DurationStatistics took = {};
    int rested = kShown;  // intervals since the last one in which it did something
    bool is_shown() const { return count > 0 || rested < kShown; }
  };
  // Of signals and exits there may be many after a change.
  static constexpr std::size_t kLauncherEvents = 1'000;
  static constexpr std::size_t kShownLauncherEvents = 5;
  static Activity& at(std::vector<Activity>& activities, ObjectId id);
  std::string head(double seconds) const;
  std::string losses() const;
  std::string last_changes(const ReportOptions& options) const;
  std::string node_table(double seconds, const ReportOptions& options, const std::vector<std::uint64_t>& missed) const;

  TraceAnalysis analysis_;
  std::int64_t now_ns_ = 0;  // of the last event
  std::uint64_t all_events_ = 0;
  std::uint64_t all_lost_ = 0;  // that were counted
  bool has_uncounted_loss_ = false;
  std::uint64_t events_ = 0;  // these and the next ones are of the interval
  std::uint64_t callbacks_ended_ = 0;
  DurationStatistics latency_;
  std::vector<Activity> subscriptions_;  // latency of messages, by ObjectId
  std::vector<Activity> callbacks_;      // duration, by ObjectId
};

// Gives what has come of a live session to a sink; not much more than is read in an instant, so that the caller can do
// something else in between. Returns kItem when there may be more. Throws TraceReadError.
LiveReader::State read_some(LiveReader& reader, TraceSink& sink);

}  // namespace tracing
