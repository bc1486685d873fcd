// SPDX-License-Identifier: Apache-2.0
// Makes a class of this library a plugin:
//
//   PLUGINLIB_EXPORT_CLASS(shapes::Square, shapes::Shape)
//
// in one source file, outside every namespace. In CMake, pluginlib_export_plugin_description_file() registers its
// description.
#pragma once

#include "class_loader/register_macro.hpp"

#define PLUGINLIB_EXPORT_CLASS(class_type, base_class_type) CLASS_LOADER_REGISTER_CLASS(class_type, base_class_type)
