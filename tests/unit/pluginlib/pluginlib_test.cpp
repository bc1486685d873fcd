// SPDX-License-Identifier: Apache-2.0
// Plugins that packages export through the ament index.
#include <gmock/gmock.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <pluginlib/class_loader.hpp>

#include "tests/unit/pluginlib/shapes.hpp"
#include "tests/unit/pluginlib/thrown_by.hpp"

namespace {

namespace fs = std::filesystem;
using shapes::Shape;
using test_support::thrown_by;
using testing::ElementsAre;
using testing::IsEmpty;

constexpr const char* kDescription = R"xml(
<class_libraries>
  <library path="shapes_plugins">
    <class name="square" type="shapes::Square" base_class_type="shapes::Shape">
      <description> Four corners. </description>
    </class>
    <class type="shapes::Triangle" base_class_type="shapes::Shape"/>
    <class type="shapes::Missing" base_class_type="shapes::Shape"/>
    <class type="shapes::Red" base_class_type="shapes::Colour"/>
    <class name="sketch" type="shapes::Sketch" base_class_type="shapes::Drawing"/>
  </library>
  <library path="lost_plugins">
    <class name="lost" type="shapes::Lost" base_class_type="shapes::Shape"/>
  </library>
</class_libraries>)xml";

// A prefix with the package `shapes`, which has the base class, and `shapes_plugins`.
class Plugins : public testing::Test {
 protected:
  Plugins() {
    std::string directory = (fs::temp_directory_path() / "plugins-XXXXXX").string();
    prefix_ = mkdtemp(directory.data());
    write("share/ament_index/resource_index/packages/shapes", "");
    write("share/ament_index/resource_index/packages/shapes_plugins", "");
    export_description(kDescription);
    fs::create_directories(prefix_ / "lib");
    fs::create_symlink(SHAPES_LIBRARY, library());
    setenv("AMENT_PREFIX_PATH", prefix_.c_str(), 1);
  }
  ~Plugins() override { fs::remove_all(prefix_); }

  void write(const fs::path& file, const std::string& content) const {
    fs::create_directories((prefix_ / file).parent_path());
    std::ofstream(prefix_ / file) << content;
  }
  void export_description(const std::string& xml) const {
    write("share/ament_index/resource_index/shapes__pluginlib__plugin/shapes_plugins",
          "share/shapes_plugins/plugins.xml\n");
    write("share/shapes_plugins/plugins.xml", xml);
  }
  std::string description() const { return prefix_ / "share/shapes_plugins/plugins.xml"; }
  std::string library() const { return prefix_ / "lib/libshapes_plugins.so"; }

  fs::path prefix_;
};

TEST_F(Plugins, AreFoundWithWhatTheirPackageTells) {
  pluginlib::ClassLoader<Shape> loader("shapes", "shapes::Shape");
  EXPECT_THAT(loader.getPluginXmlPaths(), ElementsAre(description()));
  EXPECT_THAT(loader.getDeclaredClasses(), ElementsAre("lost", "shapes::Missing", "shapes::Triangle", "square"));
  EXPECT_EQ(loader.getBaseClassType(), "shapes::Shape");
  EXPECT_EQ(loader.getClassType("square"), "shapes::Square");
  EXPECT_EQ(loader.getClassDescription("square"), "Four corners.");
  EXPECT_EQ(loader.getClassPackage("square"), "shapes_plugins");
  EXPECT_EQ(loader.getPluginManifestPath("square"), description());
  EXPECT_EQ(loader.getClassLibraryPath("square"), library());
  EXPECT_EQ(loader.getName("shapes::Triangle"), "Triangle");
  EXPECT_TRUE(loader.isClassAvailable("square"));
  EXPECT_FALSE(loader.isClassAvailable("shapes::Red"));
  EXPECT_EQ(loader.getClassType("shapes::Red"), "");
}

TEST_F(Plugins, AreCreatedByTheirName) {
  pluginlib::ClassLoader<Shape> loader("shapes", "shapes::Shape");
  EXPECT_FALSE(loader.isClassLoaded("square"));
  EXPECT_EQ(loader.createSharedInstance("square")->name(), "square");
  EXPECT_TRUE(loader.isClassLoaded("square"));
  EXPECT_THAT(loader.getRegisteredLibraries(), ElementsAre(library()));
  const pluginlib::UniquePtr<Shape> triangle = loader.createUniqueInstance("shapes::Triangle");
  EXPECT_EQ(triangle->name(), "triangle");
  const std::unique_ptr<Shape> owned(loader.createUnmanagedInstance("square"));
  EXPECT_EQ(owned->name(), "square");
  EXPECT_EQ(loader.unloadLibraryForClass("square"), 0);
  EXPECT_FALSE(loader.isClassLoaded("square"));
  EXPECT_EQ(thrown_by<pluginlib::LibraryUnloadException>([&] { loader.unloadLibraryForClass("square"); }),
            "the library of plugin 'square' is not loaded");
  EXPECT_EQ(triangle->name(), "triangle");
}

