// SPDX-License-Identifier: MIT
// Finds the file for a scene's name on the command line, and the picture's default name.
#pragma once

#include <string>
#include <vector>

namespace minkray {

/// Names of the built-in scenes, sorted. Searches the folder "scenes" of the sources that the
/// program was built in, and "share/minkray/scenes" where it is installed.
std::vector<std::string> built_in_scenes();

/// Returns the file for `name`: the name itself if there is such a file or if it looks like a path;
/// otherwise the built-in scene of that name. Throws BadInput that lists the built-in scenes if
/// there is none.
std::string scene_file(const std::string& name);

/// Default file for a scene's picture, in the working folder: "showcase.png" for
/// "scenes/showcase.json" with the suffix ".png". Throws WrongUsage if that file exists and is not
/// a picture by Minkray.
std::string default_output(const std::string& scene_file, const std::string& suffix);

}  // namespace minkray
