// SPDX-License-Identifier: Apache-2.0
#include "programs/ros/parameter_verb.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <optional>

#include "base/diagnostics/diagnostic.hpp"
#include "launcher/frontend/frontend.hpp"
#include "launcher/message_types/print_value.hpp"
#include "launcher/message_types/yaml_text.hpp"

namespace launch {

namespace {

// The number of the type as a single value in rcl_interfaces/msg/ParameterType; that of a list is five more.
enum class Single { kBool = 1, kInteger = 2, kDouble = 3, kString = 4 };
constexpr int kListOffset = 5;
constexpr const char* kNames[] = {"", "bool", "integer", "double", "string"};

std::optional<Single> type_of(const Value& value) {
  const Scalar* const scalar = value.scalar();
  if (scalar == nullptr) {
    return std::nullopt;
  }
  switch (scalar->type) {
    case Scalar::Type::kBool:
      return Single::kBool;
    case Scalar::Type::kInt:
      return Single::kInteger;
    case Scalar::Type::kFloat:
      return Single::kDouble;
    case Scalar::Type::kString:
      return Single::kString;
    default:
      return std::nullopt;
  }
}

std::string yaml_of(const Scalar& scalar, Single type) {
  switch (type) {
    case Single::kBool:
      return scalar.bool_value ? "true" : "false";
    case Single::kInteger:
      return fmt::to_string(scalar.int_value);
    case Single::kDouble:
      return to_yaml({FieldKind::kFloat64}, {scalar.float_value});
    case Single::kString:
      break;
  }
  return yaml_text(scalar.text.text(), true);
}

std::string as_text(const std::string& text) {
  return fmt::format("{{type: 4, string_value: {}}}", yaml_text(text, true));
}

}  // namespace

std::string yaml_list(const std::vector<std::string>& texts) {
  std::string list;
  for (const std::string& text : texts) {
    list += (list.empty() ? "" : ", ") + yaml_text(text, true);
  }
  return "[" + list + "]";
}

std::string parameter_value_yaml(const std::string& text) {
  Value value;
  try {
    value = yaml11_value(LocatedText(text));
  } catch (const LaunchError&) {
    return as_text(text);
  }
  if (const std::vector<Value>* const list = value.list()) {
    const Single type = list->empty() ? Single::kBool : type_of(list->front()).value_or(Single::kString);
    std::string items;
    for (const Value& item : *list) {
      if (type_of(item) != type) {
        return as_text(text);
      }
      items += (items.empty() ? "" : ", ") + yaml_of(*item.scalar(), type);
    }
    return fmt::format("{{type: {}, {}_array_value: [{}]}}", static_cast<int>(type) + kListOffset,
                       kNames[static_cast<int>(type)], items);
  }
  const std::optional<Single> type = type_of(value);
  if (!type) {
    return as_text(text);
  }
  return fmt::format("{{type: {}, {}_value: {}}}", static_cast<int>(*type), kNames[static_cast<int>(*type)],
                     yaml_of(*value.scalar(), *type));
}

namespace {

// The members of ParameterValue, by ParameterType.
constexpr const char* kMembers[] = {"",
                                    "bool_value",
                                    "integer_value",
                                    "double_value",
                                    "string_value",
                                    "byte_array_value",
                                    "bool_array_value",
                                    "integer_array_value",
                                    "double_array_value",
                                    "string_array_value"};

}  // namespace

std::string ParameterReading::python() const {
  if (type == 0) {
    return "None";
  }
  // A text alone is printed as it is.
  return field.many == Many::kOne && field.kind == FieldKind::kString ? text_of(value) : to_python(field, value);
}

std::vector<std::string> parameter_names(GraphSession& session, const std::string& node,
                                         const std::vector<std::string>& prefixes) {
  const Reply reply = ask(session, node + "/list_parameters", "rcl_interfaces/srv/ListParameters",
                          fmt::format("{{prefixes: {}}}", yaml_list(prefixes)));
  std::vector<std::string> names;
  for (const MessageValue& name : reply.at("result.names").list()) {
    names.push_back(text_of(name));
  }
  std::sort(names.begin(), names.end());
  return names;
}

std::vector<ParameterReading> parameter_values(GraphSession& session, const std::string& node,
                                               const std::vector<std::string>& names) {
  const Reply reply = ask(session, node + "/get_parameters", "rcl_interfaces/srv/GetParameters",
                          fmt::format("{{names: {}}}", yaml_list(names)));
  const MessageType& type = *reply.type->find("values")->type.message;
  std::vector<ParameterReading> readings;
  for (const MessageValue& value : reply.at("values").list()) {
    ParameterReading& reading = readings.emplace_back();
    reading.type = static_cast<std::size_t>(number_of(member(type, value, "type")));
    if (reading.type != 0 && reading.type < std::size(kMembers)) {
      reading.field = type.find(kMembers[reading.type])->type;
      reading.value = member(type, value, kMembers[reading.type]);
    }
  }
  return readings;
}

std::vector<SetResult> set_parameters(GraphSession& session, const std::string& node,
                                      const std::vector<std::pair<std::string, std::string>>& parameters,
                                      bool atomically) {
  std::string list;
  for (const auto& [name, value] : parameters) {
    list += fmt::format("{}{{name: {}, value: {}}}", list.empty() ? "" : ", ", yaml_text(name, true), value);
  }
  const std::string request = fmt::format("{{parameters: [{}]}}", list);
  const Reply reply = atomically ? ask(session, node + "/set_parameters_atomically",
                                       "rcl_interfaces/srv/SetParametersAtomically", request)
                                 : ask(session, node + "/set_parameters", "rcl_interfaces/srv/SetParameters", request);
  const MessageType& type = *reply.type->find(atomically ? "result" : "results")->type.message;
  const auto read = [&type](const MessageValue& result) -> SetResult {
    return {std::get<bool>(member(type, result, "successful").data), text_of(member(type, result, "reason"))};
  };
  if (atomically) {
    return {read(reply.at("result"))};
  }
  std::vector<SetResult> results;
  for (const MessageValue& result : reply.at("results").list()) {
    results.push_back(read(result));
  }
  if (results.size() != parameters.size()) {
    throw CommandError(
        fmt::format("'{}' has answered for {} of {} parameters", node, results.size(), parameters.size()));
  }
  return results;
}

SetResult set_parameter(GraphSession& session, const std::string& node, const std::string& name,
                        const std::string& value) {
  return set_parameters(session, node, {{name, value}}, false).front();
}

void ParameterVerb::declare_node(CLI::App& app) {
  app.add_option("node", node_, "name of the node")->required();
  look_.declare(app);
  app.add_flag("--include-hidden-nodes", hidden_, "has no effect: a node that is named may be hidden");
  app.add_option("--timeout", timeout_,
                 fmt::format("wait so many seconds for the node; default: {:g}", kLongestLook.count()))
      ->check(CLI::PositiveNumber);
  app.add_option("--service-timeout", service_timeout_, "wait so many seconds for an answer; default: 10")
      ->check(CLI::PositiveNumber);
}

std::string ParameterVerb::find_node(GraphSession& session) const {
  if (service_timeout_) {
    session.set_answer_time(Seconds(*service_timeout_));
  }
  return require_node(session, node_,
                      Seconds(std::max(timeout_.value_or(kLongestLook.count()), look_.spin_time.value_or(0.0))));
}

int ParameterVerb::report(const SetResult& result, const std::string& good, const std::string& bad) {
  const std::string text = (result.successful ? good : bad) + (result.reason.empty() ? "" : ": " + result.reason);
  if (result.successful) {
    put(text + "\n");
    return 0;
  }
  fmt::print(stderr, "{}\n", text);
  return 1;
}

std::vector<std::string> ParameterVerb::complete(const std::vector<std::string>& words) {
  if (words.empty()) {
    return all_node_names();
  }
  if (words.size() > 1) {
    return {};
  }
  GraphSession session;
  return parameter_names(session, require_node(session, words.front(), std::nullopt), {});
}

}  // namespace launch
