// SPDX-License-Identifier: Apache-2.0
// What participants and endpoints announce about themselves.
#include "participant/user_data.hpp"

#include <gtest/gtest.h>

namespace {

using rmw_fastrtps::enclave_user_data;
using rmw_fastrtps::type_hash_user_data;
using rmw_fastrtps::user_data_value;

TEST(UserData, HasValuesByTheirKeys) {
  EXPECT_EQ(user_data_value("enclave=/a;typehash=RIHS01_0;", "typehash"), "RIHS01_0");
  EXPECT_EQ(user_data_value("enclave=/a", "enclave"), "/a");
  EXPECT_EQ(user_data_value("enclave=a=b;", "enclave"), "a=b");
  EXPECT_EQ(user_data_value("enclave=;", "enclave"), "");
}

TEST(UserData, WithoutTheKeyIsEmpty) {
  EXPECT_EQ(user_data_value("", "typehash"), "");
  EXPECT_EQ(user_data_value(";;", "typehash"), "");
  EXPECT_EQ(user_data_value("typehash", "typehash"), "");
  EXPECT_EQ(user_data_value("no_typehash=1;typehashes=2;", "typehash"), "");
}

TEST(UserData, SaysWhatItIsMadeOf) {
  EXPECT_EQ(user_data_value(enclave_user_data("/a"), "enclave"), "/a");
  EXPECT_EQ(enclave_user_data("/a").back(), 0);
  EXPECT_EQ(user_data_value(type_hash_user_data("RIHS01_0"), "typehash"), "RIHS01_0");
  EXPECT_TRUE(type_hash_user_data("").empty());
}

}  // namespace
