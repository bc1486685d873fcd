// SPDX-License-Identifier: Apache-2.0
// launch param list, get, set, describe, delete
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <regex>

#include "base/diagnostics/diagnostic.hpp"
#include "launcher/message_types/print_value.hpp"
#include "programs/ros/graph_names.hpp"
#include "programs/ros/parameter_verb.hpp"

namespace launch {

namespace {

constexpr const char* kTypeNames[] = {"not set",    "boolean",       "integer",       "double",       "string",
                                      "byte array", "boolean array", "integer array", "double array", "string array"};
constexpr const char* kLabels[] = {
    "Parameter not set.", "Boolean value is:",   "Integer value is:",   "Double value is:",   "String value is:",
    "Byte values are:",   "Boolean values are:", "Integer values are:", "Double values are:", "String values are:"};

// Calls it for each node. Names those that do not answer, and goes on. Returns the exit code.
template <typename Function>
int for_each_that_answers(const std::vector<std::string>& nodes, const Function& function) {
  int exit_code = 0;
  for (const std::string& node : nodes) {
    if (GraphSession::is_stopped()) {
      return 1;
    }
    try {
      function(node);
    } catch (const CommandError& error) {
      fmt::print(stderr, "node '{}' is left out: {}\n", node, error.what());
      exit_code = 1;
    }
  }
  return exit_code;
}

class ParamList final : public Verb {
 public:
  void declare(CLI::App& app) override {
    app.add_option("node", node_, "name of the node; default: all nodes");
    look_.declare(app);
    app.add_flag("--include-hidden-nodes", hidden_, "also nodes whose name begins with '_'");
    app.add_option("--param-prefixes", prefixes_, "only parameters below these names")->expected(1, 100);
    app.add_flag("--param-type", types_, "also print the types");
    app.add_option("--filter", filter_, "only names that begin like this regular expression");
    app.add_option("--timeout", timeout_,
                   "wait so many seconds for the node that is named, or for any, and for each answer")
        ->check(CLI::PositiveNumber);
  }

  int run() override {
    GraphSession session;
    if (timeout_ > 0) {
      session.set_answer_time(Seconds(timeout_));
    }
    session.discover(look_.time());
    if (!node_.empty()) {
      list(session, require_node(session, node_, timeout_ > 0 ? Seconds(timeout_) : look_.time()));
      return 0;
    }
    std::vector<std::string> nodes;
    session.wait_until([&] { return !(nodes = nodes_to_list(session)).empty(); }, Seconds(timeout_));
    if (nodes.empty()) {
      fmt::print(stderr, "launch param list: there is no node with parameters\n");
    }
    return for_each_that_answers(nodes, [&](const std::string& node) { list(session, node); });
  }

  std::vector<std::string> complete(const std::vector<std::string>& words) override {
    return words.empty() ? all_node_names() : std::vector<std::string>();
  }

 private:
  std::vector<std::string> nodes_to_list(GraphSession& session) const {
    std::vector<std::string> nodes =
        nodes_with_service(session, "/list_parameters", "rcl_interfaces/srv/ListParameters");
    std::erase_if(nodes, [this](const std::string& node) { return !hidden_ && is_hidden(node); });
    return nodes;
  }

  void list(GraphSession& session, const std::string& node) const {
    std::vector<std::string> names = parameter_names(session, node, prefixes_);
    if (!filter_.empty()) {
      const std::regex pattern(filter_);
      std::erase_if(names, [&](const std::string& name) {
        return !std::regex_search(name, pattern, std::regex_constants::match_continuous);
      });
    }
    std::vector<std::int64_t> types;
    if (types_ && !names.empty()) {
      const Reply reply = ask(session, node + "/describe_parameters", "rcl_interfaces/srv/DescribeParameters",
                              fmt::format("{{names: {}}}", yaml_list(names)));
      const MessageType& descriptor = *reply.type->find("descriptors")->type.message;
      for (const MessageValue& each : reply.at("descriptors").list()) {
        types.push_back(number_of(member(descriptor, each, "type")));
      }
    }
    put(node_.empty() && !names.empty() ? node + ":\n" : "");
    for (std::size_t i = 0; i < names.size(); ++i) {
      put(i < types.size() ? fmt::format("  {} (type: {})\n", names[i], kTypeNames[types[i]])
                           : fmt::format("  {}\n", names[i]));
    }
  }

