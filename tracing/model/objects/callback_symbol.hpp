// SPDX-License-Identifier: Apache-2.0
// Makes the demangled symbol of a callback readable.
#pragma once

#include <string>
#include <string_view>

namespace tracing {

// "std::_Bind<void (Ping::*(Ping*, std::_Placeholder<1>))(std::shared_ptr<std_msgs::msg::String_<std::allocator<void>
// >)>" becomes "Ping::?(std::shared_ptr<std_msgs::msg::String>)": std::bind records the class but not which method.
// Library noise (allocators, deleters, ABI namespaces) is removed; other symbols stay as they are.
std::string readable_symbol(std::string_view symbol);

// As short as still can be recognised, from what readable_symbol() gives: "Ping::on_pong" for
// "robot::Ping::on_pong(std::shared_ptr<std_msgs::msg::String>)", "Ping::Ping lambda" for
// "robot::Ping::Ping(rclcpp::NodeOptions const&)::{lambda()#1}".
std::string short_symbol(std::string_view readable);

}  // namespace tracing
