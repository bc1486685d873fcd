// SPDX-License-Identifier: Apache-2.0
// Launch files of ROS 1 in the words of ROS 2.
#include <gtest/gtest.h>

#include "actions/builtin_actions.hpp"
#include "programs/launch/rewrite/formatted.hpp"
#include "programs/launch/rewrite/migrate_xml.hpp"

namespace launch {
namespace {

TEST(Migrate, WritesAFileOfRos1InTheWordsOfRos2) {
  const auto file = std::make_shared<SourceFile>("robot.launch", R"xml(<launch>
  <!-- the robot -->
  <arg name="name" doc="which one"/>
  <arg name="rate" value="10"/>
  <param name="/robot/description" command="xacro $(find robot)/a.xacro"/>
  <group ns="$(arg name)" clear_params="true">
    <node pkg="robot" type="drive" name="drive" ns="base" required="true" clear_params="true">
      <param name="~max/speed" type="double" value="$(optenv SPEED 1)"/>
      <rosparam command="load" file="$(find robot)/drive.yaml"/>
      <remap from="cmd" to="/cmd"/>
    </node>
    <include file="$(find other)/launch/more.launch" ns="more" pass_all_args="true">
      <arg name="rate" value="$(arg rate)"/>
    </include>
  </group>
  <remap from="a" to="b"/>
  <machine name="far"/>
</launch>
)xml");
  const Migrated made = migrate_xml(file);
  EXPECT_EQ(formatted_xml(made.text, builtin_actions()), R"xml(<launch>
  <!-- the robot -->
  <arg name="name" description="which one"/>
  <let name="rate" value="10"/>
  <set_parameter name="robot.description" value="$(command 'xacro $(find-pkg-share robot)/a.xacro')"/>
  <group>
    <push_ros_namespace namespace="$(var name)"/>
    <node pkg="robot" exec="drive" name="drive" namespace="base" on_exit="shutdown">
      <param name="max.speed" value="$(env SPEED 1)" type="float"/>
      <param from="$(find-pkg-share robot)/drive.yaml"/>
      <remap from="cmd" to="/cmd"/>
    </node>
    <group>
      <push_ros_namespace namespace="more"/>
      <include file="$(find-pkg-share other)/launch/more.launch">
        <arg name="rate" value="$(var rate)"/>
      </include>
    </group>
  </group>
  <set_remap from="a" to="b"/>
  <machine name="far"/>
</launch>
)xml");
  ASSERT_EQ(made.left.size(), 3U);
  EXPECT_EQ(made.left[0].message, "a parameter of the master is one of each node of its scope in ROS 2");
  EXPECT_EQ(made.left[1].message,
            "a parameter file of ROS 2 has the name of the node and 'ros__parameters' above the parameters");
  EXPECT_EQ(made.left[2].message, "'machine' is not known to ROS 2");
  EXPECT_EQ(file->position(made.left[2].where.begin).line, 17U);
}

}  // namespace
}  // namespace launch