  std::string node_, filter_;
  LookOptions look_;
  bool hidden_ = false;
  bool types_ = false;
  double timeout_ = 0;
  std::vector<std::string> prefixes_;
};

class ParamGet final : public ParameterVerb {
 public:
  void declare(CLI::App& app) override {
    declare_node(app);
    app.add_option("parameters", parameters_,
                   "names of the parameters; none: the first word is a parameter, which all nodes are asked for");
    app.add_flag("--hide-type", hide_type_, "print the values alone");
  }

  int run() override {
    GraphSession session;
    if (parameters_.empty()) {
      if (node_.starts_with('/')) {
        throw CommandError("no parameter is given", fmt::format("launch param get {} PARAMETER", node_));
      }
      return of_all_nodes(session, node_);
    }
    const std::string node = find_node(session);
    const std::vector<ParameterReading> values = parameter_values(session, node, parameters_);
    if (parameters_.size() > 1) {
      return several(session, node, values);
    }
    if (values.empty() || values.front().type == 0) {
      throw CommandError(fmt::format("parameter '{}' of '{}' is not set", parameters_.front(), node),
                         did_you_mean(parameters_.front(), parameter_names(session, node, {})));
    }
    put(text(values.front()) + "\n");
    return 0;
  }

 private:
  std::string text(const ParameterReading& value) const {
    return hide_type_ || value.type == 0 ? (value.type == 0 ? kLabels[0] : value.python())
                                         : fmt::format("{} {}", kLabels[value.type], value.python());
  }

  int several(GraphSession& session, const std::string& node, std::vector<ParameterReading> values) const {
    if (values.size() != parameters_.size()) {  // a node that lacks one of them answers for none
      values.clear();
      for (const std::string& name : parameters_) {
        const std::vector<ParameterReading> one = parameter_values(session, node, {name});
        values.push_back(one.empty() ? ParameterReading() : one.front());
      }
    }
    int exit_code = 0;
    for (std::size_t i = 0; i < parameters_.size(); ++i) {
      if (values[i].type != 0) {
        put(fmt::format("{}:\n  {}\n", parameters_[i], text(values[i])));
      } else {
        fmt::print(stderr, "{}: parameter of '{}' is not set\n", parameters_[i], node);
        exit_code = 1;
      }
    }
    return exit_code;
  }

  int of_all_nodes(GraphSession& session, const std::string& parameter) const {
    session.discover(look_time());
    bool found = false;
    std::vector<std::string> nodes;
    // On a busy machine the services of a node may come long after the node.
    session.wait_until(
        [&] {
          nodes = nodes_with_service(session, "/get_parameters", "rcl_interfaces/srv/GetParameters");
          std::erase_if(nodes, [](const std::string& node) { return is_hidden(node); });
          return !nodes.empty();
        },
        look_time() ? Seconds(0) : kLongestLook);
    const int exit_code = for_each_that_answers(nodes, [&](const std::string& node) {
      const std::vector<ParameterReading> values = parameter_values(session, node, {parameter});
      if (!values.empty() && values.front().type != 0) {
        put(fmt::format("{}:\n  {}\n", node, text(values.front())));
        found = true;
      }
    });
    if (!found) {
      throw CommandError(fmt::format("no node has a parameter '{}' that is set", parameter));
    }
    return exit_code;
  }

  std::vector<std::string> parameters_;
  bool hide_type_ = false;
};

class ParamSet final : public ParameterVerb {
 public:
  void declare(CLI::App& app) override {
    declare_node(app);
    app.add_option("assignments", words_,
                   "names and values in turn; a value is YAML: 3, 1.5, true, text, [1, 2]. NAME VALUE NAME VALUE …")
        ->required();
    app.add_flag("--atomic", atomic_, "set all of them, or none when the node refuses one");
  }

