// SPDX-License-Identifier: Apache-2.0
// launch topic hz, bw, delay
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <map>

#include "base/diagnostics/diagnostic.hpp"
#include "launcher/message_types/cdr/cdr_codec.hpp"
#include "launcher/message_types/message_condition.hpp"
#include "launcher/message_types/message_part.hpp"
#include "programs/ros/calculations/rate_statistics.hpp"
#include "programs/ros/endpoints.hpp"
#include "programs/ros/graph_names.hpp"
#include "programs/ros/topic_graph.hpp"

namespace launch {

namespace {

constexpr std::chrono::seconds kPrintPeriod{1};

// A topic and what is measured of it.
struct Measured {
  std::string topic;
  std::shared_ptr<const MessageType> type;
  std::unique_ptr<RawSubscription> subscription;
};

// None if the user has asked to stop before the topic has appeared.
std::optional<Measured> measure(GraphSession& session, const std::string& topic, const QosOptions& qos) {
  const std::string type = wait_for_type(session, topic);
  if (type.empty()) {
    return std::nullopt;
  }
  Measured measured{topic, installed_interfaces().message(type), nullptr};
  measured.subscription = std::make_unique<RawSubscription>(session, topic, measured.type, qos.make());
  return measured;
}

// The topics that are named, or all that there are with `all`; of these, those of types that are not installed are left
// out with a warning. None if the user has asked to stop.
std::vector<Measured> measure_all(GraphSession& session, const std::vector<std::string>& topics, bool all,
                                  const LookOptions& look, const QosOptions& qos) {
  std::vector<Measured> measured;
  for (const std::string& topic : topics) {
    if (auto one = measure(session, full_name(topic), qos)) {
      measured.push_back(std::move(*one));
    } else {
      return {};
    }
  }
  if (!all) {
    return measured;
  }
  session.discover(look.time());
  for (const auto& [topic, types] : session.node().get_topic_names_and_types()) {
    if (is_hidden(topic) || types.size() != 1) {
      continue;
    }
    try {
      Measured one{topic, installed_interfaces().message(types.front()), nullptr};
      one.subscription = std::make_unique<RawSubscription>(session, topic, one.type, qos.make());
      measured.push_back(std::move(one));
    } catch (const LaunchError& error) {
      fmt::print(stderr, "WARNING: topic [{}] is left out: {}\n", topic, error.what());
    }
  }
  if (measured.empty()) {
    throw CommandError("there are no topics");
  }
  return measured;
}

// Names of topics, or all of them.
struct TopicsOption {
  std::vector<std::string> names;
  bool all = false;

  void declare(CLI::App& app) {
    CLI::Option* const words = app.add_option("topic", names, "names of the topics");
    app.add_flag("-a,--all", all, "all topics that there are")->excludes(words);
  }
  void check() const {
    if (names.empty() && !all) {
      throw CommandError("no topic is given", "name topics, or use --all");
    }
  }
};

// Calls `take` for each message and `print` each second, until the user stops it.
template <typename Take, typename Print>
void run_until_stopped(GraphSession& session, const std::vector<Measured>& topics, const Take& take,
                       const Print& print) {
  auto next = SessionClock::now() + kPrintPeriod;
  GraphSession::WakeUps wake_ups;
  for (const Measured& topic : topics) {
    wake_ups.subscriptions.push_back(topic.subscription->handle());
  }
  while (!GraphSession::is_stopped()) {
    for (const Measured& topic : topics) {
      while (const auto message = topic.subscription->take()) {
        take(topic, *message);
      }
    }
    if (SessionClock::now() >= next) {
      print();
      next += kPrintPeriod;
    }
    session.wait(wake_ups, next);
  }
}

double now_seconds(GraphSession& session) {
  return session.node().now().seconds();
}

class TopicHz final : public Verb {
 public:
  void declare(CLI::App& app) override {
    topics_.declare(app);
    app.add_option("-w,--window", window_, "the last so many messages count")
        ->check(CLI::PositiveNumber)
        ->capture_default_str();
    app.add_option("--filter", filter_, "only messages of which this holds, such as 'm.data > 3'");
    app.add_flag("--wall-time", wall_time_, "has no effect: the time of the machine is used");
    qos_.declare(app, "subscribe", "sensor_data");
    look_.declare(app);
  }

  int run() override {
    topics_.check();
    GraphSession session;
    const std::vector<Measured> measured = measure_all(session, topics_.names, topics_.all, look_, qos_);
    for (const Measured& one : measured) {
      if (!filter_.empty()) {
        conditions_.try_emplace(one.topic, one.type, word_of_command_line("--filter", filter_));
      }
      statistics_.try_emplace(one.topic, window_);
      if (measured.size() > 1) {
        put(fmt::format("Subscribed to [{}]\n", one.topic));
      }
    }
    run_until_stopped(
        session, measured,
        [&](const Measured& topic, const RawSubscription::Message& message) { take(session, topic, message); },
        [&] { print(measured); });
    return 0;
  }

  std::vector<std::string> complete(const std::vector<std::string>& words) override {
    (void)words;
    return all_names(kTopics);
  }

