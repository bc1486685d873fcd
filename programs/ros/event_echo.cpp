// SPDX-License-Identifier: Apache-2.0
// launch service echo, launch action echo: the events of service introspection
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>
#include <iterator>
#include <sstream>

#include "launcher/message_types/cdr/cdr_codec.hpp"
#include "launcher/message_types/print_value.hpp"
#include "programs/ros/endpoints.hpp"
#include "programs/ros/graph_names.hpp"
#include "programs/ros/topic_graph.hpp"

namespace launch {

namespace {

constexpr std::size_t kTruncate = 128;
constexpr const char* kEventTypes[] = {"REQUEST_SENT", "REQUEST_RECEIVED", "RESPONSE_SENT", "RESPONSE_RECEIVED"};

// The same message with a word in the place of the number info.event_type.
std::shared_ptr<const MessageType> with_event_word(const MessageType& event) {
  MessageType info = *event.fields.at(0).type.message;
  info.fields.at(0).type = {.kind = FieldKind::kString};
  MessageType shown = event;
  shown.fields.at(0).type.message = std::make_shared<const MessageType>(std::move(info));
  return std::make_shared<const MessageType>(std::move(shown));
}

// A topic whose messages are printed.
struct Source {
  std::string heading;  // a line before each message; may be empty
  std::string topic;
  std::shared_ptr<const MessageType> type;
  std::shared_ptr<const MessageType> shown;  // as it is printed
  std::unique_ptr<RawSubscription> subscription;
  bool is_event;
};

class EventEcho : public Verb {
 public:
  std::vector<std::string> complete(const std::vector<std::string>& words) override {
    return words.empty() ? all_names(names_) : std::vector<std::string>();
  }

 protected:
  explicit EventEcho(const NamesOfGraph& names) : names_(names) {}

  void declare_echo(CLI::App& app) {
    app.add_option(names_.kind, name_, fmt::format("name of the {}", names_.kind))->required();
    app.add_option("type", type_, fmt::format("its type, such as {}; default: what the graph says", names_.example));
    app.add_flag("--csv", csv_, "print all fields on one line, with commas between them");
    app.add_flag("-f,--full-length", full_length_, "print all elements of arrays and all characters of strings");
    app.add_option("-l,--truncate-length", truncate_, "most elements of an array, and characters of a string")
        ->check(CLI::NonNegativeNumber)
        ->capture_default_str();
    app.add_flag("--no-arr", style_.no_arrays, "print no elements of arrays");
    app.add_flag("--no-str", style_.no_strings, "print no strings");
    app.add_flag("--flow-style", style_.flow, "print each message on one line");
    look_.declare(app);
  }

  // The type of the command line, or that of the graph.
  std::string find_type(GraphSession& session, const std::string& name) const {
    if (!type_.empty()) {
      std::string type = type_;
      if (std::count(type.begin(), type.end(), '/') == 1) {
        type.insert(type.find('/'), fmt::format("/{}", names_.folder));
      }
      return type;
    }
    session.discover(look_.time());
    return types_of(session, names_, name).front();
  }

  static Source event_source(GraphSession& session, const std::string& service, const std::string& type) {
    auto event = installed_interfaces().message(type + "_Event");
    return source(session, service + "/_service_event", event, rmw_qos_profile_services_default, true);
  }

  static Source source(GraphSession& session, const std::string& topic, const std::shared_ptr<const MessageType>& type,
                       const rmw_qos_profile_t& qos, bool is_event) {
    return {"",
            topic,
            type,
            is_event ? with_event_word(*type) : type,
            std::make_unique<RawSubscription>(session, topic, type, qos),
            is_event};
  }

  // Prints what comes until the user stops it.
  int echo(GraphSession& session, const std::vector<Source>& sources) {
    style_.truncate = full_length_ ? PrintStyle::kWhole : truncate_;
    GraphSession::WakeUps wake_ups;
    for (const Source& each : sources) {
      wake_ups.subscriptions.push_back(each.subscription->handle());
    }
    while (!GraphSession::is_stopped()) {
      for (const Source& each : sources) {
        while (const auto message = each.subscription->take()) {
          put(text(each, *message));
        }
      }
      session.wait(wake_ups, SessionClock::time_point::max());
    }
    return 0;
  }

  std::string name_;

 private:
  std::string text(const Source& from, const RawSubscription::Message& message) const {
    const rmw_serialized_message_t& bytes = message.bytes.get_rcl_serialized_message();
    MessageValue value = from_cdr(*from.type, bytes.buffer, bytes.buffer_length);
    const FieldType type{.kind = FieldKind::kMessage, .message = from.shown};
    const std::string heading = from.heading.empty() ? "" : from.heading + "\n";
    if (from.is_event) {
      MessageValue& event_type = value.list().at(0).list().at(0);
      const auto number = static_cast<std::size_t>(number_of(event_type));
      event_type.data = number < std::size(kEventTypes) ? kEventTypes[number] : fmt::to_string(number);
    }
    return heading + (csv_ ? to_csv(type, value, style_) + "\n" : to_yaml(type, value, style_) + "---\n");
  }

