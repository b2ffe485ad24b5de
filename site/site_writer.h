// The files of a site: pages with their frame, tables, charts, and what they share.
#pragma once

#include "site/menu.h"
#include "site/table.h"

#include <filesystem>
#include <string>
#include <vector>

namespace shadowbench::site {

struct Page {
    std::string address;                                                   // from the site's folder: "scenes/simple.html"
    std::string title;                                                     // text
    std::string main;                                                      // HTML
    std::vector<std::string> scripts = {"assets/d3.js", "assets/site.js"}; // from the site's folder; classic ones
    std::vector<std::string> styles = {"assets/style.css"};
    std::string description = {}; // in a sentence, for search engines and cards of links; "": its title
};

/// A chart by gnuplot, which is seen without JavaScript, and what a script draws in its place.
struct Chart {
    std::string name = {}; // of its files, from the site's folder, without their endings: "charts/sweep-trees-casters";
                           // "": there are none, a script alone draws it
    std::string title = {}, text = {}; // caption; what a reader who does not see it is told
    std::string kind = {};             // "scatter", "lines", "bars"; "": it stays as it is
    std::string table = {};            // id of the table, on the same page, that it is drawn from
    std::vector<std::pair<std::string, std::string>> options = {}; // attributes data-<first>="<second>" for the script
};

/// From the page at `address` to the site's folder: "" or "../".
std::string rootFrom(const std::string& address);

class SiteWriter {
public:
    /// `navigation` and `scenes`: the pages that every page leads to.
    SiteWriter(std::filesystem::path folder, std::vector<Link> navigation, std::vector<LinkGroup> scenes = {});

    [[nodiscard]] const std::filesystem::path& folder() const { return folder_; }

    /// Writes the page with head and navigation around it.
    void add(const Page& page);

    /// HTML of a table on the page at `address`; writes its files for papers.
    std::string table(const std::string& address, const Table& table);

    /// HTML of a chart on the page at `address`.
    [[nodiscard]] std::string chart(const std::string& address, const Chart& chart) const;

    /// Writes style, script and d3. Once, in any order.
    void writeAssets() const;

    [[nodiscard]] std::size_t pages() const { return pages_; }

private:
    std::filesystem::path folder_;
    std::vector<Link> navigation_;
    std::vector<LinkGroup> scenes_;
    std::size_t pages_ = 0;
};

} // namespace shadowbench::site
