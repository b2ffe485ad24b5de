// The viewer of cells in a real browser, from a file.
#include "base/files.h"
#include "base/image_io.h"
#include "harness/cells/kept_images.h"
#include "site/names.h"
#include "site/viewer/cells.h"
#include "tests/browser/browser.h"
#include "tests/browser/checks.h"
#include "tests/browser/tiny_run.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <gtest/gtest.h>

namespace shadowbench::browser {
namespace {

namespace fs = std::filesystem;

constexpr int side = 48;
const std::string pcf = "pcf_map=64", uniform = "sm-uniform_map=64"; // slugs

/// A site of nothing but cells.
class Cells : public testing::Test {
protected:
    static void writeSite(const std::vector<Record>& records, const fs::path& images, const fs::path& folder) {
        site::SiteWriter writer(folder, {});
        site::writeCells(records, images, writer);
        writer.writeAssets();
    }

    static const fs::path& page() {
        static const TemporaryFolder folder;
        static const fs::path file = [&] {
            writeSite(tinyRun().records(), tinyRun().images(), folder.path());
            return folder.path() / "cells/tiny.html";
        }();
        return file;
    }

    std::unique_ptr<Tab> open(const std::string& hash, const Looks& looks = {}) const {
        std::unique_ptr<Tab> tab = chromium().tab(looks);
        tab->open(page(), hash);
        tab->waitFor(shown);
        return tab;
    }

    /// Waits until the view has been remembered with this in its address.
    static void waitForAddress(Tab& tab, const std::string& part) { tab.waitFor("location.hash.includes('" + part + "')"); }

    /// The view once its address has been remembered.
    static std::string address(Tab& tab) {
        tab.value("new Promise((done) => setTimeout(done, 200))");
        return tab.value("location.hash");
    }

    static std::string field(Tab& tab, const std::string& name) {
        return tab.value("document.querySelector('[data-field=" + name + "]').textContent");
    }

    static nlohmann::json paneCentre(Tab& tab) {
        return tab.value("(() => { const box = document.querySelector('.viewer canvas').getBoundingClientRect();"
                         "return [box.x + box.width / 2, box.y + box.height / 2, box.width]; })()");
    }

    static Image<float> exr(const std::string& variant) {
        return readChannel(tinyRun().images() / "tiny" / variant / "visibility.exr", "V");
    }
    static Image<float> truth(const std::string& channel) {
        return readChannel(tinyRun().images() / "tiny/truth-hard.exr", channel);
    }

