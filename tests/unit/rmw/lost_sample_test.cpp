// SPDX-License-Identifier: Apache-2.0
// A subscription whose samples get lost on the way. They come from a writer of plain Fast DDS whose transport loses the
// samples that the test chooses.
#include <atomic>
#include <condition_variable>
#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/publisher/DataWriterListener.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <fastdds/dds/topic/Topic.hpp>
#include <fastdds/dds/topic/TypeSupport.hpp>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

#include "bytes_type.hpp"
#include "fastdds_versions/delivery.hpp"
#include "fastdds_versions/lossy_transport.hpp"
#include "fastdds_versions/writer.hpp"
#include "rmw_test.hpp"
#include "std_msgs/msg/string.hpp"
#include "tests/support/emulated.hpp"
#include "tests/support/sandbox.hpp"

namespace {

namespace fdds = eprosima::fastdds::dds;
namespace rtps = rmw_fastrtps::rtps;

using rmw_test::Bytes;
using rmw_test::Context;
using rmw_test::Node;
using rmw_test::Subscription;
using std_msgs::msg::String;

constexpr uint32_t kDomain = 42;
constexpr rmw_time_t kNoWait{0, 0};

// Loses the samples of one sequence number until told otherwise, and counts the losses.
class Loss {
 public:
  bool loses(const rtps::CDRMessage_t& message) {
    // RTPS 9.4.5.3: flags, octets to inline QoS, reader, writer, sequence number. User writers end in 2 or 3.
    const rtps::octet* data = message.buffer + message.pos;
    const bool of_user = data[11] == 0x02 || data[11] == 0x03;
    const std::lock_guard lock(mutex_);
    if (!of_user || data[16] != lost_) {
      return false;
    }
    ++times_;
    changed_.notify_all();
    return true;
  }

  // 0: none.
  void lose(uint8_t sequence_number) {
    const std::lock_guard lock(mutex_);
    lost_ = sequence_number;
  }

  // Returns after this number of further losses.
  void wait_for(int more) {
    std::unique_lock lock(mutex_);
    const int until = times_ + more;
    ASSERT_TRUE(
        changed_.wait_for(lock, std::chrono::seconds(rmw_test::kPatience.sec), [&] { return times_ >= until; }));
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  uint8_t lost_ = 0;
  int times_ = 0;
};

class Matches final : public fdds::DataWriterListener {
 public:
  void on_publication_matched(fdds::DataWriter*, const fdds::PublicationMatchedStatus& info) override {
    const std::lock_guard lock(mutex_);
    count_ = info.current_count;
    changed_.notify_all();
  }
  void wait() {
    std::unique_lock lock(mutex_);
    ASSERT_TRUE(changed_.wait_for(lock, std::chrono::seconds(rmw_test::kPatience.sec), [this] { return count_ == 1; }));
  }

 private:
  std::mutex mutex_;
  std::condition_variable changed_;
  int count_ = 0;
};

class LostSample : public testing::Test {
 protected:
  void SetUp() override { NEEDS_NETWORK_DEVICES(); }

  LostSample() {
    rmw_fastrtps::turn_off_delivery_within_the_process();
    auto transport = std::make_shared<rtps::test_UDPv4TransportDescriptor>();
    transport->drop_data_messages_filter_ = [this](rtps::CDRMessage_t& message) { return loss_.loses(message); };
    fdds::DomainParticipantQos qos = fdds::PARTICIPANT_QOS_DEFAULT;
    qos.transport().use_builtin_transports = false;
    qos.transport().user_transports.push_back(transport);
    participant_ = fdds::DomainParticipantFactory::get_instance()->create_participant(kDomain, qos);
    fdds::TypeSupport(new Bytes("std_msgs::msg::dds_::String_")).register_type(participant_);
    topic_ = participant_->create_topic("rt/chatter", "std_msgs::msg::dds_::String_", fdds::TOPIC_QOS_DEFAULT);
  }
  ~LostSample() override {
    participant_->delete_contained_entities();
    fdds::DomainParticipantFactory::get_instance()->delete_participant(participant_);
  }

  fdds::DataWriter* create_writer(fdds::ReliabilityQosPolicyKind reliability) {
    fdds::DataWriterQos qos = fdds::DATAWRITER_QOS_DEFAULT;
    qos.reliability().kind = reliability;
    qos.history().depth = 10;
    rmw_fastrtps::heartbeat_period(qos) = rmw_fastrtps::DdsDuration(0, 10000000);
    fdds::Publisher* publisher = participant_->create_publisher(fdds::PUBLISHER_QOS_DEFAULT);
    return publisher->create_datawriter(topic_, qos, &matches_);
  }

