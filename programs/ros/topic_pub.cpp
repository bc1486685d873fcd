// SPDX-License-Identifier: Apache-2.0
// launch topic pub
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <string_view>

#include "base/diagnostics/read_source_file.hpp"
#include "launcher/message_types/print_value.hpp"
#include "launcher/message_types/read_value.hpp"
#include "programs/ros/endpoints.hpp"
#include "programs/ros/graph_names.hpp"
#include "programs/ros/topic_graph.hpp"

namespace launch {

namespace {

// A subscription may learn of the publisher after the publisher has learned of the subscription. A reliable one then
// asks for what it has missed.
constexpr Seconds kAckPatience(2);

class TopicPub final : public Verb {
 public:
  void declare(CLI::App& app) override {
    app.add_option("topic", topic_, "name of the topic")->required();
    app.add_option("type", type_, "type of the messages, such as std_msgs/msg/String")->required();
    values_.declare(app, "values", "message");
    app.add_option(
           "--yaml-file", file_,
           "publish the messages of this file in turn, as 'launch topic echo' writes them, and end with the last one")
        ->excludes("values")
        ->excludes("--stdin");
    app.add_option("-r,--rate", rate_, "messages in a second")->check(CLI::PositiveNumber)->capture_default_str();
    app.add_option("-p,--print", print_nth_, "print each N-th message")
        ->check(CLI::NonNegativeNumber)
        ->capture_default_str();
    CLI::Option* const once = app.add_flag("-1,--once", once_, "publish one message");
    app.add_option("-t,--times", times_, "publish so many messages")->check(CLI::NonNegativeNumber)->excludes(once);
    app.add_option("-w,--wait-matching-subscriptions", wait_,
                   "wait for so many subscriptions first; default: 1 with --once or --times, else 0")
        ->check(CLI::NonNegativeNumber);
    app.add_option("--max-wait-time-secs", longest_wait_, "fail after waiting so long; default: wait without end")
        ->check(CLI::PositiveNumber);
    app.add_option("--keep-alive", keep_alive_, "keep the publisher so many seconds after the last message")
        ->check(CLI::NonNegativeNumber)
        ->capture_default_str();
    app.add_option("-n,--node-name", node_name_, "name of the node; default: a hidden one");
    qos_.declare(app, "publish", "default");
    look_.declare(app);
  }

  int run() override {
    const std::string topic = full_name(topic_);
    const std::shared_ptr<const MessageType> type = installed_interfaces().message(type_);
    std::vector<MessageText> messages = read(*type);
    times_ = once_ ? 1 : times_ == 0 && !file_.empty() ? messages.size() : times_;
    const std::size_t wanted = wait_.value_or(times_ != 0 ? 1 : 0);
    if (wanted == 0 && longest_wait_) {
      throw CommandError("--max-wait-time-secs needs --wait-matching-subscriptions, --once or --times");
    }
    GraphSession session(node_name_);
    DescribedPublisher publisher(session, topic, type, qos_.make());
    if (!wait_for_subscriptions(session, publisher, wanted)) {
      return GraphSession::is_stopped() ? 0 : 1;
    }
    put("publisher: beginning loop\n");
    const auto period = std::chrono::duration_cast<SessionClock::duration>(Seconds(1.0 / rate_));
    auto next = SessionClock::now();
    for (std::uint64_t count = 1; !GraphSession::is_stopped() && (times_ == 0 || count <= times_); ++count) {
      MessageText& message = messages[(count - 1) % messages.size()];
      message.stamp(session.node().now().nanoseconds());
      if (print_nth_ != 0 && count % print_nth_ == 0) {
        put(fmt::format("publishing #{}: {}\n\n", count, to_python(*type, message.value)));
      }
      publisher.publish(message.value);
      next += period;
      if (count != times_) {
        session.sleep_until(next);
      }
    }
    publisher.wait_for_all_acked(kAckPatience);
    session.sleep_until(SessionClock::now() + std::chrono::duration_cast<SessionClock::duration>(Seconds(keep_alive_)));
    return 0;
  }

  std::vector<std::string> complete(const std::vector<std::string>& words) override { return topic_then_type(words); }

 private:
  // Those of the file, or the one of the command line.
  std::vector<MessageText> read(const MessageType& type) {
    if (file_.empty()) {
      return {read_message(type, values_.read("values"))};
    }
    const auto file = read_source_file(file_);
    std::vector<MessageText> messages;
    for (const LocatedText& document : documents_of(file)) {
      messages.push_back(read_message(type, document));
    }
    if (messages.empty()) {
      throw CommandError(fmt::format("'{}' holds no message", file_));
    }
    return messages;
  }

  // The parts between the lines '---' that hold something.
  static std::vector<LocatedText> documents_of(const std::shared_ptr<const SourceFile>& file) {
    std::vector<LocatedText> documents;
    const std::string_view text = file->text();
    std::size_t begin = 0;
    const auto add = [&](std::size_t end) {
      const std::string_view document = text.substr(begin, end - begin);
      if (document.find_first_not_of(" \t\r\n") != std::string_view::npos) {
        documents.emplace_back(std::string(document),
                               SourceRange{file, static_cast<std::uint32_t>(begin), static_cast<std::uint32_t>(end)});
      }
    };
    for (std::size_t line = 0; line < text.size();) {
      const std::size_t end = std::min(text.find('\n', line), text.size());
      if (text.substr(line, end - line).starts_with("---")) {
        add(line);
        begin = std::min(end + 1, text.size());
      }
      line = end + 1;
    }
    add(text.size());
    return documents;
  }

  bool wait_for_subscriptions(GraphSession& session, const DescribedPublisher& publisher, std::size_t wanted) const {
    const auto enough = [&] { return publisher.subscription_count() >= wanted; };
    Seconds waited(0);
    while (!session.wait_until(enough, waited == Seconds(0) ? Seconds(0) : Seconds(1))) {
      if (GraphSession::is_stopped()) {
        return false;
      }
      if (longest_wait_ && waited.count() >= *longest_wait_) {
        throw CommandError(fmt::format("waited for subscriptions in vain: {} of {} are there",
                                       publisher.subscription_count(), wanted));
      }
      fmt::print("Waiting for at least {} matching subscription(s)...\n", wanted);
      put("");
      waited += Seconds(1);
    }
    return true;
  }

  std::string topic_, type_, node_name_, file_;
  ValuesOption values_;
  bool once_ = false;
  double rate_ = 1.0;
  std::uint64_t print_nth_ = 1;
  std::uint64_t times_ = 0;
  std::optional<std::size_t> wait_;
  std::optional<double> longest_wait_;
  double keep_alive_ = 0.1;
  QosOptions qos_;
  LookOptions look_;
};

}  // namespace

std::vector<VerbInfo> topic_pub_verbs() {
  return {{"topic", "pub", "publishes messages", make_verb<TopicPub>}};
}

}  // namespace launch
