// SPDX-License-Identifier: Apache-2.0
// Against the hashes that ROS 2 Jazzy and Lyrical announce.
#include "programs/ros/calculations/type_hash.hpp"

#include <gtest/gtest.h>
#include <stdlib.h>

#include "programs/ros/verb.hpp"

using launch::installed_interfaces;
using launch::service_type_hash;
using launch::type_hash;

namespace {

class TypeHash : public testing::Test {
 protected:
  static void SetUpTestSuite() { ::setenv("AMENT_PREFIX_PATH", PREFIX, 1); }

  static std::string of_service(const std::string& name) {
    return service_type_hash(installed_interfaces().service(name), *installed_interfaces().message(name + "_Event"));
  }
};

TEST_F(TypeHash, OfMessages) {
  const std::pair<const char*, const char*> expected[] = {
      {"std_msgs/msg/Empty", "20b625256f32d5dbc0d04fee44f43c41e51c70d3502f84b4a08e7a9c26a96312"},
      {"std_msgs/msg/String", "df668c740482bbd48fb39d76a70dfd4bd59db1288021743503259e948f6b1a18"},
      {"geometry_msgs/msg/Twist", "9c45bf16fe0983d80e3cfe750d6835843d265a9a6c46bd2e609fcddde6fb8d2a"},
      {"geometry_msgs/msg/TwistStamped", "5f0fcd4f81d5d06ad9b4c4c63e3ea51b82d6ae4d0558f1d475229b1121db6f64"}};
  for (const auto& [name, hash] : expected) {
    EXPECT_EQ(type_hash(*installed_interfaces().message(name)), std::string("RIHS01_") + hash) << name;
  }
}

TEST_F(TypeHash, OfServices) {
  EXPECT_EQ(of_service("std_srvs/srv/Empty"),
            "RIHS01_5888399dedec5ccc85ea6451949fd2c9f97bfdf963f9a588821639fcd31b5d19");
  EXPECT_EQ(of_service("rcl_interfaces/srv/ListParameters"),
            "RIHS01_3e6062bfbb27bfb8730d4cef2558221f51a11646d78e7bb30a1e83afac3aad9d");
  EXPECT_EQ(of_service("example_interfaces/srv/AddTwoInts"),
            "RIHS01_e118de6bf5eeb66a2491b5bda11202e7b68f198d6f67922cf30364858239c81a");
}

}  // namespace
