// SPDX-License-Identifier: Apache-2.0
#include "tracing/model/objects/callback_symbol.hpp"

#include <gtest/gtest.h>

namespace tracing {
namespace {

TEST(CallbackSymbol, NamesTheClassOfABoundMethod) {
  EXPECT_EQ(readable_symbol("std::_Bind<void (Ping::*(Ping*))()>"), "Ping::?()");
  EXPECT_EQ(readable_symbol("std::_Bind<void (ns::Ping::*(ns::Ping*, std::_Placeholder<1>))"
                            "(std::shared_ptr<std_msgs::msg::String_<std::allocator<void> > >)>"),
            "ns::Ping::?(std::shared_ptr<std_msgs::msg::String>)");
  EXPECT_EQ(readable_symbol("std::_Bind<bool (A::*(std::shared_ptr<A>, std::_Placeholder<1>))(int) const>"),
            "A::?(int) const");
}

TEST(CallbackSymbol, ShortensLibraryNames) {
  EXPECT_EQ(
      readable_symbol("f(std::__cxx11::basic_string<char, std::char_traits<char>, std::allocator<char> > const&)"),
      "f(std::string const&)");
  EXPECT_EQ(readable_symbol(
                "f(std::unique_ptr<M_<std::allocator<void> >, std::default_delete<M_<std::allocator<void> > > >)"),
            "f(std::unique_ptr<M>)");
  EXPECT_EQ(readable_symbol("f(std::vector<int, std::allocator<int> >)"), "f(std::vector<int>)");
}

TEST(CallbackSymbol, LeavesOthersAsTheyAre) {
  EXPECT_EQ(readable_symbol("Node::Node()::{lambda()#1}"), "Node::Node()::{lambda()#1}");
  EXPECT_EQ(readable_symbol("std::_Bind<void (*(int))(int)>"), "void (*(int))(int)");
  EXPECT_EQ(readable_symbol("std::_Bind<broken (A::*("), "std::_Bind<broken (A::*(");
  EXPECT_EQ(readable_symbol(""), "");
}

TEST(ShortSymbol, LeavesClassAndMethod) {
  EXPECT_EQ(short_symbol("Ping::?()"), "Ping::?");
  EXPECT_EQ(short_symbol("robot::Ping::on_pong(std::shared_ptr<std_msgs::msg::String>)"), "Ping::on_pong");
  EXPECT_EQ(short_symbol("void filter::Fusion<int, float>::handle<long>(std::vector<int> const&) const"),
            "Fusion::handle");
  EXPECT_EQ(short_symbol("main"), "main");
  EXPECT_EQ(short_symbol(""), "");
}

TEST(ShortSymbol, NamesALambdaAfterItsFunction) {
  EXPECT_EQ(short_symbol("robot::Ping::Ping(rclcpp::NodeOptions const&)::{lambda(int)#1}"), "Ping::Ping lambda");
  EXPECT_EQ(short_symbol("main::{lambda()#2}::operator()() const::{lambda(int)#1}"), "main lambda");
  EXPECT_EQ(short_symbol("(anonymous namespace)::tick()"), "tick");
}

}  // namespace
}  // namespace tracing
