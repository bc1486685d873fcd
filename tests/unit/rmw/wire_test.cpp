// SPDX-License-Identifier: Apache-2.0
// Checks with a participant of plain Fast DDS how other DDS applications see us, and how we see them.

#include <algorithm>
#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/SampleInfo.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <fastdds/dds/topic/Topic.hpp>
#include <fastdds/dds/topic/TypeSupport.hpp>
#include <functional>
#include <map>
#include <mutex>
#include <random>
#include <thread>
#include <vector>

#include "bytes_type.hpp"
#include "fastdds_versions/delivery.hpp"
#include "fastdds_versions/discovery_listener.hpp"
#include "fastdds_versions/writer.hpp"
#include "rmw_dds_common/msg/participant_entities_info.hpp"
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
using rmw_test::Publisher;
using rmw_test::Subscription;

// Remembers the user data of the last participant that was found, and of the endpoints by topic.
class FoundParticipants final : public rmw_fastrtps::FoundListener {
 public:
  void endpoint_changed(const rmw_fastrtps::FoundEndpoint& endpoint) override {
    std::lock_guard lock(mutex_);
    endpoints_[endpoint.topic].assign(endpoint.user_data.begin(), endpoint.user_data.end());
  }
  void participant_changed(const rmw_fastrtps::FoundParticipant& participant) override {
    if (participant.change == rmw_fastrtps::FoundParticipant::Change::kFound) {
      std::lock_guard lock(mutex_);
      user_data_.assign(participant.user_data.begin(), participant.user_data.end());
      name_ = participant.name;
    }
  }
  std::string user_data() {
    std::lock_guard lock(mutex_);
    return user_data_;
  }
  std::string name() {
    std::lock_guard lock(mutex_);
    return name_;
  }

  // The user data of an endpoint on the DDS topic, "" if none was found.
  std::string user_data_on(const std::string& topic) {
    std::lock_guard lock(mutex_);
    return endpoints_[topic];
  }

 private:
  std::mutex mutex_;
  std::string user_data_;
  std::string name_;
  std::map<std::string, std::string> endpoints_;
};

constexpr uint32_t kDomain = 42;

class Wire : public testing::Test {
 protected:
  void SetUp() override { NEEDS_NETWORK_DEVICES(); }

  Wire() {
    // Serialized bytes must work between the two sides as between processes.
    rmw_fastrtps::turn_off_delivery_within_the_process();
    participant_ = fdds::DomainParticipantFactory::get_instance()->create_participant(
        kDomain, fdds::PARTICIPANT_QOS_DEFAULT, &found_, fdds::StatusMask::none());
  }
  ~Wire() override {
    participant_->delete_contained_entities();
    fdds::DomainParticipantFactory::get_instance()->delete_participant(participant_);
  }

  fdds::Topic* topic(const char* name, const char* type) {
    fdds::TypeSupport(new Bytes(type)).register_type(participant_);
    return participant_->create_topic(name, type, fdds::TOPIC_QOS_DEFAULT);
  }

  fdds::DataReader* reader(const char* topic_name, const char* type, bool transient_local = false) {
    fdds::DataReaderQos qos = fdds::DATAREADER_QOS_DEFAULT;
    qos.reliability().kind = fdds::RELIABLE_RELIABILITY_QOS;
    qos.durability().kind = transient_local ? fdds::TRANSIENT_LOCAL_DURABILITY_QOS : fdds::VOLATILE_DURABILITY_QOS;
    qos.history().kind = fdds::KEEP_ALL_HISTORY_QOS;
    qos.endpoint().history_memory_policy = rtps::PREALLOCATED_WITH_REALLOC_MEMORY_MODE;
    return participant_->create_subscriber(fdds::SUBSCRIBER_QOS_DEFAULT)
        ->create_datareader(topic(topic_name, type), qos);
  }

  static std::vector<uint8_t> next(fdds::DataReader* reader, fdds::SampleInfo& info) {
    std::vector<uint8_t> bytes;
    EXPECT_TRUE(reader->wait_for_unread_message({10, 0}));
    EXPECT_TRUE(reader->take_next_sample(&bytes, &info) == rmw_fastrtps::return_code::kOk);
    return bytes;
  }

  test_support::Sandbox sandbox_;
  FoundParticipants found_;
  fdds::DomainParticipant* participant_;
  Context context_{kDomain};
};

template <typename Condition>
void wait_for(Condition condition) {
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(10);
  while (!condition()) {
    ASSERT_LT(std::chrono::steady_clock::now(), deadline);
    std::this_thread::yield();
  }
}

TEST_F(Wire, MessagesHaveTheTopicTypeAndBytesOfRos) {
  fdds::DataReader* chatter = reader("rt/ns/chatter", "std_msgs::msg::dds_::String_");
  Node node(context_);
  Publisher<std_msgs::msg::String> publisher(node, "/ns/chatter");
  wait_for([&] { return publisher.matched() == 1; });
  std_msgs::msg::String message;
  message.data = "abc";
  publisher.publish(message);
  fdds::SampleInfo info;
  const std::vector<uint8_t> expected{0, 1, 0, 0, 4, 0, 0, 0, 'a', 'b', 'c', 0};
  EXPECT_EQ(next(chatter, info), expected);
  rmw_gid_t gid;
  ASSERT_EQ(rmw_get_gid_for_publisher(publisher.handle, &gid), RMW_RET_OK);
  const rtps::GUID_t writer = info.sample_identity.writer_guid();
  EXPECT_TRUE(std::equal(gid.data, gid.data + 12, writer.guidPrefix.value));
  EXPECT_TRUE(std::equal(gid.data + 12, gid.data + 16, writer.entityId.value));
}

