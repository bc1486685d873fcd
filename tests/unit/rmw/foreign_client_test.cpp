// SPDX-License-Identifier: Apache-2.0
// A service answers clients of other DDS programs, which do not name the reader of their responses (micro-ROS agents).

#include <cstring>
#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/SampleInfo.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <fastdds/dds/topic/Topic.hpp>
#include <fastdds/dds/topic/TypeSupport.hpp>
#include <thread>
#include <vector>

#include "bytes_type.hpp"
#include "example_interfaces/srv/add_two_ints.hpp"
#include "fastdds_versions/delivery.hpp"
#include "fastdds_versions/writer.hpp"
#include "rmw_test.hpp"
#include "rosidl_typesupport_cpp/service_type_support.hpp"
#include "tests/support/emulated.hpp"
#include "tests/support/sandbox.hpp"

namespace {

namespace fdds = eprosima::fastdds::dds;
namespace rtps = rmw_fastrtps::rtps;

using example_interfaces::srv::AddTwoInts;

constexpr uint32_t kDomain = 43;

// A request or a response as CDR: a header for little endian, then 64-bit integers.
std::vector<uint8_t> cdr(const std::vector<int64_t>& values) {
  std::vector<uint8_t> bytes = {0, 1, 0, 0};
  bytes.resize(4 + values.size() * sizeof(int64_t));
  std::memcpy(bytes.data() + 4, values.data(), values.size() * sizeof(int64_t));
  return bytes;
}

template <typename ConditionT>
void wait_for(ConditionT condition) {
  const auto deadline = std::chrono::steady_clock::now() + std::chrono::seconds(60);
  while (!condition()) {
    ASSERT_LT(std::chrono::steady_clock::now(), deadline);
    std::this_thread::yield();
  }
}

class ForeignClient : public testing::Test {
 protected:
  void SetUp() override { NEEDS_NETWORK_DEVICES(); }

  ForeignClient() {
    // Serialized bytes must work between the two sides as between processes.
    rmw_fastrtps::turn_off_delivery_within_the_process();
    participant_ =
        fdds::DomainParticipantFactory::get_instance()->create_participant(kDomain, fdds::PARTICIPANT_QOS_DEFAULT);
    fdds::DataWriterQos writer_qos = fdds::DATAWRITER_QOS_DEFAULT;
    writer_qos.endpoint().history_memory_policy = rtps::PREALLOCATED_WITH_REALLOC_MEMORY_MODE;
    writer_ = participant_->create_publisher(fdds::PUBLISHER_QOS_DEFAULT)
                  ->create_datawriter(topic("rq/addRequest", "example_interfaces::srv::dds_::AddTwoInts_Request_"),
                                      writer_qos);
    fdds::DataReaderQos reader_qos = fdds::DATAREADER_QOS_DEFAULT;
    reader_qos.reliability().kind = fdds::RELIABLE_RELIABILITY_QOS;
    reader_qos.endpoint().history_memory_policy = rtps::PREALLOCATED_WITH_REALLOC_MEMORY_MODE;
    reader_ = participant_->create_subscriber(fdds::SUBSCRIBER_QOS_DEFAULT)
                  ->create_datareader(topic("rr/addReply", "example_interfaces::srv::dds_::AddTwoInts_Response_"),
                                      reader_qos);
  }
  ~ForeignClient() override {
    participant_->delete_contained_entities();
    fdds::DomainParticipantFactory::get_instance()->delete_participant(participant_);
  }

  fdds::Topic* topic(const char* name, const char* type) {
    fdds::TypeSupport(new rmw_test::Bytes(type)).register_type(participant_);
    return participant_->create_topic(name, type, fdds::TOPIC_QOS_DEFAULT);
  }

  static rmw_service_t* create_service(const rmw_test::Node& node) {
    return rmw_create_service(node.handle, rosidl_typesupport_cpp::get_service_type_support_handle<AddTwoInts>(),
                              "/add", &rmw_qos_profile_services_default);
  }

  // Waits for a request whose numbers have the sum 42.
  static rmw_service_info_t take_request(const rmw_service_t* service) {
    AddTwoInts::Request request;
    rmw_service_info_t info{};
    bool taken = false;
    wait_for([&] {
      EXPECT_EQ(rmw_take_request(service, &info, &request, &taken), RMW_RET_OK);
      return taken;
    });
    EXPECT_EQ(request.a + request.b, 42);
    return info;
  }

