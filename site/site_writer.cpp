#include "site/site_writer.h"

#include "embedded_d3.h"
#include "site/made_file.h"
#include "site/names.h"

#include <filesystem>
#include <fmt/format.h>

namespace shadowbench::site {
namespace {

/// "scenes/simple.html" → "scenes-simple".
std::string stemOf(const std::string& address) {
    std::string stem = address.substr(0, address.rfind('.'));
    for (char& letter : stem)
        if (letter == '/') letter = '-';
    return stem;
}

Data linkData(const Link& link, const std::string& page) {
    Data entry;
    entry.set("name", truncate(link.title));
    entry.set("address", rootFrom(page) + link.address);
    entry.set("here", link.address == page);
    return entry;
}

void setMenu(Data& data, const std::vector<LinkGroup>& groups, const std::string& page) {
    Data list{Data::type::list};
    std::string current;
    for (const LinkGroup& group : groups) {
        Data entry, scenes{Data::type::list};
        for (const Link& link : group.links) {
            scenes << linkData(link, page);
            if (link.address == page) current = truncate(link.title);
        }
        entry.set("group", group.title);
        entry.set("scenes", scenes);
        list << entry;
    }
    data.set("grouped", !groups.empty());
    data.set("groups", list);
    if (current.empty())
        data.set("current", false);
    else
        data.set("current", current);
}

} // namespace

std::string rootFrom(const std::string& address) { return address.find('/') == std::string::npos ? "" : "../"; }

SiteWriter::SiteWriter(std::filesystem::path folder, std::vector<Link> navigation, std::vector<LinkGroup> scenes)
    : folder_(std::move(folder)), navigation_(std::move(navigation)), scenes_(std::move(scenes)) {}

void SiteWriter::add(const Page& page) {
    const std::string root = rootFrom(page.address);
    Data data, links{Data::type::list}, scripts{Data::type::list}, styles{Data::type::list};
    data.set("title", truncate(page.title));
    data.set("root", root);
    data.set("main", page.main);
    for (const Link& link : navigation_) links << linkData(link, page.address);
    setMenu(data, scenes_, page.address);
    data.set("description", truncate(page.description.empty() ? page.title + ", by shadowbench." : page.description));
    data.set("carded", std::filesystem::exists(folder_ / "assets/card.png"));
    for (const std::string& script : page.scripts) {
        Data entry;
        entry.set("script", root + script);
        scripts << entry;
    }
    data.set("links", links);
    for (const std::string& style : page.styles) {
        Data entry;
        entry.set("style", root + style);
        styles << entry;
    }
    data.set("scripts", scripts);
    data.set("styles", styles);
    writeMade(folder_ / page.address, render("page.html", data));
    ++pages_;
}

std::string SiteWriter::table(const std::string& address, const Table& table) {
    if (table.rows.empty()) return "";
    const std::string files = fmt::format("tables/{}-{}", stemOf(address), table.id);
    writeMade(folder_ / (files + ".csv"), csvOf(table));
    writeMade(folder_ / (files + ".tex"), latexOf(table, true, stemOf(address) + "-" + table.id));
    writeMade(folder_ / (files + "-full.tex"), latexOf(table, false, stemOf(address) + "-" + table.id + "-full"));
    writeMade(folder_ / (files + ".md"), markdownOf(table));
    return render("table.html", tableData(table, rootFrom(address), files));
}

std::string SiteWriter::chart(const std::string& address, const Chart& chart) const {
    Data data, options{Data::type::list};
    data.set("file", rootFrom(address) + chart.name);
    data.set("drawn", !chart.name.empty());
    data.set("title", truncate(chart.title));
    data.set("alternative", truncate(chart.text));
    data.set("interactive", !chart.kind.empty());
    data.set("kind", chart.kind);
    data.set("table", chart.table);
    for (const auto& [name, value] : chart.options) {
        Data option;
        option.set("name", name);
        option.set("value", value);
        options << option;
    }
    data.set("options", options);
    return render("chart.html", data);
}

void SiteWriter::writeAssets() const {
    writeMade(folder_ / "assets/style.css", embeddedFile("assets/style.css"));
    std::string script(embeddedFile("assets/tables.js"));
    writeMade(folder_ / "assets/site.js", script.append(embeddedFile("assets/charts.js")));
    writeMade(folder_ / "assets/d3.js", embedded::d3().front().text);
}

} // namespace shadowbench::site
