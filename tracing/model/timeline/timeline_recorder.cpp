// SPDX-License-Identifier: Apache-2.0
#include "tracing/model/timeline/timeline_recorder.hpp"

#include <algorithm>
#include <tuple>

#include "tracing/model/objects/callback_symbol.hpp"
#include "tracing/model/timeline/instance_index.hpp"

namespace tracing::timeline {

namespace {

Callback callback_of(const CallbackObject& object, const ObjectModel& objects) {
  using From = CallbackObject::Owner;
  using To = CallbackResult::Owner;
  Callback callback;
  callback.process = object.process;
  callback.address = object.address;
  callback.symbol = readable_symbol(object.symbol);
  const ObjectId subscription = objects.subscription_of(object);
  if (subscription != kNoObject) {
    callback.owner = To::kSubscription;
    callback.owner_id = subscription;
    callback.node = objects.subscriptions()[subscription].node;
    callback.topic = objects.subscriptions()[subscription].topic;
  } else if (object.owner == From::kTimer && object.owner_id != kNoObject) {
    callback.owner = To::kTimer;
    callback.owner_id = object.owner_id;
    callback.node = objects.timers()[object.owner_id].node;
    callback.period_ns = objects.timers()[object.owner_id].period_ns;
  } else if (object.owner == From::kService && object.owner_id != kNoObject) {
    callback.owner = To::kService;
    callback.owner_id = object.owner_id;
    callback.node = objects.services()[object.owner_id].node;
    callback.service = objects.services()[object.owner_id].name;
  } else if (object.owner == From::kClient) {
    callback.owner = To::kClient;
    if (object.owner_id != kNoObject) {
      callback.owner_id = object.owner_id;
      callback.node = objects.clients()[object.owner_id].node;
      callback.service = objects.clients()[object.owner_id].name;
    }
  }
  return callback;
}

// Fills processes, nodes, topics, endpoints and callbacks. Their indices are the ids of the analysis.
void copy_objects(const TraceAnalysis& analysis, Timeline& timeline) {
  const ObjectModel& objects = analysis.objects();
  const std::vector<std::optional<ProcessIndex>> places = analysis.places();
  for (ProcessId id = 0; id < analysis.processes().size(); ++id) {
    const ProcessObject& process = analysis.processes()[id];
    timeline.processes.push_back({process.vpid.value_or(0), process.name, analysis.host_of(id), places[id]});
  }
  for (const NodeObject& node : objects.nodes()) {
    timeline.nodes.push_back({node.process, node.name});
  }
  for (const TopicObject& topic : objects.topics()) {
    timeline.topics.push_back(topic.name);
  }
  for (const EndpointObject& end : objects.publishers()) {
    timeline.publishers.push_back({end.node, end.topic, end.queue_depth, end.qos});
  }
  for (const EndpointObject& end : objects.subscriptions()) {
    timeline.subscriptions.push_back({end.node, end.topic, end.queue_depth, end.qos});
  }
  for (const auto& [publisher, subscriptions] : analysis.chains().links()) {
    for (const ObjectId subscription : subscriptions) {
      timeline.kept.push_back({publisher, subscription});
    }
  }
  for (const TimerObject& timer : objects.timers()) {
    timeline.timers.push_back({timer.node, timer.period_ns});
  }
  for (const ServiceObject& service : objects.services()) {
    timeline.services.push_back({service.node, service.name});
  }
  for (const ClientObject& client : objects.clients()) {
    timeline.clients.push_back({client.node, client.name});
  }
  const CallbackGroups& groups = analysis.groups();
  for (const ExecutorObject& executor : groups.executors()) {
    timeline.executors.push_back({executor.process, executor.address, executor.kind});
  }
  for (const GroupObject& group : groups.groups()) {
    timeline.callback_groups.push_back({group.executor, group.kind});
  }
  for (const ::tracing::SimulatedTime& time : groups.simulated_times()) {
    timeline.simulated_times.push_back({time.time_ns, time.simulated_ns});
  }
  for (const CallbackObject& object : objects.callbacks()) {
    timeline.callbacks.push_back(callback_of(object, objects));
    timeline.callbacks.back().group = groups.group_of(object);
  }
}

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
  analysis.keep_chain_passages();
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
  timeline_.instances.push_back({.start_ns = instance.begin_ns,
                                 .end_ns = instance.end_ns,
                                 .callback = instance.callback,
                                 .thread = thread_of(instance.thread),
                                 .finished = instance.finished,
                                 .intra_process = instance.intra_process});
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
  constexpr std::int64_t kMostAfter = (1 << 24) - 1;
  const std::int64_t after_ns = publication.written_ns - publication.published_ns;
  message.written_after_ns = after_ns > 0 && after_ns <= kMostAfter ? static_cast<std::uint32_t>(after_ns) : 0;
  message.topic = publication.topic;
  message.publisher = publication.publisher;
  message.publishing_thread = thread_of(publication.thread);
  return message;
}

void TimelineRecorder::on_publication(const Publication& publication) {
  timeline_.messages.push_back(message_of(publication));
  if (with_details_) {
    timeline_.messages.back().publishing_instance = static_cast<Index>(message_details_.size());
    message_details_.push_back(detail_of(publication));
  }
}

// Without its publication a message has no place in the timeline.
void TimelineRecorder::on_message(const MessageFlow& flow) {
  if (flow.publication.publisher == kNoObject) {
    return;
  }
  Flow told{message_of(flow.publication), flow.callback_begin_ns};
  told.message.subscription = flow.subscription;
  told.message.taking_thread = thread_of(flow.taking_thread);
  told.message.taken_ns = flow.taken_ns;
  if (with_details_) {
    told.message.publishing_instance = static_cast<Index>(message_details_.size());
    message_details_.push_back(detail_of(flow.publication));
    message_details_.back().waited_ns = flow.executor_waited_ns.value_or(-1);
    message_details_.back().is_by_order = flow.is_by_order;
  }
  flows_.push_back(told);
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
  timeline_.states.push_back({interval.begin_ns, interval.end_ns, thread->second, other,
                              static_cast<std::int32_t>(interval.cpu), interval.state});
}

// Publications and flows become one list: a flow has its publication in it, so of publications only those are left that
// nobody took.
void TimelineRecorder::join_messages() {
  const auto key = [](const Message& message) { return std::tie(message.published_ns, message.publisher); };
  std::stable_sort(flows_.begin(), flows_.end(),
                   [&](const Flow& left, const Flow& right) { return key(left.message) < key(right.message); });
  std::stable_sort(timeline_.messages.begin(), timeline_.messages.end(),
                   [&](const Message& left, const Message& right) { return key(left) < key(right); });
  std::vector<Flow> joined;
  joined.reserve(std::max(flows_.size(), timeline_.messages.size()));
  auto flow = flows_.begin();
  for (const Message& publication : timeline_.messages) {
    bool taken = false;
    while (flow != flows_.end() && key(flow->message) <= key(publication)) {
      flow->message.repeated = taken;
      taken = true;
      joined.push_back(*flow++);
    }
    if (!taken) {
      joined.push_back({publication, 0});
    }
  }
  flows_ = std::move(joined);
}

// Finds the instances in which messages were published, and those that got them.
void TimelineRecorder::link_messages(const InstanceIndex& index) {
  timeline_.messages.clear();
  timeline_.messages.reserve(flows_.size());
  for (Flow& flow : flows_) {
    Message& message = flow.message;
    if (with_details_) {
      timeline_.details.messages.push_back(message_details_[message.publishing_instance]);
    }
    message.publishing_instance = index.running(message.publishing_thread, message.published_ns);
    if (flow.callback_begin_ns != 0) {
      message.receiving_instance = index.begun(message.taking_thread, flow.callback_begin_ns);
      if (message.receiving_instance != kNone) {
        timeline_.instances[message.receiving_instance].message = timeline_.messages.size();
      }
    }
    timeline_.messages.push_back(message);
  }
  flows_ = {};
  message_details_ = {};
}

// Refers to the instances by their places, which are known now.
void TimelineRecorder::finish_details(const TraceAnalysis& analysis, const InstanceIndex& index) {
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
  details.hops.reserve(analysis.chains().hops().size());
  for (const tracing::ChainHop& hop : analysis.chains().hops()) {
    const auto thread = threads_.find({hop.process, hop.vtid});
    details.hops.push_back({hop.before, thread == threads_.end() ? kNone : index.begun(thread->second, hop.begin_ns)});
  }
  for (const tracing::ChainPassage& passage : analysis.chains().passages()) {
    const ChainRecord& path = analysis.chains().paths()[passage.path];
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
  std::stable_sort(timeline_.instances.begin(), timeline_.instances.end(),
                   [](const Instance& left, const Instance& right) { return left.start_ns < right.start_ns; });
  std::stable_sort(timeline_.states.begin(), timeline_.states.end(),
                   [](const ThreadState& left, const ThreadState& right) { return left.begin_ns < right.begin_ns; });
  join_messages();
  {
    const InstanceIndex index(timeline_.instances, timeline_.threads.size());
    link_messages(index);
    if (with_details_) {
      finish_details(analysis, index);
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