  test_support::Sandbox sandbox_;
  fdds::DomainParticipant* participant_;
  fdds::DataWriter* writer_;
  fdds::DataReader* reader_;
};

TEST_F(ForeignClient, IsAnsweredWithTheIdentityOfItsRequest) {
  rmw_test::Context context(kDomain);
  rmw_test::Node node(context);
  rmw_service_t* service = create_service(node);
  ASSERT_NE(service, nullptr) << rmw_test::take_error();
  wait_for([&] {
    fdds::PublicationMatchedStatus sending;
    fdds::SubscriptionMatchedStatus receiving;
    writer_->get_publication_matched_status(sending);
    reader_->get_subscription_matched_status(receiving);
    return sending.current_count == 1 && receiving.current_count == 1;
  });

  std::vector<uint8_t> request = cdr({40, 2});
  rtps::WriteParams sent;
  ASSERT_TRUE(rmw_fastrtps::write_sample(*writer_, &request, sent));
  rmw_service_info_t info = take_request(service);
  AddTwoInts::Response response;
  response.sum = 42;
  // The service's side of the match may come a moment later than the client's; a client repeats its request then.
  fdds::SampleInfo answer;
  std::vector<uint8_t> bytes;
  wait_for([&] {
    EXPECT_EQ(rmw_send_response(service, &info.request_id, &response), RMW_RET_OK) << rmw_test::take_error();
    return reader_->take_next_sample(&bytes, &answer) == rmw_fastrtps::return_code::kOk;
  });
  EXPECT_EQ(bytes, cdr({42}));
  EXPECT_EQ(answer.related_sample_identity, sent.sample_identity());
  EXPECT_EQ(rmw_destroy_service(node.handle, service), RMW_RET_OK);
}

// Discovery reports the two endpoints of a client in any order, and on a busy machine long after each other.
TEST_F(ForeignClient, IsAnsweredWhenItsReaderIsFoundLongAfterItsRequest) {
  fdds::SubscriberQos subscriber_qos = fdds::SUBSCRIBER_QOS_DEFAULT;
  subscriber_qos.entity_factory().autoenable_created_entities = false;
  fdds::DataReaderQos reader_qos = reader_->get_qos();
  fdds::DataReader* late_reader =
      participant_->create_subscriber(subscriber_qos)
          ->create_datareader(participant_->find_topic("rr/addReply", rmw_fastrtps::DdsDuration{1, 0}), reader_qos);
  ASSERT_NE(late_reader, nullptr);

  rmw_test::Context context(kDomain);
  rmw_test::Node node(context);
  rmw_service_t* service = create_service(node);
  ASSERT_NE(service, nullptr) << rmw_test::take_error();
  wait_for([&] {
    fdds::PublicationMatchedStatus sending;
    writer_->get_publication_matched_status(sending);
    return sending.current_count == 1;
  });
  std::vector<uint8_t> request = cdr({40, 2});
  rtps::WriteParams sent;
  sent.related_sample_identity().writer_guid() = late_reader->guid();
  ASSERT_TRUE(rmw_fastrtps::write_sample(*writer_, &request, sent));
  rmw_service_info_t info = take_request(service);
  AddTwoInts::Response response;
  response.sum = 42;
  EXPECT_EQ(rmw_send_response(service, &info.request_id, &response), RMW_RET_OK) << rmw_test::take_error();

  ASSERT_EQ(late_reader->enable(), rmw_fastrtps::return_code::kOk);
  fdds::SampleInfo answer;
  std::vector<uint8_t> bytes;
  wait_for([&] { return late_reader->take_next_sample(&bytes, &answer) == rmw_fastrtps::return_code::kOk; });
  EXPECT_EQ(bytes, cdr({42}));
  EXPECT_EQ(answer.related_sample_identity.writer_guid(), late_reader->guid());
  EXPECT_EQ(answer.related_sample_identity.sequence_number(), sent.sample_identity().sequence_number());
  EXPECT_EQ(rmw_destroy_service(node.handle, service), RMW_RET_OK);
}

}  // namespace
