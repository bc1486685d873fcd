// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cstdlib>
#include <memory>
#include <string>

#include "tracetools/utils.hpp"

struct Message {};
struct Listener {
  void on_message(std::shared_ptr<const Message>) {}
};
void exported_callback(const Message&) {}
extern "C" void c_callback(const Message&) {}

namespace {

void hidden_callback(const Message&) {}

template <typename Callable>
std::string symbol_of(const Callable& callable) {
  char* symbol = tracetools::get_symbol(callable);
  const std::string text = symbol != nullptr ? symbol : "null";
  std::free(symbol);
  return text;
}

using Callback = std::function<void(const Message&)>;

TEST(Symbol, OfAPlainFunctionIsItsName) {
  EXPECT_EQ(symbol_of(Callback(exported_callback)), "exported_callback(Message const&)");
}

TEST(Symbol, IsNullWithoutAnExportedMangledName) {
  EXPECT_EQ(symbol_of(Callback(hidden_callback)), "null");
  EXPECT_EQ(symbol_of(Callback(c_callback)), "null");
}

TEST(Symbol, OfABoundMethodShowsItsClass) {
  Listener listener;
  const std::function<void(std::shared_ptr<const Message>)> bound =
      std::bind(&Listener::on_message, &listener, std::placeholders::_1);
  EXPECT_EQ(symbol_of(bound),
            "std::_Bind<void (Listener::*(Listener*, std::_Placeholder<1>))(std::shared_ptr<Message const>)>");
}

TEST(Symbol, OfALambdaShowsWhereItStands) {
  const auto lambda = [](const Message&) {};
  EXPECT_NE(symbol_of(lambda).find("Symbol_OfALambdaShowsWhereItStands_Test::TestBody()::{lambda(Message const&)#1}"),
            std::string::npos);
  EXPECT_EQ(symbol_of(Callback(lambda)), symbol_of(lambda));
}

}  // namespace
