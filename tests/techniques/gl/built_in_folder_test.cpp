// A user's copy of a built-in technique folder draws the bits of the row.
#include "base/temporary_folder.h"
#include "scene/sky.h"
#include "techniques/folder/folder_technique.h"
#include "tests/support/built_in_folders.h"
#include "tests/support/stages.h"
#include "tests/support/test_names.h"

#include <gtest/gtest.h>

namespace shadowbench {
namespace {

/// Every choice of every parameter of words, each with all else at its default, and the variants of a run.
std::vector<std::string> variantsOf(const techniques::Entry& entry) {
    std::vector<std::string> variants = entry.variants;
    for (const techniques::Parameter& parameter : entry.parameters)
        if (const auto* words = std::get_if<techniques::OneOf>(&parameter.domain))
            for (const std::string& word : words->values) variants.push_back(parameter.name + "=" + word);
    return variants;
}

Image<float> drawn(Stage& stage, const techniques::Entry& entry, const std::string& variant) {
    const auto technique = entry.make(techniques::parseParameters(variant, entry.parameters, entry.id));
    for (int frame = 0; frame < 3; ++frame) stage.render(*technique, frame, 1);
    return stage.visibility();
}

std::vector<std::string> namesOfFolders() {
    std::vector<std::string> names;
    for (const std::filesystem::path& folder : builtInFolders())
        names.push_back((folder.parent_path().filename() / folder.filename()).string());
    return names;
}

class BuiltInFolder : public testing::TestWithParam<std::string> {};

TEST_P(BuiltInFolder, DrawsTheBitsOfItsRowWhereAUserHasCopiedIt) {
    Scene scene = boxScene(64);
    scene.light = {LightKind::Rectangle, {1.7, 6.1, -2.3}, {0, -1, 0}, {1, 0, 0}, {0, 0, 1}};
    Stage stage(scene);
    stage.show(0);
    const std::filesystem::path source = std::filesystem::path(SOURCE_FOLDER) / "techniques" / GetParam();
    const TemporaryFolder room;
    std::filesystem::copy(source, room.path() / "copy");
    const techniques::Entry copy = techniques::folderEntry(techniques::readTechniqueFolder(room.path() / "copy"));
    const techniques::Entry& row = techniques::entryNamed(source.filename().string());
    EXPECT_EQ(copy.id, "my:" + row.id);
    for (const std::string& variant : variantsOf(row)) {
        const Image<float> own = drawn(stage, row, variant), mine = drawn(stage, copy, variant);
        EXPECT_TRUE(std::ranges::equal(own, mine)) << variant;
    }
}

INSTANTIATE_TEST_SUITE_P(Catalogue, BuiltInFolder, testing::ValuesIn(namesOfFolders()), nameOfText);

} // namespace
} // namespace shadowbench
