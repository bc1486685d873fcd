// SPDX-License-Identifier: Apache-2.0
#include "tracing/show/report/read_system.hpp"

#include <cstdint>
#include <optional>

#include "tracing/decode/reader/trace_reader.hpp"
#include "tracing/model/analysis/trace_analysis.hpp"
#include "tracing/model/execution/sink_list.hpp"
#include "tracing/model/timeline/timeline_recorder.hpp"
#include "tracing/show/report/launch_filter.hpp"
#include "tracing/show/report/recorded_facts.hpp"

namespace tracing {

namespace {

// Hands each event on to those that are asked for.
class Readers : public TraceSink {
 public:
  Readers(TraceAnalysis& analysis, const SystemOptions& options) : analysis_(analysis), options_(options) {}
  void on_event(const Event& event) override {
    if (!first_event_ns_) {
      first_event_ns_ = event.timestamp_ns;
    }
    if (!options_.processes.empty() && event.vpid && !options_.processes.contains(*event.vpid)) {
      return;
    }
    if (options_.with_analysis) {
      analysis_.on_event(event);
    }
    if (options_.beside != nullptr) {
      options_.beside->on_event(event);
    }
    ++events_;
  }
  void on_loss(const Loss& loss) override { analysis_.on_loss(loss); }
  std::uint64_t events() const { return events_; }
  std::optional<std::int64_t> first_event_ns() const { return first_event_ns_; }

 private:
  TraceAnalysis& analysis_;
  const SystemOptions& options_;
  std::uint64_t events_ = 0;
  std::optional<std::int64_t> first_event_ns_;
};

}  // namespace

TracedSystem read_system(const std::vector<std::filesystem::path>& directories, const SystemOptions& options) {
  TracedSystem system;
  system.directory = std::filesystem::weakly_canonical(directories.front());
  timeline::TimelineRecorder recorder;
  SinkList<timeline::TimelineRecorder> sinks(recorder, options.also);
  TraceAnalysis analysis(options.also == nullptr ? static_cast<ExecutionSink*>(&recorder) : &sinks, options.chains);
  if (options.at_begin) {
    options.at_begin(analysis.objects());
  }
  if (options.with_details) {
    recorder.record_details(analysis);
  }
  recorder.keep_first(options.most_records);
  TraceReader reader(directories, TraceReader::Clocks::kOne);
  system.open = reader.open_directories();
  system.verdict = read_verdicts(directories);
  Readers readers(analysis, options);
  LaunchFilter filter(reader, directories, readers, options.all);
  try {
    reader.read(filter);
  } catch (const TraceReadError& error) {
    if (readers.events() == 0) {
      throw;
    }
    system.error = error.what();
    analysis.doubt_all();
  }
  system.others = filter.others();
  system.first_event_ns = readers.first_event_ns().value_or(0);
  system.results = analysis.finish();
  if (options.at_end) {
    options.at_end(analysis, system.results);
  }
  system.timeline = recorder.finish(analysis, system.results.overview);
  return system;
}

}  // namespace tracing
