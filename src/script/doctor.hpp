#pragma once

#include <string>
#include <vector>

namespace ricochet {

/// One thing that the program does, tried.
struct Finding {
  std::string what;
  std::string trouble;  ///< why it does not work, with the remedy; "" if it does
  bool needed;          ///< for the main job: an impact whose rows are stored
};

/// Tries everything in a folder of its own below `folder`, which it removes again. `golden`: the e of the impact that
/// is tried, to its last bit, as printf's %a writes it.
std::vector<Finding> examined(const std::string& folder, const std::string& golden);

/// Prints what works on this machine and what does not, tried in the folder of results. False if the main job does not.
bool examine();

}  // namespace ricochet
