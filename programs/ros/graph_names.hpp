// SPDX-License-Identifier: Apache-2.0
// The names in the ROS graph, as the commands need them.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "programs/ros/graph_session.hpp"
#include "programs/ros/verb.hpp"

namespace launch {

using NamesAndTypes = std::map<std::string, std::vector<std::string>>;

// Full names, sorted; a name as often as nodes have it. Hidden nodes begin with "_".
std::vector<std::string> node_names(GraphSession& session, bool hidden);

enum class OfNode { kSubscriptions, kPublishers, kServices, kClients };
// `node` is a full name.
NamesAndTypes names_of_node(GraphSession& session, const std::string& node, OfNode what);

// The actions among services or clients of a node, which have a part for each: name and type.
NamesAndTypes actions_among(const NamesAndTypes& services);
// All actions of the graph.
NamesAndTypes actions_of_graph(GraphSession& session);

// A kind of names that the graph has.
struct NamesOfGraph {
  const char* kind;     // "topic"
  const char* folder;   // of its types: "msg"
  const char* example;  // of a type
  NamesAndTypes (*look)(GraphSession& session);
};
extern const NamesOfGraph kTopics, kServices, kActions;

// Throws CommandError if there is none of this name.
std::vector<std::string> types_of(GraphSession& session, const NamesOfGraph& names, const std::string& name);
CommandError unknown_name(GraphSession& session, const NamesOfGraph& names, const std::string& name);

// Prints the names, a line each, with their types if asked for. `count`: prints only how many there are.
void put_names(const NamesAndTypes& names, bool show_types, bool count);

// Waits until there is the node, 3 seconds or `time`. Throws CommandError if it does not come. Returns the full name.
std::string require_node(GraphSession& session, const std::string& name, std::optional<Seconds> time);

// Nodes with a service of this name behind their own name ("/get_state") and this type.
std::vector<std::string> nodes_with_service(GraphSession& session, const std::string& suffix, const std::string& type);

// Calls a service with a request written as YAML, and gives the response. Throws CommandError if it is not there or
// does not answer within the time of the session.
struct Reply {
  std::shared_ptr<const MessageType> type;
  MessageValue value;

  // A part of it: "result.names". The path must be right.
  const MessageValue& at(const std::string& path) const;
};
Reply ask(GraphSession& session, const std::string& service, const std::string& type, const std::string& request);

// The exit code if the user has asked to stop, who does not want to hear of an error any more. Otherwise throws
// CommandError.
int stopped_or(const std::string& message);

// A member of a message that is an element of a list, by name.
const MessageValue& member(const MessageType& type, const MessageValue& value, const std::string& name);
const std::string& text_of(const MessageValue& value);
std::int64_t number_of(const MessageValue& value);

// For the shell's completion.
std::vector<std::string> all_names(const NamesOfGraph& names);
std::vector<std::string> all_node_names();

}  // namespace launch
