// SPDX-License-Identifier: Apache-2.0
// Measures the latency of messages from publish() to the callback, and counts lost ones, like performance_test.
// Publishers and subscribers may be in one process or in several of one host.
//
// Parameters: msg             Array1k (default), Array4k, Array16k, Array32k, Array64k, Array256k, Array1m, Array4m
//             topic           (default test_topic)
//             rate            messages per second of each publisher (default 1000, 0: as fast as possible)
//             publishers      in this process (default 1); expected_publishers: wait for so many, anywhere (default as
//             many)
//             subscribers     likewise (default 1), expected_subscribers
//             reliability     reliable (default) or best_effort
//             durability      volatile (default) or transient_local
//             history         keep_last (default) or keep_all
//             history_depth   (default 16)
//             intra_process   deliver within the process by pointer (default false)
//             zero_copy       publish messages that are created in memory of the middleware (default false)
//             max_runtime     seconds (default 0: until interrupted)
//             ignore          seconds at the beginning that do not count (default 0)
//             logfile         .csv or .json, one row a second
#include <atomic>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <performance_test_msgs/msg/array16k.hpp>
#include <performance_test_msgs/msg/array1k.hpp>
#include <performance_test_msgs/msg/array1m.hpp>
#include <performance_test_msgs/msg/array256k.hpp>
#include <performance_test_msgs/msg/array32k.hpp>
#include <performance_test_msgs/msg/array4k.hpp>
#include <performance_test_msgs/msg/array4m.hpp>
#include <performance_test_msgs/msg/array64k.hpp>
#include <rclcpp/rclcpp.hpp>
#include <thread>
#include <utility>
#include <vector>

#include "latency_statistics.hpp"
#include "log_file.hpp"
#include "settings.hpp"

namespace performance_test {

namespace {

using std::chrono::steady_clock;

int64_t monotonic_now() {
  return std::chrono::duration_cast<std::chrono::nanoseconds>(steady_clock::now().time_since_epoch()).count();
}

// Counts of publishers and subscriptions. Thread safe.
class Counts {
 public:
  void sent() { ++sent_; }

  // `last_id` belongs to the subscription and this publisher.
  void received(int64_t sent_at, uint64_t id, uint64_t& last_id, size_t bytes) {
    const int64_t latency = monotonic_now() - sent_at;
    const std::lock_guard lock(mutex_);
    latencies_.push_back(latency);
    bytes_ += bytes;
    // Messages sent before the first received one are not lost: the subscription was not discovered yet.
    if (last_id != 0 && id > last_id + 1) {
      lost_ += id - last_id - 1;
    }
    last_id = id;
  }

  // Returns the counts and latencies since the last call.
  Interval take(std::vector<int64_t>& latencies) {
    Interval interval;
    interval.sent = sent_.exchange(0);
    latencies.clear();
    {
      const std::lock_guard lock(mutex_);
      latencies.swap(latencies_);
      interval.lost = std::exchange(lost_, 0);
      interval.bytes_received = std::exchange(bytes_, 0);
    }
    interval.received = latencies.size();
    interval.latency = summarize(latencies);
    return interval;
  }

 private:
  std::atomic<uint64_t> sent_{0};
  std::mutex mutex_;
  std::vector<int64_t> latencies_;
  uint64_t lost_ = 0;
  uint64_t bytes_ = 0;
};

// Publishers and subscriptions of one message type.
class Endpoints {
 public:
  virtual ~Endpoints() = default;
  // Whether all endpoints have discovered each other.
  virtual bool matched() const = 0;
  // Publishes until `stop`. Each publisher has a thread.
  virtual void publish(size_t publisher, const std::atomic_bool& stop) = 0;
};

template <typename MessageT>
class TypedEndpoints : public Endpoints {
 public:
  TypedEndpoints(rclcpp::Node& node, const Settings& settings, Counts& counts) : settings_(settings), counts_(counts) {
    const auto intra_process =
        settings.intra_process ? rclcpp::IntraProcessSetting::Enable : rclcpp::IntraProcessSetting::Disable;
    rclcpp::SubscriptionOptions subscription_options;
    subscription_options.use_intra_process_comm = intra_process;
    for (int i = 0; i < settings.subscribers; ++i) {
      subscriptions_.push_back(node.create_subscription<MessageT>(
          settings.topic, settings.qos,
          [&counts, last_ids = std::map<uint64_t, uint64_t>()](const MessageT& message) mutable {
            counts.received(message.time, message.id, last_ids[message.publisher], sizeof(MessageT));
          },
          subscription_options));
    }
    rclcpp::PublisherOptions publisher_options;
    publisher_options.use_intra_process_comm = intra_process;
    for (int i = 0; i < settings.publishers; ++i) {
      publishers_.push_back(node.create_publisher<MessageT>(settings.topic, settings.qos, publisher_options));
    }
  }

