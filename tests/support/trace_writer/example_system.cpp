// SPDX-License-Identifier: Apache-2.0
#include "tests/support/trace_writer/example_system.hpp"

#include <optional>

#include "tests/support/trace_writer/scheduler_writer.hpp"
#include "tests/support/trace_writer/trace_writer.hpp"

namespace tracing::testing {

namespace {

using namespace ros2;

constexpr Thread kSensor{101, 101, "sensor"};
constexpr Thread kFilter{102, 102, "filter"};
constexpr Thread kDisplay{103, 103, "display"};
constexpr Thread kLauncher{100, 100, "launch"};
constexpr Thread kStress{90, 90, "stress"};
constexpr Thread kIdle{0, 0, "swapper/1"};

// Handles of the three processes may be equal; each has one object of a kind.
enum : Handle {
  kContext = 0x100,
  kNode,
  kRmwNode,
  kPublisher,
  kRmwPublisher,
  kSubscription,
  kRmwSubscription,
  kObject,
  kTimer,
  kCallback,
  kStateMachine,
  kMessage,
};

constexpr std::int64_t us(std::int64_t microseconds) {
  return microseconds * 1000;
}

class Example {
 public:
  Example(const std::filesystem::path& directory, ExampleEvents events, const ExampleVariant& variant)
      : writer_(directory, {.packet_size = 1 << 20}),
        has_scheduler_(events == ExampleEvents::kRosAndScheduler),
        variant_(variant) {}

