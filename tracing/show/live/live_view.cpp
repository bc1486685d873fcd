// SPDX-License-Identifier: Apache-2.0
#include "tracing/show/live/live_view.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "tracing/model/findings/printable.hpp"
#include "tracing/model/findings/quantity_text.hpp"
#include "tracing/model/objects/object_names.hpp"
#include "tracing/show/report/report_sections.hpp"
#include "tracing/show/report/text_table.hpp"

namespace tracing {

namespace {

constexpr const char* kUnnamed = R"(
?  The name of a node is not known: a node of another ROS 2 tells it to a session
   that begins later if its launch has a <trace>, or began with launch --trace
)";

std::string duration(std::int64_t nanoseconds) {
  return format_duration(static_cast<double>(nanoseconds));
}

std::string hertz_text(double hertz) {
  return fmt::format("{:.4g} Hz", hertz);
}

// What one subscription or callback did in the interval.
struct Line {
  std::uint64_t count;
  DurationSummary took;
  std::uint64_t bad;  // messages that were dropped, periods that were missed
};

class ActivityTable {
 public:
  ActivityTable(const char* title, const char* key, const char* bad, double seconds)
      : seconds_(seconds), table_(title, key) {
    table_.column("rate",
                  [seconds](const Line& line) { return Cell{hertz_text(static_cast<double>(line.count) / seconds)}; });
    table_.times(&Line::took, Style::kBold);
    table_.count(bad, &Line::bad, Style::kBad);
  }

  void add(const std::string& label, const std::string& remark, const Line& line) {
    Row row{.label = printable(label), .remark = printable(remark)};
    sort_by(row, line.took);
    row.count = static_cast<double>(line.count);
    row.rate = row.count / seconds_;
    table_.add(std::move(row), line);
  }
  std::string text(const ReportOptions& options) const { return table_.text(options); }

 private:
  double seconds_;
  ResultTable<Line> table_;
};

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
  now_ns_ = std::max(now_ns_, event.timestamp_ns);
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
  ResultTable<NodeActivity> table("Nodes", "total");
  table.column("callbacks", [seconds](const NodeActivity& node) {
    return Cell{hertz_text(static_cast<double>(node.count) / seconds)};
  });
  table.column("load", [seconds](const NodeActivity& node) {
    return Cell{fmt::format("{:.2f} %", static_cast<double>(node.busy_ns) / seconds / 1e7)};
  });
  table.column("longest", [](const NodeActivity& node) {
    return Cell{node.longest_ns == 0 ? "-" : duration(node.longest_ns), Style::kBold};
  });
  table.count("missed", &NodeActivity::missed, Style::kBad);
  for (const auto& [name, node] : nodes) {
    Row row{.label = name.empty() ? "?" : name};
    row.count = static_cast<double>(node.count);
    row.rate = row.count / seconds;
    row.max = static_cast<double>(node.longest_ns);
    row.total = static_cast<double>(node.busy_ns);
    table.add(std::move(row), node);
  }
  return table.text(options);
}

// The last changes of conditions and priorities, and which processes were started again.
std::string LiveView::last_changes(const ReportOptions& options) const {
  std::vector<LauncherEventResult> events = analysis_.launcher_events();
  std::erase_if(events, [](const LauncherEventResult& event) { return event.is_ordinary(); });
  if (events.size() > kShownLauncherEvents) {
    events.erase(events.begin(), events.end() - kShownLauncherEvents);
  }
  for (LauncherEventResult& event : events) {
    event.subject = printable(event.subject);
    event.what = printable(event.what);
  }
  return launcher_section(events, now_ns_, options);
}

std::string LiveView::screen(double seconds, const ReportOptions& options) const {
  const ObjectModel& objects = analysis_.objects();
  const bool lost = all_lost_ > 0 || has_uncounted_loss_;
  std::string text = shortened(head(seconds), options.width) + "\n" +
                     styled(losses(), lost ? Style::kBad : Style::kGood, options.color) + "\n";
  text += last_changes(options);
  const std::vector<std::uint64_t> missed = analysis_.missed_periods();
  const std::vector<std::uint64_t> dropped = analysis_.dropped_messages();
  text += node_table(seconds, options, missed);
  ActivityTable messages("Messages, publish to callback", "p99", "dropped", seconds);
  for (ObjectId id = 0; id < subscriptions_.size(); ++id) {
    const Activity& activity = subscriptions_[id];
    if (!activity.is_shown()) {
      continue;
    }
    const EndpointObject& subscription = objects.subscriptions()[id];
    const std::string topic =
        subscription.topic == kNoObject ? std::string("?") : objects.topics()[subscription.topic].name;
    messages.add(topic, "to " + node_of(objects, subscription.node),
                 {activity.count, activity.took.summary(), id < dropped.size() ? dropped[id] : 0});
  }
  ActivityTable callbacks("Callbacks", "total", "missed", seconds);
  bool has_unnamed = false;
  for (ObjectId id = 0; id < callbacks_.size(); ++id) {
    const Activity& activity = callbacks_[id];
    if (!activity.is_shown()) {
      continue;
    }
    const CallbackObject& callback = objects.callbacks()[id];
    const std::string node = node_name(objects, callback);
    has_unnamed = has_unnamed || node.empty();
    callbacks.add((node.empty() ? "?" : node) + " " + callback_source(objects, callback), "",
                  {activity.count, activity.took.summary(), id < missed.size() ? missed[id] : 0});
  }
  text += messages.text(options) + callbacks.text(options);
  if (has_unnamed) {
    text += kUnnamed;
  }
  return text;
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
