// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <functional>
#include <unordered_map>
#include <utility>
#include <vector>

#include "tracing/show/page/column_buffer.hpp"
#include "tracing/show/page/page.hpp"

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

// A column with a number of each item.
template <class Items, class Number>
void add_column(ColumnBuffer& buffer, const Items& items, Number number) {
  for (const auto& item : items) {
    buffer.add(static_cast<std::uint64_t>(std::invoke(number, item)));
  }
}

template <class Items, class Reference>
void add_close_column(ColumnBuffer& buffer, const Items& items, Reference reference) {
  CloseReferences column(buffer);
  for (const auto& item : items) {
    column.add(std::invoke(reference, item));
  }
}

template <class Items, class Key, class Reference>
void add_repeated_column(ColumnBuffer& buffer, const Items& items, Key key, Reference reference) {
  RepeatedReferences column(buffer);
  for (const auto& item : items) {
    column.add(std::invoke(key, item), std::invoke(reference, item));
  }
}

// Gives the step from the item before.
template <class Item>
auto step_of(std::int64_t Item::*time, std::int64_t begin_ns) {
  return [time, last = begin_ns](const Item& item) mutable { return item.*time - std::exchange(last, item.*time); };
}

void add_instances(ColumnBuffer& buffer, const Timeline& timeline) {
  const auto& instances = timeline.instances;
  add_column(buffer, instances, step_of(&Instance::start_ns, timeline.begin_ns));
  add_column(buffer, instances, [](const Instance& instance) { return instance.end_ns - instance.start_ns; });
  add_column(buffer, instances, &Instance::callback);
  add_repeated_column(buffer, instances, &Instance::callback, &Instance::thread);
  add_column(buffer, instances, [](const Instance& instance) {
    return (instance.finished ? 1U : 0U) | (instance.intra_process ? 2U : 0U);
  });
}

void add_messages(ColumnBuffer& buffer, const Timeline& timeline) {
  const auto callback_of = [&timeline](Index Message::*instance) {
    return [&timeline, instance](const Message& message) {
      return message.*instance == kNone ? kNone : timeline.instances[message.*instance].callback;
    };
  };
  const auto& messages = timeline.messages;
  add_column(buffer, messages, step_of(&Message::published_ns, timeline.begin_ns));
  add_column(buffer, messages, [](const Message& message) { return message.published_ns - message.called_ns; });
  // Clocks of two hosts may differ, so a message may be taken before it is published.
  for (const Message& message : messages) {
    buffer.add(message.taken_ns == 0 ? 0 : 1);
    if (message.taken_ns != 0) {
      buffer.add_signed(message.taken_ns - message.published_ns);
    }
  }
  add_close_column(buffer, messages, &Message::publishing_instance);
  add_close_column(buffer, messages, &Message::receiving_instance);
  add_repeated_column(buffer, messages, callback_of(&Message::publishing_instance), &Message::publisher);
  add_repeated_column(buffer, messages, callback_of(&Message::receiving_instance), &Message::subscription);
  add_repeated_column(buffer, messages, &Message::publisher, &Message::publishing_thread);
  add_column(buffer, messages, &Message::repeated);
  add_column(buffer, messages, [](const Message& message) { return message.written_after_ns; });
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
  add_close_column(buffer, states, &ThreadState::thread);
  // Most states begin where the one before ended.
  std::int64_t last = timeline.begin_ns;
  for (const ThreadState* state : states) {
    buffer.add_signed(state->begin_ns - last);
    last = state->end_ns;
  }
  add_column(buffer, states, [](const ThreadState* state) { return state->end_ns - state->begin_ns; });
  add_column(buffer, states, &ThreadState::state);
  RepeatedReferences others(buffer);
  for (const ThreadState* state : states) {
    if (state->state == ThreadState::State::kRunnable) {
      others.add(state->thread, state->other);
    }
  }
  add_repeated_column(buffer, states, &ThreadState::thread,
                      [](const ThreadState* state) { return static_cast<Index>(state->cpu); });
}

}  // namespace

void write_page_columns(const Timeline& timeline, const WriteText& write) {
  ColumnBuffer buffer(write);
  add_instances(buffer, timeline);
  add_messages(buffer, timeline);
  add_states(buffer, timeline);
  buffer.finish();
}

}  // namespace tracing
