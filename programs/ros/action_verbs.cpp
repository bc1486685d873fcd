// SPDX-License-Identifier: Apache-2.0
// launch action info, send_goal
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <iterator>
#include <random>

#include "base/diagnostics/diagnostic.hpp"
#include "launcher/message_types/cdr/cdr_codec.hpp"
#include "launcher/message_types/print_value.hpp"
#include "launcher/message_types/read_value.hpp"
#include "programs/ros/endpoints.hpp"
#include "programs/ros/graph_names.hpp"
#include "programs/ros/topic_graph.hpp"

namespace launch {

namespace {

class ActionInfo final : public Verb {
 public:
  void declare(CLI::App& app) override {
    app.add_option("action", action_, "name of the action")->required();
    look_.declare(app);
    app.add_flag("-t,--show-types", show_types_, "also print the types");
    app.add_flag("-c,--count", count_, "print only how many clients and servers there are");
  }

  int run() override {
    const std::string action = full_name(action_);
    GraphSession session;
    session.discover(look_.time());
    put(fmt::format("Action: {}\n", action));
    put_nodes(session, action, "Action clients", OfNode::kClients);
    put_nodes(session, action, "Action servers", OfNode::kServices);
    return 0;
  }

  std::vector<std::string> complete(const std::vector<std::string>& words) override {
    return words.empty() ? all_names(kActions) : std::vector<std::string>();
  }

 private:
  void put_nodes(GraphSession& session, const std::string& action, const char* title, OfNode what) const {
    std::vector<std::string> lines;
    for (const std::string& node : node_names(session, false)) {
      const NamesAndTypes actions = actions_among(names_of_node(session, node, what));
      if (const auto found = actions.find(action); found != actions.end()) {
        lines.push_back(show_types_ ? fmt::format("    {} [{}]\n", node, fmt::join(found->second, ", "))
                                    : fmt::format("    {}\n", node));
      }
    }
    put(fmt::format("{}: {}\n{}", title, lines.size(),
                    count_ ? std::string() : fmt::format("{}", fmt::join(lines, ""))));
  }

  std::string action_;
  LookOptions look_;
  bool show_types_ = false;
  bool count_ = false;
};

// action_msgs/msg/GoalStatus
constexpr const char* kStatus[] = {"UNKNOWN", "ACCEPTED", "EXECUTING", "CANCELING", "SUCCEEDED", "CANCELED", "ABORTED"};
constexpr std::size_t kSucceeded = 4;

class SendGoal final : public Verb {
 public:
  void declare(CLI::App& app) override {
    app.add_option("action", action_, "name of the action")->required();
    app.add_option("type", type_, "type of the action, such as example_interfaces/action/Fibonacci")->required();
    goal_.declare(app, "goal", "goal");
    app.add_flag("-f,--feedback", feedback_, "print feedback");
    app.add_option("--timeout", timeout_, "wait so many seconds for the server; default: without end")
        ->check(CLI::PositiveNumber);
  }

  int run() override {
    const std::string action = full_name(action_);
    InterfaceLibrary& library = installed_interfaces();
    if (const std::size_t slash = type_.find('/'); slash == type_.rfind('/') && slash != std::string::npos) {
      type_.insert(slash, "/action");
    }
    const auto goal_type = library.message(type_ + "_Goal");
    const MessageValue goal = read_message(*goal_type, goal_.read("goal")).value;
    GraphSession session;
    const std::string base = action + "/_action/";
    const ServiceType send_type = library.action_service(type_, "SendGoal");
    const ServiceType result_type = library.action_service(type_, "GetResult");
    DescribedClient sender(session, base + "send_goal", send_type);
    DescribedClient results(session, base + "get_result", result_type);
    std::unique_ptr<RawSubscription> feedback;
    if (feedback_) {
      feedback = std::make_unique<RawSubscription>(
          session, base + "feedback", library.message(type_ + "_FeedbackMessage"), rmw_qos_profile_default);
    }
    put("Waiting for an action server to become available...\n");
    const auto ready = [&] { return sender.service_is_ready() && results.service_is_ready(); };
    if (!session.wait_until(ready, timeout_ ? std::optional<Seconds>(*timeout_) : std::nullopt)) {
      return stopped_or(fmt::format("there is no server of action '{}'", action));
    }
    put(fmt::format("Sending goal:\n     {}\n", to_yaml({FieldKind::kMessage, goal_type}, goal)));
    const MessageValue id = random_id();
    const auto answer = sender.call(message_of({id, goal}));
    if (!answer) {
      return stopped_or("the server has not answered");
    }
    if (!std::get<bool>(member(*send_type.response, *answer, "accepted").data)) {
      put("Goal was rejected.\n");
      return 1;
    }
    put(fmt::format("Goal accepted with ID: {}\n\n", id_text(id)));
    return await_result(session, results, result_type, id, feedback.get());
  }

