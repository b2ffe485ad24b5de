// Every page of the site that a run ends with, opened from its file. Another site: SHADOWBENCH_SITE=FOLDER names it.
#include "tests/browser/browser.h"
#include "tests/browser/checks.h"
#include "tests/browser/tiny_run.h"

#include <cstdlib>
#include <gtest/gtest.h>

namespace shadowbench::browser {
namespace {

namespace fs = std::filesystem;

Browser& chromium() {
    static Browser browser;
    return browser;
}

fs::path siteFolder() {
    const char* chosen = std::getenv("SHADOWBENCH_SITE");
    return chosen != nullptr ? fs::path(chosen) : tinyRun().folder();
}

TEST(Pages, AreThereAndTheFirstIsTheIndex) {
    EXPECT_TRUE(fs::exists(siteFolder() / "index.html"));
    EXPECT_GE(pagesOf(siteFolder()).size(), 3U);
}

TEST(Pages, LoadWithoutComplaintAndFitPhonesAndWideScreens) {
    const auto tab = chromium().tab();
    for (const fs::path& page : pagesOf(siteFolder())) {
        tab->open(page);
        EXPECT_EQ(overflow(*tab, 400, 800), Sentences()) << page;
        EXPECT_EQ(overflow(*tab, 2560, 1440), Sentences()) << page;
    }
    EXPECT_EQ(tab->complaints(), Sentences());
}

TEST(Pages, NameWhatTheyShowAndLeadOnlyToFilesThatAreThere) {
    for (const fs::path& page : pagesOf(siteFolder())) {
        const auto tab = chromium().tab();
        tab->open(page);
        EXPECT_EQ(faultsOf(*tab, page), Sentences());
    }
}

TEST(Pages, HaveEveryTableAndPictureWithoutJavaScript) {
    const auto tab = chromium().tab({.scripts = false});
    for (const fs::path& page : pagesOf(siteFolder())) {
        tab->open(page);
        EXPECT_EQ(missingContent(*tab), Sentences()) << page;
    }
}

} // namespace
} // namespace shadowbench::browser
