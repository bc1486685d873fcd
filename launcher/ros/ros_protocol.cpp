// SPDX-License-Identifier: Apache-2.0
#include "launcher/ros/ros_protocol.hpp"

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace launch {

namespace {

using Json = nlohmann::ordered_json;

// A double keeps its type: JSON writers drop neither the point nor the exponent. Infinity and not-a-number are written
// as text, and a byte as an object with its number.
Json scalar_to_json(const ParameterScalar& scalar) {
  if (const double* const number = std::get_if<double>(&scalar); number != nullptr && !std::isfinite(*number)) {
    return {{"float", std::isnan(*number) ? "nan" : *number > 0 ? "inf" : "-inf"}};
  }
  if (const std::byte* const byte = std::get_if<std::byte>(&scalar)) {
    return {{"byte", std::to_integer<int>(*byte)}};
  }
  return std::visit([](const auto& value) { return Json(value); }, scalar);
}

ParameterScalar scalar_from_json(const Json& json) {
  switch (json.type()) {
    case Json::value_t::boolean:
      return json.get<bool>();
    case Json::value_t::number_integer:
    case Json::value_t::number_unsigned:
      return json.get<std::int64_t>();
    case Json::value_t::number_float:
      return json.get<double>();
    case Json::value_t::string:
      return json.get<std::string>();
    default:
      if (json.contains("byte")) {
        return std::byte{json.at("byte").get<std::uint8_t>()};
      }
      return std::stod(json.at("float").get<std::string>());
  }
}

Json to_json(const std::vector<NamedParameter>& parameters) {
  Json list = Json::array();
  for (const NamedParameter& parameter : parameters) {
    Json value;
    if (const auto* const scalar = std::get_if<ParameterScalar>(&parameter.value)) {
      value = scalar_to_json(*scalar);
    } else {
      value = Json::array();
      for (const ParameterScalar& item : std::get<std::vector<ParameterScalar>>(parameter.value)) {
        value.push_back(scalar_to_json(item));
      }
    }
    list.push_back({{"name", parameter.name}, {"value", std::move(value)}});
  }
  return list;
}

std::vector<NamedParameter> parameters_from(const Json& list) {
  std::vector<NamedParameter> parameters;
  for (const Json& entry : list) {
    const Json& value = entry.at("value");
    NamedParameter parameter{entry.at("name").get<std::string>(), {}};
    if (value.is_array()) {
      std::vector<ParameterScalar> items;
      for (const Json& item : value) {
        items.push_back(scalar_from_json(item));
      }
      parameter.value = std::move(items);
    } else {
      parameter.value = scalar_from_json(value);
    }
    parameters.push_back(std::move(parameter));
  }
  return parameters;
}

Json to_json(const ComposableNode& node) {
  Json remaps = Json::array();
  for (const auto& [from, to] : node.remaps) {
    remaps.push_back({from, to});
  }
  return {{"package", node.package},
          {"plugin", node.plugin},
          {"name", node.name},
          {"namespace", node.name_space},
          {"parameters", to_json(node.parameters)},
          {"remaps", std::move(remaps)},
          {"extra_arguments", to_json(node.extra_arguments)}};
}

ComposableNode node_from(const Json& json) {
  ComposableNode node;
  node.package = json.at("package");
  node.plugin = json.at("plugin");
  node.name = json.at("name");
  node.name_space = json.at("namespace");
  node.parameters = parameters_from(json.at("parameters"));
  for (const Json& remap : json.at("remaps")) {
    node.remaps.emplace_back(remap.at(0), remap.at(1));
  }
  node.extra_arguments = parameters_from(json.at("extra_arguments"));
  return node;
}

struct Write {
  Json operator()(const LoadNode& r) const {
    return {{"do", "load_node"}, {"container", r.container}, {"node", to_json(r.node)}};
  }
  Json operator()(const UnloadNode& r) const {
    return {{"do", "unload_node"}, {"container", r.container}, {"unique_id", r.unique_id}};
  }
  Json operator()(const ListNodes& r) const { return {{"do", "list_nodes"}, {"container", r.container}}; }
  Json operator()(const ChangeState& r) const {
    return {{"do", "change_state"}, {"node", r.node}, {"transition", r.transition}};
  }
  Json operator()(const GetState& r) const { return {{"do", "get_state"}, {"node", r.node}}; }
  Json operator()(const SetParameters& r) const {
    return {{"do", "set_parameters"}, {"node", r.node}, {"parameters", to_json(r.parameters)}};
  }
  Json operator()(const NodePresent& r) const { return {{"do", "wait_node"}, {"node", r.node}}; }
  Json operator()(const TopicPresent& r) const { return {{"do", "wait_topic"}, {"topic", r.topic}}; }
  Json operator()(const ServicePresent& r) const { return {{"do", "wait_service"}, {"service", r.service}}; }
  Json operator()(const MessagePublished& r) const { return {{"do", "wait_message"}, {"topic", r.topic}}; }
  Json operator()(const StateReached& r) const { return {{"do", "wait_state"}, {"node", r.node}, {"state", r.state}}; }
  Json operator()(const ParameterReached& r) const {
    return {{"do", "wait_parameter"}, {"node", r.node}, {"parameter", to_json(std::vector{r.parameter})}};
  }
  Json operator()(const WatchMessages& r) const {
    return {{"do", "watch_messages"}, {"topic", r.topic}, {"type", r.type}, {"condition", r.condition}};
  }
  Json operator()(const MeterTopic& r) const { return {{"do", "meter_topic"}, {"topic", r.topic}, every(r.every)}; }
  Json operator()(const AskService& r) const { return {{"do", "ask_service"}, {"service", r.service}, every(r.every)}; }
  Json operator()(const AskState& r) const { return {{"do", "ask_state"}, {"node", r.node}, every(r.every)}; }
  static Json every(Duration time) { return {"every_ns", time.count()}; }
  Json operator()(const WatchTransitions& r) const { return {{"do", "watch_transitions"}, {"node", r.node}}; }
};

Json to_json(const SeenMessages& seen) {
  return {{"all", seen.all},   {"matching", seen.matching},     {"first_ns", seen.first_ns}, {"last_ns", seen.last_ns},
          {"last", seen.last}, {"publishers", seen.publishers}, {"types", seen.types}};
}

SeenMessages messages_from(const Json& json) {
  return {.all = json.at("all"),
          .matching = json.at("matching"),
          .first_ns = json.at("first_ns"),
          .last_ns = json.at("last_ns"),
          .last = json.at("last"),
          .publishers = json.at("publishers"),
          .types = json.at("types")};
}

RosRequest request_from(const std::string& what, const Json& json) {
  const auto text = [&](const char* name) { return json.at(name).get<std::string>(); };
  const auto every = [&] { return Duration(json.at("every_ns").get<std::int64_t>()); };
  if (what == "load_node") {
    return LoadNode{text("container"), node_from(json.at("node"))};
  }
  if (what == "unload_node") {
    return UnloadNode{text("container"), json.at("unique_id").get<std::uint64_t>()};
  }
  if (what == "list_nodes") {
    return ListNodes{text("container")};
  }
  if (what == "change_state") {
    return ChangeState{text("node"), text("transition")};
  }
  if (what == "get_state") {
    return GetState{text("node")};
  }
  if (what == "set_parameters") {
    return SetParameters{text("node"), parameters_from(json.at("parameters"))};
  }
  if (what == "wait_node") {
    return NodePresent{text("node")};
  }
  if (what == "wait_topic") {
    return TopicPresent{text("topic")};
  }
  if (what == "wait_service") {
    return ServicePresent{text("service")};
  }
  if (what == "wait_message") {
    return MessagePublished{text("topic")};
  }
  if (what == "wait_state") {
    return StateReached{text("node"), text("state")};
  }
  if (what == "wait_parameter") {
    return ParameterReached{text("node"), parameters_from(json.at("parameter")).at(0)};
  }
  if (what == "watch_messages") {
    return WatchMessages{text("topic"), text("type"), text("condition")};
  }
  if (what == "meter_topic") {
    return MeterTopic{text("topic"), every()};
  }
  if (what == "ask_service") {
    return AskService{text("service"), every()};
  }
  if (what == "ask_state") {
    return AskState{text("node"), every()};
  }
  if (what == "watch_transitions") {
    return WatchTransitions{text("node")};
  }
  throw std::runtime_error(fmt::format("unknown request '{}'", what));
}

std::string line_of(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n";
}

template <typename Read>
auto parse(std::string_view text, Read read) {
  try {
    return read(Json::parse(text));
  } catch (const Json::exception& error) {
    throw std::runtime_error(fmt::format("'{}' is no line of this protocol: {}", text, error.what()));
  }
}

}  // namespace

std::string to_line(const RosRequestLine& line) {
  Json json = {{"id", line.id}};
  json.update(line.request ? std::visit(Write(), *line.request) : Json({{"do", "cancel"}}));
  if (line.timeout > Duration(0)) {
    json["timeout"] = std::chrono::duration<double>(line.timeout).count();
  }
  return line_of(json);
}

RosRequestLine parse_request_line(std::string_view text) {
  return parse(text, [](const Json& json) {
    RosRequestLine line;
    line.id = json.at("id");
    if (const auto what = json.at("do").get<std::string>(); what != "cancel") {
      line.request = request_from(what, json);
    }
    line.timeout = std::chrono::duration_cast<Duration>(std::chrono::duration<double>(json.value("timeout", 0.0)));
    return line;
  });
}

std::string to_line(const RosAnswerLine& line) {
  const RosAnswer& answer = line.answer;
  Json json = {{"id", line.id}, {"ok", answer.ok}};
  const auto add = [&](const char* name, const auto& value) {
    if (value != std::decay_t<decltype(value)>()) {
      json[name] = value;
    }
  };
  add("error", answer.error);
  add("node", answer.node);
  add("unique_id", answer.unique_id);
  add("nodes", answer.nodes);
  add("ids", answer.ids);
  add("state", answer.state);
  add("previous_state", answer.previous_state);
  add("seen", answer.seen);
  if (answer.messages) {
    json["messages"] = to_json(*answer.messages);
  }
  if (answer.traffic) {
    json["traffic"] = {answer.traffic->messages, answer.traffic->publishers, answer.traffic->measured.count()};
  }
  if (answer.found) {
    json["found"] = static_cast<int>(*answer.found);
  }
  return line_of(json);
}

RosAnswerLine parse_answer_line(std::string_view text) {
  return parse(text, [](const Json& json) {
    RosAnswerLine line;
    line.id = json.at("id");
    line.answer.ok = json.at("ok");
    line.answer.error = json.value("error", "");
    line.answer.node = json.value("node", "");
    line.answer.unique_id = json.value("unique_id", std::uint64_t(0));
    line.answer.nodes = json.value("nodes", std::vector<std::string>());
    line.answer.ids = json.value("ids", std::vector<std::uint64_t>());
    line.answer.state = json.value("state", "");
    line.answer.previous_state = json.value("previous_state", "");
    line.answer.seen = json.value("seen", "");
    if (json.contains("messages")) {
      line.answer.messages = messages_from(json.at("messages"));
    }
    if (json.contains("traffic")) {
      const Json& traffic = json.at("traffic");
      line.answer.traffic = {traffic.at(0), traffic.at(1), Duration(traffic.at(2).get<std::int64_t>())};
    }
    if (json.contains("found")) {
      line.answer.found = static_cast<ServiceFinding>(json.at("found").get<int>());
    }
    return line;
  });
}

}  // namespace launch