  int run() override {
    if (words_.size() % 2 != 0) {
      throw CommandError(fmt::format("parameter '{}' has no value", words_.back()), "names and values stand in turn");
    }
    GraphSession session;
    const std::string node = find_node(session);
    std::vector<std::pair<std::string, std::string>> parameters;
    for (std::size_t i = 0; i < words_.size(); i += 2) {
      parameters.emplace_back(words_[i], parameter_value_yaml(words_[i + 1]));
    }
    const std::vector<SetResult> results = set_parameters(session, node, parameters, atomic_);
    if (atomic_) {
      return report(results.front(), "Set parameters atomically successful", "Setting parameters atomically failed");
    }
    int exit_code = 0;
    for (std::size_t i = 0; i < results.size(); ++i) {
      const std::string prefix = results.size() > 1 ? parameters[i].first + ": " : "";
      exit_code |= report(results[i], prefix + "Set parameter successful", prefix + "Setting parameter failed");
    }
    return exit_code;
  }

 private:
  std::vector<std::string> words_;
  bool atomic_ = false;
};

class ParamDelete final : public ParameterVerb {
 public:
  void declare(CLI::App& app) override {
    declare_node(app);
    app.add_option("parameter", parameter_, "name of the parameter")->required();
  }

  int run() override {
    GraphSession session;
    const std::string node = find_node(session);
    return report(set_parameter(session, node, parameter_, "{type: 0}"), "Deleted parameter successfully",
                  "Deleting parameter failed");
  }
};

class ParamDescribe final : public ParameterVerb {
 public:
  void declare(CLI::App& app) override {
    declare_node(app);
    app.add_option("parameters", parameters_, "names of the parameters")->required();
  }

  int run() override {
    GraphSession session;
    const std::string node = find_node(session);
    const Reply reply = ask(session, node + "/describe_parameters", "rcl_interfaces/srv/DescribeParameters",
                            fmt::format("{{names: {}}}", yaml_list(parameters_)));
    const MessageType& descriptor = *reply.type->find("descriptors")->type.message;
    for (const MessageValue& each : reply.at("descriptors").list()) {
      put(description(descriptor, each));
    }
    return 0;
  }

 private:
  static std::string description(const MessageType& type, const MessageValue& value) {
    const auto at = [&](const char* name) -> const MessageValue& { return member(type, value, name); };
    std::string text =
        fmt::format("Parameter name: {}\n  Type: {}\n", text_of(at("name")), kTypeNames[number_of(at("type"))]);
    if (!text_of(at("description")).empty()) {
      text += fmt::format("  Description: {}\n", text_of(at("description")));
    }
    text += "  Constraints:\n";
    if (std::get<bool>(at("read_only").data)) {
      text += "    Read only: true\n";
    }
    for (const char* const name : {"floating_point_range", "integer_range"}) {
      const MessageType& range = *type.find(name)->type.message;
      for (const MessageValue& each : at(name).list()) {
        const auto part = [&](const char* of) { return to_csv(range.find(of)->type, member(range, each, of)); };
        text += fmt::format("    Min value: {}\n    Max value: {}\n", part("from_value"), part("to_value"));
        if (part("step") != "0" && part("step") != "0.0") {
          text += fmt::format("    Step: {}\n", part("step"));
        }
      }
    }
    if (!text_of(at("additional_constraints")).empty()) {
      text += fmt::format("    Additional constraints: {}\n", text_of(at("additional_constraints")));
    }
    return text;
  }

  std::vector<std::string> parameters_;
};

}  // namespace

std::vector<VerbInfo> param_verbs() {
  return {{"param", "delete", "deletes a parameter", make_verb<ParamDelete>},
          {"param", "describe", "describes parameters", make_verb<ParamDescribe>},
          {"param", "get", "prints the value of a parameter", make_verb<ParamGet>},
          {"param", "list", "lists the parameters", make_verb<ParamList>},
          {"param", "set", "sets a parameter", make_verb<ParamSet>}};
}

}  // namespace launch
