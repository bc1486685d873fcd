// SPDX-License-Identifier: Apache-2.0
// Makes a publisher of a type that only the maker of the factory knows. NodeTopicsInterface::create_publisher() calls
// it.
#pragma once

#include <functional>
#include <memory>
#include <string>

#include "rclcpp/node_interfaces/node_base_interface.hpp"
#include "rclcpp/publisher.hpp"
#include "rclcpp/publisher_options.hpp"
#include "rclcpp/qos.hpp"

namespace rclcpp {

struct PublisherFactory {
  using PublisherFactoryFunction =
      std::function<PublisherBase::SharedPtr(node_interfaces::NodeBaseInterface*, const std::string&, const QoS&)>;

  PublisherFactoryFunction create_typed_publisher;
};

// The factory keeps a copy of the options.
template <typename MessageT, typename AllocatorT = std::allocator<void>,
          typename PublisherT = Publisher<MessageT, AllocatorT>>
PublisherFactory create_publisher_factory(const PublisherOptionsWithAllocator<AllocatorT>& options) {
  return {[options](node_interfaces::NodeBaseInterface* node_base, const std::string& topic_name,
                    const QoS& qos) -> PublisherBase::SharedPtr {
    auto publisher = std::make_shared<PublisherT>(node_base, topic_name, qos, options);
    publisher->post_init_setup(node_base, topic_name, qos, options);
    return publisher;
  }};
}

}  // namespace rclcpp
