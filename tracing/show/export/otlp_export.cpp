// SPDX-License-Identifier: Apache-2.0
// OpenTelemetry's protocol as JSON (https://opentelemetry.io/docs/specs/otlp/#json-protobuf-encoding), in a file as its
// file exporter writes it: one line, with one request.
//
// A passage of a chain is a trace. Its root span is the passage; below it are a span for each run of a callback, and
// between two of these one for the message on its way. The resource of a span is the process in which it begins.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "tracing/show/export/export.hpp"
#include "tracing/show/export/output_file.hpp"

namespace tracing {
namespace {

using Json = nlohmann::ordered_json;
using timeline::ChainPassage;
using timeline::Index;
using timeline::kNone;

// SpanKind and StatusCode of opentelemetry/proto/trace/v1/trace.proto.
enum SpanKind { kInternal = 1, kProducer = 4, kConsumer = 5 };
constexpr int kStatusError = 2;

Json text_attribute(const char* key, const std::string& value) {
  return {{"key", key}, {"value", {{"stringValue", value}}}};
}
// 64-bit integers are texts in the JSON of protobuf.
Json number_attribute(const char* key, std::int64_t value) {
  return {{"key", key}, {"value", {{"intValue", std::to_string(value)}}}};
}
Json flag_attribute(const char* key, bool value) {
  return {{"key", key}, {"value", {{"boolValue", value}}}};
}

// FNV-1a. Ids are the same in each export of a recording, so that a backend which has got it twice has it once.
std::uint64_t mixed(std::uint64_t hash, std::uint64_t value) {
  constexpr std::uint64_t kPrime = 0x100000001b3;
  for (int byte = 0; byte < 8; ++byte) {
    hash = (hash ^ (value >> (8 * byte) & 0xff)) * kPrime;
  }
  return hash;
}
constexpr std::uint64_t kBasis = 0xcbf29ce484222325;

class OtlpWriter {
 public:
  explicit OtlpWriter(const TracedSystem& system) : system_(system), timeline_(system.timeline) {
    spans_.resize(timeline_.processes.size());
  }

  Json request() {
    std::multimap<std::uint32_t, std::size_t> chains;  // by path
    for (std::size_t id = 0; id < system_.results.ros2.chains.size(); ++id) {
      chains.emplace(system_.results.ros2.chains[id].path, id);
    }
    for (const ChainPassage& passage : timeline_.details.passages) {
      const auto [first, last] = chains.equal_range(passage.path);
      for (auto chain = first; chain != last; ++chain) {
        add_passage(chain->second, passage);
      }
    }
    Json resources = Json::array();
    for (std::size_t process = 0; process < spans_.size(); ++process) {
      if (!spans_[process].empty()) {
        resources.push_back(
            {{"resource", {{"attributes", resource_of(timeline_.processes[process])}}},
             {"scopeSpans", Json::array({{{"scope", {{"name", "launch"}}}, {"spans", std::move(spans_[process])}}})}});
      }
    }
    return {{"resourceSpans", std::move(resources)}};
  }

 private:
  struct Ids {
    std::string trace;  // hexadecimal digits
    std::uint64_t base = 0;

    std::string span(std::uint64_t number) const {
      return fmt::format("{:016x}", std::max<std::uint64_t>(mixed(base, number), 1));
    }
  };

  // Processes that are alike in another run have the same `service.name`.
  static Json resource_of(const timeline::Process& process) {
    Json attributes =
        Json::array({text_attribute("service.name", process.name), number_attribute("process.pid", process.vpid)});
    if (!process.host.empty()) {
      attributes.push_back(text_attribute("host.name", process.host));
    }
    return attributes;
  }

  Ids ids_of(std::size_t chain, const ChainPassage& passage) const {
    std::uint64_t base = mixed(kBasis, static_cast<std::uint64_t>(passage.output_ns));
    base = mixed(base, static_cast<std::uint64_t>(passage.input_ns));
    base = mixed(mixed(base, passage.path), chain);
    return {fmt::format("{:016x}{:016x}", std::max<std::uint64_t>(base, 1), mixed(base, kBasis)), base};
  }

