// SPDX-License-Identifier: Apache-2.0
// Loading, unloading and listing components, in the process of the test.
#include <gmock/gmock.h>

#include <class_loader/class_loader.hpp>
#include <cstdlib>
#include <rclcpp_components/component_manager.hpp>
#include <rclcpp_components/component_manager_isolated.hpp>
#include <rclcpp_components/node_main.hpp>

#include "tests/unit/rclcpp_components/container_client.hpp"

namespace {

using testing::ElementsAre;
using testing::HasSubstr;

class ComponentManagerTest : public RosTest {
 protected:
  ComponentManagerTest() {
    const std::filesystem::path prefix = sandbox_.directory() / "prefix";
    const std::string library = TEST_COMPONENTS;
    write_components(prefix, "tested",
                     "test_components::Throwing;" + library + "\ntest_components::ThrowingNoException;" + library +
                         "\n\ntest_components::Plain;" + library + "\ntest_components::Forgotten;" + library +
                         "\ntest_components::Lost;lib/libnowhere.so\n");
    write_components(prefix, "malformed", "test_components::Plain;" + library + ";\n");
    setenv("AMENT_PREFIX_PATH", prefix.c_str(), 1);
    executor_->add_node(node_);
    executor_->add_node(manager_);
  }
  ~ComponentManagerTest() override { unsetenv("AMENT_PREFIX_PATH"); }

  std::string error_of(const std::string& package, const std::string& plugin) {
    const LoadNode::Response response = client_.load(package, plugin);
    EXPECT_FALSE(response.success);
    EXPECT_EQ(response.unique_id, 0u);
    return response.error_message;
  }

  // The value of a parameter of the component `node`, from its parameter service.
  rclcpp::Parameter parameter_of(const std::string& node, const std::string& name) {
    rclcpp::SyncParametersClient client(executor_, std::make_shared<rclcpp::Node>("reader"), node);
    EXPECT_TRUE(client.wait_for_service(kPatience));
    return client.get_parameters({name}).at(0);
  }

