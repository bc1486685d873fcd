// SPDX-License-Identifier: Apache-2.0
// Decides the conditions of a launch file on what its nodes do, while that is recorded.
//
// Time is that of the trace. What has not happened is known only of times up to which everything was told (advance()),
// so a recording that comes late makes no false alarm. A loss of events does not make one either: what was lost may
// have been what a condition waits for, so it begins anew.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "tracing/decode/reader/trace_sink.hpp"
#include "tracing/model/analysis/trace_analysis.hpp"
#include "tracing/model/conditions/condition_lines.hpp"
#include "tracing/show/live/watched_chains.hpp"

namespace tracing {

// The processes of the launch.
class LaunchedProcesses {
 public:
  virtual ~LaunchedProcesses() = default;
  // The label of a process, "talker-1"; nullopt for one of somebody else.
  virtual std::optional<std::string> label(std::int64_t vpid) = 0;
  virtual bool lives(std::int64_t vpid) = 0;
};

class LiveConditions : public ExecutionSink, public TraceSink {
 public:
  using Tell = std::function<void(const ConditionReport&)>;
  // `processes` must outlive this object.
  LiveConditions(LaunchedProcesses& processes, Tell tell);
  LiveConditions(const LiveConditions&) = delete;  // the analysis tells this object what happens
  LiveConditions& operator=(const LiveConditions&) = delete;

  // The condition counts from now on, or from when its name is seen.
  void watch(ConditionId id, const LiveCondition& condition);
  void forget(ConditionId id);

  void on_event(const Event& event) override;
  void on_loss(const Loss& loss) override;
  void on_callback_begin(const CallbackInstance& instance) override;
  void on_callback(const CallbackInstance& instance) override;
  void on_publication(const Publication& publication) override;
  void on_message(const MessageFlow& message) override;
  void on_message_link(const MessageLink& link) override;
  void on_call(const ServiceCall& call) override;
  // Everything up to this time of the trace has been told.
  void advance(std::int64_t until_ns);
  // Tells once of each condition whose name was not seen in its `grace`, which counts from the first call after
  // watch(). `now` is of any clock that does not jump.
  void tell_unseen(std::chrono::nanoseconds now);

 private:
  // What has happened in the last window, in parts of it.
  struct Parts {
    static constexpr std::int64_t kCount = 20;
    std::array<std::uint32_t, kCount> counts{};
    std::array<std::uint32_t, kCount> late{};  // or lost: some of them
    std::int64_t current = 0;                  // number of the part that is being filled; 0: none yet
    std::uint64_t sum = 0;
    std::uint64_t late_sum = 0;

    void add(bool is_late);
    // To the next part; the oldest one falls out of the window.
    void step();
    double late_share() const { return sum == 0 ? 0 : static_cast<double>(late_sum) / static_cast<double>(sum); }
  };
  struct Rule {
    ConditionId id = 0;
    LiveCondition condition;
    std::vector<std::string> chain = {};  // the names of its nodes, if it is about a chain
    std::set<ProcessId> processes = {};
    std::optional<std::int64_t> seen_ns = std::nullopt;  // since then something alive has the name
    bool was_seen = false;
    std::int64_t last_ns = 0;  // when something has happened last
    bool holds = false;
    std::int64_t since_ns = 0;     // of silence that holds: its begin
    std::int64_t last_bad_ns = 0;  // of a rate or of what is late, if it holds: when it was beyond its limit last
    Parts parts = {};
    std::optional<std::chrono::nanoseconds> unseen_since = std::nullopt;
    bool told_unseen = false;
  };
  // A callback that runs, of a node whose callbacks must not be late.
  struct Running {
    ThreadId thread;
    ObjectId callback = kNoObject;
    std::int64_t begin_ns = 0;
    std::set<ConditionId> late = {};  // conditions that have counted it already
  };
  // When the timer of a callback must be called next, as far as its calls tell.
  struct Due {
    std::int64_t due_ns = 0;
    std::int64_t least_late_ns = 0;  // of the last calls
    std::int64_t most_late_ns = 0;
    int calls = 0;
  };
  // What a subscription has missed.
  struct Missed {
    std::int64_t last_ns = 0;  // when it got a message last
    std::uint64_t count = 0;
  };

