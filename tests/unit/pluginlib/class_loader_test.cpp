// SPDX-License-Identifier: Apache-2.0
// Libraries that are loaded at run time, and objects of the classes in them.
#include <gmock/gmock.h>

#include <class_loader/class_loader.hpp>
#include <class_loader/multi_library_class_loader.hpp>

#include "tests/unit/pluginlib/shapes.hpp"
#include "tests/unit/pluginlib/thrown_by.hpp"

namespace {

using class_loader::ClassLoader;
using class_loader::MultiLibraryClassLoader;
using shapes::Colour;
using shapes::Shape;
using test_support::thrown_by;
using testing::ElementsAre;
using testing::StartsWith;

class Circle : public Shape {
 public:
  std::string name() const override { return "circle"; }
};

TEST(ClassLoader, CreatesObjectsOfTheClassesOfABase) {
  ClassLoader loader(SHAPES_LIBRARY);
  EXPECT_EQ(loader.getLibraryPath(), SHAPES_LIBRARY);
  EXPECT_TRUE(loader.isLibraryLoaded());
  EXPECT_THAT(loader.getAvailableClasses<Shape>(), ElementsAre("shapes::Square", "shapes::Triangle"));
  EXPECT_THAT(loader.getAvailableClasses<Colour>(), ElementsAre("shapes::Red"));
  EXPECT_TRUE(loader.isClassAvailable<Shape>("shapes::Square"));
  EXPECT_FALSE(loader.isClassAvailable<Colour>("shapes::Square"));
  EXPECT_EQ(loader.createInstance<Shape>("shapes::Square")->name(), "square");
  EXPECT_EQ(loader.createSharedInstance<Shape>("shapes::Triangle")->name(), "triangle");
  const ClassLoader::UniquePtr<Colour> red = loader.createUniqueInstance<Colour>("shapes::Red");
  EXPECT_EQ(red->hue(), 0);
  const std::unique_ptr<Shape> owned(loader.createUnmanagedInstance<Shape>("shapes::Square"));
  EXPECT_EQ(owned->name(), "square");
}

TEST(ClassLoader, ConstructorsGetTheArgumentsThatTheirBaseTells) {
  using shapes::Drawing;
  ClassLoader loader(SHAPES_LIBRARY);
  const auto size = [](int value) { return std::make_unique<int>(value); };
  EXPECT_EQ(loader.createUniqueInstance<Drawing>("shapes::Sketch", "a", size(1))->text(), "a 1");
  EXPECT_EQ(loader.createInstance<Drawing>("shapes::Sketch", std::string("b"), size(2))->text(), "b 2");
  const std::unique_ptr<Drawing> owned(loader.createUnmanagedInstance<Drawing>("shapes::Sketch", "c", size(3)));
  EXPECT_EQ(owned->text(), "c 3");

  MultiLibraryClassLoader several(false);
  several.loadLibrary(SHAPES_LIBRARY);
  EXPECT_EQ(several.createInstance<Drawing>("shapes::Sketch", "d", size(4))->text(), "d 4");
  EXPECT_EQ(several.createUniqueInstance<Drawing>("shapes::Sketch", SHAPES_LIBRARY, "e", size(5))->text(), "e 5");
}

TEST(ClassLoader, ObjectsKeepTheirLibrary) {
  std::shared_ptr<Shape> square;
  {
    ClassLoader loader(SHAPES_LIBRARY);
    square = loader.createInstance<Shape>("shapes::Square");
    EXPECT_EQ(loader.unloadLibrary(), 0);
    EXPECT_TRUE(loader.isLibraryLoaded());
  }
  EXPECT_EQ(square->name(), "square");
}

TEST(ClassLoader, LoadsAreCounted) {
  ClassLoader loader(SHAPES_LIBRARY);
  loader.loadLibrary();
  EXPECT_EQ(loader.unloadLibrary(), 1);
  EXPECT_TRUE(loader.isLibraryLoaded());
  EXPECT_EQ(loader.unloadLibrary(), 0);
  EXPECT_EQ(loader.unloadLibrary(), 0);
  EXPECT_FALSE(loader.isLibraryLoaded());
  EXPECT_THAT(loader.getAvailableClasses<Shape>(), ElementsAre());
  EXPECT_EQ(thrown_by<class_loader::CreateClassException>([&] { loader.createInstance<Shape>("shapes::Square"); }),
            "cannot create an object of class 'shapes::Square': the library '" SHAPES_LIBRARY "' is not loaded");
  loader.loadLibrary();
  EXPECT_EQ(loader.createInstance<Shape>("shapes::Square")->name(), "square");
}

TEST(ClassLoader, OnDemandTheFirstObjectLoadsTheLibraryAndTheLastUnloadsIt) {
  ClassLoader loader(SHAPES_LIBRARY, true);
  EXPECT_TRUE(loader.isOnDemandLoadUnloadEnabled());
  EXPECT_FALSE(loader.isLibraryLoaded());
  {
    const auto square = loader.createInstance<Shape>("shapes::Square");
    EXPECT_EQ(square->name(), "square");
    EXPECT_TRUE(loader.isLibraryLoaded());
  }
  EXPECT_FALSE(loader.isLibraryLoaded());
}

TEST(ClassLoader, TellsWhatIsMissing) {
  EXPECT_THAT(thrown_by<class_loader::LibraryLoadException>([] { ClassLoader loader("/nowhere/libno.so"); }),
              StartsWith("cannot load the library '/nowhere/libno.so': /nowhere/libno.so: cannot open"));
  ClassLoader loader(SHAPES_LIBRARY);
  EXPECT_EQ(thrown_by<class_loader::CreateClassException>([&] { loader.createInstance<Shape>("shapes::Red"); }),
            "cannot create an object of class 'shapes::Red': the library '" SHAPES_LIBRARY
            "' has no such class with that base class");
}

TEST(ClassLoader, WithoutANameItHasTheClassesThatTheProgramWasLinkedWith) {
  ClassLoader loader("");
  EXPECT_THAT(loader.getAvailableClasses<Shape>(), ElementsAre("Circle"));
  EXPECT_EQ(loader.createInstance<Shape>("Circle")->name(), "circle");
}

TEST(ClassLoader, NamesOfLibrariesAreThoseOfTheSystem) {
  EXPECT_EQ(class_loader::systemLibraryFormat("shapes"), "libshapes.so");
  EXPECT_EQ(class_loader::systemLibrarySuffix(), ".so");
}

TEST(MultiLibraryClassLoader, FindsTheLibraryThatHasTheClass) {
  MultiLibraryClassLoader loader(false);
  EXPECT_EQ(thrown_by<class_loader::CreateClassException>([&] { loader.createInstance<Shape>("shapes::Square"); }),
            "no library that is loaded has the class 'shapes::Square'");
  loader.loadLibrary("");
  loader.loadLibrary(SHAPES_LIBRARY);
  EXPECT_THAT(loader.getRegisteredLibraries(), ElementsAre("", SHAPES_LIBRARY));
  EXPECT_THAT(loader.getAvailableClasses<Shape>(), ElementsAre("Circle", "shapes::Square", "shapes::Triangle"));
  EXPECT_THAT(loader.getAvailableClassesForLibrary<Colour>(SHAPES_LIBRARY), ElementsAre("shapes::Red"));
  EXPECT_EQ(loader.createInstance<Shape>("shapes::Square")->name(), "square");
  EXPECT_EQ(loader.createUniqueInstance<Shape>("Circle", "")->name(), "circle");
  EXPECT_EQ(loader.unloadLibrary(SHAPES_LIBRARY), 0);
  EXPECT_FALSE(loader.isLibraryAvailable(SHAPES_LIBRARY));
  EXPECT_EQ(thrown_by<class_loader::LibraryUnloadException>([&] { loader.unloadLibrary(SHAPES_LIBRARY); }),
            "the library '" SHAPES_LIBRARY "' is not loaded");
  EXPECT_EQ(thrown_by<class_loader::NoClassLoaderExistsException>(
                [&] { loader.createInstance<Shape>("shapes::Square", SHAPES_LIBRARY); }),
            "the library '" SHAPES_LIBRARY "' is not loaded");
}

TEST(MultiLibraryClassLoader, OnDemandItLoadsWhatItNeeds) {
  MultiLibraryClassLoader loader(true);
  loader.loadLibrary(SHAPES_LIBRARY);
  EXPECT_EQ(loader.createInstance<Shape>("shapes::Triangle")->name(), "triangle");
}

}  // namespace

CLASS_LOADER_REGISTER_CLASS(Circle, Shape)
