// SPDX-License-Identifier: MIT
// Which file a scene's name on the command line means, and where its picture goes by default.
#pragma once

#include <string>
#include <vector>

namespace minkray {

/// The names of the scenes that come with Minkray, sorted. They are looked for in the folder
/// "scenes" of the sources that the program was built in and in "share/minkray/scenes" of the place
/// that it was installed to.
std::vector<std::string> built_in_scenes();

/// The file that `name` means: itself if there is such a file or if it looks like a path; else the
/// scene of that name that comes with Minkray. Throws BadInput that names the scenes there are if
/// it is neither.
std::string scene_file(const std::string& name);

/// The file in the working folder that the picture of a scene goes to if no other is named:
/// "showcase.png" for "scenes/showcase.json" with the suffix ".png". Throws WrongUsage if it is
/// there already and is no picture by Minkray.
std::string default_output(const std::string& scene_file, const std::string& suffix);

}  // namespace minkray
