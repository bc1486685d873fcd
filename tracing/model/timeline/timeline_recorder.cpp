// SPDX-License-Identifier: Apache-2.0
#include "tracing/model/timeline/timeline_recorder.hpp"

#include <algorithm>
#include <tuple>
#include <utility>

#include "tracing/model/timeline/instance_index.hpp"
#include "tracing/model/timeline/nearly_sorted.hpp"
#include "tracing/model/timeline/timeline_objects.hpp"

namespace tracing::timeline {

namespace {

MessageDetail detail_of(const Publication& publication) {
  return {.rcl_ns = publication.rcl_ns,
          .written_ns = publication.written_ns,
          .has_rclcpp = publication.rclcpp_ns != 0,
          .intra_process = publication.intra_process};
}

}  // namespace

std::size_t TimelineRecorder::HashThreadId::operator()(const ThreadId& thread) const {
  return static_cast<std::size_t>(thread.vtid) * 0x9e3779b97f4a7c15 ^ static_cast<std::size_t>(thread.process);
}

Index TimelineRecorder::thread_of(const ThreadId& id) {
  if (last_thread_ != kNone && id == last_thread_id_) {
    return last_thread_;  // consecutive events often have one thread
  }
  const auto [found, is_new] = threads_.try_emplace(id, timeline_.threads.size());
  if (is_new) {
    timeline_.threads.push_back({id.process, id.vtid});
  }
  last_thread_id_ = id;
  last_thread_ = found->second;
  return last_thread_;
}

void TimelineRecorder::record_details(TraceAnalysis& analysis) {
  with_details_ = true;
  analysis_ = &analysis;
  analysis.keep_chain_passages();
}

// Each counts as one of the timeline's records at least, so there are enough of them before the last one's time.
bool TimelineRecorder::is_wanted(std::int64_t time_ns) {
  if (end_ns_ && time_ns >= *end_ns_) {
    return false;
  }
  last_ns_ = std::max(last_ns_, time_ns);
  if (++count_ > most_ && most_ > 0 && !end_ns_) {
    end_ns_ = last_ns_ + 1;
  }
  return true;
}

void TimelineRecorder::on_callback_begin(const CallbackInstance& instance) {
  const Index thread = thread_of(instance.thread);
  if (with_details_) {
    if (thread >= running_.size()) {
      running_.resize(thread + 1);
    }
    running_[thread].push_back({instance.callback, instance.begin_ns, 0, 0});
  }
}

void TimelineRecorder::on_allocation(const Allocation& allocation) {
  if (!with_details_) {
    return;
  }
  const auto thread = threads_.find(allocation.thread);
  if (thread == threads_.end() || thread->second >= running_.size() || running_[thread->second].empty()) {
    return;
  }
  Memory& memory = running_[thread->second].back();
  ++memory.calls;
  memory.bytes += allocation.bytes;
}

void TimelineRecorder::end_memory(const CallbackInstance& instance, Index thread) {
  if (thread >= running_.size()) {
    return;
  }
  std::vector<Memory>& running = running_[thread];
  const auto ended = std::find_if(running.rbegin(), running.rend(), [&](const Memory& memory) {
    return memory.callback == instance.callback && memory.begin_ns == instance.begin_ns;
  });
  if (ended == running.rend()) {
    return;
  }
  if (ended->calls > 0) {
    memory_.push_back({thread, *ended});
  }
  running.erase(std::next(ended).base());
}

void TimelineRecorder::on_call(const ServiceCall& call) {
  if (with_details_) {
    timeline_.details.calls.push_back(
        {call.client, call.service, call.sent_ns, call.taken_ns, call.answered_ns, call.received_ns});
  }
}

void TimelineRecorder::on_executor_wait(const ExecutorWait& wait) {
  if (with_details_) {
    timeline_.details.waits.push_back({wait.begin_ns, wait.end_ns, thread_of(wait.thread)});
  }
}

void TimelineRecorder::on_callback(const CallbackInstance& instance) {
  if (with_details_) {
    end_memory(instance, thread_of(instance.thread));
  }
  const Index thread = thread_of(instance.thread);
  if (is_wanted(instance.begin_ns)) {
    timeline_.instances.push_back({.start_ns = instance.begin_ns,
                                   .end_ns = instance.end_ns,
                                   .callback = instance.callback,
                                   .thread = thread,
                                   .finished = instance.finished,
                                   .intra_process = instance.intra_process});
  }
}

Message TimelineRecorder::message_of(const Publication& publication) {
  Message message;
  message.published_ns = publication.published_ns;
  message.called_ns = publication.published_ns;
  if (publication.rcl_ns != 0) {
    message.called_ns = publication.rcl_ns;
  }
  if (publication.rclcpp_ns != 0) {
    message.called_ns = publication.rclcpp_ns;
  }
  // It is in the trace a little after rmw_publish.
  constexpr std::int64_t kMostAfter = (1 << 23) - 1;
  const std::int64_t after_ns = publication.written_ns - publication.published_ns;
  message.written_after_ns = after_ns > 0 && after_ns <= kMostAfter ? static_cast<std::uint32_t>(after_ns) : 0;
  message.topic = publication.topic;
  message.publisher = publication.publisher;
  message.publishing_thread = thread_of(publication.thread);
  return message;
}

// Most publications are taken soon, and then their flows have all that is known.
void TimelineRecorder::forget_taken() {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < sent_.size(); ++i) {
    if (is_taken(sent_[i])) {
      continue;
    }
    sent_[kept] = sent_[i];
    if (with_details_) {
      sent_details_[kept] = sent_details_[i];
    }
    ++kept;
  }
  sent_.resize(kept);
  if (with_details_) {
    sent_details_.resize(kept);
  }
}

