// SPDX-License-Identifier: Apache-2.0
// launch topic echo
#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "base/diagnostics/diagnostic.hpp"
#include "launcher/message_types/cdr/cdr_codec.hpp"
#include "launcher/message_types/message_condition.hpp"
#include "launcher/message_types/message_part.hpp"
#include "launcher/message_types/print_value.hpp"
#include "programs/ros/endpoints.hpp"
#include "programs/ros/graph_names.hpp"
#include "programs/ros/topic_graph.hpp"

namespace launch {

namespace {

constexpr std::size_t kTruncate = 128;
constexpr const char* kClearScreen = "\x1b[H\x1b[2J\n";

class TopicEcho final : public Verb {
 public:
  void declare(CLI::App& app) override {
    app.add_option("topic", topic_, "name of the topic")->required();
    app.add_option("type", type_, "type of its messages; default: what the graph says");
    look_.declare(app);
    qos_.declare(app, "subscribe", "sensor_data");
    app.add_flag("--csv", csv_, "print all fields on one line, with commas between them");
    app.add_option("--field", field_, "print only this field, such as pose.position or covariance[0]");
    app.add_flag("-f,--full-length", full_length_, "print all elements of arrays and all characters of strings");
    app.add_option("-l,--truncate-length", truncate_, "most elements of an array, and characters of a string")
        ->check(CLI::NonNegativeNumber)
        ->capture_default_str();
    app.add_flag("--no-arr", style_.no_arrays, "print no elements of arrays");
    app.add_flag("--no-str", style_.no_strings, "print no strings");
    app.add_flag("--flow-style", style_.flow, "print each message on one line");
    app.add_flag("--no-lost-messages", no_lost_, "has no effect: lost messages are not reported");
    app.add_flag("--raw", raw_, "print the bytes");
    app.add_option("--filter", filter_, "print only messages of which this holds, such as 'm.data > 3'");
    app.add_flag("--once", once_, "end after the first message");
    app.add_option("--timeout", timeout_, "end after so many seconds")->check(CLI::PositiveNumber);
    app.add_flag("-i,--include-message-info", info_, "also print times and sequence numbers");
    app.add_flag("-c,--clear", clear_, "clear the screen before each message");
    app.add_option("-n,--node-name", node_name_, "name of the node; default: a hidden one");
  }

  int run() override {
    const std::string topic = full_name(topic_);
    style_.truncate = full_length_ ? PrintStyle::kWhole : truncate_;
    std::shared_ptr<const MessageType> type;
    if (!type_.empty()) {  // a mistake in the command line needs no middleware
      type = installed_interfaces().message(type_);
      compile(type);
    }
    GraphSession session(node_name_);
    const auto begin = SessionClock::now();
    session.discover(look_.time());
    if (type == nullptr) {
      const auto name = type_of_topic(session, topic);
      if (!name) {
        throw unknown_name(session, kTopics, topic);
      }
      type = installed_interfaces().message(*name);
      compile(type);
    }
    const rmw_qos_profile_t qos = qos_.is_chosen() ? qos_.make() : matching_qos(session, topic, qos_.make());
    RawSubscription subscription(session, topic, type, qos);
    const auto end = timeout_ ? begin + std::chrono::duration_cast<SessionClock::duration>(Seconds(*timeout_))
                              : SessionClock::time_point::max();
    while (!GraphSession::is_stopped() && SessionClock::now() < end) {
      while (const auto message = subscription.take()) {
        if (show(*type, *message) && once_) {
          return 0;
        }
      }
      session.wait({{subscription.handle()}, {}}, end);
    }
    return 0;
  }

  std::vector<std::string> complete(const std::vector<std::string>& words) override { return topic_then_type(words); }

 private:
  void compile(const std::shared_ptr<const MessageType>& type) {
    path_.emplace(type, word_of_command_line("--field", field_));
    if (!filter_.empty()) {
      condition_.emplace(type, word_of_command_line("--filter", filter_));
    }
  }

  static std::string info_text(const rmw_message_info_t& info, bool csv) {
    return csv ? fmt::format("{},{},{},{},", info.source_timestamp, info.received_timestamp,
                             info.publication_sequence_number, info.reception_sequence_number)
               : fmt::format(
                     "publication_sequence_number: {}\nreception_sequence_number: {}\n"
                     "received_timestamp: {}\nsource_timestamp: {}\n---\n",
                     info.publication_sequence_number, info.reception_sequence_number, info.received_timestamp,
                     info.source_timestamp);
  }

  // False if the message is not printed.
  bool show(const MessageType& type, const RawSubscription::Message& message) {
    const rmw_serialized_message_t& bytes = message.bytes.get_rcl_serialized_message();
    std::string text = clear_ ? kClearScreen : "";
    if (info_) {
      text += info_text(message.info, csv_);
    }
    if (raw_) {
      put(text + python_bytes(bytes.buffer, bytes.buffer_length) + "\n---\n");
      return true;
    }
    const MessageValue value = from_cdr(type, bytes.buffer, bytes.buffer_length);
    if (condition_ && !condition_->holds(value)) {
      return false;
    }
    const MessageValue* const part = path_->find(value);
    if (part == nullptr) {
      return false;
    }
    put(text + part_text(*part));
    return true;
  }

  std::string part_text(const MessageValue& part) const {
    const FieldType& type = path_->type();
    if (csv_) {
      return to_csv(type, part, style_) + "\n";
    }
    if (type.many == Many::kOne && type.kind != FieldKind::kMessage) {
      return to_csv(type, part, style_) + "\n---\n";
    }
    PrintStyle style = style_;
    style.flow = style.flow || (type.many != Many::kOne && type.kind != FieldKind::kMessage);
    return to_yaml(type, part, style) + "---\n";
  }

  std::string topic_, type_, field_, filter_, node_name_;
  LookOptions look_;
  QosOptions qos_;
  PrintStyle style_;
  std::size_t truncate_ = kTruncate;
  bool csv_ = false, full_length_ = false, no_lost_ = false, raw_ = false, once_ = false, info_ = false, clear_ = false;
  std::optional<double> timeout_;
  std::optional<MessagePart> path_;
  std::optional<MessageCondition> condition_;
};

}  // namespace

std::vector<VerbInfo> topic_echo_verbs() {
  return {{"topic", "echo", "prints the messages of a topic", make_verb<TopicEcho>}};
}

}  // namespace launch
