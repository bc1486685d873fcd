// SPDX-License-Identifier: Apache-2.0
// The names that sensor_msgs/msg/CameraInfo has for models of distortion.
#pragma once

namespace sensor_msgs {
namespace distortion_models {

// NOLINTBEGIN: the names of ROS 2
inline const char PLUMB_BOB[] = "plumb_bob";
inline const char RATIONAL_POLYNOMIAL[] = "rational_polynomial";
inline const char EQUIDISTANT[] = "equidistant";
// NOLINTEND

}  // namespace distortion_models
}  // namespace sensor_msgs