void TimelineRecorder::on_publication(const Publication& publication) {
  const Message message = message_of(publication);
  if (!is_wanted(message.published_ns)) {
    return;
  }
  if (sent_.size() == sent_.capacity()) {
    forget_taken();
  }
  sent_.push_back({message, publication.number});
  if (with_details_) {
    sent_details_.push_back(detail_of(publication));
  }
}

// Without its publication a message has no place in the timeline.
void TimelineRecorder::on_message(const MessageFlow& flow) {
  const std::uint64_t number = flow.publication.number;
  if (flow.publication.publisher == kNoObject) {
    return;
  }
  Message message = message_of(flow.publication);
  message.subscription = flow.subscription;
  message.taking_thread = thread_of(flow.taking_thread);
  message.taken_ns = flow.taken_ns;
  message.callback_ns = flow.callback_begin_ns;
  message.needs_no_callback = flow.needs_no_callback ? 1 : 0;
  if (end_ns_ && message.published_ns >= *end_ns_) {
    return;
  }
  if (number >= taken_.size()) {
    taken_.resize(number + 1);
  }
  taken_[number] = true;
  if (with_details_) {
    message.publishing_instance = static_cast<Index>(message_details_.size());
    message_details_.push_back(detail_of(flow.publication));
    message_details_.back().waited_ns = flow.executor_waited_ns.value_or(-1);
    message_details_.back().is_estimated = flow.is_estimated;
  }
  timeline_.messages.push_back(message);
}

void TimelineRecorder::on_lifecycle_state(const LifecycleInterval& interval) {
  if (interval.node == kNoObject) {
    return;
  }
  timeline_.lifecycle.push_back({interval.node, std::string(interval.state), interval.begin_ns, interval.end_ns});
}

void TimelineRecorder::on_thread_state(const ThreadInterval& interval) {
  const auto thread = threads_.find(interval.thread);
  if (thread == threads_.end()) {
    return;
  }
  Index other = kNone;
  if (!interval.other_name.empty()) {
    const auto next = static_cast<Index>(other_threads_.size());
    const auto [known, is_new] =
        other_threads_.try_emplace({interval.other_tid, std::string(interval.other_name)}, next);
    if (is_new) {
      timeline_.other_threads.push_back({interval.other_tid, std::string(interval.other_name)});
    }
    other = known->second;
  }
  if (is_wanted(interval.begin_ns)) {
    timeline_.states.push_back({interval.begin_ns, interval.end_ns, thread->second, other,
                                static_cast<std::int32_t>(interval.cpu), interval.state});
  }
}

// Publications and flows become one list: a flow has its publication in it, so of publications only those are left that
// nobody took.
void TimelineRecorder::join_messages() {
  std::vector<Message>& messages = timeline_.messages;
  const auto key = [](const Message& message) { return std::tie(message.published_ns, message.publisher); };
  const auto is_earlier = [&](const Message& left, const Message& right) { return key(left) < key(right); };
  sort_nearly_sorted(messages, is_earlier);
  for (std::size_t i = 1; i < messages.size(); ++i) {
    messages[i].repeated = key(messages[i - 1]) == key(messages[i]);
  }
  forget_taken();
  const auto taken = static_cast<std::ptrdiff_t>(messages.size());
  messages.reserve(messages.size() + sent_.size());
  for (std::size_t i = 0; i < sent_.size(); ++i) {
    if (with_details_) {
      sent_[i].message.publishing_instance = static_cast<Index>(message_details_.size());
      message_details_.push_back(sent_details_[i]);
    }
    messages.push_back(sent_[i].message);
  }
  sent_ = {};
  sent_details_ = {};
  taken_ = {};
  std::stable_sort(messages.begin() + taken, messages.end(), is_earlier);
  std::inplace_merge(messages.begin(), messages.begin() + taken, messages.end(), is_earlier);
}

