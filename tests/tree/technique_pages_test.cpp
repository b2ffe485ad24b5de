// The pages in docs/techniques are those that the program makes of the catalogue and of the published records.
#include "base/files.h"
#include "harness/records/comparability.h"
#include "studies/behaviour/technique_page.h"
#include "techniques/catalog.h"

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

/// The names of the pictures that a page shows.
std::set<std::string> picturesOf(const std::string& page) {
    static const std::string folder = "](../pictures/techniques/";
    std::set<std::string> names;
    for (std::size_t at = page.find(folder); at != std::string::npos; at = page.find(folder, at + 1))
        names.insert(page.substr(at + folder.size(), page.find(')', at) - at - folder.size()));
    return names;
}

TEST(TechniquePages, AreThoseOfCatalogueAndPublishedRecords) {
    const fs::path folder = root / "docs/techniques", pictures = root / "docs/pictures/techniques";
    std::vector<fs::path> files;
    for (const char* set : {"published", "failures"}) files.push_back(root / "results" / set / "results.jsonl");
    const std::vector<Record> records = gate::readOfOneDevice(files);
    std::set<std::string> pages, shown;
    for (const techniques::Entry& entry : techniques::catalog()) {
        const std::string name = entry.id + ".md", page = techniquePage(entry, records, pictures);
        pages.insert(name);
        shown.merge(picturesOf(page));
        ASSERT_TRUE(fs::exists(folder / name)) << name << " is not there; make it: tools/technique-pages";
        EXPECT_EQ(readFile(folder / name), page) << name << " is stale; make it again: tools/technique-pages";
    }
    EXPECT_EQ(namesIn(folder), pages);
    EXPECT_EQ(namesIn(pictures), shown) << "draw them again: tools/technique-pages";
}

} // namespace
} // namespace shadowbench
