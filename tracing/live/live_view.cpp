// SPDX-License-Identifier: Apache-2.0
#include "tracing/live/live_view.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "tracing/findings/quantity_text.hpp"
#include "tracing/objects/object_names.hpp"
#include "tracing/report/screen_table.hpp"

namespace tracing {

namespace {

std::string duration(std::int64_t nanoseconds) {
  return format_duration(static_cast<double>(nanoseconds));
}

Row row_of(std::string label, std::string remark, std::uint64_t count, const DurationSummary& took, double seconds) {
  Row row{.label = std::move(label)};
  row.remark = std::move(remark);
  row.count = static_cast<double>(count);
  row.rate = row.count / seconds;
  row.cells = {{fmt::format("{:.4g} Hz", row.rate)}};
  if (took.count == 0) return row;
  row.cells.insert(row.cells.end(),
                   {{duration(took.p50_ns)}, {duration(took.p99_ns), Style::kBold}, {duration(took.max_ns)}});
  row.total = took.mean_ns * static_cast<double>(took.count);
  row.p50 = static_cast<double>(took.p50_ns);
  row.p99 = static_cast<double>(took.p99_ns);
  row.max = static_cast<double>(took.max_ns);
  return row;
}

std::string node_of(const ObjectModel& objects, ObjectId node) {
  return node == kNoObject ? std::string("?") : objects.nodes()[node].name;
}

}  // namespace

LiveView::Activity& LiveView::at(std::vector<Activity>& activities, ObjectId id) {
  if (id >= activities.size()) activities.resize(id + 1);
  return activities[id];
}

void LiveView::on_event(const Event& event) {
  ++events_;
  ++all_events_;
  analysis_.on_event(event);
}

void LiveView::on_loss(const Loss& loss) {
  if (loss.kind == Loss::Kind::kEvents && loss.count) {
    all_lost_ += *loss.count;
  } else {
    has_uncounted_loss_ = true;
  }
  analysis_.on_loss(loss);
}

void LiveView::on_callback(const CallbackInstance& instance) {
  ++callbacks_ended_;
  Activity& activity = at(callbacks_, instance.callback);
  ++activity.count;
  if (instance.finished) activity.took.add(instance.end_ns - instance.begin_ns);
}

void LiveView::on_message(const MessageFlow& message) {
  if (message.subscription == kNoObject) return;
  Activity& activity = at(subscriptions_, message.subscription);
  ++activity.count;
  const Publication& from = message.publication;
  const std::int64_t begin_ns = from.rclcpp_ns != 0 ? from.rclcpp_ns
                                : from.rcl_ns != 0  ? from.rcl_ns
                                                    : from.published_ns;
  if (begin_ns == 0 || message.callback == kNoObject) return;
  activity.took.add(message.callback_begin_ns - begin_ns);
  latency_.add(message.callback_begin_ns - begin_ns);
}

std::string LiveView::losses() const {
  if (all_lost_ == 0) return has_uncounted_loss_ ? "some lost" : "none lost";
  return fmt::format("{}{} lost", has_uncounted_loss_ ? "at least " : "", all_lost_);
}

std::string LiveView::head(double seconds) const {
  std::uint64_t messages = 0;
  for (const Activity& activity : subscriptions_) messages += activity.count;
  const auto rate = [seconds](std::uint64_t count) { return static_cast<double>(count) / seconds; };
  std::string text = fmt::format("{:.0f} events/s, {:.4g} callbacks/s, {:.4g} messages/s", rate(events_),
                                 rate(callbacks_ended_), rate(messages));
  if (const DurationSummary latency = latency_.summary(); latency.count > 0) {
    text += fmt::format(", latency p50 {}, p99 {}", duration(latency.p50_ns), duration(latency.p99_ns));
  }
  return text;
}

std::string LiveView::line(double seconds) const {
  return head(seconds) + ", " + losses();
}

std::string LiveView::screen(double seconds, const ReportOptions& options) const {
  const ObjectModel& objects = analysis_.objects();
  const bool lost = all_lost_ > 0 || has_uncounted_loss_;
  std::string text = shortened(head(seconds), options.width) + "\n" +
                     styled(losses(), lost ? Style::kBad : Style::kGood, options.color) + "\n";
  ScreenTable messages("Messages, publish to callback", {"rate", "p50", "p99", "max"}, "p99");
  for (ObjectId id = 0; id < subscriptions_.size(); ++id) {
    const Activity& activity = subscriptions_[id];
    if (activity.count == 0) continue;
    const EndpointObject& subscription = objects.subscriptions()[id];
    const std::string topic =
        subscription.topic == kNoObject ? std::string("?") : objects.topics()[subscription.topic].name;
    messages.add(
        row_of(topic, "to " + node_of(objects, subscription.node), activity.count, activity.took.summary(), seconds));
  }
  ScreenTable callbacks("Callbacks", {"rate", "p50", "p99", "max"}, "total");
  for (ObjectId id = 0; id < callbacks_.size(); ++id) {
    const Activity& activity = callbacks_[id];
    if (activity.count == 0) continue;
    const CallbackObject& callback = objects.callbacks()[id];
    const std::string node = node_name(objects, callback);
    callbacks.add(row_of((node.empty() ? "?" : node) + " " + callback_source(objects, callback), "", activity.count,
                         activity.took.summary(), seconds));
  }
  return text + messages.text(options) + callbacks.text(options);
}

void LiveView::clear() {
  events_ = 0;
  callbacks_ended_ = 0;
  latency_ = {};
  for (std::vector<Activity>* activities : {&subscriptions_, &callbacks_}) {
    for (Activity& activity : *activities) {
      if (activity.count > 0) activity = {};
    }
  }
}

}  // namespace tracing
