// SPDX-License-Identifier: Apache-2.0
#include "tracing/model/compare/run_recorder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <tuple>

#include "tracing/model/compare/subject_names.hpp"
#include "tracing/model/messages/hop_times.hpp"
#include "tracing/model/objects/record_at.hpp"

namespace tracing::compare {

namespace {

// Adds what was measured to the run, and knows which processes are doubtful.
class Writer {
 public:
  Writer(const TraceAnalysis& analysis, const TraceResults& results, RunSummary& run)
      : objects_(analysis.objects()), places_(analysis.places()), results_(results), run_(run) {}

  bool is_doubtful(ProcessId process) const {
    if (process >= places_.size() || !places_[process]) {
      return false;
    }
    return results_.overview.processes[*places_[process]].doubtful;
  }
  bool is_node_doubtful(ObjectId node) const {
    return node != kNoObject && is_doubtful(objects_.nodes()[node].process);
  }
  Measurement* add(Kind kind, const std::string& subject, const std::string& quantity, const KeptSamples& samples,
                   bool doubtful, bool estimated = false) {
    if (samples.count() == 0) {
      return nullptr;
    }
    const int number = ++seen_[{kind, subject, quantity}];
    const std::string name = number == 1 ? subject : fmt::format("{} #{}", subject, number);
    run_.measurements.push_back({kind, name, quantity, {}, samples.count(), samples.values(), doubtful, estimated});
    return &run_.measurements.back();
  }
  // Those that sent messages and those that sent nothing.
  // `knows_sent`: false if its process has sent nothing at all, or the trace has no events of that.
  void add_parts(const std::string& callback, const char* quantity, const std::array<KeptSamples, 2>& parts,
                 bool doubtful, bool knows_sent) {
    const auto& [silent, sending] = parts;
    if (Measurement* const part = add(Kind::kCallback, callback, quantity, sending, doubtful)) {
      part->sends = true;
    }
    const std::string other = std::string(quantity) + (sending.count() > 0 ? kWithoutSending : "");
    if (Measurement* const part = add(Kind::kCallback, callback, other, silent, doubtful)) {
      part->sends = knows_sent ? std::optional(false) : std::nullopt;
    }
  }