TEST_F(Plugins, AreCreatedWithArguments) {
  pluginlib::ClassLoader<shapes::Drawing> loader("shapes", "shapes::Drawing");
  EXPECT_EQ(loader.createSharedInstance("sketch", "a", std::make_unique<int>(1))->text(), "a 1");
  EXPECT_EQ(loader.createUniqueInstance("sketch", "b", std::make_unique<int>(2))->text(), "b 2");
}

TEST_F(Plugins, OutliveTheirLoader) {
  std::shared_ptr<Shape> square;
  {
    pluginlib::ClassLoader<Shape> loader("shapes", "shapes::Shape");
    square = loader.createSharedInstance("square");
  }
  EXPECT_EQ(square->name(), "square");
}

TEST_F(Plugins, WhatIsMissingIsTold) {
  pluginlib::ClassLoader<Shape> loader("shapes", "shapes::Shape");
  EXPECT_EQ(thrown_by<pluginlib::LibraryLoadException>([&] { loader.createSharedInstance("circle"); }),
            "no package exports a plugin 'circle' with base class 'shapes::Shape'; there are: 'lost' 'shapes::Missing' "
            "'shapes::Triangle' 'square'");
  EXPECT_EQ(thrown_by<pluginlib::CreateClassException>([&] { loader.createSharedInstance("shapes::Missing"); }),
            "cannot create an object of class 'shapes::Missing': the library '" + library() +
                "' has no such class with that base class");
  const std::string prefix = prefix_;
  EXPECT_EQ(thrown_by<pluginlib::LibraryLoadException>([&] { loader.createSharedInstance("lost"); }),
            "the library 'lost_plugins' of plugin 'lost' is in none of:\n  " + prefix + "/lib\n  " + prefix +
                "/lib/shapes_plugins\n  " + prefix + "\n  " + prefix + "/share/shapes_plugins");
  EXPECT_EQ(thrown_by<pluginlib::ClassLoaderException>(
                [] { pluginlib::ClassLoader<Shape> unknown("circles", "shapes::Shape"); }),
            "the package 'circles' is in no prefix of AMENT_PREFIX_PATH");
}

TEST_F(Plugins, ADescriptionThatIsNoneCostsItsPlugins) {
  export_description("<library>\n  <class/>\n</library>");
  testing::internal::CaptureStderr();
  pluginlib::ClassLoader<Shape> loader("shapes", "shapes::Shape");
  EXPECT_EQ(
      testing::internal::GetCapturedStderr(),
      "pluginlib: the plugins of " + description() + " are left out: line 1: <library> needs the attribute 'path'\n");
  EXPECT_THAT(loader.getDeclaredClasses(), IsEmpty());
  export_description("<plugins/>");
  testing::internal::CaptureStderr();
  loader.refreshDeclaredClasses();
  EXPECT_EQ(testing::internal::GetCapturedStderr(),
            "pluginlib: the plugins of " + description() +
                " are left out: line 1: <plugins> must be <library> or <class_libraries>\n");
}

TEST_F(Plugins, ThatCameLaterAreFoundByARefresh) {
  export_description("<class_libraries/>");
  pluginlib::ClassLoader<Shape> loader("shapes", "shapes::Shape");
  EXPECT_THAT(loader.getDeclaredClasses(), IsEmpty());
  export_description(kDescription);
  loader.refreshDeclaredClasses();
  const auto square = loader.createSharedInstance("square");
  loader.refreshDeclaredClasses();
  EXPECT_TRUE(loader.isClassLoaded("square"));
}

TEST_F(Plugins, DescriptionsMayBeGivenByTheirPaths) {
  write("elsewhere/more.xml", R"(<library path="../lib/libshapes_plugins">
    <class type="shapes::Square" base_class_type="shapes::Shape"/></library>)");
  pluginlib::ClassLoader<Shape> loader("shapes", "shapes::Shape", "plugin", {prefix_ / "elsewhere/more.xml"});
  EXPECT_THAT(loader.getDeclaredClasses(), ElementsAre("shapes::Square"));
  EXPECT_EQ(loader.createSharedInstance("shapes::Square")->name(), "square");
}

}  // namespace