 private:
  void take(GraphSession& session, const Measured& topic, const RawSubscription::Message& message) {
    if (const auto condition = conditions_.find(topic.topic); condition != conditions_.end()) {
      const rmw_serialized_message_t& bytes = message.bytes.get_rcl_serialized_message();
      if (!condition->second.holds(from_cdr(*topic.type, bytes.buffer, bytes.buffer_length))) {
        return;
      }
    }
    statistics_.at(topic.topic).add_arrival(now_seconds(session));
  }

  void print(const std::vector<Measured>& topics) {
    std::vector<std::pair<std::string, RateStatistics::Summary>> rows;
    for (const Measured& topic : topics) {
      if (const auto summary = statistics_.at(topic.topic).take_summary()) {
        rows.emplace_back(topic.topic, *summary);
      }
    }
    put(topics.size() == 1 ? (rows.empty() ? "" : rate_text(rows.front().second)) : rate_table(rows));
  }

  TopicsOption topics_;
  std::size_t window_ = 10000;
  std::string filter_;
  bool wall_time_ = false;
  QosOptions qos_;
  LookOptions look_;
  std::map<std::string, RateStatistics> statistics_;
  std::map<std::string, MessageCondition> conditions_;
};

class TopicBw final : public Verb {
 public:
  void declare(CLI::App& app) override {
    topics_.declare(app);
    app.add_option("-w,--window", window_, "the last so many messages count")
        ->check(CLI::PositiveNumber)
        ->capture_default_str();
    qos_.declare(app, "subscribe", "sensor_data");
    look_.declare(app);
  }

  int run() override {
    topics_.check();
    GraphSession session;
    const std::vector<Measured> measured = measure_all(session, topics_.names, topics_.all, look_, qos_);
    std::map<std::string, BandwidthStatistics> statistics;
    for (const Measured& one : measured) {
      put(fmt::format("Subscribed to [{}]\n", one.topic));
      statistics.try_emplace(one.topic, window_);
    }
    run_until_stopped(
        session, measured,
        [&](const Measured& topic, const RawSubscription::Message& message) {
          statistics.at(topic.topic).add(now_seconds(session), message.bytes.size());
        },
        [&] {
          const double now = now_seconds(session);
          if (statistics.size() == 1) {
            const auto summary = statistics.begin()->second.summary(now);
            put(summary ? bandwidth_text(*summary) : "");
            return;
          }
          std::vector<std::pair<std::string, BandwidthStatistics::Summary>> rows;
          for (const Measured& one : measured) {
            if (const auto summary = statistics.at(one.topic).take_summary(now)) {
              rows.emplace_back(one.topic, *summary);
            }
          }
          put(bandwidth_table(rows));
        });
    return 0;
  }

  std::vector<std::string> complete(const std::vector<std::string>& words) override {
    (void)words;
    return all_names(kTopics);
  }

 private:
  TopicsOption topics_;
  std::size_t window_ = 100;
  QosOptions qos_;
  LookOptions look_;
};

class TopicDelay final : public Verb {
 public:
  void declare(CLI::App& app) override {
    app.add_option("topic", topic_, "name of the topic; its messages have a header")->required();
    app.add_option("-w,--window", window_, "the last so many messages count")
        ->check(CLI::PositiveNumber)
        ->capture_default_str();
    qos_.declare(app, "subscribe", "sensor_data");
    look_.declare(app);
  }

  std::vector<std::string> complete(const std::vector<std::string>& words) override {
    return words.empty() ? all_names(kTopics) : std::vector<std::string>();
  }

  int run() override {
    GraphSession session;
    std::vector<Measured> measured;
    auto one = measure(session, full_name(topic_), qos_);
    if (!one) {
      return 0;
    }
    const MessageField* const header = one->type->find("header");
    if (header == nullptr || header->type.message == nullptr || header->type.message->name != "std_msgs/msg/Header") {
      throw CommandError(fmt::format("messages of type {} have no header", one->type->name));
    }
    const MessagePart stamp(one->type, LocatedText("header.stamp"));
    measured.push_back(std::move(*one));
    RateStatistics statistics(window_);
    bool any = false;
    run_until_stopped(
        session, measured,
        [&](const Measured& topic, const RawSubscription::Message& message) {
          const rmw_serialized_message_t& bytes = message.bytes.get_rcl_serialized_message();
          const MessageValue value = from_cdr(*topic.type, bytes.buffer, bytes.buffer_length);
          const MessageValue::List& time = stamp.find(value)->list();
          const double sent = static_cast<double>(std::get<std::int64_t>(time[0].data)) +
                              1e-9 * static_cast<double>(std::get<std::int64_t>(time[1].data));
          statistics.add(now_seconds(session) - sent);
          any = true;
        },
        [&] {
          if (const auto summary = statistics.take_summary()) {
            put(delay_text(*summary));
          } else if (any) {
            put("no new messages\n");
          }
        });
    return 0;
  }

 private:
  std::string topic_;
  std::size_t window_ = 100;
  QosOptions qos_;
  LookOptions look_;
};

}  // namespace

std::vector<VerbInfo> topic_rate_verbs() {
  return {{"topic", "bw", "measures the bytes that come on a topic", make_verb<TopicBw>},
          {"topic", "delay", "measures how old the messages of a topic are when they come", make_verb<TopicDelay>},
          {"topic", "hz", "measures how often messages come", make_verb<TopicHz>}};
}

}  // namespace launch