  void add_passage(std::size_t chain, const ChainPassage& passage) {
    std::vector<Index> instances;
    for (std::uint32_t hop = passage.last_hop; hop != kNone; hop = timeline_.details.hops[hop].before) {
      instances.push_back(timeline_.details.hops[hop].instance);
    }
    std::reverse(instances.begin(), instances.end());
    // A window of time may have cut it.
    if (instances.empty() || std::find(instances.begin(), instances.end(), kNone) != instances.end()) {
      return;
    }
    const ChainResult& result = system_.results.ros2.chains[chain];
    const Ids ids = ids_of(chain, passage);
    const std::string name = result.name.empty()
                                 ? fmt::format("{} to {}", result.steps.front().node, result.steps.back().node)
                                 : result.name;
    Json root = span(ids, 0, "", name, kInternal, passage.input_ns, passage.output_ns);
    root["attributes"] =
        Json::array({text_attribute("ros2.chain", name), flag_attribute("ros2.chain.first_output", passage.is_first)});
    if (result.budget_ns) {
      root["attributes"].push_back(number_attribute("ros2.chain.budget_ns", *result.budget_ns));
      if (passage.is_first && passage.output_ns - passage.input_ns > *result.budget_ns) {
        root["status"] = {{"code", kStatusError}, {"message", "over its budget"}};
      }
    }
    add(instances.front(), std::move(root));
    std::uint64_t number = 0;
    std::string parent = ids.span(0);
    for (std::size_t step = 0; step < instances.size(); ++step) {
      const timeline::Instance& run = timeline_.instances[instances[step]];
      if (step > 0 && run.message != kNone) {
        const std::string id = ids.span(++number);
        add(instances[step - 1], message_span(ids, number, parent, run));
        parent = id;
      }
      add(instances[step], callback_span(ids, ++number, parent, run, step > 0));
      parent = ids.span(number);
    }
  }

  static Json span(const Ids& ids, std::uint64_t number, const std::string& parent, const std::string& name,
                   SpanKind kind, std::int64_t begin_ns, std::int64_t end_ns) {
    Json made = {{"traceId", ids.trace}, {"spanId", ids.span(number)}};
    if (!parent.empty()) {
      made["parentSpanId"] = parent;
    }
    made["name"] = name;
    made["kind"] = static_cast<int>(kind);
    made["startTimeUnixNano"] = std::to_string(begin_ns);
    made["endTimeUnixNano"] = std::to_string(end_ns);
    return made;
  }

  // From the call of publish() to the begin of the callback.
  Json message_span(const Ids& ids, std::uint64_t number, const std::string& parent,
                    const timeline::Instance& run) const {
    const timeline::Message& message = timeline_.messages[run.message];
    const std::string& topic = timeline_.topics[message.topic];
    Json made = span(ids, number, parent, "send " + topic, kProducer, message.called_ns, run.start_ns);
    made["attributes"] =
        Json::array({text_attribute("messaging.system", "ros2"), text_attribute("messaging.operation.type", "send"),
                     text_attribute("messaging.destination.name", topic)});
    if (run.message < timeline_.details.messages.size()) {
      const std::int64_t waited_ns = timeline_.details.messages[run.message].waited_ns;
      if (waited_ns >= 0) {
        made["attributes"].push_back(
            number_attribute("ros2.executor_wait_ns", message.taken_ns - message.published_ns - waited_ns));
      }
    }
    return made;
  }

  Json callback_span(const Ids& ids, std::uint64_t number, const std::string& parent, const timeline::Instance& run,
                     bool has_message) const {
    const timeline::Callback& callback = timeline_.callbacks[run.callback];
    const std::string node = callback.node == kNone ? "" : timeline_.nodes[callback.node].name;
    const std::string what = callback.topic != kNone ? "process " + timeline_.topics[callback.topic]
                             : callback.period_ns > 0
                                 ? fmt::format("timer {} ms", static_cast<double>(callback.period_ns) / 1e6)
                                 : "callback";
    Json made = span(ids, number, parent, what, has_message ? kConsumer : kInternal, run.start_ns, run.end_ns);
    Json& attributes = made["attributes"] = Json::array({text_attribute("ros2.node", node)});
    if (callback.topic != kNone) {
      attributes.push_back(text_attribute("messaging.system", "ros2"));
      attributes.push_back(text_attribute("messaging.operation.type", "process"));
      attributes.push_back(text_attribute("messaging.destination.name", timeline_.topics[callback.topic]));
    }
    if (!callback.symbol.empty()) {
      attributes.push_back(text_attribute("code.function.name", callback.symbol));
    }
    attributes.push_back(number_attribute("thread.id", timeline_.threads[run.thread].vtid));
    if (!run.finished) {
      made["status"] = {{"code", kStatusError}, {"message", "the trace has no end of it"}};
    }
    return made;
  }

  void add(Index instance, Json made) {
    const Index process = timeline_.threads[timeline_.instances[instance].thread].process;
    spans_[process].push_back(std::move(made));
  }

  const TracedSystem& system_;
  const timeline::Timeline& timeline_;
  std::vector<std::vector<Json>> spans_;  // by process
};

}  // namespace

void export_otlp(const TracedSystem& system, const std::filesystem::path& file) {
  OutputFile out(file);
  out.write(OtlpWriter(system).request().dump(-1, ' ', false, Json::error_handler_t::replace));
  out.write("\n");
  out.finish();
}

}  // namespace tracing