 private:
  const ObjectModel& objects_;
  const std::vector<std::optional<ProcessIndex>> places_;
  const TraceResults& results_;
  RunSummary& run_;
  std::map<std::tuple<Kind, std::string, std::string>, int> seen_;
};

}  // namespace

void RunRecorder::Chains::on_response(PathId path, std::int64_t input_ns, std::int64_t output_ns) {
  record_at(responses, path).add(output_ns - input_ns);
}

void RunRecorder::on_callback_begin(const CallbackInstance& instance) {
  chains_.on_callback_begin(instance);
  Callback& callback = record_at(callbacks_, instance.callback);
  if (callback.last_begin_ns != 0) {
    callback.intervals.add(instance.begin_ns - callback.last_begin_ns);
  }
  callback.last_begin_ns = instance.begin_ns;
  active_[instance.thread].push_back({.begin_ns = instance.begin_ns});
}

bool RunRecorder::has_sent(const CallbackInstance& instance) {
  std::vector<Active>* const active = active_.find(instance.thread);
  if (active == nullptr) {
    return false;
  }
  const auto ended = std::find_if(active->rbegin(), active->rend(),
                                  [&](const Active& one) { return one.begin_ns == instance.begin_ns; });
  if (ended == active->rend()) {
    return false;
  }
  const bool sends = ended->sends;
  active->erase(std::next(ended).base());
  return sends;
}

void RunRecorder::on_publication(const Publication& publication) {
  chains_.on_publication(publication);
  std::vector<Active>* const active = active_.find(publication.thread);
  if (active == nullptr || active->empty() || publication.topic == kNoObject) {
    return;
  }
  // What a callback logs is no other work.
  const std::string& topic = objects_->topics()[publication.topic].name;
  if (topic != "/rosout" && topic != "/parameter_events") {
    active->back().sends = true;
    senders_.insert(publication.thread.process);
  }
}

void RunRecorder::on_callback(const CallbackInstance& instance) {
  chains_.on_callback(instance);
  Callback& callback = record_at(callbacks_, instance.callback);
  const std::size_t part = has_sent(instance) ? 1 : 0;
  if (instance.finished) {
    callback.durations[part].add(instance.end_ns - instance.begin_ns);
  }
  if (instance.is_scheduled) {
    callback.running[part].add(instance.end_ns - instance.begin_ns - instance.runnable_ns - instance.blocked_ns);
    callback.waiting.add(instance.runnable_ns);
    callback.blocked.add(instance.blocked_ns);
  }
}

void RunRecorder::on_message(const MessageFlow& message) {
  chains_.on_message(message);
  if (message.publication.number == 0 || message.callback == kNoObject) {
    return;
  }
  const HopTimes times = hop_times(message);
  Hop& hop = record_at(hops_, message.subscription);
  hop.latency.add(times.latency_ns);
  hop.is_estimated = hop.is_estimated || message.is_estimated;
  if (times.transport_ns) {
    hop.transport.add(*times.transport_ns);
  }
  if (times.executor_ns) {
    hop.executor.add(*times.executor_ns);
  }
}

void RunRecorder::on_call(const ServiceCall& call) {
  if (call.client == kNoObject) {
    return;
  }
  calls_[{call.client, call.service}].add(call.received_ns - call.sent_ns);
}

bool RunRecorder::waits(PathId path) const {
  for (PathId at = path; chains_.paths()[at].parent != kNoPath; at = chains_.paths()[at].parent) {
    const ChainRecord& before = chains_.paths()[chains_.paths()[at].parent];
    const ObjectId kept = objects_->subscription_of(objects_->callbacks()[before.callback]);
    for (const auto& [publisher, subscriptions] : chains_.links()) {
      if (objects_->publishers()[publisher].topic == chains_.paths()[at].topic &&
          std::find(subscriptions.begin(), subscriptions.end(), kept) != subscriptions.end()) {
        return true;
      }
    }
  }
  return false;
}

RunSummary RunRecorder::finish(const TraceAnalysis& analysis, const TraceResults& results) {
  const ObjectModel& objects = analysis.objects();
  const SubjectNames names(analysis);
  RunSummary run;
  run.events = results.overview.events;
  run.begin_ns = results.overview.begin_ns.value_or(0);
  run.duration_ns = results.overview.end_ns.value_or(0) - run.begin_ns;
  Writer writer(analysis, results, run);
  for (ObjectId id = 0; id < callbacks_.size(); ++id) {
    const bool doubtful = writer.is_doubtful(objects.callbacks()[id].process);
    const bool knows_sent = senders_.contains(objects.callbacks()[id].process);
    writer.add_parts(names.callback(id), kDuration, callbacks_[id].durations, doubtful, knows_sent);
    writer.add(Kind::kCallback, names.callback(id), "interval", callbacks_[id].intervals, doubtful);
    writer.add_parts(names.callback(id), kRunning, callbacks_[id].running, doubtful, knows_sent);
    writer.add(Kind::kCallback, names.callback(id), kWaiting, callbacks_[id].waiting, doubtful);
    writer.add(Kind::kCallback, names.callback(id), kBlocked, callbacks_[id].blocked, doubtful);
  }
  for (ObjectId id = 0; id < hops_.size(); ++id) {
    const bool doubtful = writer.is_node_doubtful(objects.subscriptions()[id].node);
    const Hop& hop = hops_[id];
    writer.add(Kind::kHop, names.subscription(id), "latency", hop.latency, doubtful, hop.is_estimated);
    writer.add(Kind::kHop, names.subscription(id), "on the way", hop.transport, doubtful, hop.is_estimated);
    writer.add(Kind::kHop, names.subscription(id), "waiting for the executor", hop.executor, doubtful,
               hop.is_estimated);
  }
  for (const auto& [pair, samples] : calls_) {
    const auto& [client, service] = pair;
    const bool doubtful = writer.is_node_doubtful(objects.clients()[client].node);
    writer.add(Kind::kCall, names.call(client, service), "round trip", samples, doubtful);
  }
  for (PathId path = 0; path < chains_.responses.size(); ++path) {
    const ChainRecord& last = chains_.paths()[path];
    if (last.goes_on || last.length < 2) {
      continue;
    }
    std::vector<std::string> steps;
    std::string subject;
    bool doubtful = false;
    bool estimated = false;
    for (PathId at = path; at != kNoPath; at = chains_.paths()[at].parent) {
      const ObjectId callback = chains_.paths()[at].callback;
      subject = names.step(callback) + (subject.empty() ? "" : " -> ") + subject;
      steps.insert(steps.begin(), names.callback(callback));
      doubtful = doubtful || writer.is_doubtful(objects.callbacks()[callback].process);
      const ObjectId subscription = objects.subscription_of(objects.callbacks()[callback]);
      estimated = estimated || (subscription < hops_.size() && hops_[subscription].is_estimated);
    }
    Measurement* const chain =
        writer.add(Kind::kChain, subject, "response", chains_.responses[path], doubtful, estimated);
    if (chain != nullptr) {
      chain->steps = std::move(steps);
      chain->waits = waits(path);
    }
  }
  const auto key = [](const Measurement& one) { return std::tie(one.kind, one.subject, one.quantity); };
  std::stable_sort(run.measurements.begin(), run.measurements.end(),
                   [&](const Measurement& a, const Measurement& b) { return key(a) < key(b); });
  return run;
}

}  // namespace tracing::compare