  std::vector<std::string> complete(const std::vector<std::string>& words) override {
    return words.empty()       ? all_names(kActions)
           : words.size() == 1 ? installed_interfaces().names("action")
                               : std::vector<std::string>();
  }

 private:
  static MessageValue message_of(MessageValue::List members) {
    MessageValue message;
    message.data = std::move(members);
    return message;
  }

  // A unique_identifier_msgs/msg/UUID.
  static MessageValue random_id() {
    std::random_device random;
    MessageValue id = default_value(*installed_interfaces().message("unique_identifier_msgs/msg/UUID"));
    for (MessageValue& byte : id.list().front().list()) {
      byte.data = static_cast<std::int64_t>(random() & 0xFF);
    }
    return id;
  }
  static std::string id_text(const MessageValue& id) {
    std::string text;
    for (const MessageValue& byte : id.list().front().list()) {
      text += fmt::format("{:02x}", number_of(byte));
    }
    return text;
  }

  int await_result(GraphSession& session, DescribedClient& results, const ServiceType& type, const MessageValue& id,
                   RawSubscription* feedback) const {
    const std::int64_t sent = results.send(message_of({id}));
    while (true) {
      while (feedback != nullptr) {
        const auto message = feedback->take();
        if (!message) {
          break;
        }
        put_feedback(*message, id);
      }
      if (const auto response = results.take(sent)) {
        const auto result = type.response->find("result")->type;
        const auto status = static_cast<std::size_t>(number_of(member(*type.response, *response, "status")));
        put(fmt::format("Result:\n    {}\nGoal finished with status: {}\n",
                        to_yaml(result, member(*type.response, *response, "result")),
                        kStatus[status < std::size(kStatus) ? status : 0]));
        return status == kSucceeded ? 0 : 1;
      }
      if (GraphSession::is_stopped()) {
        return cancel(session, id);
      }
      GraphSession::WakeUps wake_ups{{}, {results.handle()}};
      if (feedback != nullptr) {
        wake_ups.subscriptions.push_back(feedback->handle());
      }
      session.wait(wake_ups, SessionClock::time_point::max());
    }
  }

  void put_feedback(const RawSubscription::Message& message, const MessageValue& id) const {
    const auto type = installed_interfaces().message(type_ + "_FeedbackMessage");
    const rmw_serialized_message_t& bytes = message.bytes.get_rcl_serialized_message();
    const MessageValue value = from_cdr(*type, bytes.buffer, bytes.buffer_length);
    if (value.list().front() == id) {
      put(fmt::format("Feedback:\n    {}\n", to_yaml(type->find("feedback")->type, member(*type, value, "feedback"))));
    }
  }

  // Waits for the server, but not for long: the user wants to go.
  int cancel(GraphSession& session, const MessageValue& id) const {
    put("Canceling goal...\n");
    const ServiceType type = installed_interfaces().service("action_msgs/srv/CancelGoal");
    DescribedClient client(session, full_name(action_) + "/_action/cancel_goal", type);
    GraphSession::forget_stop();
    if (!session.wait_until([&] { return client.service_is_ready(); }, Seconds(2))) {
      return 1;
    }
    MessageValue request = default_value(*type.request);
    request.list().front().list().front() = id;
    const auto response = client.call(request, Seconds(2));
    put(response ? "Goal canceled.\n" : "");
    return 1;
  }

  std::string action_, type_;
  ValuesOption goal_;
  bool feedback_ = false;
  std::optional<double> timeout_;
};

}  // namespace

std::vector<VerbInfo> action_verbs() {
  return {{"action", "info", "describes an action", make_verb<ActionInfo>},
          {"action", "send_goal", "sends a goal and waits for its result", make_verb<SendGoal>}};
}

}  // namespace launch