  bool matched() const override {
    for (const auto& publisher : publishers_) {
      if (publisher->get_subscription_count() < static_cast<size_t>(settings_.expected_subscribers)) {
        return false;
      }
    }
    for (const auto& subscription : subscriptions_) {
      if (subscription->get_publisher_count() < static_cast<size_t>(settings_.expected_publishers)) {
        return false;
      }
    }
    return true;
  }

  void publish(size_t publisher, const std::atomic_bool& stop) override {
    const bool paced = settings_.rate > 0;
    const auto period = std::chrono::nanoseconds(paced ? static_cast<int64_t>(1e9 / settings_.rate) : 0);
    const auto message = std::make_unique<MessageT>();  // too large for the stack
    auto next = steady_clock::now();
    for (uint64_t id = 1; !stop; ++id) {
      publish_one(*publishers_[publisher], *message, publisher, id);
      counts_.sent();
      if (paced) {
        next += period;
        std::this_thread::sleep_until(next);
      }
    }
  }

 private:
  void publish_one(rclcpp::Publisher<MessageT>& publisher, MessageT& own, size_t number, uint64_t id) {
    const auto stamp = [number, id](MessageT& message) {
      message.publisher = number;
      message.id = id;
      message.time = monotonic_now();
    };
    if (settings_.zero_copy) {
      auto loan = publisher.borrow_loaned_message();
      stamp(loan.get());
      publisher.publish(std::move(loan));
    } else if (settings_.intra_process) {
      auto message = std::make_unique<MessageT>(rosidl_runtime_cpp::MessageInitialization::SKIP);
      stamp(*message);
      publisher.publish(std::move(message));
    } else {
      stamp(own);
      publisher.publish(own);
    }
  }

  const Settings& settings_;
  Counts& counts_;
  std::vector<typename rclcpp::Publisher<MessageT>::SharedPtr> publishers_;
  std::vector<typename rclcpp::Subscription<MessageT>::SharedPtr> subscriptions_;
};

template <typename MessageT>
std::unique_ptr<Endpoints> create(rclcpp::Node& node, const Settings& settings, Counts& counts) {
  return std::make_unique<TypedEndpoints<MessageT>>(node, settings, counts);
}

std::unique_ptr<Endpoints> create_endpoints(rclcpp::Node& node, const Settings& settings, Counts& counts) {
  using namespace performance_test_msgs::msg;
  using Create = std::unique_ptr<Endpoints> (*)(rclcpp::Node&, const Settings&, Counts&);
  static const std::pair<const char*, Create> types[] = {
      {"Array1k", create<Array1k>},   {"Array4k", create<Array4k>},   {"Array16k", create<Array16k>},
      {"Array32k", create<Array32k>}, {"Array64k", create<Array64k>}, {"Array256k", create<Array256k>},
      {"Array1m", create<Array1m>},   {"Array4m", create<Array4m>},
  };
  std::string known;
  for (const auto& [name, function] : types) {
    if (settings.msg == name) {
      return function(node, settings, counts);
    }
    known += (known.empty() ? "" : ", ") + std::string(name);
  }
  throw std::invalid_argument("parameter 'msg' is '" + settings.msg + "': it must be one of " + known);
}

void add(Interval& whole, const Interval& interval) {
  whole.sent += interval.sent;
  whole.received += interval.received;
  whole.lost += interval.lost;
  whole.bytes_received += interval.bytes_received;
}

void print(const char* label, const Interval& interval) {
  const LatencySummary& latency = interval.latency;
  std::printf(
      "%-8s sent %lu, received %lu, lost %lu, %.1f MiB/s; latency ms: min %.4f mean %.4f p50 %.4f p90 %.4f "
      "p99 %.4f p99.9 %.4f max %.4f\n",
      label, interval.sent, interval.received, interval.lost,
      interval.length > 0 ? static_cast<double>(interval.bytes_received) / interval.length / 1048576 : 0, latency.min,
      latency.mean, latency.median, latency.p90, latency.p99, latency.p999, latency.max);
  std::fflush(stdout);
}

// Reads the counts every second until the end of the run.
class Recorder {
 public:
  Recorder(const Settings& settings, Counts& counts) : settings_(settings), counts_(counts), log_file_(settings) {}

