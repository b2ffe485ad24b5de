// Rows of the folders under techniques/modern, as they lie in the tree.
#pragma once

#include "techniques/folder/folder_technique.h"
#include "tests/support/stages.h"

#include <filesystem>
#include <string>

namespace shadowbench {

inline techniques::Entry modernRow(const std::string& id) {
    return techniques::folderEntry(
        techniques::readTechniqueFolder(std::filesystem::path(SOURCE_FOLDER) / "techniques/modern" / id));
}

/// The first frame.
inline Image<float> renderedModern(Stage& stage, const std::string& id, const std::string& parameters = "") {
    const techniques::Entry entry = modernRow(id);
    const auto technique = entry.make(techniques::parseParameters(parameters, entry.parameters, entry.id));
    stage.render(*technique, 0, 1);
    return stage.visibility();
}

} // namespace shadowbench
