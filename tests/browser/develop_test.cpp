// The page of `develop`: a save changes what it shows, and it can be used by every eye and by the keyboard.
#include "tests/browser/checks.h"
#include "tests/support/live_page.h"

#include <gtest/gtest.h>

namespace shadowbench::browser {
namespace {

class DevelopPage : public testing::Test {
protected:
    std::unique_ptr<Tab> open(const Looks& looks = {}) const {
        std::unique_ptr<Tab> tab = chromium().tab(looks);
        tab->visit(page_.address() + "/");
        tab->waitFor(drawn);
        return tab;
    }

    static std::string text(Tab& tab, const std::string& expression) {
        return tab.value("(" + expression + ").textContent");
    }
    static std::string leak(Tab& tab, int column) { return text(tab, leakRow + ".cells[" + std::to_string(column) + "]"); }
    static std::string picture(Tab& tab) { return tab.value("new URL(document.querySelector('img').src).pathname"); }
    static std::string errorText(Tab& tab) { return text(tab, "document.getElementById('error')"); }

    /// A shader in which all is lit: false shadows are gone, and leaks are more.
    void saveAllLit() const {
        mine_.write("resolve.frag", replaced(mapShader, "shadowTest(depths, testedPoint(receiver))", "1.0"));
    }

    static constexpr const char* drawn = "document.querySelector('img')?.naturalWidth > 0";
    static inline const std::string leakRow =
        "[...document.querySelectorAll('tbody tr')].find((row) => row.cells[0].textContent === 'leak')";

    WrittenTechnique mine_;
    TemporaryFolder temporary_;
    LivePage page_{mine_.path(), temporary_.path()};
};

TEST_F(DevelopPage, ShowsFiguresAndPicturesOfASaveBesideThoseThatAreKept) {
    const auto tab = open();
    EXPECT_EQ(leak(*tab, 3), "as kept");
    const std::string before = leak(*tab, 1), firstPicture = picture(*tab);
    saveAllLit();
    tab->waitFor(leakRow + ".cells[3].textContent.startsWith('▲')");
    EXPECT_NE(leak(*tab, 1), before);
    EXPECT_EQ(leak(*tab, 2), before);
    const std::string newPicture = picture(*tab);
    EXPECT_NE(newPicture, firstPicture);

    tab->press("c");
    EXPECT_EQ(picture(*tab), firstPicture);
    EXPECT_EQ(tab->value("document.getElementById('flip').ariaPressed"), "true");
    tab->press("c");
    EXPECT_EQ(picture(*tab), newPicture);
    tab->press("k");
    tab->waitFor(leakRow + ".cells[3].textContent === 'as kept'");
    tab->press("y");
    tab->waitFor("/copied|selected/.test(document.getElementById('state').textContent)");
    EXPECT_EQ(tab->complaints(), Sentences());
}

TEST_F(DevelopPage, SaysAnErrorOverThePictureThatWasGood) {
    const auto tab = open();
    const std::string good = picture(*tab);
    mine_.write("resolve.frag", replaced(mapShader, "receiver.seen ?", "reciever.seen ?"));
    tab->waitFor("!document.getElementById('error').hidden");
    EXPECT_EQ(errorText(*tab), "resolve.frag:8: error: `reciever' undeclared (did you mean \"receiver\" or \"Receiver\"?)");
    EXPECT_EQ(tab->value("document.getElementById('error').getAttribute('role')"), "alert");
    EXPECT_EQ(picture(*tab), good);
    EXPECT_EQ(tab->value("getComputedStyle(document.querySelector('img')).opacity"), "0.3");
    mine_.write("resolve.frag", mapShader);
    tab->waitFor("document.getElementById('error').hidden");
    EXPECT_EQ(tab->value("getComputedStyle(document.querySelector('img')).opacity"), "1");
}

TEST_F(DevelopPage, CanBeUsedByEveryEyeAndByTheKeyboard) {
    for (const bool dark : {false, true}) {
        const auto tab = open({.dark = dark});
        EXPECT_EQ(lowContrast(*tab), Sentences()) << (dark ? "dark" : "light");
        EXPECT_EQ(faultsOf(*tab, "develop"), Sentences());
        EXPECT_EQ(missingContent(*tab), Sentences());
        for (const auto& [width, height] : {std::pair(400, 800), std::pair(2560, 1440)}) {
            EXPECT_EQ(overflow(*tab, width, height), Sentences());
            EXPECT_EQ(overlaps(*tab, width, height), Sentences());
        }
        EXPECT_EQ(keyboardFaults(*tab), Sentences());
    }
}

} // namespace
} // namespace shadowbench::browser
