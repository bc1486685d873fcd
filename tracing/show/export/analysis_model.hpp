// SPDX-License-Identifier: Apache-2.0
// The tables of tracetools_analysis' Ros2DataModel as CSV files, written while the trace is read.
//
//   AnalysisModelWriter writer("model");
//   TraceReader(directory).read(writer);
//   writer.finish();
//
// Names of tables and columns are those of tracetools_analysis 3.1. Each table but `contexts` has one more column at
// its end, `vpid`, because handles of two processes may be equal. Times are nanoseconds.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "tracing/decode/reader/ros2_decoder.hpp"
#include "tracing/decode/reader/trace_sink.hpp"
#include "tracing/model/objects/process_table.hpp"
#include "tracing/show/export/output_file.hpp"

namespace tracing {

class AnalysisModelWriter : public TraceSink {
 public:
  // Objects are always written; what happens is written from `begin_ns` on and before `end_ns`.
  struct Window {
    std::optional<std::int64_t> begin_ns;
    std::optional<std::int64_t> end_ns;
  };

  // Makes the directory if it does not exist. `window` gets the time of the first event of the trace. Throws
  // OutputError.
  explicit AnalysisModelWriter(const std::filesystem::path& directory,
                               std::function<Window(std::int64_t first_ns)> window = nullptr);

  void on_event(const Event& event) override;
  void on_loss(const Loss&) override {}

  // The files get their names. To be called once, at the end.
  void finish();

 private:
  enum Table : std::size_t {
    kContexts,
    kNodes,
    kRmwPublishers,
    kRclPublishers,
    kRmwSubscriptions,
    kRclSubscriptions,
    kSubscriptionObjects,
    kServices,
    kClients,
    kTimers,
    kTimerNodeLinks,
    kCallbackObjects,
    kCallbackSymbols,
    kCallbackInstances,
    kRclcppPublishInstances,
    kRclPublishInstances,
    kRmwPublishInstances,
    kRmwTakeInstances,
    kRclTakeInstances,
    kRclcppTakeInstances,
    kLifecycleStateMachines,
    kLifecycleTransitions,
    kTables
  };
  // A callback that runs in a thread.
  struct Active {
    ros2::Handle callback = 0;
    std::int64_t begin_ns = 0;
    bool intra_process = false;
  };
  struct ThreadKey {
    ProcessId process = kNoProcess;
    std::int64_t vtid = 0;
    bool operator==(const ThreadKey&) const = default;
  };
  struct HashThreadKey {
    std::size_t operator()(const ThreadKey& key) const {
      return static_cast<std::size_t>(key.vtid) * 0x9e3779b97f4a7c15 ^ key.process;
    }
  };

  bool is_in_window(std::int64_t time_ns) const;
  // Adds a row: integers, texts, bools and gids as pandas writes them.
  template <class... Cells>
  void row(Table table, const Cells&... cells);
  template <class Struct>
  void on(const Event& event, const Struct& fields);

  std::function<Window(std::int64_t)> choose_window_;
  std::optional<Window> window_;
  std::array<std::unique_ptr<OutputFile>, kTables> files_;
  std::string line_;
  ros2::Decoder decoder_{[](const std::string&) {}};
  ProcessTable processes_;
  std::unordered_map<ThreadKey, std::vector<Active>, HashThreadKey> active_;
};

}  // namespace tracing
