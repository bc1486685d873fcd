// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <unordered_map>
#include <vector>

#include "tracing/show/page/column_buffer.hpp"
#include "tracing/show/page/page_parts.hpp"

namespace tracing {

namespace {

using timeline::Index;
using timeline::Instance;
using timeline::kNone;
using timeline::Message;
using timeline::ThreadState;
using timeline::Timeline;

// References that follow one another are often close: 0 for none, else 1, 2, 3, … for the steps 0, -1, 1, …
class CloseReferences {
 public:
  explicit CloseReferences(ColumnBuffer& buffer) : buffer_(buffer) {}
  void add(Index index) {
    if (index == kNone) {
      buffer_.add(0);
      return;
    }
    const std::int64_t step = std::int64_t{index} - last_;
    buffer_.add((static_cast<std::uint64_t>(step) << 1 ^ static_cast<std::uint64_t>(step >> 63)) + 1);
    last_ = index;
  }

 private:
  ColumnBuffer& buffer_;
  std::int64_t last_ = 0;
};

// References that mostly are as they were the last time with the same key: 0 for that, 1 for none, else index + 2.
class RepeatedReferences {
 public:
  explicit RepeatedReferences(ColumnBuffer& buffer) : buffer_(buffer) {}
  void add(Index key, Index index) {
    Index& last = last_.try_emplace(key, kNone).first->second;
    buffer_.add(index == last ? 0 : index == kNone ? 1 : std::uint64_t{index} + 2);
    last = index;
  }

 private:
  ColumnBuffer& buffer_;
  std::unordered_map<Index, Index> last_;
};

void add_instances(ColumnBuffer& buffer, const Timeline& timeline) {
  std::int64_t last = timeline.begin_ns;
  for (const Instance& instance : timeline.instances) {
    buffer.add(static_cast<std::uint64_t>(instance.start_ns - last));
    last = instance.start_ns;
  }
  for (const Instance& instance : timeline.instances) {
    buffer.add(static_cast<std::uint64_t>(instance.end_ns - instance.start_ns));
  }
  for (const Instance& instance : timeline.instances) {
    buffer.add(instance.callback);
  }
  RepeatedReferences threads(buffer);
  for (const Instance& instance : timeline.instances) {
    threads.add(instance.callback, instance.thread);
  }
  for (const Instance& instance : timeline.instances) {
    buffer.add((instance.finished ? 1U : 0U) | (instance.intra_process ? 2U : 0U));
  }
}

void add_messages(ColumnBuffer& buffer, const Timeline& timeline) {
  const auto callback_of = [&timeline](Index instance) {
    return instance == kNone ? kNone : timeline.instances[instance].callback;
  };
  std::int64_t last = timeline.begin_ns;
  for (const Message& message : timeline.messages) {
    buffer.add(static_cast<std::uint64_t>(message.published_ns - last));
    last = message.published_ns;
  }
  for (const Message& message : timeline.messages) {
    buffer.add(static_cast<std::uint64_t>(message.published_ns - message.called_ns));
  }
  // Clocks of two hosts may differ, so a message may be taken before it is published.
  for (const Message& message : timeline.messages) {
    buffer.add(message.taken_ns == 0 ? 0 : 1);
    if (message.taken_ns != 0) {
      buffer.add_signed(message.taken_ns - message.published_ns);
    }
  }
  CloseReferences from(buffer);
  for (const Message& message : timeline.messages) {
    from.add(message.publishing_instance);
  }
  CloseReferences to(buffer);
  for (const Message& message : timeline.messages) {
    to.add(message.receiving_instance);
  }
  RepeatedReferences publishers(buffer);
  for (const Message& message : timeline.messages) {
    publishers.add(callback_of(message.publishing_instance), message.publisher);
  }
  RepeatedReferences subscriptions(buffer);
  for (const Message& message : timeline.messages) {
    subscriptions.add(callback_of(message.receiving_instance), message.subscription);
  }
  RepeatedReferences threads(buffer);
  for (const Message& message : timeline.messages) {
    threads.add(message.publisher, message.publishing_thread);
  }
  for (const Message& message : timeline.messages) {
    buffer.add(message.repeated ? 1 : 0);
  }
}

// Thread by thread, each in the order of time.
void add_states(ColumnBuffer& buffer, const Timeline& timeline) {
  std::vector<const ThreadState*> states;
  states.reserve(timeline.states.size());
  for (const ThreadState& state : timeline.states) {
    states.push_back(&state);
  }
  std::stable_sort(states.begin(), states.end(),
                   [](const ThreadState* left, const ThreadState* right) { return left->thread < right->thread; });
  CloseReferences threads(buffer);
  for (const ThreadState* state : states) {
    threads.add(state->thread);
  }
  // Most states begin where the one before ended.
  std::int64_t last = timeline.begin_ns;
  for (const ThreadState* state : states) {
    buffer.add_signed(state->begin_ns - last);
    last = state->end_ns;
  }
  for (const ThreadState* state : states) {
    buffer.add(static_cast<std::uint64_t>(state->end_ns - state->begin_ns));
  }
  for (const ThreadState* state : states) {
    buffer.add(static_cast<std::uint64_t>(state->state));
  }
  RepeatedReferences others(buffer);
  for (const ThreadState* state : states) {
    if (state->state == ThreadState::State::kRunnable) {
      others.add(state->thread, state->other);
    }
  }
  RepeatedReferences cpus(buffer);
  for (const ThreadState* state : states) {
    cpus.add(state->thread, static_cast<Index>(state->cpu));
  }
}

}  // namespace

std::string page_columns(const Timeline& timeline) {
  ColumnBuffer buffer;
  add_instances(buffer, timeline);
  add_messages(buffer, timeline);
  add_states(buffer, timeline);
  return buffer.compressed_text();
}

}  // namespace tracing