  const std::shared_ptr<rclcpp::executors::SingleThreadedExecutor> executor_ =
      std::make_shared<rclcpp::executors::SingleThreadedExecutor>();
  const rclcpp::Node::SharedPtr node_ = std::make_shared<rclcpp::Node>("asker");
  const std::shared_ptr<rclcpp_components::ComponentManager> manager_ =
      std::make_shared<rclcpp_components::ComponentManager>(executor_);
  ContainerClient client_{*executor_, node_, "/ComponentManager"};
};

TEST_F(ComponentManagerTest, ProgramsFindComponentsWithALoaderOfTheirOwn) {
  using rclcpp_components::NodeFactory;
  class_loader::ClassLoader loader(TEST_COMPONENTS);
  const std::string plain = "rclcpp_components::NodeFactoryTemplate<test_components::Plain>";
  EXPECT_THAT(loader.getAvailableClasses<NodeFactory>(), testing::Contains(plain));
  const auto factory = loader.createInstance<NodeFactory>(plain);
  auto component = factory->create_node_instance(rclcpp::NodeOptions());
  EXPECT_STREQ(component.get_node_base_interface()->get_name(), "plain");
}

TEST_F(ComponentManagerTest, LoadsListsAndUnloads) {
  const LoadNode::Response talker = client_.load("composition", "composition::Talker");
  EXPECT_EQ(talker.error_message, "");
  EXPECT_TRUE(talker.success);
  EXPECT_EQ(talker.full_node_name, "/talker");
  EXPECT_EQ(talker.unique_id, 1u);
  const LoadNode::Response listener = client_.load("composition", "composition::Listener", "ear");
  EXPECT_EQ(listener.full_node_name, "/ear");
  EXPECT_EQ(listener.unique_id, 2u);
  EXPECT_THAT(node_->get_node_names(), testing::IsSupersetOf({"/talker", "/ear"}));
  EXPECT_EQ(node_->count_publishers("chatter"), 1u);

  ListNodes::Response list = client_.list();
  EXPECT_THAT(list.unique_ids, ElementsAre(1u, 2u));
  EXPECT_THAT(list.full_node_names, ElementsAre("/talker", "/ear"));

  EXPECT_TRUE(client_.unload(1).success);
  EXPECT_EQ(node_->count_publishers("chatter"), 0u);
  const UnloadNode::Response again = client_.unload(1);
  EXPECT_FALSE(again.success);
  EXPECT_EQ(again.error_message, "No node found with unique_id: 1");

  // An id is never used again.
  EXPECT_EQ(client_.load("composition", "composition::Talker").unique_id, 3u);
  list = client_.list();
  EXPECT_THAT(list.unique_ids, ElementsAre(2u, 3u));
}

TEST_F(ComponentManagerTest, ComponentHasTheNamesRulesAndParametersOfTheRequest) {
  LoadNode::Request request;
  request.package_name = "composition";
  request.plugin_name = "composition::Talker";
  request.node_name = "mouth";
  request.node_namespace = "/face";
  request.remap_rules = {"chatter:=/news"};
  EXPECT_EQ(client_.load(request).full_node_name, "/face/mouth");
  EXPECT_EQ(node_->count_publishers("/news"), 1u);

  LoadNode::Request plain;
  plain.package_name = "tested";
  plain.plugin_name = "test_components::Plain";
  plain.parameters = {parameter("speed", 2.5)};
  plain.extra_arguments = {parameter("use_intra_process_comms", true)};
  plain.log_level = 10;
  EXPECT_EQ(client_.load(plain).full_node_name, "/plain");
  EXPECT_EQ(parameter_of("/plain", "speed").as_double(), 2.5);
  EXPECT_TRUE(parameter_of("/plain", "intra").as_bool());
  EXPECT_EQ(rclcpp::get_logger("plain").get_effective_level(), rclcpp::Logger::Level::Debug);
}

TEST_F(ComponentManagerTest, ArgumentsOfTheProcessReachAComponentOnlyIfTheyAreForwarded) {
  LoadNode::Request request;
  request.package_name = "tested";
  request.plugin_name = "test_components::Plain";
  request.node_name = "alone";
  EXPECT_TRUE(client_.load(request).success);
  EXPECT_FALSE(parameter_of("/alone", "global").as_bool());
  request.node_name = "with";
  request.extra_arguments = {parameter("forward_global_arguments", true)};
  EXPECT_TRUE(client_.load(request).success);
  EXPECT_TRUE(parameter_of("/with", "global").as_bool());
}

TEST_F(ComponentManagerTest, ExtraArgumentsAreOptionsOfTheComponent) {
  const auto load = [&](const std::string& name, std::vector<rcl_interfaces::msg::Parameter> extra_arguments) {
    LoadNode::Request request;
    request.package_name = "tested";
    request.plugin_name = "test_components::Plain";
    request.node_name = name;
    request.extra_arguments = std::move(extra_arguments);
    EXPECT_EQ(client_.load(request).error_message, "");
  };
  const auto services_of = [&](const std::string& name) {
    std::vector<std::string> services;
    for (const auto& [service, types] :
         node_->get_node_graph_interface()->get_service_names_and_types_by_node(name, "/")) {
      services.push_back(service);
    }
    return services;
  };
  const auto publishes = [&](const std::string& name, const std::string& topic) {
    const auto publishers = node_->get_publishers_info_by_topic(topic);
    return std::any_of(publishers.begin(), publishers.end(),
                       [&](const auto& publisher) { return publisher.node_name() == name; });
  };
  load("plain", {});
  load("bare", {parameter("start_parameter_services", false), parameter("enable_rosout", false),
                parameter("start_parameter_event_publisher", false), parameter("use_clock_thread", false),
                parameter("enable_topic_statistics", false), parameter("enable_type_description_service", false)});
  load("full", {parameter("enable_logger_service", true)});
  EXPECT_THAT(services_of("bare"), testing::IsEmpty());
  EXPECT_THAT(services_of("plain"), testing::AllOf(testing::Contains("/plain/get_parameters"),
                                                   testing::Contains("/plain/get_type_description"),
                                                   testing::Not(testing::Contains("/plain/set_logger_levels"))));
  EXPECT_THAT(services_of("full"), testing::Contains("/full/set_logger_levels"));
  for (const char* topic : {"/rosout", "/parameter_events"}) {
    EXPECT_TRUE(publishes("plain", topic)) << topic;
    EXPECT_FALSE(publishes("bare", topic)) << topic;
  }
}

TEST_F(ComponentManagerTest, AClassOfAProgramMayHaveExtraArgumentsOfItsOwn) {
  class Bridge : public rclcpp_components::ComponentManager {
   public:
    explicit Bridge(const std::weak_ptr<rclcpp::Executor>& executor) : ComponentManager(executor, "bridge") {}
    rclcpp::NodeOptions create_node_options(const std::shared_ptr<LoadNode::Request> request) override {
      for (const auto& argument : request->extra_arguments) {
        names.push_back(argument.name);
      }
      return ComponentManager::create_node_options(request);
    }
    std::vector<std::string> names;
  };
  const auto bridge = std::make_shared<Bridge>(executor_);
  executor_->add_node(bridge);
  ContainerClient client(*executor_, node_, "/bridge");
  LoadNode::Request request;
  request.package_name = "tested";
  request.plugin_name = "test_components::Plain";
  request.extra_arguments = {parameter("to_domain", 3), parameter("use_intra_process_comms", true)};
  EXPECT_EQ(client.load(request).error_message, "");
  EXPECT_THAT(bridge->names, ElementsAre("to_domain", "use_intra_process_comms"));
  EXPECT_TRUE(parameter_of("/plain", "intra").as_bool());
  executor_->remove_node(bridge);
}

TEST_F(ComponentManagerTest, ErrorsAreInTheResponseAndTheContainerGoesOn) {
  EXPECT_EQ(error_of("nowhere", "test_components::Plain"), "Could not find requested resource in ament index");
  EXPECT_EQ(error_of("", "test_components::Plain"), "Could not find requested resource in ament index");
  EXPECT_EQ(error_of("../packages/tested", "test_components::Plain"),
            "Could not find requested resource in ament index");
  EXPECT_EQ(error_of("malformed", "test_components::Plain"), "Invalid resource entry");
  EXPECT_EQ(error_of("tested", "test_components::Unknown"), "Failed to find class with the requested plugin name.");
  EXPECT_EQ(error_of("tested", "test_components::Forgotten"), "Failed to find class with the requested plugin name.");
  const std::string library = (sandbox_.directory() / "prefix/lib/libnowhere.so").string();
  EXPECT_EQ(error_of("tested", "test_components::Lost"), "Failed to load library: " + library +
                                                             ": cannot open shared object file: No such file or "
                                                             "directory");
  EXPECT_EQ(error_of("tested", "test_components::Throwing"),
            "Component constructor threw an exception: no such device");
  EXPECT_EQ(error_of("tested", "test_components::ThrowingNoException"), "Component constructor threw an exception");

  LoadNode::Request request;
  request.package_name = "tested";
  request.plugin_name = "test_components::Plain";
  request.extra_arguments = {parameter("use_intra_process_comms", 1)};
  EXPECT_EQ(client_.load(request).error_message,
            "Extra component argument 'use_intra_process_comms' must be a boolean");
  request.extra_arguments = {parameter("use_intra_process_comm", true)};
  EXPECT_EQ(client_.load(request).error_message,
            "Unknown extra component argument 'use_intra_process_comm'; did you mean 'use_intra_process_comms'?");
  request.extra_arguments = {parameter("priority", 1)};
  EXPECT_EQ(client_.load(request).error_message,
            "Unknown extra component argument 'priority'; known are allow_undeclared_parameters, "
            "enable_logger_service, enable_rosout, "
            "enable_topic_statistics, enable_type_description_service, forward_global_arguments, "
            "start_parameter_event_publisher, start_parameter_services, use_clock_thread, use_intra_process_comms");
  request.extra_arguments.clear();
  request.parameters = {parameter("speed", "high")};
  EXPECT_THAT(client_.load(request).error_message,
              HasSubstr("Component constructor threw an exception: parameter 'speed' has invalid type: "));
  request.parameters.clear();
  request.remap_rules = {"not a rule"};
  EXPECT_THAT(client_.load(request).error_message, HasSubstr("not a rule"));
  request.remap_rules.clear();
  EXPECT_TRUE(client_.load(request).success);
  EXPECT_EQ(client_.list().unique_ids.size(), 1u);
}

TEST_F(ComponentManagerTest, FactoryIsNullForAClassThatTheLibraryLacks) {
  EXPECT_NE(manager_->create_component_factory({"test_components::Plain", TEST_COMPONENTS}), nullptr);
  EXPECT_EQ(manager_->create_component_factory({"composition::Talker", TEST_COMPONENTS}), nullptr);
  EXPECT_EQ(rclcpp_components::create_component_factory("test_components::Unknown"), nullptr);
  EXPECT_THAT(rclcpp_components::ComponentLibrary(TEST_COMPONENTS).get_available_classes(),
              ElementsAre("test_components::Throwing", "test_components::ThrowingNoException",
                          "test_components::ThreadTeller", "test_components::Plain"));
}

TEST_F(ComponentManagerTest, ThreadNumberIsAReadOnlyParameterWithinTheMachinesThreads) {
  const auto descriptor = manager_->describe_parameter("thread_num");
  EXPECT_TRUE(descriptor.read_only);
  EXPECT_EQ(descriptor.integer_range.at(0).from_value, 1);
  EXPECT_EQ(static_cast<uint64_t>(manager_->get_parameter("thread_num").as_int()),
            descriptor.integer_range.at(0).to_value);
}

TEST_F(ComponentManagerTest, IsolatedComponentsEndBeforeTheirExecutorHasBegun) {
  const auto isolated =
      std::make_shared<rclcpp_components::ComponentManagerIsolated<>>(std::weak_ptr<rclcpp::Executor>(), "isolated");
  executor_->add_node(isolated);
  ContainerClient client(*executor_, node_, "/isolated");
  for (uint64_t id = 1; id <= 3; ++id) {
    EXPECT_EQ(client.load("tested", "test_components::Plain").unique_id, id);
    EXPECT_TRUE(client.unload(id).success);
  }
  EXPECT_TRUE(client.load("tested", "test_components::Plain").success);  // the destructor unloads this component
}

TEST_F(ComponentManagerTest, ProgramOfAnUnknownComponentFails) {
  rclcpp::shutdown();
  char name[] = "program";
  char* argv[] = {name, nullptr};
  testing::internal::CaptureStderr();
  EXPECT_EQ(rclcpp_components::node_main<rclcpp::executors::SingleThreadedExecutor>("nobody::Knows", 1, argv), 1);
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "no library of this program has component 'nobody::Knows'\n");
}

}  // namespace
