// SPDX-License-Identifier: Apache-2.0
// Two nodes between which a network loses packets, for counted_losses_test.py. `radio_worker sender` publishes on two
// topics until the receiver has got enough of both. `radio_worker receiver` prints what it lacks, as a line of JSON for
// each topic.
#include <cstdio>
#include <memory>
#include <rclcpp/rclcpp.hpp>
#include <set>
#include <std_msgs/msg/int64.hpp>
#include <string>

using std_msgs::msg::Int64;

namespace {

constexpr std::size_t kEnough = 150;  // of each topic
constexpr std::size_t kAll = 10'000;  // more than come before they are taken

class Sender : public rclcpp::Node {
 public:
  Sender() : Node("sender") {
    // It keeps one message: a newer one takes the place of one that was lost and not repeated yet.
    reliable_ = create_publisher<Int64>("reliable", rclcpp::QoS(1));
    best_effort_ = create_publisher<Int64>("best_effort", rclcpp::QoS(1).best_effort());
    done_ =
        create_subscription<Int64>("done", rclcpp::QoS(1).transient_local(), [](const Int64&) { rclcpp::shutdown(); });
    timer_ = create_wall_timer(std::chrono::milliseconds(5), [this] { send(); });
  }

 private:
  void send() {
    if (reliable_->get_subscription_count() == 0 || best_effort_->get_subscription_count() == 0) {
      return;
    }
    constexpr int kBurst = 5;  // faster than a message can be repeated
    for (int i = 0; i < kBurst; ++i) {
      Int64 message;
      message.data = ++sent_;
      reliable_->publish(message);
      best_effort_->publish(message);
    }
  }

  std::int64_t sent_ = 0;
  rclcpp::Publisher<Int64>::SharedPtr reliable_;
  rclcpp::Publisher<Int64>::SharedPtr best_effort_;
  rclcpp::Subscription<Int64>::SharedPtr done_;
  rclcpp::TimerBase::SharedPtr timer_;
};

class Receiver : public rclcpp::Node {
 public:
  Receiver() : Node("receiver") {
    done_ = create_publisher<Int64>("done", rclcpp::QoS(1).transient_local());
    reliable_.subscription = create_subscription<Int64>("reliable", rclcpp::QoS(kAll),
                                                        [this](const Int64& message) { receive(reliable_, message); });
    best_effort_.subscription =
        create_subscription<Int64>("best_effort", rclcpp::QoS(kAll).best_effort(),
                                   [this](const Int64& message) { receive(best_effort_, message); });
  }
  ~Receiver() override {
    for (const Received& received : {reliable_, best_effort_}) {
      std::printf("{\"topic\": \"%s\", \"received\": %zu, \"missing\": %ld}\n", received.subscription->get_topic_name(),
                  received.numbers.size(),
                  static_cast<long>(*received.numbers.rbegin() - *received.numbers.begin() + 1) -
                      static_cast<long>(received.numbers.size()));
    }
  }

 private:
  struct Received {
    rclcpp::Subscription<Int64>::SharedPtr subscription;
    std::set<std::int64_t> numbers;
  };

  void receive(Received& received, const Int64& message) {
    received.numbers.insert(message.data);
    if (!is_done_ && reliable_.numbers.size() >= kEnough && best_effort_.numbers.size() >= kEnough) {
      is_done_ = true;
      done_->publish(Int64());
      // The sender takes it, however often it is lost on the way, and ends.
      graph_ = create_wall_timer(std::chrono::milliseconds(10), [this] {
        if (count_publishers("/reliable") == 0) {
          rclcpp::shutdown();
        }
      });
    }
  }

  bool is_done_ = false;
  Received reliable_;
  Received best_effort_;
  rclcpp::Publisher<Int64>::SharedPtr done_;
  rclcpp::TimerBase::SharedPtr graph_;
};

}  // namespace

int main(int argc, char** argv) {
  rclcpp::init(argc, argv);
  const bool sends = argc > 1 && std::string(argv[1]) == "sender";
  rclcpp::spin(sends ? std::shared_ptr<rclcpp::Node>(std::make_shared<Sender>()) : std::make_shared<Receiver>());
  rclcpp::shutdown();
}
