// SPDX-License-Identifier: Apache-2.0
#include "programs/ros/graph_names.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <rcl/graph.h>

#include <algorithm>
#include <rclcpp/exceptions.hpp>

#include "base/diagnostics/diagnostic.hpp"
#include "launcher/message_types/message_part.hpp"
#include "launcher/message_types/read_value.hpp"
#include "programs/ros/endpoints.hpp"

namespace launch {

namespace {

constexpr Seconds kServicePatience(10);
constexpr std::string_view kSendGoal = "/_action/send_goal";
constexpr std::string_view kFeedback = "/_action/feedback";

std::string without_end(const std::string& text, std::string_view end) {
  return text.ends_with(end) ? text.substr(0, text.size() - end.size()) : text;
}

std::vector<std::string> names_in(const NamesAndTypes& names) {
  std::vector<std::string> list;
  for (const auto& [name, types] : names) {
    list.push_back(name);
  }
  return list;
}

NamesAndTypes actions_with(const NamesAndTypes& names, std::string_view end, std::string_view type_end) {
  NamesAndTypes actions;
  for (const auto& [name, types] : names) {
    if (!name.ends_with(end)) {
      continue;
    }
    for (const std::string& type : types) {
      actions[without_end(name, end)].push_back(without_end(type, type_end));
    }
  }
  return actions;
}

}  // namespace

std::vector<std::string> node_names(GraphSession& session, bool hidden) {
  std::vector<std::string> names = session.node().get_node_names();
  std::erase_if(names,
                [&](const std::string& name) { return !hidden && name.compare(name.rfind('/') + 1, 1, "_") == 0; });
  std::sort(names.begin(), names.end());
  return names;
}

NamesAndTypes names_of_node(GraphSession& session, const std::string& node, OfNode what) {
  const std::size_t slash = node.rfind('/');
  const std::string name = node.substr(slash + 1);
  const std::string name_space = slash == 0 ? "/" : node.substr(0, slash);
  rcl_allocator_t allocator = rcl_get_default_allocator();
  rcl_names_and_types_t found = rcl_get_zero_initialized_names_and_types();
  const rcl_node_t* const own = &session.rcl_node();
  rcl_ret_t ret = RCL_RET_OK;
  switch (what) {
    case OfNode::kSubscriptions:
      ret =
          rcl_get_subscriber_names_and_types_by_node(own, &allocator, false, name.c_str(), name_space.c_str(), &found);
      break;
    case OfNode::kPublishers:
      ret = rcl_get_publisher_names_and_types_by_node(own, &allocator, false, name.c_str(), name_space.c_str(), &found);
      break;
    case OfNode::kServices:
      ret = rcl_get_service_names_and_types_by_node(own, &allocator, name.c_str(), name_space.c_str(), &found);
      break;
    case OfNode::kClients:
      ret = rcl_get_client_names_and_types_by_node(own, &allocator, name.c_str(), name_space.c_str(), &found);
      break;
  }
  if (ret != RCL_RET_OK) {
    rclcpp::exceptions::throw_from_rcl_error(ret, "cannot describe node '" + node + "'");
  }
  NamesAndTypes names;
  for (std::size_t i = 0; i < found.names.size; ++i) {
    const rcutils_string_array_t& types = found.types[i];
    names[found.names.data[i]].assign(types.data, types.data + types.size);
  }
  (void)rcl_names_and_types_fini(&found);
  return names;
}

NamesAndTypes actions_among(const NamesAndTypes& services) {
  return actions_with(services, kSendGoal, "_SendGoal");
}

NamesAndTypes actions_of_graph(GraphSession& session) {
  return actions_with(session.node().get_topic_names_and_types(), kFeedback, "_FeedbackMessage");
}

const NamesOfGraph kTopics{"topic", "msg", "std_msgs/msg/String",
                           [](GraphSession& session) { return session.node().get_topic_names_and_types(); }};
const NamesOfGraph kServices{"service", "srv", "std_srvs/srv/Empty",
                             [](GraphSession& session) { return session.node().get_service_names_and_types(); }};
const NamesOfGraph kActions{"action", "action", "example_interfaces/action/Fibonacci", actions_of_graph};

std::vector<std::string> types_of(GraphSession& session, const NamesOfGraph& names, const std::string& name) {
  const NamesAndTypes all = names.look(session);
  const auto found = all.find(name);
  if (found == all.end()) {
    throw unknown_name(session, names, name);
  }
  return found->second;
}

CommandError unknown_name(GraphSession& session, const NamesOfGraph& names, const std::string& name) {
  return CommandError(fmt::format("unknown {} '{}'", names.kind, name),
                      did_you_mean(name, names_in(names.look(session))));
}

std::vector<std::string> all_names(const NamesOfGraph& names) {
  GraphSession session;
  session.discover(std::nullopt);
  return names_in(names.look(session));
}

int stopped_or(const std::string& message) {
  if (GraphSession::is_stopped()) {
    return 1;
  }
  throw CommandError(message);
}

void put_names(const NamesAndTypes& names, bool show_types, bool count) {
  if (count) {
    put(fmt::format("{}\n", names.size()));
    return;
  }
  for (const auto& [name, types] : names) {
    put(show_types ? fmt::format("{} [{}]\n", name, fmt::join(types, ", ")) : name + "\n");
  }
}

std::string require_node(GraphSession& session, const std::string& name, std::optional<Seconds> time) {
  const std::string full = full_name(name);
  const auto is_there = [&] {
    const std::vector<std::string> names = node_names(session, true);
    return std::find(names.begin(), names.end(), full) != names.end();
  };
  if (!session.wait_until(is_there, time.value_or(kLongestLook))) {
    throw CommandError(fmt::format("there is no node '{}'", full), did_you_mean(full, node_names(session, false)));
  }
  return full;
}

std::vector<std::string> nodes_with_service(GraphSession& session, const std::string& suffix, const std::string& type) {
  const NamesAndTypes services = session.node().get_service_names_and_types();
  std::vector<std::string> nodes = node_names(session, true);
  std::erase_if(nodes, [&](const std::string& node) {
    const auto found = services.find(node + suffix);
    return found == services.end() ||
           std::find(found->second.begin(), found->second.end(), type) == found->second.end();
  });
  return nodes;
}

const MessageValue& Reply::at(const std::string& path) const {
  return *MessagePart(type, LocatedText(path)).find(value);
}

Reply ask(GraphSession& session, const std::string& service, const std::string& type, const std::string& request) {
  const ServiceType description = installed_interfaces().service(type);
  DescribedClient client(session, service, description);
  if (!session.wait_until([&] { return client.service_is_ready(); }, kServicePatience)) {
    throw CommandError(fmt::format("there is no service '{}'", service));
  }
  auto response = client.call(read_message(*description.request, LocatedText(request)).value, session.answer_time());
  if (!response) {
    throw CommandError(fmt::format("service '{}' has not answered", service));
  }
  return {description.response, std::move(*response)};
}

const MessageValue& member(const MessageType& type, const MessageValue& value, const std::string& name) {
  return value.list()[static_cast<std::size_t>(type.find(name) - type.fields.data())];
}

const std::string& text_of(const MessageValue& value) {
  return std::get<std::string>(value.data);
}

std::int64_t number_of(const MessageValue& value) {
  const auto* const large = std::get_if<std::uint64_t>(&value.data);
  return large != nullptr ? static_cast<std::int64_t>(*large) : std::get<std::int64_t>(value.data);
}

std::vector<std::string> all_node_names() {
  GraphSession session;
  session.discover(std::nullopt);
  return node_names(session, false);
}

}  // namespace launch
