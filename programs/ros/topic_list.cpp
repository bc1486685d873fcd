// SPDX-License-Identifier: Apache-2.0
// launch topic list, info, type, find
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>

#include "programs/ros/graph_names.hpp"
#include "programs/ros/qos_text.hpp"
#include "programs/ros/topic_graph.hpp"

namespace launch {

namespace {

class TopicList final : public Verb {
 public:
  void declare(CLI::App& app) override {
    look_.declare(app);
    app.add_flag("-t,--show-types", show_types_, "also print the types");
    app.add_flag("-c,--count-topics", count_, "print only how many there are");
    app.add_flag("--include-hidden-topics", hidden_, "also topics whose name begins with '_'");
    app.add_flag("-v,--verbose", verbose_, "print publishers and subscribers of each topic");
  }

  int run() override {
    GraphSession session;
    session.discover(look_.time());
    auto topics = session.node().get_topic_names_and_types();
    std::erase_if(topics, [this](const auto& topic) { return !hidden_ && is_hidden(topic.first); });
    if (!count_ && verbose_ && !topics.empty()) {
      put(section(session, topics, true) + "\n" + section(session, topics, false) + "\n");
      return 0;
    }
    put_names(topics, show_types_, count_);
    return 0;
  }

 private:
  static std::string section(GraphSession& session, const NamesAndTypes& topics, bool publishers) {
    std::string text = publishers ? "Published topics:\n" : "Subscribed topics:\n";
    for (const auto& [name, types] : topics) {
      const std::size_t count =
          publishers ? session.node().count_publishers(name) : session.node().count_subscribers(name);
      if (count != 0) {
        text += fmt::format(" * {} [{}] {} {}{}\n", name, fmt::join(types, ", "), count,
                            publishers ? "publisher" : "subscriber", count > 1 ? "s" : "");
      }
    }
    return text;
  }

  LookOptions look_;
  bool show_types_ = false;
  bool count_ = false;
  bool hidden_ = false;
  bool verbose_ = false;
};

class TopicInfo final : public Verb {
 public:
  void declare(CLI::App& app) override {
    app.add_option("topic", topic_, "name of the topic")->required();
    look_.declare(app);
    app.add_flag("-v,--verbose", verbose_, "also print node, type, GID and quality of service of each end");
  }

  int run() override {
    const std::string topic = full_name(topic_);
    GraphSession session;
    session.discover(look_.time());
    const auto topics = session.node().get_topic_names_and_types();
    const auto found = topics.find(topic);
    if (found == topics.end()) {
      throw unknown_topic(session, topic);
    }
    const char* const line_end = verbose_ ? "\n\n" : "\n";
    const auto& types = found->second;
    put(types.size() == 1 ? fmt::format("Type: {}{}", types.front(), line_end)
                          : fmt::format("Type: ['{}']{}", fmt::join(types, "', '"), line_end));
    put(fmt::format("Publisher count: {}{}", session.node().count_publishers(topic), line_end));
    if (verbose_) {
      put_endpoints(session.node().get_publishers_info_by_topic(topic));
    }
    put(fmt::format("Subscription count: {}{}", session.node().count_subscribers(topic), line_end));
    if (verbose_) {
      put_endpoints(session.node().get_subscriptions_info_by_topic(topic));
    }
    return 0;
  }

  std::vector<std::string> complete(const std::vector<std::string>& words) override {
    return words.empty() ? topic_names() : std::vector<std::string>();
  }

 private:
  static void put_endpoints(const std::vector<rclcpp::TopicEndpointInfo>& endpoints) {
    for (const rclcpp::TopicEndpointInfo& endpoint : endpoints) {
      put(endpoint_text(endpoint) + "\n\n");
    }
  }

  std::string topic_;
  LookOptions look_;
  bool verbose_ = false;
};

class TopicType final : public Verb {
 public:
  void declare(CLI::App& app) override {
    app.add_option("topic", topic_, "name of the topic")->required();
    look_.declare(app);
  }

  int run() override {
    const std::string topic = full_name(topic_);
    GraphSession session;
    session.discover(look_.time());
    const auto topics = session.node().get_topic_names_and_types();
    const auto found = topics.find(topic);
    if (found == topics.end()) {
      throw unknown_topic(session, topic);
    }
    for (const std::string& type : found->second) {
      put(type + "\n");
    }
    return 0;
  }

  std::vector<std::string> complete(const std::vector<std::string>& words) override {
    return words.empty() ? topic_names() : std::vector<std::string>();
  }

 private:
  std::string topic_;
  LookOptions look_;
};

class TopicFind final : public Verb {
 public:
  void declare(CLI::App& app) override {
    app.add_option("type", type_, "type of the topics, such as std_msgs/msg/String")->required();
    look_.declare(app);
    app.add_flag("-c,--count-topics", count_, "print only how many there are");
    app.add_flag("--include-hidden-topics", hidden_, "also topics whose name begins with '_'");
  }

  int run() override {
    if (std::count(type_.begin(), type_.end(), '/') == 1) {
      type_.insert(type_.find('/'), "/msg");
    }
    GraphSession session;
    session.discover(look_.time());
    std::vector<std::string> found;
    for (const auto& [name, types] : session.node().get_topic_names_and_types()) {
      if ((hidden_ || !is_hidden(name)) && std::find(types.begin(), types.end(), type_) != types.end()) {
        found.push_back(name);
      }
    }
    if (count_) {
      put(fmt::format("{}\n", found.size()));
      return 0;
    }
    for (const std::string& name : found) {
      put(name + "\n");
    }
    return 0;
  }

  std::vector<std::string> complete(const std::vector<std::string>& words) override {
    return words.empty() ? installed_interfaces().names("msg") : std::vector<std::string>();
  }

 private:
  std::string type_;
  LookOptions look_;
  bool count_ = false;
  bool hidden_ = false;
};

}  // namespace

std::unique_ptr<Verb> make_topic_list() {
  return std::make_unique<TopicList>();
}
std::unique_ptr<Verb> make_topic_info() {
  return std::make_unique<TopicInfo>();
}
std::unique_ptr<Verb> make_topic_type() {
  return std::make_unique<TopicType>();
}
std::unique_ptr<Verb> make_topic_find() {
  return std::make_unique<TopicFind>();
}

}  // namespace launch
