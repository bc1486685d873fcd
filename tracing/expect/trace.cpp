// SPDX-License-Identifier: Apache-2.0
#include "launch_trace_testing/trace.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <memory>
#include <ostream>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "tracing/decode/reader/trace_reader.hpp"
#include "tracing/expect/event_table.hpp"
#include "tracing/model/analysis/trace_analysis.hpp"
#include "tracing/model/timeline/timeline.hpp"
#include "tracing/model/timeline/timeline_recorder.hpp"

namespace launch_trace_testing {

// Reads a trace into memory.
class TraceStore {
 public:
  TraceStore() = default;
  TraceStore(const std::vector<std::filesystem::path>& directories, const ReadOptions& options);

  std::vector<Event> events;
  std::vector<Loss> losses;
  std::vector<std::string> damage;
  std::vector<std::filesystem::path> directories;
  std::vector<CallbackRun> callbacks;
  std::vector<Delivery> deliveries;
  std::vector<MessageDoubts> doubts;
  std::string tracetools;
  bool lacks_middleware = false;

 private:
  Event stored(const tracing::Event& event, const std::string& host);
  void set_class(Event& stored, const tracing::EventClass& event_class, const std::string& host);
  void add_callbacks(const tracing::timeline::Timeline& timeline);
  void add_deliveries(const tracing::timeline::Timeline& timeline);
  void add_doubts(const tracing::Ros2Results& results);