  const NamesOfGraph& names_;
  std::string type_;
  LookOptions look_;
  PrintStyle style_;
  std::size_t truncate_ = kTruncate;
  bool csv_ = false, full_length_ = false;
};

class ServiceEcho final : public EventEcho {
 public:
  ServiceEcho() : EventEcho(kServices) {}

  void declare(CLI::App& app) override { declare_echo(app); }

  int run() override {
    const std::string service = full_name(name_);
    GraphSession session;
    const std::string type = find_type(session, service);
    std::vector<Source> sources;
    sources.push_back(event_source(session, service, type));
    const std::string& topic = sources.front().topic;
    if (!session.wait_until([&] { return session.node().count_publishers(topic) > 0; }, Seconds(1))) {
      fmt::print(stderr, "No publishers on topic '{}'; is service introspection on the client or server enabled?\n",
                 topic);
    }
    return echo(session, sources);
  }
};

class ActionEcho final : public EventEcho {
 public:
  ActionEcho() : EventEcho(kActions) {}

  void declare(CLI::App& app) override {
    declare_echo(app);
    app.add_option("-i,--interfaces", interfaces_,
                   "print only these, with '|' between them: GOAL_SERVICE, CANCEL_SERVICE, RESULT_SERVICE, "
                   "FEEDBACK_TOPIC, STATUS_TOPIC");
  }

  int run() override {
    const std::vector<std::string> chosen = chosen_interfaces();
    const std::string action = full_name(name_);
    GraphSession session;
    const std::string type = find_type(session, action);
    std::vector<Source> sources;
    for (const std::string& interface : chosen) {
      sources.push_back(source_of(session, interface, action + "/_action/", type));
      sources.back().heading = "interface: " + interface;
    }
    return echo(session, sources);
  }

 private:
  static constexpr const char* kInterfaces[] = {"GOAL_SERVICE", "CANCEL_SERVICE", "RESULT_SERVICE", "FEEDBACK_TOPIC",
                                                "STATUS_TOPIC"};

  std::vector<std::string> chosen_interfaces() const {
    if (!interfaces_) {
      return {std::begin(kInterfaces), std::end(kInterfaces)};
    }
    std::vector<std::string> chosen;
    std::istringstream words(*interfaces_);
    for (std::string word; std::getline(words, word, '|');) {
      word.erase(std::remove(word.begin(), word.end(), ' '), word.end());
      std::transform(word.begin(), word.end(), word.begin(), [](unsigned char c) { return std::toupper(c); });
      if (std::find(std::begin(kInterfaces), std::end(kInterfaces), word) == std::end(kInterfaces)) {
        throw CommandError(fmt::format("an action has no interface '{}'", word),
                           fmt::format("its interfaces are {}", fmt::join(kInterfaces, ", ")));
      }
      chosen.push_back(word);
    }
    if (chosen.empty()) {
      throw CommandError("--interfaces names none");
    }
    return chosen;
  }

  static Source source_of(GraphSession& session, const std::string& interface, const std::string& prefix,
                          const std::string& type) {
    if (interface == "GOAL_SERVICE") {
      return event_source(session, prefix + "send_goal", type + "_SendGoal");
    }
    if (interface == "CANCEL_SERVICE") {
      return event_source(session, prefix + "cancel_goal", "action_msgs/srv/CancelGoal");
    }
    if (interface == "RESULT_SERVICE") {
      return event_source(session, prefix + "get_result", type + "_GetResult");
    }
    if (interface == "FEEDBACK_TOPIC") {
      return source(session, prefix + "feedback", installed_interfaces().message(type + "_FeedbackMessage"),
                    rmw_qos_profile_default, false);
    }
    rmw_qos_profile_t of_status = rmw_qos_profile_default;
    of_status.durability = RMW_QOS_POLICY_DURABILITY_TRANSIENT_LOCAL;
    of_status.depth = 1;
    return source(session, prefix + "status", installed_interfaces().message("action_msgs/msg/GoalStatusArray"),
                  of_status, false);
  }

  std::optional<std::string> interfaces_;
};

}  // namespace

std::vector<VerbInfo> event_echo_verbs() {
  return {{"action", "echo", "prints what comes and goes of an action", make_verb<ActionEcho>},
          {"service", "echo", "prints the requests and responses of a service", make_verb<ServiceEcho>}};
}

}  // namespace launch
