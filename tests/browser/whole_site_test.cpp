// The viewer where it is part of something larger: of a site in one file, and of a comparison with older records.
#include "base/files.h"
#include "base/image_io.h"
#include "base/temporary_folder.h"
#include "site/site.h"
#include "tests/browser/checks.h"
#include "tests/browser/tiny_run.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace shadowbench::browser {
namespace {

namespace fs = std::filesystem;

const std::string pcf = "pcf_map=64";

/// The site of the tiny run as one file, alone in its folder.
const fs::path& singleFile() {
    static const TemporaryFolder folder;
    static const fs::path file = [] {
        fs::path made = folder.path() / "run.html";
        site::writeSingleFile(tinyRun().folder(), made);
        return made;
    }();
    return file;
}

std::string idOfCells(Tab& tab) { return tab.value("document.querySelector('[id^=page-cells_tiny]').id"); }

/// Waits until the viewer of the page that is shown shows something.
void waitForViewer(Tab& tab) { tab.waitFor("document.querySelector('.viewer').viewer?.shown?.edges"); }

TEST(SingleFile, ShowsItsFirstPageAndComplainsOfNothing) {
    const auto tab = chromium().tab();
    tab->open(singleFile());
    EXPECT_EQ(tab->value("[...document.querySelectorAll('.page')].filter((e) => e.checkVisibility()).map((e) => e.id)"),
              nlohmann::json::array({"page-index.html"}));
    EXPECT_EQ(tab->value("document.querySelector('.viewer').viewer"), nullptr) << "unpacked before it is seen";
    EXPECT_EQ(tab->complaints(), Sentences());
}

TEST(SingleFile, HasEveryPageWithoutJavaScript) {
    const auto tab = chromium().tab({.scripts = false});
    tab->open(singleFile());
    const std::string page = idOfCells(*tab);
    tab->open(singleFile(), "#" + page + "-cell-" + pcf);
    EXPECT_EQ(tab->value("[...document.querySelectorAll('.page')].filter((e) => e.checkVisibility()).map((e) => e.id)"),
              nlohmann::json::array({page}));
    const std::string pictures = "[...document.getElementById('" + page + "-cell-" + pcf + "').querySelectorAll('TAG')]";
    const auto of = [&](std::string tag) { return std::string(pictures).replace(pictures.find("TAG"), 3, tag); };
    EXPECT_EQ(tab->value(of("img") + ".map((e) => e.naturalWidth)"), nlohmann::json::array({48, 48}));
    EXPECT_EQ(tab->value(of("svg[role=img] use") + ".map((e) => e.getBBox().width)"), nlohmann::json::array({48}))
        << "the truth, which all cells share";
}

TEST(SingleFile, ShowsPixelsAndIsShownByAnAddressAsItWasSeen) {
    const Image<float> v = readChannel(tinyRun().images() / "tiny" / pcf / "visibility.exr", "V");
    const auto tab = chromium().tab();
    tab->open(singleFile());
    tab->value("document.querySelector('[data-table=\"page-choose.html-all\"] a[href*=\"pcf\"]').click()");
    waitForViewer(*tab);
    tab->press("n");
    const std::vector<int> pixel = tab->value("document.querySelector('.viewer').viewer.view.pixel");
    EXPECT_EQ(std::stof(tab->value("document.querySelector('[data-field=technique]').textContent").get<std::string>()),
              v(pixel[0], pixel[1]));
    tab->value("new Promise((done) => setTimeout(done, 200))");
    const std::string seen = tab->value("location.hash");
    EXPECT_NE(seen.find("-cell-" + pcf), std::string::npos) << seen;
    EXPECT_NE(seen.find(fmt::format("&pixel={},{}", pixel[0], pixel[1])), std::string::npos) << seen;
    const auto another = chromium().tab();
    another->open(singleFile(), seen);
    waitForViewer(*another);
    EXPECT_EQ(another->value("location.hash"), seen);
    const std::string values = "document.querySelector('.viewer .readout').textContent";
    EXPECT_EQ(another->value(values), tab->value(values));
    EXPECT_TRUE(another->value("document.querySelector('.viewer').checkVisibility()"));
    another->value("document.querySelector('.top .brand').click()");
    another->waitFor("document.querySelector('[id=\"page-index.html\"]').checkVisibility()");
    EXPECT_FALSE(another->value("document.querySelector('.viewer').checkVisibility()"));
    EXPECT_EQ(another->complaints(), Sentences());
}

TEST(SingleFile, HoldsTheFramesOfSequences) {
    const auto tab = chromium().tab();
    tab->open(singleFile());
    tab->open(singleFile(), "#" + idOfCells(*tab) + "-cell-sm-uniform_map=64&mode=frames&frame=1");
    waitForViewer(*tab);
    EXPECT_EQ(tab->value("document.querySelector('.viewer').dataset.mode"), "frames");
    EXPECT_EQ(tab->complaints(), Sentences());
}

TEST(Comparison, ShowsHeadAgainstBaseInTheViewer) {
    std::vector<Record> base = tinyRun().records();
    for (Record& record : base) {
        if (record.variant != "pcf:map=64") continue;
        record.values["accuracy.leak"] = *record.values["accuracy.leak"] / 2;
        record.images = "drawn otherwise";
    }
    const TemporaryFolder folder;
    fs::create_directories(folder.path() / "base");
    fs::copy(tinyRun().images(), folder.path() / "base/images", fs::copy_options::recursive);
    fs::copy_file(folder.path() / "base/images/tiny/none/visibility.exr",
                  folder.path() / "base/images/tiny" / pcf / "visibility.exr", fs::copy_options::overwrite_existing);
    site::writeSite({.records = tinyRun().records(),
                     .images = tinyRun().images(),
                     .base = base,
                     .baseName = "before",
                     .baseImages = folder.path() / "base/images"},
                    folder.path() / "site");
    const auto tab = chromium().tab();
    tab->open(folder.path() / "site/gate.html");
    EXPECT_EQ(missingContent(*tab), Sentences());
    EXPECT_EQ(tab->value("document.querySelectorAll('.pictures img').length"), 5);
    const std::string address = tab->value("document.querySelector('a[href*=\"against\"]').getAttribute('href')");
    EXPECT_EQ(address, "cells/tiny.html#" + pcf + "&against=cell:base_" + pcf);
    tab->open(folder.path() / "site/cells/tiny.html", address.substr(address.find('#')) + "&pixel=3,3");
    waitForViewer(*tab);
    EXPECT_EQ(tab->value("document.querySelector('[name=against]').value"), "cell:base_" + pcf);
    EXPECT_EQ(tab->value("document.querySelector('.viewer').viewer.shown.other.every((v) => v === 1)"), true)
        << "the base draws no shadow";
    EXPECT_EQ(tab->complaints(), Sentences());
}

} // namespace
} // namespace shadowbench::browser