TEST_F(Wire, ParticipantsAnnounceTheirEnclave) {
  Node node(context_);
  wait_for([&] { return !found_.user_data().empty(); });
  EXPECT_STREQ(found_.user_data().c_str(), "enclave=/;");
  EXPECT_EQ(found_.name(), "/");
}

TEST_F(Wire, EndpointsAnnounceTheDefinitionOfTheirType) {
  Node node(context_);
  const Publisher<std_msgs::msg::String> publisher(node, "/chatter");
  const Subscription<std_msgs::msg::String> subscription(node, "/heard");
  for (const char* topic : {"rt/chatter", "rt/heard"}) {
    wait_for([&] { return !found_.user_data_on(topic).empty(); });
    EXPECT_EQ(found_.user_data_on(topic),
              "typehash=RIHS01_df668c740482bbd48fb39d76a70dfd4bd59db1288021743503259e948f6b1a18;");
  }
}

TEST_F(Wire, NodesAreAnnouncedOnRosDiscoveryInfo) {
  fdds::DataReader* discovery =
      reader("ros_discovery_info", "rmw_dds_common::msg::dds_::ParticipantEntitiesInfo_", true);
  Node node(context_, "talker", "/ns");
  Publisher<std_msgs::msg::String> publisher(node, "/chatter");
  const auto* type_support =
      rosidl_typesupport_cpp::get_message_type_support_handle<rmw_dds_common::msg::ParticipantEntitiesInfo>();
  rmw_dds_common::msg::ParticipantEntitiesInfo state;
  // The last state counts; earlier ones may come before.
  do {
    fdds::SampleInfo info;
    std::vector<uint8_t> bytes = next(discovery, info);
    rmw_serialized_message_t serialized{bytes.data(), bytes.size(), bytes.size(), rcutils_get_default_allocator()};
    ASSERT_EQ(rmw_deserialize(&serialized, type_support, &state), RMW_RET_OK) << rmw_test::take_error();
    ASSERT_EQ(state.node_entities_info_seq.size(), 1u);
  } while (state.node_entities_info_seq[0].writer_gid_seq.empty());
  EXPECT_EQ(state.node_entities_info_seq[0].node_name, "talker");
  EXPECT_EQ(state.node_entities_info_seq[0].node_namespace, "/ns");
  rmw_gid_t gid;
  ASSERT_EQ(rmw_get_gid_for_publisher(publisher.handle, &gid), RMW_RET_OK);
  const auto& announced = state.node_entities_info_seq[0].writer_gid_seq[0].data;
  EXPECT_TRUE(std::equal(announced.begin(), announced.end(), gid.data));
}

TEST_F(Wire, SourceTimestampsSurviveToTheNanosecond) {
  Node node(context_);
  Subscription<std_msgs::msg::String> subscription(node, "/chatter");
  fdds::DataWriter* writer =
      participant_->create_publisher(fdds::PUBLISHER_QOS_DEFAULT)
          ->create_datawriter(topic("rt/chatter", "std_msgs::msg::dds_::String_"), fdds::DATAWRITER_QOS_DEFAULT);
  wait_for([&] {
    fdds::PublicationMatchedStatus status;
    writer->get_publication_matched_status(status);
    return status.current_count == 1 && subscription.matched() == 1;
  });
  std::mt19937_64 random(7);
  std::vector<int64_t> nanoseconds{0, 1, 2, 3, 999999998, 999999999, 500000000, 123456789};
  for (int i = 0; i < 500; ++i) {
    nanoseconds.push_back(static_cast<int64_t>(random() % 1000000000));
  }
  for (const int64_t fraction : nanoseconds) {
    const int64_t timestamp = 1767225600 * int64_t{1000000000} + fraction;
    std::vector<uint8_t> bytes{0, 1, 0, 0, 4, 0, 0, 0, 'a', 'b', 'c', 0};
    rtps::WriteParams params;
    params.source_timestamp().from_ns(timestamp);
    ASSERT_TRUE(rmw_fastrtps::write_sample(*writer, &bytes, params));
    rmw_message_info_t info;
    EXPECT_EQ(subscription.next(&info).data, "abc");
    ASSERT_EQ(info.source_timestamp, timestamp);
  }
}

TEST_F(Wire, PublishedTimestampIsThatOfTheSample) {
  fdds::DataReader* chatter = reader("rt/chatter", "std_msgs::msg::dds_::String_");
  Node node(context_);
  Publisher<std_msgs::msg::String> publisher(node, "/chatter");
  wait_for([&] { return publisher.matched() == 1; });
  rmw_time_point_value_t before = 0;
  ASSERT_EQ(rcutils_system_time_now(&before), RCUTILS_RET_OK);
  publisher.publish(std_msgs::msg::String());
  rmw_time_point_value_t after = 0;
  ASSERT_EQ(rcutils_system_time_now(&after), RCUTILS_RET_OK);
  fdds::SampleInfo info;
  (void)next(chatter, info);
  EXPECT_GE(info.source_timestamp.to_ns(), before);
  EXPECT_LE(info.source_timestamp.to_ns(), after);
}

}  // namespace
