#include "tests/browser/checks.h"

#include <algorithm>
#include <fmt/format.h>

namespace shadowbench::browser {
namespace {

namespace fs = std::filesystem;

void append(Sentences& to, const nlohmann::json& sentences) {
    for (const auto& sentence : sentences) to.push_back(sentence.get<std::string>());
}

// Names of things by what is in the page; each expression gives a list of sentences.
constexpr const char* unnamed = R"js(
  [...document.querySelectorAll("img:not([alt])")].map((e) => "no text for the picture " + e.src).concat(
  [...document.querySelectorAll("button, select, input, a[href]")].filter((e) => !e.closest("[hidden]")).filter((e) =>
    !(e.textContent.trim() || e.querySelector("img[alt]") || e.getAttribute("aria-label") || e.title || (e.labels && e.labels.length)))
    .map((e) => "no name for " + e.outerHTML.slice(0, 120)),
  document.querySelectorAll("h1").length === 1 ? [] : ["not one heading h1"],
  document.title ? [] : ["no title"],
  [...document.querySelectorAll("script")].filter((e) => !e.src).map(() => "a script in the page itself"),
  [...document.querySelectorAll("[style]")].filter((e) => !e.closest(".viewer, svg, figure.chart"))
    .map((e) => "a style in the page itself: " + e.outerHTML.slice(0, 120))))js";

constexpr const char* files = R"js(
  [...document.querySelectorAll("a[href], img[src], script[src], link[href]")].map((e) => e.href || e.src)
    .filter((address) => address.startsWith("file:")).map((address) => decodeURIComponent(new URL(address).pathname)))js";

} // namespace

std::vector<fs::path> pagesOf(const fs::path& site) {
    std::vector<fs::path> pages;
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(site))
        if (entry.path().extension() == ".html") pages.push_back(entry.path());
    std::ranges::sort(pages);
    return pages;
}

Sentences faultsOf(Tab& tab, const fs::path& page) {
    Sentences faults = tab.complaints();
    append(faults, tab.value(unnamed));
    for (const auto& file : tab.value(files))
        if (!fs::exists(file.get<std::string>())) faults.push_back("a link leads nowhere: " + file.get<std::string>());
    for (std::string& fault : faults) fault = page.string() + ": " + fault;
    return faults;
}

Sentences overflow(Tab& tab, int width, int height) {
    tab.resize(width, height);
    tab.value("new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)))");
    const auto widest = tab.value(R"js((() => {
      const page = document.documentElement;
      if (page.scrollWidth <= page.clientWidth) return null;
      const wide = [...document.body.querySelectorAll("*")].filter((e) => e.getBoundingClientRect().right > page.clientWidth + 1
        && !e.parentElement.closest(".scroll"));
      return page.scrollWidth + " wide: " + wide.slice(0, 3).map((e) => e.outerHTML.slice(0, 120)).join(" … ");
    })())js");
    if (widest.is_null()) return {};
    return {fmt::format("at {} × {} the page is {}", width, height, widest.get<std::string>())};
}

Sentences missingContent(Tab& tab) {
    Sentences missing;
    append(missing, tab.value(R"js(
      [...document.images].filter((e) => !e.complete || e.naturalWidth === 0).map((e) => "a picture is missing: " + e.src).concat(
      [...document.querySelectorAll("table")].filter((e) => e.rows.length === 0).map((e) => "an empty table")))js"));
    return missing;
}

} // namespace shadowbench::browser
