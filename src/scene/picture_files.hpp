#pragma once
// The files of the pictures of a scene.

#include <string>

#include "clca/image/image.hpp"
#include "scene/value.hpp"

namespace clca::scene {

struct PictureFile {
  image::Image image;
  std::string problem;  ///< why it cannot be read; empty if it can
};

/// Reads each file that a `picture` names as its `file`, once, and attaches it to all values that
/// name it. Paths begin at `folder`. Throws SceneError at the first picture with which the rows of
/// all are larger than the text of a scene may be.
void read_picture_files(Value& root, const std::string& folder);

}  // namespace clca::scene
