// Draws the frames of a technique folder.
#pragma once

#include "techniques/folder/description.h"

namespace shadowbench::techniques {

/// The entry of the folder for the catalogue; its techniques keep what was read, so that later changes of the files do not
/// show. A shader that does not compile is BadInput with the file and the line when the technique is made.
Entry folderEntry(TechniqueFolder folder);

} // namespace shadowbench::techniques
