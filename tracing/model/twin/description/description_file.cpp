// SPDX-License-Identifier: Apache-2.0
#include "tracing/model/twin/description/description_file.hpp"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>

namespace tracing::twin {

namespace {

using Json = nlohmann::ordered_json;

constexpr int kVersion = 1;

Json index_json(Index index) {
  return index == kNone ? Json() : Json(index);
}

Json qos_json(const Qos& qos) {
  return {{"reliable", qos.reliable}, {"depth", qos.depth}};
}

Json output_json(const Output& output) {
  Json json = {{"publisher", index_json(output.publisher)},
               {"client", index_json(output.client)},
               {"rule", kOutputRules[static_cast<std::size_t>(output.rule)]},
               {"times", output.times},
               {"called", output.called},
               {"sent", output.sent}};
  if (output.rule == Output::Rule::kEvery) {
    json["every"] = output.every;
  }
  if (output.rule == Output::Rule::kChance) {
    json["chance"] = output.chance;
  }
  if (output.rule == Output::Rule::kJoin) {
    json["inputs"] = output.inputs;
  }
  return json;
}

Json callback_json(const Callback& callback) {
  Json json = {{"name", callback.name},
               {"kind", kCallbackKinds[static_cast<std::size_t>(callback.kind)]},
               {"group", callback.group},
               {"runs", callback.runs}};
  switch (callback.kind) {
    case Callback::Kind::kTimer:
      json["period_ns"] = callback.period_ns;
      json["phase_ns"] = callback.phase_ns;
      json["replaces_loop"] = callback.replaces_loop;
      break;
    case Callback::Kind::kSubscription:
      json["topic"] = callback.topic;
      json["qos"] = qos_json(callback.qos);
      break;
    case Callback::Kind::kService:
      json["service"] = callback.service;
      break;
    case Callback::Kind::kClient:
      json["client"] = callback.client;
      break;
  }
  json["blocked"] = callback.blocked;
  json["overhead_ns"] = callback.overhead_ns;
  json["outputs"] = Json::array();
  for (const Output& output : callback.outputs) {
    json["outputs"].push_back(output_json(output));
  }
  json["run_times_ns"] = callback.run_times.values;
  json["silent_run_times_ns"] = callback.silent_run_times.values;
  json["delays_ns"] = callback.delays.values;
  json["near_delays_ns"] = callback.near_delays.values;
  json["gaps_ns"] = callback.gaps.values;
  return json;
}

template <std::size_t N>
std::size_t word_index(const Json& word, const char* const (&words)[N]) {
  const auto text = word.get<std::string>();
  const auto* const found = std::find(std::begin(words), std::end(words), text);
  if (found == std::end(words)) {
    throw std::runtime_error("'" + text + "' is none of the known words");
  }
  return static_cast<std::size_t>(found - std::begin(words));
}

Index read_index(const Json& json, std::size_t size) {
  if (json.is_null()) {
    return kNone;
  }
  const auto index = json.get<Index>();
  if (index >= size) {
    throw std::runtime_error("the index " + std::to_string(index) + " is too large");
  }
  return index;
}

Index read_place(const Json& json, std::size_t size) {
  const Index index = read_index(json, size);
  if (index == kNone) {
    throw std::runtime_error("an index is null");
  }
  return index;
}

Qos read_qos(const Json& json) {
  return {json.at("reliable").get<bool>(), json.at("depth").get<std::uint64_t>()};
}

Distribution read_distribution(const Json& json) {
  return Distribution::of(json.get<std::vector<std::int64_t>>());
}

Output read_output(const Json& json, const System& system, std::size_t callbacks) {
  Output output;
  output.publisher = read_index(json.at("publisher"), system.publishers.size());
  output.client = read_index(json.at("client"), system.clients.size());
  output.rule = static_cast<Output::Rule>(word_index(json.at("rule"), kOutputRules));
  output.times = json.at("times").get<std::size_t>();
  output.called = json.at("called").get<double>();
  output.sent = json.at("sent").get<double>();
  output.every = json.value("every", std::size_t{1});
  output.chance = json.value("chance", 1.0);
  if (output.every == 0) {
    throw std::runtime_error("'every' is 0");
  }
  if (output.rule == Output::Rule::kJoin) {
    for (const Json& input : json.at("inputs")) {
      output.inputs.push_back(read_place(input, callbacks));
    }
  }
  return output;
}

Callback read_callback(const Json& json, const System& system, std::size_t callbacks) {
  Callback callback;
  callback.name = json.at("name").get<std::string>();
  callback.kind = static_cast<Callback::Kind>(word_index(json.at("kind"), kCallbackKinds));
  callback.group = read_place(json.at("group"), system.groups.size());
  callback.runs = json.at("runs").get<std::uint64_t>();
  switch (callback.kind) {
    case Callback::Kind::kTimer:
      callback.period_ns = json.at("period_ns").get<std::int64_t>();
      callback.phase_ns = json.at("phase_ns").get<std::int64_t>();
      callback.replaces_loop = json.value("replaces_loop", false);
      if (callback.period_ns <= 0) {
        throw std::runtime_error("the period of '" + callback.name + "' is not positive");
      }
      break;
    case Callback::Kind::kSubscription:
      callback.topic = read_place(json.at("topic"), system.topics.size());
      callback.qos = read_qos(json.at("qos"));
      break;
    case Callback::Kind::kService:
      callback.service = json.at("service").get<std::string>();
      break;
    case Callback::Kind::kClient:
      callback.client = read_place(json.at("client"), system.clients.size());
      break;
  }
  callback.blocked = std::clamp(json.at("blocked").get<double>(), 0.0, 1.0);
  callback.overhead_ns = json.value("overhead_ns", std::int64_t{0});
  for (const Json& output : json.at("outputs")) {
    callback.outputs.push_back(read_output(output, system, callbacks));
  }
  callback.run_times = read_distribution(json.at("run_times_ns"));
  callback.silent_run_times = read_distribution(json.at("silent_run_times_ns"));
  callback.delays = read_distribution(json.at("delays_ns"));
  callback.near_delays = read_distribution(json.value("near_delays_ns", Json::array()));
  callback.gaps = read_distribution(json.at("gaps_ns"));
  return callback;
}

void read_graph(const Json& json, System& system) {
  for (const Json& process : json.at("processes")) {
    system.processes.push_back({process.at("name").get<std::string>()});
  }
  for (const Json& executor : json.at("executors")) {
    system.executors.push_back({read_place(executor.at("process"), system.processes.size()),
                                static_cast<Executor::Kind>(word_index(executor.at("kind"), kExecutorKinds)),
                                std::max<std::size_t>(1, executor.at("threads").get<std::size_t>()),
                                executor.at("priority").get<int>()});
  }
  for (const Json& node : json.at("nodes")) {
    system.nodes.push_back({read_place(node.at("process"), system.processes.size()), node.at("name").get<std::string>(),
                            node.at("intra_process").get<bool>()});
  }
  for (const Json& group : json.at("groups")) {
    system.groups.push_back({read_place(group.at("node"), system.nodes.size()),
                             read_place(group.at("executor"), system.executors.size()),
                             group.at("reentrant").get<bool>()});
  }
  for (const Json& topic : json.at("topics")) {
    system.topics.push_back({topic.at("name").get<std::string>(), topic.at("bytes").get<std::uint64_t>()});
  }
  for (const Json& publisher : json.at("publishers")) {
    system.publishers.push_back({read_place(publisher.at("node"), system.nodes.size()),
                                 read_place(publisher.at("topic"), system.topics.size()),
                                 read_qos(publisher.at("qos"))});
  }
  for (const Json& client : json.at("clients")) {
    system.clients.push_back(
        {read_place(client.at("node"), system.nodes.size()), client.at("service").get<std::string>()});
  }
}

}  // namespace

std::string description_of(const System& system) {
  Json json = {{"version", kVersion},           {"duration_ns", system.duration_ns},
               {"active_ns", system.active_ns}, {"cpus", system.cpus},
               {"seed", system.seed},           {"processor_times", system.processor_times}};
  for (const char* list :
       {"missing", "processes", "executors", "nodes", "groups", "topics", "publishers", "clients", "callbacks"}) {
    json[list] = Json::array();
  }
  json["missing"] = system.missing;
  for (const Process& process : system.processes) {
    json["processes"].push_back({{"name", process.name}});
  }
  for (const Executor& executor : system.executors) {
    json["executors"].push_back({{"process", executor.process},
                                 {"kind", kExecutorKinds[static_cast<std::size_t>(executor.kind)]},
                                 {"threads", executor.threads},
                                 {"priority", executor.priority}});
  }
  for (const Node& node : system.nodes) {
    json["nodes"].push_back({{"process", node.process}, {"name", node.name}, {"intra_process", node.intra_process}});
  }
  for (const Group& group : system.groups) {
    json["groups"].push_back({{"node", group.node}, {"executor", group.executor}, {"reentrant", group.reentrant}});
  }
  for (const Topic& topic : system.topics) {
    json["topics"].push_back({{"name", topic.name}, {"bytes", topic.bytes}});
  }
  for (const Publisher& publisher : system.publishers) {
    json["publishers"].push_back(
        {{"node", publisher.node}, {"topic", publisher.topic}, {"qos", qos_json(publisher.qos)}});
  }
  for (const Client& client : system.clients) {
    json["clients"].push_back({{"node", client.node}, {"service", client.service}});
  }
  for (const Callback& callback : system.callbacks) {
    json["callbacks"].push_back(callback_json(callback));
  }
  return json.dump(1) + "\n";
}

System parse_description(std::string_view text, const std::string& name) {
  try {
    const Json json = Json::parse(text);
    if (json.at("version").get<int>() != kVersion) {
      throw std::runtime_error("it has another version than " + std::to_string(kVersion));
    }
    System system;
    system.duration_ns = json.at("duration_ns").get<std::int64_t>();
    system.active_ns = json.value("active_ns", system.duration_ns);
    system.cpus = std::max<std::size_t>(1, json.at("cpus").get<std::size_t>());
    system.seed = json.at("seed").get<std::uint64_t>();
    system.processor_times = json.value("processor_times", true);
    system.missing = json.at("missing").get<std::vector<std::string>>();
    read_graph(json, system);
    const Json& callbacks = json.at("callbacks");
    for (const Json& callback : callbacks) {
      system.callbacks.push_back(read_callback(callback, system, callbacks.size()));
    }
    return system;
  } catch (const std::exception& error) {
    throw std::runtime_error(name + " does not describe a twin: " + error.what());
  }
}

System read_description(const std::filesystem::path& file) {
  std::ifstream stream(file);
  std::ostringstream text;
  text << stream.rdbuf();
  if (!stream) {
    throw std::runtime_error("'" + file.string() + "' cannot be read");
  }
  return parse_description(text.str(), "'" + file.string() + "'");
}

}  // namespace tracing::twin
