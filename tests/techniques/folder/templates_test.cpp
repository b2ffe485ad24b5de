// Technique folders that are written to begin with.
#include "base/error.h"
#include "base/files.h"
#include "base/temporary_folder.h"
#include "techniques/folder/folder_technique.h"
#include "techniques/folder/templates.h"
#include "tests/support/message_of.h"

#include <algorithm>
#include <gtest/gtest.h>

namespace shadowbench {
namespace {

namespace fs = std::filesystem;

TEST(FolderTemplates, AreWrittenAsTheyStandInTheTreeUnderTheNewId) {
    const TemporaryFolder room;
    const std::vector<std::string> names = techniques::folderTemplates();
    EXPECT_EQ(names, (std::vector<std::string>{"history", "pcf", "shadow-map", "vsm"}));
    for (const std::string& name : names) {
        const fs::path folder = room.path() / "deeper" / name,
                       source = fs::path(SOURCE_FOLDER) / "techniques/folder/templates" / name;
        const std::vector<fs::path> files = techniques::writeFromTemplate(name, "mine", folder);
        EXPECT_EQ(std::ssize(files), std::distance(fs::directory_iterator(source), fs::directory_iterator()));
        for (const fs::path& file : files)
            if (file.extension() != ".toml") {
                EXPECT_EQ(readFile(file), readFile(source / file.filename()));
            }
        EXPECT_EQ(techniques::readTechniqueFolder(folder).entry.id, "my:mine");
        const std::string expected = readFile(folder / "expect.toml");
        EXPECT_NE(expected.find("\"my:mine\""), std::string::npos);
        EXPECT_EQ(expected.find("my:" + name), std::string::npos);
    }
}

TEST(FolderTemplates, NeverReplaceWhatIsThere) {
    const TemporaryFolder room;
    const fs::path folder = room.path() / "mine";
    fs::create_directory(folder);
    const auto message = [&] {
        return test::messageOf<BadInput>([&] { techniques::writeFromTemplate("pcf", "mine", folder); });
    };
    EXPECT_EQ(message(), "there is something at " + folder.string() + " already; name another place with --folder");
    EXPECT_TRUE(fs::is_empty(folder));
    fs::remove(folder);
    writeFile(folder, "a file");
    EXPECT_NE(message(), "");
    EXPECT_EQ(readFile(folder), "a file");
}

TEST(FolderTemplates, RefuseWrongIdsAndNamesBeforeAnythingIsMade) {
    const TemporaryFolder room;
    const fs::path folder = room.path() / "mine";
    EXPECT_EQ(test::messageOf<BadInput>([&] { techniques::writeFromTemplate("pcf", "Mine", folder); }),
              "\"Mine\" is no id: lower-case letters, digits and -, 40 at most");
    EXPECT_NE(test::messageOf<BadInput>([&] {
                  techniques::writeFromTemplate("pfc", "mine", folder);
              }).find("did you mean \"pcf\""),
              std::string::npos);
    EXPECT_FALSE(fs::exists(folder));
}

} // namespace
} // namespace shadowbench