// Puts the details in the order of the messages, which know where they are. Each cycle of places is gone through once.
void TimelineRecorder::order_message_details() {
  std::vector<Message>& messages = timeline_.messages;
  for (std::size_t first = 0; first < messages.size(); ++first) {
    std::size_t place = first;
    while (messages[place].publishing_instance != first) {
      const std::size_t from = std::exchange(messages[place].publishing_instance, static_cast<Index>(place));
      std::swap(message_details_[place], message_details_[from]);
      place = from;
    }
    messages[place].publishing_instance = static_cast<Index>(place);
  }
  timeline_.details.messages = std::move(message_details_);
}

// Finds the instances in which messages were published, and those that got them.
void TimelineRecorder::link_messages(const InstanceIndex& index) {
  for (std::size_t i = 0; i < timeline_.messages.size(); ++i) {
    Message& message = timeline_.messages[i];
    message.publishing_instance = index.running(message.publishing_thread, message.published_ns);
    if (message.callback_ns != 0) {
      message.receiving_instance = index.begun(message.taking_thread, message.callback_ns);
      if (message.receiving_instance != kNone) {
        timeline_.instances[message.receiving_instance].message = static_cast<Index>(i);
      }
    }
  }
}

// Refers to the instances by their places, which are known now.
void TimelineRecorder::finish_details(const InstanceIndex& index) {
  Details& details = timeline_.details;
  std::stable_sort(details.calls.begin(), details.calls.end(),
                   [](const Call& left, const Call& right) { return left.begin_ns() < right.begin_ns(); });
  std::stable_sort(details.waits.begin(), details.waits.end(),
                   [](const Wait& left, const Wait& right) { return left.begin_ns < right.begin_ns; });
  for (const auto& [thread, memory] : memory_) {
    details.memory.push_back({index.begun(thread, memory.begin_ns), memory.calls, memory.bytes});
  }
  memory_ = {};
  std::sort(details.memory.begin(), details.memory.end(),
            [](const InstanceMemory& left, const InstanceMemory& right) { return left.instance < right.instance; });
  ChainTracker::Passages told = analysis_->take_chain_passages();
  details.hops.reserve(told.hops.size());
  for (const tracing::ChainHop& hop : told.hops) {
    const auto thread = threads_.find({hop.process, hop.vtid});
    details.hops.push_back({hop.before, thread == threads_.end() ? kNone : index.begun(thread->second, hop.begin_ns)});
  }
  told.hops = {};
  for (const tracing::ChainPassage& passage : told.passages) {
    const ChainRecord& path = analysis_->chains().paths()[passage.path];
    if (path.named.empty() && path.goes_on) {
      continue;  // no chain of the results ends here
    }
    details.passages.push_back({passage.path, passage.last_hop, passage.input_ns, passage.output_ns, passage.is_first});
  }
}

Timeline TimelineRecorder::finish(const TraceAnalysis& analysis, const TraceOverview& overview) {
  timeline_.begin_ns = overview.begin_ns.value_or(0);
  timeline_.end_ns = overview.end_ns.value_or(0);
  // Instances and states are told at their ends.
  sort_nearly_sorted(timeline_.instances,
                     [](const Instance& left, const Instance& right) { return left.start_ns < right.start_ns; });
  sort_nearly_sorted(timeline_.states,
                     [](const ThreadState& left, const ThreadState& right) { return left.begin_ns < right.begin_ns; });
  join_messages();
  if (with_details_) {
    order_message_details();
  }
  {
    const InstanceIndex index(timeline_.instances, timeline_.threads.size());
    link_messages(index);
    if (with_details_) {
      finish_details(index);
    }
  }
  std::stable_sort(timeline_.lifecycle.begin(), timeline_.lifecycle.end(),
                   [](const LifecycleState& left, const LifecycleState& right) {
                     return std::tie(left.node, left.begin_ns) < std::tie(right.node, right.begin_ns);
                   });
  copy_objects(analysis, timeline_);
  return std::move(timeline_);
}

}  // namespace tracing::timeline
