// SPDX-License-Identifier: Apache-2.0
// The whole analysis of a trace, as the sink of one reading.
//
//   TraceAnalysis analysis;
//   TraceReader(directory).read(analysis);
//   const TraceResults results = analysis.finish();
//
// After a TraceReadError finish() still gives the results of the events before the damage.
#pragma once

#include "tracing/analysis/overview_counter.hpp"
#include "tracing/analysis/results.hpp"
#include "tracing/analysis/ros2_analysis.hpp"
#include "tracing/analysis/start_tracker.hpp"
#include "tracing/reader/ros2_decoder.hpp"
#include "tracing/reader/trace_reader.hpp"

namespace tracing {

class TraceAnalysis : public TraceSink {
 public:
  void on_event(const Event& event) override;
  void on_loss(const Loss& loss) override;

  TraceResults finish();

 private:
  OverviewCounter overview_;
  StartTracker starts_;
  Ros2Analysis ros2_;
  std::vector<std::string> warnings_;
  ros2::Decoder decoder_{[this](const std::string& problem) { warnings_.push_back(problem); }};
  ros2::ObjectEndDecoder ends_;
  ros2::ExecutionEventDecoder executions_;
  bool lacks_thread_context_ = false;
};

}  // namespace tracing
