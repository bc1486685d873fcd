// SPDX-License-Identifier: Apache-2.0
// Keeps what a launch has recorded of others out of the results. The session of a launch records all processes of the
// session daemon; the verdict of the recording names those of the launch.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <unordered_set>
#include <utility>
#include <vector>

#include "tracing/decode/reader/trace_reader.hpp"
#include "tracing/model/timeline/other_process.hpp"

namespace tracing {

// Hands everything on to a sink but userspace events of processes that do not belong to the launch of their recording.
// A recording whose verdict names no processes, or that has no verdict, is handed on whole. The reader and the sink
// must outlive it.
class LaunchFilter : public TraceSink {
 public:
  // `all`: everything is handed on.
  LaunchFilter(const TraceReader& reader, const std::vector<std::filesystem::path>& directories, TraceSink& next,
               bool all = false);
  void on_event(const Event& event) override;
  void on_loss(const Loss& loss) override { next_.on_loss(loss); }

  // What was left out, by host and id. A launcher whose own events are all that it has is not among them.
  std::vector<OtherProcess> others() const;

 private:
  using Processes = std::unordered_set<std::int64_t>;
  // Those that an event of the class may come from; null: any.
  struct Wanted {
    const Processes* processes = nullptr;
    bool of_launcher = false;
    bool is_of_ros2 = false;  // one that each process with tracetools has
  };
  Wanted find(const EventClass& event_class);
  // Null if the recording does not name its processes. The path is canonical.
  const Processes* of_directory(std::filesystem::path directory) const;
  const Processes* of_trace(std::size_t trace);
  // False if the process has no events of ROS 2 so far, so that it may belong to the launch.
  bool count(const Event& event, const Wanted& wanted);

  const TraceReader& reader_;
  TraceSink& next_;
  std::map<std::filesystem::path, std::unique_ptr<Processes>> recordings_;  // by canonical path; null: it has no list
  bool is_open_;                                                            // nothing is left out
  ByEventClass<Wanted> wanted_;
  std::map<std::size_t, std::unique_ptr<Processes>> by_trace_;
  struct Other {
    OtherProcess process;
    bool is_named = false;  // by its main thread
    bool is_traced = false;
    bool is_of_ros2 = false;
  };
  std::map<std::pair<std::string, std::int64_t>, Other> others_;
};

// "3 processes of others: --all", with `how` behind the colon; "" if there are none.
std::string others_phrase(const std::vector<OtherProcess>& others, const std::string& how = "--all");

}  // namespace tracing