    static constexpr const char* shown = "document.querySelector('.viewer').viewer?.shown?.edges";
    static constexpr const char* picture = "document.querySelector('.viewer canvas').toDataURL()";
};

TEST_F(Cells, HaveThePixelValuesOfTheExrBitForBit) {
    const auto tab = open("#" + pcf);
    for (const std::string& variant : {pcf, uniform, std::string("volume-zfail")}) {
        const Image<float> expected = exr(variant);
        const auto values = tab->value("shadowbench.channels('tiny/" + variant + "').then((c) => [...c.V])");
        ASSERT_EQ(values.size(), expected.size()) << variant;
        for (std::size_t i = 0; i < expected.size(); ++i)
            ASSERT_EQ(values[i].get<double>(), static_cast<double>(expected[i])) << variant << " " << i;
    }
    EXPECT_EQ(tab->complaints(), Sentences());
}

TEST_F(Cells, ShowTheValuesOfThePixelUnderThePointer) {
    const Image<float> v = exr(pcf), exact = truth("V"), sigma = truth("sigma");
    const auto tab = open("#" + pcf);
    for (int i = 0; i < side; i += 5) {
        const glm::ivec2 pixel(i, (7 * i + 11) % side);
        tab->value(fmt::format("location.hash = '#{}&pixel={},{}'", pcf, pixel.x, pixel.y));
        tab->waitFor(fmt::format("document.querySelector('[data-field=pixel]').textContent === '{}, {}'", pixel.x, pixel.y));
        EXPECT_EQ(std::stof(field(*tab, "technique")), v(pixel.x, pixel.y));
        EXPECT_EQ(std::stof(field(*tab, "truth")), exact(pixel.x, pixel.y));
        EXPECT_EQ(std::stof(field(*tab, "sigma")), sigma(pixel.x, pixel.y));
    }
}

TEST_F(Cells, ChooseThePixelThatIsClicked) {
    const auto tab = open("#" + pcf + "&mode=difference");
    const auto box = tab->value("(() => { const c = document.querySelector('.viewer canvas'), b = c.getBoundingClientRect();"
                                "const f = c.closest('.viewer').viewer.frame(c);"
                                "return [b.x + f.left, b.y + f.top, f.zoom]; })()");
    const double zoom = box[2];
    tab->click(box[0].get<double>() + 20.5 * zoom, box[1].get<double>() + 31.5 * zoom);
    EXPECT_EQ(field(*tab, "pixel"), "20, 31");
    waitForAddress(*tab, "pixel=20,31");
    tab->press("ArrowRight");
    EXPECT_EQ(field(*tab, "pixel"), "21, 31");
}

TEST_F(Cells, MoveTheSliderWithPointerAndKeyboard) {
    const auto tab = open("#" + uniform + "&mode=slider");
    const auto before = tab->value(picture);
    const auto centre = paneCentre(*tab);
    const double x = centre[0], y = centre[1], width = centre[2];
    tab->drag(x, y, x - 0.3 * width, y);
    const double split = tab->value("document.querySelector('.viewer').viewer.view.split");
    EXPECT_NEAR(split, 0.2, 0.01);
    EXPECT_NE(tab->value(picture), before);
    tab->press(">");
    EXPECT_NEAR(tab->value("document.querySelector('.viewer').viewer.view.split").get<double>(), split + 0.05, 1e-9);
    EXPECT_NEAR(tab->value("Number(document.querySelector('[name=split]').value)").get<double>(), split + 0.05, 0.01);
}

TEST_F(Cells, AreShownByAnAddressAsTheyWereSeen) {
    const auto tab = open("#" + pcf);
    for (const char* key : {"n", "n", "+", "4", "g", "e", "]", "["}) tab->press(key);
    tab->waitFor(shown);
    const std::string seen = address(*tab);
    for (const char* part : {"pixel=", "zoom=", "mode=difference", "gain=4", "edges=0"})
        EXPECT_NE(seen.find(part), std::string::npos) << seen << " lacks " << part;
    const auto another = open(seen);
    EXPECT_EQ(address(*another), seen);
    EXPECT_EQ(another->value(picture), tab->value(picture));
    EXPECT_EQ(field(*another, "technique"), field(*tab, "technique"));
}

TEST_F(Cells, GoToTheWorstPixelFirst) {
    const Image<float> v = exr(uniform), exact = truth("V"), surface = truth("surface");
    float worst = 0;
    for (std::size_t i = 0; i < v.size(); ++i)
        if (surface[i] == 2) worst = std::max(worst, std::abs(v[i] - exact[i]));
    ASSERT_GT(worst, 0.5F);
    const auto tab = open("#" + uniform);
    tab->press("n");
    EXPECT_EQ(std::abs(std::stof(field(*tab, "error"))), worst);
    EXPECT_NE(field(*tab, "error").find(field(*tab, "error").starts_with("-") ? "false shadow" : "leak"), std::string::npos);
    const std::string first = field(*tab, "pixel");
    tab->press("n");
    EXPECT_NE(field(*tab, "pixel"), first);
    tab->press("p");
    EXPECT_EQ(field(*tab, "pixel"), first);
}

TEST_F(Cells, KeepThePlaceWhenAnotherTechniqueIsChosen) {
    const auto tab = open("#" + uniform + "&pixel=12,30&zoom=30&mode=slider");
    tab->press("]");
    tab->waitFor("!location.hash.startsWith('#" + uniform + "')");
    const std::string seen = address(*tab);
    EXPECT_FALSE(seen.starts_with("#" + uniform)) << seen;
    for (const char* part : {"pixel=12,30", "zoom=30", "mode=slider"}) EXPECT_NE(seen.find(part), std::string::npos) << seen;
}

TEST_F(Cells, ListTheirKeysAndActOnEachWithoutComplaint) {
    const auto tab = open("#" + uniform);
    tab->press("?");
    EXPECT_TRUE(tab->value("document.querySelector('.viewer-help').open").get<bool>());
    const auto keys = tab->value("[...document.querySelectorAll('.viewer-help kbd')].map((e) => e.textContent)");
    EXPECT_GE(keys.size(), 15U);
    tab->value("document.querySelector('.viewer-help').close()");
    for (const auto& key : keys)
        if (const auto text = key.get<std::string>(); text.size() == 1 && text != "?") tab->press(text);
    tab->press(" ");
    EXPECT_EQ(tab->complaints(), Sentences());
}

TEST_F(Cells, FlickerInPlaceUnlessMotionIsUnwanted) {
    Looks lively;
    lively.still = false;
    for (const bool still : {false, true}) {
        lively.still = still;
        const auto tab = open("#" + uniform + "&mode=flicker", lively);
        const auto first = tab->value(picture);
        tab->value("new Promise((done) => setTimeout(done, 750))");
        EXPECT_EQ(tab->value(picture) == first, still);
        const auto now = tab->value(picture);
        tab->press(" ");
        EXPECT_NE(tab->value(picture), now);
    }
}

TEST_F(Cells, ShowTheFramesOfTheSequenceAndWhatFlickers) {
    const auto tab = open("#" + uniform + "&mode=frames");
    EXPECT_EQ(tab->value("[...document.querySelectorAll('.viewer .pane')].filter((e) => !e.hidden).length"), 3);
    EXPECT_EQ(tab->value("Number(document.querySelector('[name=frame]').max)"), 1);
    tab->press(".");
    waitForAddress(*tab, "frame=1");
    EXPECT_NE(
        tab->value("document.querySelector('.viewer figcaption').textContent").get<std::string>().find("moving frame 1"),
        std::string::npos);
}

TEST_F(Cells, HoldTheFramesOfTheFrontOrOfAll) {
    std::vector<Record> records = tinyRun().records();
    for (Record& record : records) record.values["cost.time.ratio"] = record.variant == "volume-zfail" ? 1 : 2;
    for (const auto& [sequences, count] :
         {std::pair(site::Sequences::Fronts, std::size_t{1}), std::pair(site::Sequences::All, records.size())}) {
        const TemporaryFolder folder;
        site::SiteWriter writer(folder.path(), {});
        site::writeCells(records, tinyRun().images(), writer, sequences);
        std::size_t found = 0;
        for (const fs::directory_entry& entry : fs::directory_iterator(folder.path() / "cells/tiny"))
            if (entry.path().stem().string().ends_with("-sequence")) ++found;
        EXPECT_EQ(found, count);
    }
}

TEST_F(Cells, ShowTheSceneWithItsShadowsByKeyAndBySwitch) {
    const auto shading = readShading(shadingFile(tinyRun().images(), "tiny"));
    ASSERT_TRUE(shading);
    const Image<glm::vec3> expected = shadedPicture(*shading, exr(pcf)), exact = shadedPicture(*shading, truth("V"));
    const auto tab = open("#" + pcf);
    const auto before = tab->value(picture);
    tab->press("s");
    tab->waitFor("document.querySelector('.viewer').viewer.shown?.shading");
    waitForAddress(*tab, "shaded=1");
    EXPECT_TRUE(tab->value("document.querySelector('[name=shaded]').checked").get<bool>());
    for (const auto& [pane, wanted] : {std::pair("technique", &expected), std::pair("second", &exact)}) {
        const auto shownPixels = tab->value(std::string("[...document.querySelector('.viewer').viewer.shown.") + pane +
                                            ".getContext('2d').getImageData(0, 0, 48, 48).data]");
        for (std::size_t i = 0; i < wanted->size(); ++i)
            for (int c = 0; c < 3; ++c)
                ASSERT_NEAR(shownPixels[4 * i + static_cast<std::size_t>(c)].get<double>(), 255 * (*wanted)[i][c], 1.5)
                    << pane << " " << i;
    }
    tab->value("document.querySelector('[name=shaded]').click()");
    tab->waitFor(
        "document.querySelector('.viewer').viewer.shown && !document.querySelector('.viewer').viewer.shown.shading");
    EXPECT_EQ(tab->value(picture), before);
    EXPECT_EQ(tab->complaints(), Sentences());
}

TEST_F(Cells, HaveNoSwitchToShadedPicturesOfARunThatHasKeptNone) {
    const TemporaryFolder folder;
    fs::copy(tinyRun().images(), folder.path() / "images", fs::copy_options::recursive);
    fs::remove(folder.path() / "images/tiny/shading.exr");
    writeSite(tinyRun().records(), folder.path() / "images", folder.path() / "site");
    const auto tab = chromium().tab();
    tab->open(folder.path() / "site/cells/tiny.html", "#" + pcf + "&shaded=1");
    tab->waitFor(shown);
    EXPECT_TRUE(tab->value("document.querySelector('[data-for=shaded]').hidden").get<bool>());
    EXPECT_EQ(address(*tab).find("shaded"), std::string::npos);
}

TEST_F(Cells, FitPhonesAndWideScreensLightAndDark) {
    for (const bool dark : {false, true}) {
        const auto tab = open("#" + pcf, {.dark = dark});
        EXPECT_EQ(overflow(*tab, 400, 800), Sentences());
        EXPECT_EQ(overflow(*tab, 2560, 1440), Sentences());
    }
}

TEST_F(Cells, HaveEveryPictureWithoutJavaScript) {
    const auto tab = chromium().tab({.scripts = false});
    tab->open(page());
    EXPECT_EQ(missingContent(*tab), Sentences());
    EXPECT_EQ(tab->value("document.querySelectorAll('.cell-pictures img').length"), 3 * tinyRun().records().size());
    EXPECT_EQ(tab->value("document.querySelector('.viewer').hidden"), true);
    EXPECT_EQ(tab->complaints(), Sentences());
}

TEST_F(Cells, SayWhichFileOfPixelValuesIsMissing) {
    const TemporaryFolder folder;
    writeSite(tinyRun().records(), tinyRun().images(), folder.path());
    fs::remove(folder.path() / "cells/tiny" / (pcf + ".js"));
    const auto tab = chromium().tab();
    tab->open(folder.path() / "cells/tiny.html", "#" + pcf);
    tab->waitFor("document.querySelector('.viewer .status').textContent.includes('tiny/pcf_map=64.js is missing')");
    tab->press("]");
    tab->waitFor(shown);
}

TEST_F(Cells, ShowHostileNamesAsText) {
    const std::string name = "<img src=x onerror=document.title='ran'>\"'&{{x}}\n";
    const TemporaryFolder folder;
    std::vector<Record> records = tinyRun().records();
    const fs::path images = folder.path() / "images";
    fs::create_directories(images);
    fs::copy(tinyRun().images() / "tiny", images / name, fs::copy_options::recursive);
    fs::copy(images / name / "none", images / name / name, fs::copy_options::recursive);
    for (Record& record : records) record.scene = name;
    records.front().variant = name;
    records.push_back(records.front());
    records.back().scene = "../" + std::string(1'000'000, 'x');
    writeSite(records, images, folder.path() / "site");
    const std::vector<fs::path> pages = pagesOf(folder.path() / "site");
    ASSERT_EQ(pages.size(), 1U);
    const auto tab = chromium().tab();
    tab->open(pages.front());
    tab->waitFor(shown);
    EXPECT_EQ(tab->complaints(), Sentences());
    EXPECT_NE(tab->value("document.title"), "ran");
    EXPECT_NE(tab->value("document.querySelector('[name=cell]').textContent").get<std::string>().find("<img src=x"),
              std::string::npos);
}

TEST_F(Cells, StayReadableForAddressesThatMakeNoSense) {
    for (const char* hash : {"#%", "#nobody&mode=upside-down&zoom=-1e999&pixel=99999,1", "#&pixel=<b>,2&gain=3&split=NaN"}) {
        const auto tab = open(hash);
        EXPECT_EQ(tab->complaints(), Sentences()) << hash;
    }
}

} // namespace
} // namespace shadowbench::browser
