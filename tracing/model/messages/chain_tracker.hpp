// SPDX-License-Identifier: Apache-2.0
// Finds the chains of callbacks that messages cause, and measures them from end to end.
//
// A chain begins with a callback that no message in the trace caused, such as that of a timer, and goes on with what
// its messages cause. What a callback publishes is caused by the message that it got; what a node publishes from
// messages that it has cached is caused by the last one of each subscription, where user code has declared it.
//
// A chain that the user has named (ChainDefinition) also begins with a callback that a message caused, if this callback
// belongs to the first node of the definition, and ends in the middle of longer chains.
//
// All times are those of CARET: an input is a begin of the first callback, an output an end of the last one.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "tracing/model/chains/chain_definition.hpp"
#include "tracing/model/execution/duration_statistics.hpp"
#include "tracing/model/execution/execution_sink.hpp"
#include "tracing/model/execution/thread_map.hpp"

namespace tracing {

using PathId = std::uint32_t;  // index in ChainTracker::paths()
inline constexpr PathId kNoPath = 0xffffffff;

// A path of callbacks as a definition describes it.
struct NamedPath {
  std::size_t definition = 0;     // index in ChainTracker::definitions()
  std::uint64_t over_budget = 0;  // responses that took longer than the budget
};

// A callback at the end of a path of callbacks, and the measurements of all that came along this path.
struct ChainRecord {
  PathId parent = kNoPath;     // kNoPath: it begins here
  ObjectId topic = kNoObject;  // between the parent and this callback
  ObjectId callback = kNoObject;
  std::uint32_t length = 1;  // callbacks
  bool goes_on = false;      // a message of the callback reached another callback
  bool is_cut = false;       // the callback is part of the path already: a loop, which is not followed
  // The path began at least once with a callback that no message caused. False: it begins there by definition alone.
  bool is_natural = false;
  std::vector<NamedPath> named = {};

  DurationStatistics until_publish;  // from the parent's begin to its publication
  DurationStatistics transfer;       // from there to the begin of this callback
  DurationStatistics transport;  // part of transfer: on the way; with the wait for the executor if that is not known
  DurationStatistics executor;   // part of transfer: the wait for the executor
  DurationStatistics take;       // part of transfer: from rmw_take on
  DurationStatistics last_callback;  // from the begin to the end of this callback
  DurationStatistics response;       // from an input to the first output that it causes ("best")
  // From the input of the output before to an output: how long something may take that just missed an input
  // ("worst-with-external-latency").
  DurationStatistics reaction;
  DurationStatistics age;             // from an input to the last output that it causes
  std::int64_t longest_begin_ns = 0;  // of the longest response
  std::int64_t longest_end_ns = 0;

 private:
  friend class ChainTracker;
  bool is_compared = false;  // with the definitions
  // The path that goes on from here, of those the one that was asked for last.
  ObjectId last_topic = kNoObject;
  ObjectId last_next = kNoObject;  // callback
  PathId last_path = kNoPath;
  std::int64_t last_input_ns = 0;  // of the last output
  std::int64_t last_output_ns = 0;
};

// A callback on the way of something through a chain. Ways that begin alike share their hops.
struct ChainHop {
  static constexpr std::uint32_t kNone = 0xffffffff;
  std::uint32_t before = kNone;  // index in ChainTracker::Passages::hops; kNone: the chain begins here
  ProcessId process = kNoProcess;
  std::int64_t vtid = 0;
  std::int64_t begin_ns = 0;  // of the callback
};

// One way through the chain that `path` ends.
struct ChainPassage {
  PathId path = kNoPath;
  std::uint32_t last_hop = ChainHop::kNone;
  std::int64_t input_ns = 0;
  std::int64_t output_ns = 0;
  bool is_first = false;  // the first output of its input, which ChainRecord::response counts
};

class ChainTracker : public ExecutionSink {
 public:
  // At most this many paths, and publications whose trails are remembered.
  static constexpr std::size_t kPaths = 1'000;
  static constexpr std::size_t kRemembered = 1 << 16;

  // Gives chains names. To be called before anything happens; the model must outlive this object.
  void define(const ObjectModel& model, std::vector<ChainDefinition> definitions) {
    model_ = &model;
    definitions_ = std::move(definitions);
  }
  const std::vector<ChainDefinition>& definitions() const { return definitions_; }
  // Also keeps each passage that may end a chain of the results, and the hops of all: 24 bytes for each callback and
  // each of its causes. To be called before anything happens.
  void keep_passages() { keeps_passages_ = true; }
  struct Passages {
    std::vector<ChainPassage> passages;  // in the order of their outputs
    std::vector<ChainHop> hops;
  };
  // To be called once, at the end.
  Passages take_passages() { return std::move(kept_); }

