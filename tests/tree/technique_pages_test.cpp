// The pages in docs/techniques are those that the program makes of the catalogue and of the published records.
#include "base/files.h"
#include "harness/records/comparability.h"
#include "harness/studies/behaviour/technique_page.h"
#include "techniques/catalog.h"
#include "tests/support/citations.h"

#include <gtest/gtest.h>
#include <set>

namespace shadowbench {
namespace {
namespace fs = std::filesystem;

const fs::path root = SOURCE_FOLDER;

std::set<std::string> namesIn(const fs::path& folder) {
    std::set<std::string> names;
    for (const fs::directory_entry& file : fs::directory_iterator(folder)) names.insert(file.path().filename().string());
    return names;
}

/// The scenes that a page names, one for each picture.
long scenesIn(const std::string& page) {
    long scenes = 0;
    for (const std::string& line : citations::linesOf(page)) scenes += line.starts_with("* **By the error**: `") ? 1 : 0;
    return scenes;
}

TEST(TechniquePages, AreThoseOfCatalogueAndPublishedRecords) {
    const fs::path folder = root / "docs/techniques", pictures = root / "docs/pictures/techniques";
    const std::vector<Record> records =
        gate::readOfOneDevice({root / "results/published/results.jsonl", root / "results/failures/results.jsonl"});
    std::set<std::string> pages;
    long scenes = 0;
    for (const techniques::Entry& entry : techniques::catalog()) {
        const std::string name = entry.id + ".md", page = techniquePage(entry, records, pictures);
        pages.insert(name);
        scenes += scenesIn(page);
        ASSERT_TRUE(fs::exists(folder / name)) << name << " is not there; make it: tools/technique-pages";
        EXPECT_EQ(readFile(folder / name), page) << name << " is stale; make it again: tools/technique-pages";
    }
    EXPECT_EQ(namesIn(folder), pages);
    if (fs::exists(pictures)) { // all or none
        EXPECT_EQ(std::ssize(namesIn(pictures)), scenes) << "draw them again: tools/technique-pages";
    }
}

} // namespace
} // namespace shadowbench