  // Returns when both ends know each other.
  void wait_for_match(const Subscription<String>& subscription) {
    matches_.wait();
    const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(rmw_test::kPatience.sec);
    while (subscription.matched() == 0) {
      ASSERT_LT(std::chrono::steady_clock::now(), deadline) << "the endpoints do not match";
      std::this_thread::yield();
    }
  }

  static void write(fdds::DataWriter& writer, const char* text) {
    String message;
    message.data = text;
    rmw_serialized_message_t serialized = rmw_get_zero_initialized_serialized_message();
    const rcutils_allocator_t allocator = rcutils_get_default_allocator();
    ASSERT_EQ(rmw_serialized_message_init(&serialized, 0, &allocator), RMW_RET_OK);
    ASSERT_EQ(rmw_serialize(&message, rosidl_typesupport_cpp::get_message_type_support_handle<String>(), &serialized),
              RMW_RET_OK);
    std::vector<uint8_t> bytes(serialized.buffer, serialized.buffer + serialized.buffer_length);
    ASSERT_EQ(rmw_serialized_message_fini(&serialized), RMW_RET_OK);
    rtps::WriteParams params;
    ASSERT_TRUE(rmw_fastrtps::write_sample(writer, &bytes, params));
  }

  test_support::Sandbox sandbox_;
  Loss loss_;
  Matches matches_;
  fdds::DomainParticipant* participant_ = nullptr;
  fdds::Topic* topic_ = nullptr;
};

TEST_F(LostSample, LeavesAReliableSubscriptionNotReadyUntilItIsResent) {
  Context context(kDomain);
  Node node(context);
  Subscription<String> subscription(node, "/chatter");
  fdds::DataWriter* writer = create_writer(fdds::RELIABLE_RELIABILITY_QOS);
  wait_for_match(subscription);

  loss_.lose(1);
  write(*writer, "first");
  write(*writer, "second");
  loss_.wait_for(3);  // it was requested again and lost again, long after the second sample arrived
  String message;
  if (subscription.wait(kNoWait) == RMW_RET_OK) {  // one wake-up without a sample is allowed, but no more
    EXPECT_FALSE(subscription.take(message));
  }
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(subscription.wait(kNoWait), RMW_RET_TIMEOUT);
    loss_.wait_for(1);
  }

  loss_.lose(0);
  EXPECT_EQ(subscription.next().data, "first");
  EXPECT_EQ(subscription.next().data, "second");
  EXPECT_EQ(subscription.wait(kNoWait), RMW_RET_TIMEOUT);
}

TEST_F(LostSample, IsToldOnceByABestEffortSubscriptionThatGoesOn) {
  Context context(kDomain);
  Node node(context);
  Subscription<String> subscription(node, "/chatter", rmw_qos_profile_sensor_data);
  rmw_event_t lost = rmw_get_zero_initialized_event();
  ASSERT_EQ(rmw_subscription_event_init(&lost, subscription.handle, RMW_EVENT_MESSAGE_LOST), RMW_RET_OK);
  fdds::DataWriter* writer = create_writer(fdds::BEST_EFFORT_RELIABILITY_QOS);
  wait_for_match(subscription);

  write(*writer, "first");
  EXPECT_EQ(subscription.next().data, "first");
  loss_.lose(2);
  write(*writer, "second");
  write(*writer, "third");
  EXPECT_EQ(subscription.next().data, "third");

  rmw_wait_set_t* wait_set = rmw_create_wait_set(&context.handle, 1);
  void* event = lost.data;
  rmw_events_t events{1, &event};
  EXPECT_EQ(rmw_wait(nullptr, nullptr, nullptr, nullptr, &events, wait_set, &rmw_test::kPatience), RMW_RET_OK);
  rmw_message_lost_status_t status{};
  bool taken = false;
  ASSERT_EQ(rmw_take_event(&lost, &status, &taken), RMW_RET_OK);
  EXPECT_TRUE(taken);
  EXPECT_EQ(status.total_count, 1u);
  EXPECT_EQ(status.total_count_change, 1u);
  event = lost.data;
  EXPECT_EQ(rmw_wait(nullptr, nullptr, nullptr, nullptr, &events, wait_set, &kNoWait), RMW_RET_TIMEOUT);
  EXPECT_EQ(event, nullptr);
  EXPECT_EQ(rmw_destroy_wait_set(wait_set), RMW_RET_OK);
  EXPECT_EQ(rmw_event_fini(&lost), RMW_RET_OK);
}

}  // namespace
