// Rows of the catalogue that are technique folders.
#include "techniques/catalog.h"
#include "techniques/folder/description.h"
#include "techniques/folder_passes.h"
#include "tests/support/built_in_folders.h"

#include <gtest/gtest.h>

namespace shadowbench {
namespace {

TEST(BuiltInFolder, IsARowOfTheNameThatItHasInTheTree) {
    ASSERT_FALSE(builtInFolders().empty());
    for (const std::filesystem::path& folder : builtInFolders()) {
        const techniques::Entry& entry = techniques::entryNamed(folder.filename().string());
        EXPECT_FALSE(techniques::drawnWith(entry.id).empty()) << folder << " has no line in techniques/catalog.inc";
        EXPECT_TRUE(entry.digest.empty()) << entry.id;
        EXPECT_FALSE(techniques::citation(entry.source).empty()) << entry.id;
    }
}

TEST(BuiltInFolder, IsReadByTheReaderOfUsersFolders) {
    for (const std::filesystem::path& folder : builtInFolders()) {
        const techniques::TechniqueFolder read = techniques::readTechniqueFolder(folder);
        const techniques::Entry& row = techniques::entryNamed(folder.filename().string());
        EXPECT_EQ(read.entry.id, "my:" + row.id);
        EXPECT_EQ(read.entry.title, row.title);
        EXPECT_EQ(read.entry.variants, row.variants) << row.id;
        EXPECT_EQ(read.entry.lacks, row.lacks) << row.id;
    }
}

} // namespace
} // namespace shadowbench