  // Takes note of objects that are new.
  void find_objects();
  bool is_named(const Rule& rule, const EndpointObject& endpoint, bool publishes);
  bool is_named(const Rule& rule, const NodeObject& node);
  // Of a chain: there is a node for each of its names.
  bool is_whole(const Rule& rule);
  bool is_named(const Rule& rule, const ClientObject& client);
  ProcessId process_of(const ClientObject& client) const;
  // Calls `visit` with each list of objects, the index of what waits for them, and two functions: whether an object has
  // the name of a rule, and which process has the object.
  template <typename Visit>
  void visit_objects(Visit visit);
  std::set<std::string> known_names(const LiveCondition& condition);
  void see(Rule& rule, ProcessId process);
  std::optional<std::int64_t> vpid_of(ProcessId process) const;
  bool is_ours(ProcessId process);
  std::int64_t counts_from(const Rule& rule) const;
  void happened(Rule& rule, std::int64_t time_ns);
  void took(Rule& rule, std::int64_t begin_ns, std::int64_t end_ns);
  void lost(Rule& rule, std::uint64_t count, bool arrived, std::int64_t time_ns);
  // One more took too long, or was lost.
  void look_at_share(Rule& rule, std::int64_t time_ns, double figure);
  static bool is_about_callbacks(const Rule* rule) {
    return rule->condition.kind == LiveCondition::Kind::kLate &&
           rule->condition.subject == LiveCondition::Subject::kNode;
  }
  void timer_begins(const CallbackInstance& instance, const std::vector<Rule*>& rules);
  void count_missed(const MessageFlow& message);
  // Makes the tracker of the chains of conditions anew.
  void follow_chains();
  void look_at_running();
  const std::vector<Rule*>& rules_of_node(ObjectId callback) const;
  void check(Rule& rule, std::int64_t until_ns);
  void check_silence(Rule& rule, std::int64_t until_ns);
  void check_window(Rule& rule, std::int64_t until_ns);
  void check_rate_part(Rule& rule, std::int64_t end_ns);
  void check_late_part(Rule& rule, std::int64_t end_ns);
  bool is_late(const Rule& rule) const;
  static double rate_of(const Rule& rule);
  static double seconds_in(std::int64_t nanoseconds) { return static_cast<double>(nanoseconds) / 1e9; }
  void change(Rule& rule, bool holds, double figure);
  bool lives(const Rule& rule);

  LaunchedProcesses& processes_;
  Tell tell_;
  TraceAnalysis analysis_;
  std::map<ConditionId, Rule> rules_;
  std::map<ProcessId, bool> ours_;
  // By ObjectId, as far as they were looked at: what waits for them.
  std::vector<std::vector<Rule*>> of_publisher_;
  std::vector<std::vector<Rule*>> of_subscription_;
  std::vector<std::vector<Rule*>> of_node_;
  std::vector<std::vector<Rule*>> of_client_;
  std::vector<std::int64_t> subscription_since_;  // by ObjectId: when it was seen first
  std::set<ObjectId> intra_process_;              // publishers that have sent within their process
  std::vector<Running> running_;
  std::map<ObjectId, Due> due_;        // by callback of a timer
  std::map<ObjectId, Missed> missed_;  // by subscription
  std::unique_ptr<WatchedChains> chains_;
  std::int64_t chains_since_ns_ = 0;  // when the tracker was made
  std::vector<Rule*> of_chain_;       // by definition of the tracker
  std::int64_t now_ns_ = 0;           // up to which everything was told
  std::int64_t doubt_ns_ = 0;         // until then, events may have been lost
};

}  // namespace tracing
