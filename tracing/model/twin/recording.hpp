// SPDX-License-Identifier: Apache-2.0
// What a twin is built from and compared with: everything that happened in a trace.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <unordered_map>
#include <vector>

#include "tracing/model/analysis/trace_analysis.hpp"
#include "tracing/model/timeline/timeline.hpp"
#include "tracing/model/timeline/timeline_recorder.hpp"

namespace tracing::twin {

struct Recording {
  struct Look {  // a thread of an executor looked for work
    ThreadId thread;
    std::uint64_t looks = 0;
  };
  struct Wait {
    ThreadId thread;
    std::int64_t begin_ns = 0;
    std::int64_t end_ns = 0;
  };
  struct Endpoint {
    std::uint64_t depth = 0;
    bool reliable = true;
    bool is_filtered = false;
  };
  struct Named {  // a service or a client
    timeline::Index node = timeline::kNone;
    std::string name;
  };

  timeline::Timeline timeline;
  std::vector<Look> looks;
  std::vector<Wait> waits;              // by begin
  std::vector<ServiceCall> calls;       // by the time of sending
  std::vector<Endpoint> publishers;     // as in the timeline
  std::vector<Endpoint> subscriptions;  // likewise
  std::vector<Named> services;
  std::vector<Named> clients;
  bool has_ext_events = false;  // of provider ros2_ext
};

// The sink of one reading, as TimelineRecorder is.
class Recorder : public ExecutionSink {
 public:
  void on_callback_begin(const CallbackInstance& instance) override { timeline_.on_callback_begin(instance); }
  void on_callback(const CallbackInstance& instance) override { timeline_.on_callback(instance); }
  void on_publication(const Publication& publication) override { timeline_.on_publication(publication); }
  void on_message(const MessageFlow& flow) override { timeline_.on_message(flow); }
  void on_call(const ServiceCall& call) override { recording_.calls.push_back(call); }
  void on_executor_wait(const ExecutorWait& wait) override;
  void on_executor_look(const ExecutorLook& look) override;
  void on_lifecycle_state(const LifecycleInterval& interval) override { timeline_.on_lifecycle_state(interval); }
  void on_thread_state(const ThreadInterval& interval) override { timeline_.on_thread_state(interval); }

  // To be called once, after the analysis has finished.
  Recording finish(const TraceAnalysis& analysis, const TraceOverview& overview);

 private:
  timeline::TimelineRecorder timeline_;
  Recording recording_;
  std::unordered_map<ThreadId, std::size_t, HashThreadId> looks_;
};

// A subscription with intra-process communication has a callback for messages of its process and one for those of other
// processes, which are the same function. What the later one ran becomes what the first one ran, and the later one has
// no owner any more.
void join_callbacks_of_subscriptions(timeline::Timeline& timeline);

// Throws TraceReadError if the trace cannot be read to its end.
Recording read_recording(const std::filesystem::path& directory);

// How many processors the machine had: LTTng has a file for each of them. 0: the trace does not tell.
std::size_t processors_of(const std::filesystem::path& directory);

// "/planner, timer 100 ms": the name of each callback of the timeline. Where names would be equal, the later ones have
// a number.
std::vector<std::string> callback_names(const timeline::Timeline& timeline);
// The same for one callback, without its number.
std::string timer_name(const std::string& node, std::int64_t period_ns);

}  // namespace tracing::twin