  std::vector<std::shared_ptr<const EventClass>> classes_;  // by tracing::EventClass::id
  std::vector<std::vector<std::size_t>> contexts_;          // of each class, those that are kept as values
  std::map<std::string, std::shared_ptr<const std::string>, std::less<>> procnames_;
};

namespace {

using tracing::timeline::kNone;

Value value_of(const tracing::FieldValue& field) {
  Value value;
  if (field.is_enumeration()) {
    Value::Enumeration enumeration{field.integer().value_or(0), {}};
    if (const auto label = field.enumeration_label()) {
      enumeration.label = *label;
    }
    value.data = std::move(enumeration);
  } else if (const auto number = field.unsigned_integer()) {
    value.data = *number;
    value.hexadecimal = field.is_hexadecimal();
  } else if (const auto with_sign = field.integer()) {
    value.data = *with_sign;
  } else if (const auto real = field.real()) {
    value.data = *real;
  } else if (const auto text = field.string()) {
    value.data = std::string(*text);
  } else if (field.is_variant()) {
    return value_of(field[0]);
  } else if (field.is_structure()) {
    Value::Structure members;
    for (std::size_t i = 0; i < field.size(); ++i) {
      members.push_back({std::string(field.member_name(i)), value_of(field[i])});
    }
    value.data = std::move(members);
  } else {
    Value::Array elements;
    for (std::size_t i = 0; i < field.size(); ++i) {
      elements.push_back(value_of(field[i]));
    }
    value.data = std::move(elements);
  }
  return value;
}

Loss loss_of(const tracing::Loss& loss) {
  return {loss.kind == tracing::Loss::Kind::kPackets, loss.count, loss.begin_ns.value_or(0), loss.end_ns.value_or(0),
          loss.stream->name};
}

// Leaves the ids as they are if the thread is not known.
void set_thread(const tracing::timeline::Timeline& timeline, tracing::timeline::Index index, std::int64_t& vpid,
                std::int64_t& vtid) {
  if (index != kNone) {
    const tracing::timeline::Thread& thread = timeline.threads[index];
    vpid = timeline.processes[thread.process].vpid;
    vtid = thread.vtid;
  }
}

}  // namespace

TraceStore::TraceStore(const std::vector<std::filesystem::path>& paths, const ReadOptions& options)
    : directories(paths) {
  tracing::timeline::TimelineRecorder recorder;
  tracing::TraceAnalysis analysis(&recorder);
  tracing::timeline::Timeline timeline;
  try {
    tracing::TraceReader reader(paths, tracing::TraceReader::Clocks::kOne);
    while (const tracing::TraceItem item = reader.next()) {
      if (item.loss != nullptr) {
        losses.push_back(loss_of(*item.loss));
        analysis.on_loss(*item.loss);
        continue;
      }
      Event event = stored(*item.event, std::string(reader.traces()[item.event->event_class->trace].text("hostname")));
      if (options.accepts && !options.accepts(event)) {
        continue;
      }
      event.position_ = events.size();
      events.push_back(std::move(event));
      analysis.on_event(*item.event);
    }
    damage = reader.damage();
    const tracing::TraceResults results = analysis.finish();
    timeline = recorder.finish(analysis, results.overview);
    add_doubts(results.ros2);
  } catch (const tracing::TraceReadError& error) {
    throw TraceError(error.remedy().empty() ? std::string(error.what())
                                            : std::string(error.what()) + "\nhelp: " + error.remedy());
  }
  add_callbacks(timeline);
  add_deliveries(timeline);
}

void TraceStore::set_class(Event& stored, const tracing::EventClass& event_class, const std::string& host) {
  if (event_class.id >= classes_.size()) {
    classes_.resize(event_class.id + 1);
    contexts_.resize(event_class.id + 1);
  }
  if (!classes_[event_class.id]) {
    EventClass known{event_class.name, host, event_class.fields, {}};
    for (std::size_t i = 0; i < event_class.contexts.size(); ++i) {
      const std::string& context = event_class.contexts[i];
      if (context == "vpid" || context == "vtid" || context == "procname") {
        continue;
      }
      known.contexts.push_back(context);
      contexts_[event_class.id].push_back(i);
    }
    classes_[event_class.id] = std::make_shared<const EventClass>(std::move(known));
  }
  stored.class_ = classes_[event_class.id];
}

Event TraceStore::stored(const tracing::Event& event, const std::string& host) {
  Event stored;
  set_class(stored, *event.event_class, host);
  stored.time_ns_ = event.timestamp_ns;
  stored.cpu_id_ = event.cpu_id.value_or(-1);
  stored.vpid_ = event.vpid.value_or(-1);
  stored.vtid_ = event.vtid.value_or(-1);
  const std::string_view procname = event.procname.value_or("");
  auto known = procnames_.find(procname);
  if (known == procnames_.end()) {
    known = procnames_.emplace(procname, std::make_shared<const std::string>(procname)).first;
  }
  stored.procname_ = known->second;
  const std::vector<std::size_t>& contexts = contexts_[event.event_class->id];
  stored.values_.reserve(event.event_class->fields.size() + contexts.size());
  for (std::size_t i = 0; i < event.event_class->fields.size(); ++i) {
    stored.values_.push_back(value_of(event.field(i)));
  }
  for (const std::size_t context : contexts) {
    stored.values_.push_back(value_of(event.context(context)));
  }
  return stored;
}

void TraceStore::add_callbacks(const tracing::timeline::Timeline& timeline) {
  callbacks.reserve(timeline.instances.size());
  for (const tracing::timeline::Instance& instance : timeline.instances) {
    CallbackRun run;
    run.start_ns = instance.start_ns;
    run.end_ns = instance.end_ns;
    run.finished = instance.finished;
    if (instance.callback != kNone) {
      const tracing::timeline::Callback& callback = timeline.callbacks[instance.callback];
      if (callback.node != kNone) {
        run.node = timeline.nodes[callback.node].name;
      }
      if (callback.topic != kNone) {
        run.topic = timeline.topics[callback.topic];
      }
      run.service = callback.service;
      run.is_timer = callback.owner == tracing::CallbackResult::Owner::kTimer;
      run.period_ns = callback.period_ns;
      run.symbol = callback.symbol;
    }
    set_thread(timeline, instance.thread, run.vpid, run.vtid);
    callbacks.push_back(std::move(run));
  }
}

void TraceStore::add_deliveries(const tracing::timeline::Timeline& timeline) {
  const auto node_name = [&](tracing::timeline::Index node) {
    return node == kNone ? std::string() : timeline.nodes[node].name;
  };
  deliveries.reserve(timeline.messages.size());
  for (const tracing::timeline::Message& message : timeline.messages) {
    Delivery delivery;
    if (message.topic != kNone) {
      delivery.topic = timeline.topics[message.topic];
    }
    if (message.publisher != kNone) {
      delivery.publisher = node_name(timeline.publishers[message.publisher].node);
    }
    if (message.subscription != kNone) {
      delivery.subscriber = node_name(timeline.subscriptions[message.subscription].node);
    }
    set_thread(timeline, message.publishing_thread, delivery.publisher_vpid, delivery.publisher_vtid);
    set_thread(timeline, message.taking_thread, delivery.subscriber_vpid, delivery.subscriber_vtid);
    delivery.called_ns = message.called_ns;
    delivery.published_ns = message.published_ns;
    delivery.taken_ns = message.taken_ns;
    if (message.receiving_instance != kNone) {
      const tracing::timeline::Instance& instance = timeline.instances[message.receiving_instance];
      delivery.callback_start_ns = instance.start_ns;
      delivery.callback_end_ns = instance.finished ? instance.end_ns : 0;
    } else if (message.needs_no_callback != 0) {
      delivery.callback_start_ns = message.taken_ns;
    }
    deliveries.push_back(std::move(delivery));
  }
}

void TraceStore::add_doubts(const tracing::Ros2Results& results) {
  for (const tracing::TopicResult& topic : results.topics) {
    const std::uint64_t taken = topic.unidentified + (results.is_older ? topic.unrecorded + topic.received_only : 0);
    if (topic.is_estimated() || taken > 0) {
      doubts.push_back({topic.name, topic.estimated, taken, topic.undecided});
    }
  }
  tracetools = fmt::format("{}", fmt::join(results.tracetools, ", "));
  lacks_middleware = results.lacks_middleware;
}

Trace::Trace() : store_(std::make_shared<const TraceStore>()) {}

Trace::Trace(const std::filesystem::path& directory, const ReadOptions& options)
    : Trace(std::vector{directory}, options) {}

Trace::Trace(const std::vector<std::filesystem::path>& directories, const ReadOptions& options)
    : store_(std::make_shared<const TraceStore>(directories, options)) {}

const std::vector<Event>& Trace::events() const {
  return store_->events;
}

const std::vector<Loss>& Trace::losses() const {
  return store_->losses;
}

const std::vector<std::string>& Trace::damage() const {
  return store_->damage;
}

const std::vector<std::filesystem::path>& Trace::directories() const {
  return store_->directories;
}

const std::vector<CallbackRun>& Trace::callbacks() const {
  return store_->callbacks;
}

const std::vector<Delivery>& Trace::deliveries() const {
  return store_->deliveries;
}

const std::vector<MessageDoubts>& Trace::doubts() const {
  return store_->doubts;
}

const std::string& Trace::tracetools() const {
  return store_->tracetools;
}

bool Trace::lacks_middleware() const {
  return store_->lacks_middleware;
}

std::int64_t Trace::begin_ns() const {
  return empty() ? 0 : events().front().time_ns();
}

std::int64_t Trace::end_ns() const {
  return empty() ? 0 : events().back().time_ns();
}

std::string to_string(const Trace& trace) {
  std::set<std::pair<std::string, std::int64_t>> processes;
  for (const Event& event : trace) {
    processes.emplace(event.host(), event.vpid());
  }
  return fmt::format("a trace with {} of {}", counted(trace.size(), "event"), counted(processes.size(), "process"));
}

std::ostream& operator<<(std::ostream& stream, const Trace& trace) {
  return stream << to_string(trace);
}

void PrintTo(const Trace& trace, std::ostream* stream) {
  *stream << trace;
}

}  // namespace launch_trace_testing
