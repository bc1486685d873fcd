// SPDX-License-Identifier: Apache-2.0
#include <yaml-cpp/yaml.h>

#include <pluginlib/class_list_macros.hpp>
#include <rcpputils/compile_warnings.hpp>
#include <sensor_msgs/image_encodings.hpp>

#include "track_parsers/parser.hpp"

#pragma GCC diagnostic error "-Wdeprecated-declarations"

namespace track_parsers {

class YamlParser : public Parser {
 public:
  int width(const std::string& text) override {
    const int bits = sensor_msgs::image_encodings::bitDepth("mono8");
    RCPPUTILS_DEPRECATION_WARNING_OFF_START
    const int usual = old_width();
    RCPPUTILS_DEPRECATION_WARNING_OFF_STOP
    return YAML::Load(text)["width"].as<int>(usual) * bits / 8;
  }
};

}  // namespace track_parsers

PLUGINLIB_EXPORT_CLASS(track_parsers::YamlParser, track_parsers::Parser)
