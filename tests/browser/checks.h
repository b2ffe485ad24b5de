// What every page of a site must do, whatever is on it. Each check gives sentences, none if all is well.
#pragma once

#include "tests/browser/browser.h"

#include <filesystem>
#include <string>
#include <vector>

namespace shadowbench::browser {

using Sentences = std::vector<std::string>;

/// The site's pages, sorted.
std::vector<std::filesystem::path> pagesOf(const std::filesystem::path& site);

/// The page that is open: complaints of the browser; a heading and a title; a text for each picture; fields and buttons with
/// a name; links to pages and files that are there.
Sentences faultsOf(Tab& tab, const std::filesystem::path& page);

/// Whether the page that is open is wider than the window: what must be scrolled sideways to be read.
Sentences overflow(Tab& tab, int width, int height);

/// Pictures that are not shown, and tables without a row.
Sentences missingContent(Tab& tab);

/// Texts of the page that is open, in a window of that size, that lie over each other.
Sentences overlaps(Tab& tab, int width, int height);

/// Texts, in a window of that size, that end at the side of a box, and words that are broken within.
Sentences cut(Tab& tab, int width, int height);

/// What axe-core, whose text is `axe`, finds on the page that is open.
Sentences violations(Tab& tab, const std::string& axe);

/// Texts whose contrast with what is behind them is below 4.5 : 1, or 3 : 1 where letters are large (WCAG 2.1, 1.4.3).
Sentences lowContrast(Tab& tab);

/// Controls that the tab key does not lead to, and those that do not show that they have the focus.
Sentences keyboardFaults(Tab& tab);

/// The browser of all tests of a program.
Browser& chromium();

} // namespace shadowbench::browser
