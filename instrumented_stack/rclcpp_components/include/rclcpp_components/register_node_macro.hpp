// SPDX-License-Identifier: Apache-2.0
// Makes a class of this library loadable at run time:
//
//   RCLCPP_COMPONENTS_REGISTER_NODE(composition::Talker)
//
// in one source file, outside every namespace. The class is constructed from rclcpp::NodeOptions and has
// get_node_base_interface(). In CMake, rclcpp_components_register_nodes() tells containers the path of the library.
//
// Programs that load components themselves, with a class_loader::ClassLoader, find
// rclcpp_components::NodeFactoryTemplate<composition::Talker> with base class rclcpp_components::NodeFactory.
#pragma once

#include <class_loader/register_macro.hpp>
#include <memory>

#include "rclcpp_components/component_library.hpp"
#include "rclcpp_components/node_factory.hpp"
#include "rclcpp_components/node_factory_template.hpp"

#define RCLCPP_COMPONENTS_REGISTER_NODE(NodeClass) RCLCPP_COMPONENTS_REGISTER_NODE_COUNTED(NodeClass, __COUNTER__)
// A separate macro level, because __COUNTER__ must be a number before it becomes part of a name.
#define RCLCPP_COMPONENTS_REGISTER_NODE_COUNTED(NodeClass, number) \
  RCLCPP_COMPONENTS_REGISTER_NODE_NUMBERED(NodeClass, number)
#define RCLCPP_COMPONENTS_REGISTER_NODE_NUMBERED(NodeClass, number)                         \
  namespace {                                                                               \
  const ::rclcpp_components::ComponentRegistration rclcpp_components_registration_##number( \
      #NodeClass, []() -> std::shared_ptr<::rclcpp_components::NodeFactory> {               \
        return std::make_shared<::rclcpp_components::NodeFactoryTemplate<NodeClass>>();     \
      });                                                                                   \
  }                                                                                         \
  CLASS_LOADER_REGISTER_CLASS(rclcpp_components::NodeFactoryTemplate<NodeClass>, rclcpp_components::NodeFactory)
