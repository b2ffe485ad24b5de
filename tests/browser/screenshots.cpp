// screenshots SITE OUT PAGE…: what Chromium shows of pages, as OUT/<page>.png. tools/screenshots calls it, and says what
// stands behind a page.
#include "tests/browser/browser.h"

#include "base/files.h"

#include <cstdio>
#include <exception>

namespace {

namespace fs = std::filesystem;
using shadowbench::browser::Browser;
using shadowbench::browser::Looks;

/// "cells/simple.html#pcf&mode=slider" → "cells-simple-pcf-mode=slider"
std::string nameOf(std::string page) {
    if (const std::size_t at = page.find(".html"); at != std::string::npos) page.erase(at, 5);
    for (char& letter : page)
        if (letter == '/' || letter == '#' || letter == '&' || letter == ':' || letter == '@') letter = '-';
    return page;
}

/// What "@dark" and "@400x800" ask for.
Looks looksOf(const std::string& words) {
    Looks looks;
    looks.dark = words.find("@dark") != std::string::npos;
    for (std::size_t at = words.find('@'); at != std::string::npos; at = words.find('@', at + 1)) {
        int width = 0, height = 0;
        if (std::sscanf(words.c_str() + at, "@%dx%d", &width, &height) != 2) continue;
        looks.width = width;
        looks.height = height;
    }
    return looks;
}

void shoot(Browser& browser, const fs::path& site, const fs::path& out, const std::string& words) {
    const std::string page = words.substr(0, words.find('@'));
    const std::size_t hash = std::min(page.find('#'), page.size());
    const auto tab = browser.tab(looksOf(words.substr(page.size())));
    tab->open(site / page.substr(0, hash), page.substr(hash));
    tab->waitForViewers();
    tab->value("new Promise((done) => setTimeout(done, 300))"); // charts are drawn once they are seen
    const fs::path file = out / (nameOf(words) + ".png");
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
