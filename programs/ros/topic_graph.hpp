// SPDX-License-Identifier: Apache-2.0
// What the commands on topics have in common.
#pragma once

#include <optional>
#include <string>

#include "programs/ros/graph_session.hpp"
#include "programs/ros/verb.hpp"

namespace launch {

// The options that `ros2` has for all commands that look at the graph.
struct LookOptions {
  std::optional<double> spin_time;
  bool no_daemon = false;
  bool use_sim_time = false;

  void declare(CLI::App& app);
  std::optional<Seconds> time() const;
};

// Those of the commands that list nodes.
struct NodeListOptions : LookOptions {
  bool all = false;
  bool count = false;

  void declare(CLI::App& app);
};

// A message on the command line, as YAML, or on standard input.
struct ValuesOption {
  std::string text = "{}";
  bool from_standard_input = false;

  // `name` is that of the word on the command line, `what` "message", "request" or "goal".
  void declare(CLI::App& app, const std::string& name, const std::string& what);
  LocatedText read(const std::string& name);
};

// Options for the quality of service.
struct QosOptions {
  std::string profile;
  std::optional<int> depth;
  std::string history, reliability, durability, liveliness;
  std::optional<double> lease;

  // `verb` is "subscribe", "publish" or "call", `default_profile` a name such as "sensor_data".
  void declare(CLI::App& app, const std::string& verb, const std::string& default_profile);
  // The profile with the changes that were asked for. Throws CommandError for an unknown word.
  rmw_qos_profile_t make() const;
  bool is_chosen() const;
};

// The quality of service with which a subscription hears every publisher that there is, beginning with `profile`.
// Warns if publishers differ.
rmw_qos_profile_t matching_qos(GraphSession& session, const std::string& topic, rmw_qos_profile_t profile);

// Nullopt if nobody knows the topic. Throws CommandError if it has several types.
std::optional<std::string> type_of_topic(GraphSession& session, const std::string& topic);

// Waits until the topic has a type, without end, and says once that it waits. Empty if the user has asked to stop.
std::string wait_for_type(GraphSession& session, const std::string& topic);

// The types of a topic, for the shell's completion; and a topic, then its type.
std::vector<std::string> types_of_topic_or_all(const std::string& topic);
std::vector<std::string> topic_then_type(const std::vector<std::string>& words);

}  // namespace launch