  void start() { start_ = last_ = steady_clock::now(); }

  // Returns false when the run is over.
  bool record() {
    const auto now = steady_clock::now();
    std::vector<int64_t> latencies;
    Interval interval = counts_.take(latencies);
    interval.end = seconds(now - start_);
    interval.length = seconds(now - last_);
    last_ = now;
    // Uses the middle of the interval, because the timer is never quite on time.
    if (interval.end - interval.length / 2 > settings_.ignore) {
      add(whole_, interval);
      whole_.length += interval.length;
      whole_.end = interval.end;
      all_latencies_.insert(all_latencies_.end(), latencies.begin(), latencies.end());
      char label[16];
      std::snprintf(label, sizeof(label), "%.0f s", interval.end);
      print(label, interval);
      log_file_.add(interval);
    }
    return settings_.max_runtime == 0 || interval.end < settings_.max_runtime;
  }

  void finish() {
    whole_.latency = summarize(std::move(all_latencies_));
    print("total", whole_);
    log_file_.finish(whole_);
  }

 private:
  static double seconds(steady_clock::duration duration) { return std::chrono::duration<double>(duration).count(); }

  const Settings& settings_;
  Counts& counts_;
  LogFile log_file_;
  steady_clock::time_point start_;
  steady_clock::time_point last_;
  Interval whole_;
  std::vector<int64_t> all_latencies_;
};

void run(const rclcpp::Node::SharedPtr& node) {
  const Settings settings = read_settings(*node);
  Counts counts;
  const std::unique_ptr<Endpoints> endpoints = create_endpoints(*node, settings, counts);
  Recorder recorder(settings, counts);

  rclcpp::executors::SingleThreadedExecutor executor;
  executor.add_node(node);
  // Discovery does not wake an executor, so this timer does.
  const auto look_again = node->create_wall_timer(std::chrono::milliseconds(20), [] {});
  while (rclcpp::ok() && !endpoints->matched()) {
    executor.spin_once();
  }
  look_again->cancel();

  std::atomic_bool stop{false};
  std::vector<std::thread> threads;
  recorder.start();
  for (int i = 0; i < settings.publishers; ++i) {
    threads.emplace_back([&, i] {
      try {
        endpoints->publish(static_cast<size_t>(i), stop);
      } catch (const std::exception& error) {
        RCLCPP_ERROR(node->get_logger(), "publishing has failed: %s", error.what());
        rclcpp::shutdown();
      }
    });
  }
  const auto timer = node->create_wall_timer(std::chrono::seconds(1), [&] {
    if (!recorder.record()) {
      executor.cancel();
    }
  });
  executor.spin();
  stop = true;
  for (std::thread& thread : threads) {
    thread.join();
  }
  recorder.finish();
}

}  // namespace

}  // namespace performance_test

int main(int argc, char** argv) {
  try {
    rclcpp::init(argc, argv);
    performance_test::run(std::make_shared<rclcpp::Node>("perf_test"));
    rclcpp::shutdown();
  } catch (const std::exception& error) {
    std::fprintf(stderr, "perf_test: %s\n", error.what());
    return EXIT_FAILURE;
  }
}
