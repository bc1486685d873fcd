// SPDX-License-Identifier: Apache-2.0
// What the commands on parameters of one node have in common.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "programs/ros/graph_names.hpp"
#include "programs/ros/topic_graph.hpp"
#include "programs/ros/verb.hpp"

namespace launch {

// "[a, 'b: c']"
std::string yaml_list(const std::vector<std::string>& texts);

// The rcl_interfaces/msg/ParameterValue for a value as a person writes it, as YAML: "{type: 2, integer_value: 3}" for
// "3". What is no bool, number, or list of such or of texts, is a text.
std::string parameter_value_yaml(const std::string& text);

// The value of a parameter that a node has answered with.
struct ParameterReading {
  std::size_t type = 0;  // rcl_interfaces/msg/ParameterType
  FieldType field;       // of the value
  MessageValue value;    // none if the parameter is not set

  std::string python() const;  // as Python prints it
};

std::vector<std::string> parameter_names(GraphSession& session, const std::string& node,
                                         const std::vector<std::string>& prefixes);
std::vector<ParameterReading> parameter_values(GraphSession& session, const std::string& node,
                                               const std::vector<std::string>& names);

struct SetResult {
  bool successful = false;
  std::string reason;
};
// Each value is a rcl_interfaces/msg/ParameterValue as YAML. With `atomically` either all are set or none, and there is
// one result.
std::vector<SetResult> set_parameters(GraphSession& session, const std::string& node,
                                      const std::vector<std::pair<std::string, std::string>>& parameters,
                                      bool atomically);
SetResult set_parameter(GraphSession& session, const std::string& node, const std::string& name,
                        const std::string& value);

class ParameterVerb : public Verb {
 public:
  std::vector<std::string> complete(const std::vector<std::string>& words) override;

 protected:
  void declare_node(CLI::App& app);
  // Waits for the node. Returns its full name. Its services have the time that the command line says.
  std::string find_node(GraphSession& session) const;
  std::optional<Seconds> look_time() const { return look_.time(); }
  // Prints the result, and returns the exit code.
  static int report(const SetResult& result, const std::string& good, const std::string& bad);

  std::string node_;
  std::string parameter_;

 private:
  LookOptions look_;
  bool hidden_ = false;
  std::optional<double> timeout_;
  std::optional<double> service_timeout_;
};

}  // namespace launch