  void on_callback_begin(const CallbackInstance& instance) override;
  void on_callback(const CallbackInstance& instance) override;
  void on_publication(const Publication& publication) override;
  void on_message(const MessageFlow& message) override;
  void on_message_link(const MessageLink& link) override;
  void finish();

  const std::vector<ChainRecord>& paths() const { return paths_; }
  // Of each publisher whose node keeps messages: the subscriptions, as user code has declared them.
  const std::map<ObjectId, std::vector<ObjectId>>& links() const { return links_; }
  bool is_full() const { return is_full_; }  // there were more paths

 protected:
  // Called for each response that a path gets, in the order of their ends.
  virtual void on_response(PathId, std::int64_t /*input_ns*/, std::int64_t /*output_ns*/) {}

 private:
  // One cause of something, back to the begin of its chain. Its members have no values of their own: lists of them are
  // made for each callback and message.
  struct Trail {
    PathId path;
    std::uint32_t hop;
    std::int64_t input_ns;
    std::int64_t callback_ns;  // begin of the callback at the end of the path
  };
  // Mostly there is one. A message of a node that keeps what it gets has those of all that it has kept.
  class Trails {
   public:
    Trails() {}
    Trails(const Trails& other) { *this = other; }
    Trails& operator=(const Trails& other) {
      size_ = other.size_;
      if (!many_.empty() || !other.many_.empty()) [[unlikely]] {
        many_ = other.many_;
      }
      if (many_.empty()) {
        std::copy(other.begin(), other.end(), few_.begin());
      }
      return *this;
    }
    void clear() {
      size_ = 0;
      many_.clear();
    }
    void push_back(const Trail& trail) {
      if (size_ < few_.size()) {
        few_[size_++] = trail;
        return;
      }
      if (many_.empty()) {
        many_.assign(few_.begin(), few_.end());
      }
      many_.push_back(trail);
      ++size_;
    }
    bool empty() const { return size_ == 0; }
    std::size_t size() const { return size_; }
    const Trail* begin() const { return many_.empty() ? few_.data() : many_.data(); }
    const Trail* end() const { return begin() + size_; }

   private:
    std::size_t size_ = 0;
    std::array<Trail, 4> few_;
    std::vector<Trail> many_;  // all of them, if they are more
  };
  struct Active {
    // Without it, the memory of the trails would be cleared each time.
    Active(ObjectId of, std::int64_t since_ns) : callback(of), begin_ns(since_ns) {}
    ObjectId callback;
    std::int64_t begin_ns;
    Trails trails;
  };
  struct Sent {
    std::uint64_t number = 0;
    std::int64_t published_ns = 0;
    Trails trails;
  };

  PathId path_of(PathId parent, ObjectId topic, ObjectId callback) {
    if (parent != kNoPath) {
      const ChainRecord& before = paths_[parent];
      if (before.last_path != kNoPath && before.last_topic == topic && before.last_next == callback) [[likely]] {
        return before.last_path;
      }
    }
    return find_path(parent, topic, callback);
  }
  PathId find_path(PathId parent, ObjectId topic, ObjectId callback);
  // The begin of a chain whose cause is not known.
  void begin_chain(const ThreadId& thread, Trails& trails, ObjectId callback, std::int64_t begin_ns);
  std::uint32_t hop_of(std::uint32_t before, const ThreadId& thread, std::int64_t begin_ns);
  std::string node_of(ObjectId callback) const;
  bool begins_named_chain(ObjectId callback);
  void compare_with_definitions(PathId path);
  bool is_in_path(PathId path, ObjectId callback) const;
  void end(const Trail& trail, std::int64_t end_ns);

  const ObjectModel* model_ = nullptr;
  std::vector<ChainDefinition> definitions_;
  enum class Begins : std::uint8_t { kUnknown, kNo, kYes };
  std::vector<Begins> begins_;  // by callback: whether a named chain begins there
  std::vector<PathId> first_;   // by callback: the path that begins there; may be shorter
  std::vector<ChainRecord> paths_;
  std::map<std::tuple<PathId, ObjectId, ObjectId>, PathId> index_;
  bool is_full_ = false;
  bool keeps_passages_ = false;
  Passages kept_;
  ThreadMap<std::vector<Active>> active_;            // innermost last
  std::vector<Sent> sent_;                           // by number, modulo its size
  std::map<ObjectId, std::vector<ObjectId>> links_;  // publisher to subscriptions
  std::map<ObjectId, Trails> latest_;                // by subscription of a link
  Trails causes_;                                    // of a publication, while it is told
};

}  // namespace tracing