  void begin() {
    if (!variant_.is_older) {
      exec(kSensor, "sensor-1", 3, -30'000'000);
      exec(kFilter, "filter-2", 4, -28'000'000);
      exec(kDisplay, "display-3", 5, -us(1));
    }
    node(kSensor, 0, "sensor");
    publisher(kSensor, us(100), "/scan");
    write(kSensor, us(200), RclTimerInit{kTimer, kExamplePeriod});
    write(kSensor, us(210), RclcppTimerCallbackAdded{kTimer, kCallback});
    write(kSensor, us(220), RclcppCallbackRegister{kCallback, "Sensor::on_timer()"});
    write(kSensor, us(230), RclcppTimerLinkNode{kTimer, kNode});
    node(kFilter, us(1000), "filter");
    publisher(kFilter, us(1100), "/points");
    subscription(kFilter, us(1200), "/scan", "Filter::on_scan(sensor_msgs::msg::LaserScan const&)");
    if (variant_.has_links) {
      write(kFilter, us(1300), MessageLinkPeriodicAsync{{kSubscription}, {kPublisher}});
    }
    node(kDisplay, us(2000), "display");
    subscription(kDisplay, us(2200), "/points", "Display::on_points(sensor_msgs::msg::PointCloud2 const&)");
    write(kDisplay, us(2300), RclLifecycleStateMachineInit{kNode, kStateMachine});
    write(kDisplay, us(5000), RclLifecycleTransition{kStateMachine, "unconfigured", "configuring"});
    write(kDisplay, us(8000), RclLifecycleTransition{kStateMachine, "configuring", "inactive"});
    write(kDisplay, us(9000), RclLifecycleTransition{kStateMachine, "inactive", "activating"});
    write(kDisplay, us(9500), RclLifecycleTransition{kStateMachine, "activating", "active"});
    for (const Thread& thread : {kSensor, kFilter, kDisplay}) {
      write(thread, us(10'000), RclcppExecutorGetNextReady{});
    }
    switches(us(11'000), kFilter, 1, kIdle);
  }

  void cycle(std::uint64_t number) {
    const std::int64_t begin = kExampleFirstCycle - kExampleBegin + static_cast<std::int64_t>(number) * kExamplePeriod;
    const std::int64_t late = number % 10 == 9 ? us(1000) : 0;
    const std::int64_t work = number % 20 == 19 ? us(4000) : us(variant_.usual_us);
    const std::int64_t scan = begin + late + us(100);
    const std::int64_t points = begin + late + us(300) + work - us(100);
    execute(kSensor, begin + late, kTimer);
    write(kSensor, begin + late, CallbackStart{kCallback, false});
    publish(kSensor, scan);
    finish(kSensor, begin + late + us(200));
    wakes(scan + us(130), kFilter);
    switches(scan + us(140), kIdle, 0, kFilter);
    take(kFilter, scan + us(150), scan);
    const std::int64_t filter = scan + us(200);
    write(kFilter, filter, CallbackStart{kCallback, false});
    if (work == us(4000)) {
      switches(filter + us(300), kFilter, 0, kStress);
      switches(filter + us(3800), kStress, 0, kFilter);
    } else {
      switches(filter + us(50), kFilter, 1, kIdle);
      wakes(filter + us(150), kFilter);
      switches(filter + us(170), kIdle, 0, kFilter);
    }
    publish(kFilter, points);
    finish(kFilter, filter + work);
    switches(filter + work + us(10), kFilter, 1, kIdle);
    if (number % 50 == 49) {
      return;
    }
    take(kDisplay, points + us(150), points);
    write(kDisplay, points + us(200), CallbackStart{kCallback, false});
    finish(kDisplay, points + us(250));
  }

  void end() { writer_.finish(); }

 private:
  template <class Event>
  void write(const Thread& thread, std::int64_t after, const Event& event) {
    writer_.write(static_cast<unsigned>(thread.vpid - kSensor.vpid), kExampleBegin + after, thread, event);
  }

  // On the processor of kFilter.
  void switches(std::int64_t after, const Thread& previous, std::int64_t state, const Thread& next) {
    if (has_scheduler_) {
      scheduler_.switches(kCpu, kExampleBegin + after, previous, state, next);
    }
  }
  void wakes(std::int64_t after, const Thread& woken) {
    if (has_scheduler_) {
      scheduler_.wakes(kCpu, kExampleBegin + after, kIdle, woken);
    }
  }

  // The launcher started the process `after` nanoseconds after the begin. It is recorded right before the begin.
  void exec(const Thread& thread, std::string_view process, std::uint32_t line, std::int64_t after) {
    static constexpr std::int64_t kUptime = 1'000'000'000;  // CLOCK_MONOTONIC at the begin
    if (!exec_) {
      exec_ = writer_.declare("launch:exec",
                              "\t\tinteger { size = 64; align = 8; signed = 1; } _time;\n\t\tstring _process;\n"
                              "\t\tinteger { size = 32; align = 8; signed = 1; } _pid;\n\t\tstring _file;\n"
                              "\t\tinteger { size = 32; align = 8; signed = 0; } _line;\n");
    }
    std::string payload;
    detail::append(payload, kUptime + after);
    payload.append(process).push_back('\0');
    detail::append(payload, static_cast<std::int32_t>(thread.vpid));
    payload.append("/examples/system.launch.xml").push_back('\0');
    detail::append(payload, line);
    writer_.write_raw(3, kExampleBegin - us(1), kLauncher, *exec_, payload);
  }

  void node(const Thread& thread, std::int64_t after, std::string_view name) {
    write(thread, after, RclInit{kContext, variant_.is_older ? "6.3.2" : "8.10.1"});
    write(thread, after + us(10), RclNodeInit{kNode, kRmwNode, name, "/"});
  }

  void publisher(const Thread& thread, std::int64_t after, std::string_view topic) {
    write(thread, after, RmwPublisherInit{kRmwPublisher, {}});
    write(thread, after + us(10), RclPublisherInit{kPublisher, kNode, kRmwPublisher, topic, 10});
  }

  void subscription(const Thread& thread, std::int64_t after, std::string_view topic, std::string_view symbol) {
    write(thread, after, RmwSubscriptionInit{kRmwSubscription, {}});
    write(thread, after + us(10), RclSubscriptionInit{kSubscription, kNode, kRmwSubscription, topic, 10});
    write(thread, after + us(20), RclcppSubscriptionInit{kSubscription, kObject});
    write(thread, after + us(30), RclcppSubscriptionCallbackAdded{kObject, kCallback});
    write(thread, after + us(40), RclcppCallbackRegister{kCallback, symbol});
  }

  void execute(const Thread& thread, std::int64_t after, Handle what) {
    write(thread, after - us(2), RclcppExecutorGetNextReady{});
    write(thread, after - us(1), RclcppExecutorExecute{what});
  }

  void publish(const Thread& thread, std::int64_t published) {
    write(thread, published - us(5), RclcppPublish{kMessage});
    write(thread, published - us(3), RclPublish{kPublisher, kMessage});
    if (variant_.is_older) {
      publish_as_before(thread, published);
    } else {
      write(thread, published, RmwPublish{kRmwPublisher, kMessage, kExampleBegin + published});
    }
    if (variant_.has_writes) {
      if (!dds_write_) {
        dds_write_ = writer_.declare("dds:write",
                                     "\t\tinteger { size = 64; align = 8; signed = 0; } _writer;\n"
                                     "\t\tinteger { size = 64; align = 8; signed = 1; } _timestamp;\n");
      }
      std::string payload;
      detail::append(payload, std::uint64_t{kRmwPublisher});
      detail::append(payload, kExampleBegin + published);
      writer_.write_raw(static_cast<unsigned>(thread.vpid - kSensor.vpid), kExampleBegin + published + us(3), thread,
                        *dds_write_, payload);
    }
  }

  // As ros2_tracing before 8.0.
  void publish_as_before(const Thread& thread, std::int64_t published) {
    if (!rmw_publish_) {
      rmw_publish_ = writer_.declare(RmwPublish::kName,
                                     "\t\tinteger { size = 64; align = 8; signed = 0; base = 16; } _message;\n");
    }
    std::string payload;
    detail::append(payload, std::uint64_t{kMessage});
    writer_.write_raw(static_cast<unsigned>(thread.vpid - kSensor.vpid), kExampleBegin + published, thread,
                      *rmw_publish_, payload);
  }

  void take(const Thread& thread, std::int64_t after, std::int64_t published) {
    const std::int64_t source = kExampleBegin + published + (variant_.is_older ? us(5) : 0);
    execute(thread, after, kSubscription);
    write(thread, after, RmwTake{kRmwSubscription, kMessage, variant_.has_source_timestamps ? source : 0, true});
    write(thread, after + us(2), RclTake{kMessage});
    write(thread, after + us(4), RclcppTake{kMessage});
  }

  void finish(const Thread& thread, std::int64_t after) {
    write(thread, after, CallbackEnd{kCallback});
    write(thread, after + us(1), RclcppExecutorWaitForWork{-1});
  }

  static constexpr unsigned kCpu = kFilter.vpid - kSensor.vpid;

  TraceWriter writer_;
  SchedulerWriter scheduler_{writer_};
  bool has_scheduler_;
  ExampleVariant variant_;
  std::optional<std::uint16_t> exec_;
  std::optional<std::uint16_t> dds_write_;
  std::optional<std::uint16_t> rmw_publish_;
};

}  // namespace

void write_example_system(const std::filesystem::path& directory, std::uint64_t cycles, ExampleEvents events,
                          const ExampleVariant& variant) {
  Example example(directory, events, variant);
  example.begin();
  for (std::uint64_t number = 0; number < cycles; ++number) {
    example.cycle(number);
  }
  example.end();
}

}  // namespace tracing::testing
