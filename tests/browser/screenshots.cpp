// screenshots SITE OUT PAGE…: what Chromium shows of pages at 1280 × 800, as OUT/<page>.png. tools/screenshots calls it.
#include "tests/browser/browser.h"

#include "base/files.h"

#include <cstdio>
#include <exception>

namespace {

namespace fs = std::filesystem;
using shadowbench::browser::Browser;

/// "cells/simple.html#pcf&mode=slider" → "cells-simple-pcf-mode=slider"
std::string nameOf(std::string page) {
    if (const std::size_t at = page.find(".html"); at != std::string::npos) page.erase(at, 5);
    for (char& letter : page)
        if (letter == '/' || letter == '#' || letter == '&' || letter == ':') letter = '-';
    return page;
}

void shoot(Browser& browser, const fs::path& site, const fs::path& out, const std::string& page) {
    const std::size_t hash = std::min(page.find('#'), page.size());
    const auto tab = browser.tab();
    tab->open(site / page.substr(0, hash), page.substr(hash));
    tab->waitFor("[...document.querySelectorAll('.viewer')].every((e) => !e.viewer || e.viewer.shown?.edges)");
    const fs::path file = out / (nameOf(page) + ".png");
    shadowbench::writeFile(file, tab->screenshot());
    std::printf("%s\n", file.c_str());
}

} // namespace

int main(int count, char** words) {
    if (count < 4) {
        std::fprintf(stderr, "screenshots SITE OUT PAGE…\n");
        return 2;
    }
    try {
        Browser browser;
        for (int i = 3; i < count; ++i) shoot(browser, words[1], words[2], words[i]);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "screenshots: %s\n", error.what());
        return 5;
    }
    return 0;
}
