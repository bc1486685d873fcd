// SPDX-License-Identifier: Apache-2.0
#include "tracing/show/live/live_view.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "tracing/model/findings/printable.hpp"
#include "tracing/model/findings/quantity_text.hpp"
#include "tracing/model/objects/object_names.hpp"
#include "tracing/show/report/screen_table.hpp"

namespace tracing {

namespace {

std::string duration(std::int64_t nanoseconds) {
  return format_duration(static_cast<double>(nanoseconds));
}

std::string hertz_text(double hertz) {
  return fmt::format("{:.4g} Hz", hertz);
}

Cell count_cell(std::uint64_t count) {
  return {count == 0 ? "-" : std::to_string(count), count == 0 ? Style::kPlain : Style::kBad};
}

Row row_of(const std::string& label, const std::string& remark, std::uint64_t count, const DurationSummary& took,
           double seconds) {
  Row row{.label = printable(label)};
  row.remark = printable(remark);
  row.count = static_cast<double>(count);
  row.rate = row.count / seconds;
  row.cells = {{hertz_text(row.rate)}};
  if (took.count == 0) {
    row.cells.insert(row.cells.end(), 3, {"-"});
    return row;
  }
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
  if (id >= activities.size()) {
    activities.resize(id + 1);
  }
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
  if (instance.finished) {
    activity.took.add(instance.end_ns - instance.begin_ns);
  }
}

void LiveView::on_message(const MessageFlow& message) {
  if (message.subscription == kNoObject) {
    return;
  }
  Activity& activity = at(subscriptions_, message.subscription);
  ++activity.count;
  const Publication& from = message.publication;
  const std::int64_t begin_ns = from.rclcpp_ns != 0 ? from.rclcpp_ns
                                : from.rcl_ns != 0  ? from.rcl_ns
                                                    : from.published_ns;
  if (begin_ns == 0 || message.callback == kNoObject) {
    return;
  }
  activity.took.add(message.callback_begin_ns - begin_ns);
  latency_.add(message.callback_begin_ns - begin_ns);
}

std::string LiveView::losses() const {
  if (all_lost_ == 0) {
    return has_uncounted_loss_ ? "some lost" : "none lost";
  }
  return fmt::format("{}{} lost", has_uncounted_loss_ ? "at least " : "", all_lost_);
}

std::string LiveView::head(double seconds) const {
  std::uint64_t messages = 0;
  for (const Activity& activity : subscriptions_) {
    messages += activity.count;
  }
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

std::string LiveView::node_table(double seconds, const ReportOptions& options,
                                 const std::vector<std::uint64_t>& missed) const {
  struct NodeActivity {
    std::uint64_t count = 0;
    std::int64_t busy_ns = 0;
    std::int64_t longest_ns = 0;
    std::uint64_t missed = 0;
  };
  const ObjectModel& objects = analysis_.objects();
  std::map<std::string, NodeActivity> nodes;
  for (ObjectId id = 0; id < callbacks_.size(); ++id) {
    const Activity& activity = callbacks_[id];
    if (!activity.is_shown()) {
      continue;
    }
    NodeActivity& node = nodes[node_name(objects, objects.callbacks()[id])];
    const DurationSummary took = activity.took.summary();
    node.count += activity.count;
    node.busy_ns += static_cast<std::int64_t>(took.mean_ns * static_cast<double>(took.count));
    node.longest_ns = std::max(node.longest_ns, took.max_ns);
  }
  for (ObjectId id = 0; id < missed.size(); ++id) {
    const auto node = nodes.find(node_name(objects, objects.callbacks()[id]));
    if (node != nodes.end()) {
      node->second.missed += missed[id];
    }
  }
  ScreenTable table("Nodes", {"callbacks", "load", "longest", "missed"}, "total");
  for (const auto& [name, node] : nodes) {
    Row row{.label = name.empty() ? "?" : name};
    row.count = static_cast<double>(node.count);
    row.rate = row.count / seconds;
    row.max = static_cast<double>(node.longest_ns);
    row.total = static_cast<double>(node.busy_ns);
    row.cells = {{hertz_text(row.rate)},
                 {fmt::format("{:.2f} %", row.total / seconds / 1e7)},
                 {node.longest_ns == 0 ? "-" : duration(node.longest_ns), Style::kBold},
                 count_cell(node.missed)};
    table.add(std::move(row));
  }
  return table.text(options);
}

std::string LiveView::screen(double seconds, const ReportOptions& options) const {
  const ObjectModel& objects = analysis_.objects();
  const bool lost = all_lost_ > 0 || has_uncounted_loss_;
  std::string text = shortened(head(seconds), options.width) + "\n" +
                     styled(losses(), lost ? Style::kBad : Style::kGood, options.color) + "\n";
  const std::vector<std::uint64_t> missed = analysis_.missed_periods();
  const std::vector<std::uint64_t> dropped = analysis_.dropped_messages();
  text += node_table(seconds, options, missed);
  ScreenTable messages("Messages, publish to callback", {"rate", "p50", "p99", "max", "dropped"}, "p99");
  for (ObjectId id = 0; id < subscriptions_.size(); ++id) {
    const Activity& activity = subscriptions_[id];
    if (!activity.is_shown()) {
      continue;
    }
    const EndpointObject& subscription = objects.subscriptions()[id];
    const std::string topic =
        subscription.topic == kNoObject ? std::string("?") : objects.topics()[subscription.topic].name;
    Row row =
        row_of(topic, "to " + node_of(objects, subscription.node), activity.count, activity.took.summary(), seconds);
    row.cells.push_back(count_cell(id < dropped.size() ? dropped[id] : 0));
    messages.add(std::move(row));
  }
  ScreenTable callbacks("Callbacks", {"rate", "p50", "p99", "max", "missed"}, "total");
  for (ObjectId id = 0; id < callbacks_.size(); ++id) {
    const Activity& activity = callbacks_[id];
    if (!activity.is_shown()) {
      continue;
    }
    const CallbackObject& callback = objects.callbacks()[id];
    const std::string node = node_name(objects, callback);
    Row row = row_of((node.empty() ? "?" : node) + " " + callback_source(objects, callback), "", activity.count,
                     activity.took.summary(), seconds);
    row.cells.push_back(count_cell(id < missed.size() ? missed[id] : 0));
    callbacks.add(std::move(row));
  }
  return text + messages.text(options) + callbacks.text(options);
}

void LiveView::clear() {
  events_ = 0;
  callbacks_ended_ = 0;
  latency_ = {};
  for (std::vector<Activity>* activities : {&subscriptions_, &callbacks_}) {
    for (Activity& activity : *activities) {
      if (activity.count > 0) {
        activity = {.rested = 0};
      }
      if (activity.is_shown()) {
        ++activity.rested;
      }
    }
  }
}

LiveReader::State read_some(LiveReader& reader, TraceSink& sink) {
  constexpr std::size_t kMostItems = 4096;
  TraceItem item;
  for (std::size_t i = 0; i < kMostItems; ++i) {
    const LiveReader::State state = reader.next(item);
    if (state != LiveReader::State::kItem) {
      return state;
    }
    if (item.event != nullptr) {
      sink.on_event(*item.event);
    } else {
      sink.on_loss(*item.loss);
    }
  }
  return LiveReader::State::kItem;
}

}  // namespace tracing
