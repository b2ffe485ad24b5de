// `develop`: a technique folder's rows on a page that shows each state of the folder as it is saved.
#pragma once

#include "studies/develop/drawing.h"

#include <functional>
#include <string>

namespace shadowbench::develop {

/// Draws the folder now and after each change of it, until the user interrupts. `ready` is called with the page's port once
/// it can be opened; `command` is what shows a state again. Throws BadInput for a scene that cannot be had.
void develop(Request request, const std::string& command, const std::function<void(int)>& ready);

} // namespace shadowbench::develop
