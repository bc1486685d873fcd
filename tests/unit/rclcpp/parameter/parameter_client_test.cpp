// SPDX-License-Identifier: Apache-2.0
// Parameters of one node, read and changed from another.
#include <fstream>
#include <thread>

#include "tests/unit/rclcpp/ros_test.hpp"

namespace {

// The owner of the parameters in an executor of its own, and a node that asks.
class ParameterClient : public RosTest {
 protected:
  ParameterClient() {
    owner_->declare_parameter("speed", 1.5);
    owner_->declare_parameter("wheels.count", 4);
    executor_.add_node(owner_);
    thread_ = std::thread([this] { executor_.spin(); });
  }
  ~ParameterClient() override {
    rclcpp::shutdown();
    thread_.join();
  }

  // The path of a new file.
  std::string write(const char* name, const char* text) const {
    const std::string file = (sandbox_.directory() / name).string();
    std::ofstream(file) << text;
    return file;
  }

  rclcpp::Node::SharedPtr owner_ = std::make_shared<rclcpp::Node>("owner", "ns");
  rclcpp::Node::SharedPtr asker_ = std::make_shared<rclcpp::Node>("asker");
  rclcpp::executors::SingleThreadedExecutor executor_;
  std::thread thread_;
};

TEST_F(ParameterClient, ReadsAndChangesParametersOfAnotherNode) {
  rclcpp::SyncParametersClient client(asker_, "/ns/owner");
  ASSERT_TRUE(client.wait_for_service(kPatience));
  EXPECT_EQ(client.get_parameter<double>("speed"), 1.5);
  EXPECT_EQ(client.get_parameters({"wheels.count"}, kPatience).at(0).as_int(), 4);
  EXPECT_EQ(client.get_parameter_types({"speed", "wheels.count"}),
            (std::vector<rclcpp::ParameterType>{rclcpp::PARAMETER_DOUBLE, rclcpp::PARAMETER_INTEGER}));
  EXPECT_TRUE(client.has_parameter("speed"));
  EXPECT_FALSE(client.has_parameter("height"));
  EXPECT_EQ(client.list_parameters({"wheels"}, 0).names, std::vector<std::string>{"wheels.count"});
  EXPECT_EQ(client.describe_parameters({"speed"}).at(0).name, "speed");

  EXPECT_TRUE(client.set_parameters({rclcpp::Parameter("speed", 2.5)}).at(0).successful);
  EXPECT_EQ(owner_->get_parameter("speed").as_double(), 2.5);
  EXPECT_TRUE(client.set_parameters_atomically({rclcpp::Parameter("speed", 3.0)}).successful);
  EXPECT_EQ(owner_->get_parameter("speed").as_double(), 3.0);
}

TEST_F(ParameterClient, LoadsWhatAFileHoldsForTheOtherNode) {
  const std::string file = write("parameters.yaml",
                                 "/**:\n  ros__parameters: {speed: 0.5}\n"
                                 "ns/owner:\n  ros__parameters: {wheels: {count: 6}}\n"
                                 "elsewhere:\n  ros__parameters: {speed: 9.0}\n");
  rclcpp::SyncParametersClient client(asker_, "/ns/owner");
  ASSERT_TRUE(client.wait_for_service(kPatience));
  const auto results = client.load_parameters(file);
  ASSERT_EQ(results.size(), 2u);
  EXPECT_TRUE(results[0].successful && results[1].successful);
  EXPECT_EQ(owner_->get_parameter("speed").as_double(), 0.5);
  EXPECT_EQ(owner_->get_parameter("wheels.count").as_int(), 6);

  const rclcpp::ParameterMap map = rclcpp::parameter_map_from_yaml_file(file);
  EXPECT_EQ(map.size(), 3u);
  EXPECT_EQ(map.at("/elsewhere"), std::vector<rclcpp::Parameter>{rclcpp::Parameter("speed", 9.0)});
  EXPECT_EQ(rclcpp::parameters_from_map(map, "/elsewhere").size(), 2u);
}

TEST_F(ParameterClient, FilesThatCannotBeLoadedSayWhy) {
  const std::string of_another = write("another.yaml", "elsewhere:\n  ros__parameters: {speed: 9.0}\n");
  rclcpp::SyncParametersClient client(asker_, "/ns/owner");
  try {
    client.load_parameters(of_another);
    FAIL();
  } catch (const rclcpp::exceptions::InvalidParametersException& error) {
    EXPECT_STREQ(error.what(), "there are no parameters for node '/ns/owner'");
  }
  const std::string wrong = write("wrong.yaml", "owner: 3\n");
  EXPECT_THROW(client.load_parameters(wrong), rclcpp::exceptions::RCLError);
  EXPECT_THROW(rclcpp::parameter_map_from_yaml_file("/nowhere.yaml"), rclcpp::exceptions::RCLError);
}

TEST_F(ParameterClient, RefusalsSayWhy) {
  rclcpp::SyncParametersClient client(asker_, "/ns/owner");
  ASSERT_TRUE(client.wait_for_service(kPatience));
  EXPECT_TRUE(client.get_parameters({"height"}).empty());
  EXPECT_THROW(client.get_parameter<int64_t>("height"), std::runtime_error);
  EXPECT_EQ(client.get_parameter<int64_t>("height", 3), 3);
  EXPECT_EQ(client.set_parameters({rclcpp::Parameter("height", 1)}).at(0).reason,
            "parameter 'height' cannot be set because it was not declared");
  EXPECT_FALSE(client.set_parameters_atomically({rclcpp::Parameter("speed", "fast")}).successful);
  EXPECT_EQ(owner_->get_parameter("speed").as_double(), 1.5);
}

TEST_F(ParameterClient, HearsOfChanges) {
  rclcpp::AsyncParametersClient client(asker_, "/ns/owner");
  std::vector<std::string> changed;
  const auto subscription = client.on_parameter_event([&](const rcl_interfaces::msg::ParameterEvent& event) {
    for (const auto& parameter : event.changed_parameters) {
      changed.push_back(event.node + ": " + parameter.name);
    }
  });
  ASSERT_TRUE(client.wait_for_service(kPatience));
  rclcpp::executors::SingleThreadedExecutor executor;
  executor.add_node(asker_);
  ASSERT_TRUE(spin_until(executor, [&] { return subscription->get_publisher_count() == 2; }));
  client.set_parameters({rclcpp::Parameter("speed", 2.5)});
  ASSERT_TRUE(spin_until(executor, [&] { return !changed.empty(); }));
  EXPECT_EQ(changed, std::vector<std::string>{"/ns/owner: speed"});
}

TEST_F(RosTest, NodeHasNoParameterServicesWhenItIsToldSo) {
  const rclcpp::Node with("with");
  const rclcpp::Node without("without", rclcpp::NodeOptions().start_parameter_services(false).append_parameter_override(
                                            "start_type_description_service", false));
  for (const char* name : {"get_parameters", "get_parameter_types", "set_parameters", "set_parameters_atomically",
                           "describe_parameters", "list_parameters", "get_type_description"}) {
    EXPECT_EQ(with.count_services(std::string("with/") + name), 1u) << name;
    EXPECT_EQ(with.count_services(std::string("without/") + name), 0u) << name;
  }
}

}  // namespace
