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

} // namespace shadowbench::browser
