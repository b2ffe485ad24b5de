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
  ((places) => places.filter((name, i) => places.indexOf(name) !== i).map((name) => "two landmarks of one name: " + name))(
    [...document.querySelectorAll("section[aria-label], nav, header, main, [role=region]")].filter((e) => e.checkVisibility())
      .map((e) => (e.getAttribute("role") || e.localName).replace("section", "region") + " " + (e.getAttribute("aria-label") || ""))),
  document.querySelectorAll("h1").length === 1 ? [] : ["not one heading h1"],
  document.title ? [] : ["no title"],
  [...document.querySelectorAll("script")].filter((e) => !e.src).map(() => "a script in the page itself"),
  [...document.querySelectorAll("[style]")] // not what a script has set
    .filter((e) => !e.closest(".viewer, svg, figure.chart, table[style*='table-layout: fixed']"))
    .map((e) => "a style in the page itself: " + e.outerHTML.slice(0, 120))))js";

constexpr const char* files = R"js(
  [...document.querySelectorAll("a[href], img[src], script[src], link[href]")].map((e) => e.href || e.src)
    .filter((address) => address.startsWith("file:")).map((address) => decodeURIComponent(new URL(address).pathname)))js";

// Boxes of all texts that are seen, cut at what scrolls: {text, node, box}.
constexpr const char* textBoxes = R"js(
  const boxes = [];
  const walker = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
  const cut = (box, by) => ({ left: Math.max(box.left, by.left), right: Math.min(box.right, by.right),
    top: Math.max(box.top, by.top), bottom: Math.min(box.bottom, by.bottom) });
  for (let node = walker.nextNode(); node; node = walker.nextNode()) {
    const parent = node.parentElement;
    if (!node.data.trim() || !parent.checkVisibility() || parent.closest(".heard, .skip, .hint, option, legend, script, noscript")) continue;
    const range = document.createRange();
    range.selectNodeContents(node);
    for (let box of range.getClientRects()) {
      for (let e = parent; e; e = e.parentElement)
        if (getComputedStyle(e).overflow !== "visible") box = cut(box, e.getBoundingClientRect());
      if (box.right > box.left && box.bottom > box.top) boxes.push({ text: node.data.trim().slice(0, 40), node, parent, box });
    }
  })js";

// A third of a line's height is what lines that are set close have in common.
constexpr const char* overlapping = R"js(
  boxes.sort((a, b) => a.box.top - b.box.top);
  const found = new Set();
  boxes.forEach((a, i) => {
    for (let k = i + 1; k < boxes.length && boxes[k].box.top < a.box.bottom; ++k) {
      const b = boxes[k];
      if (a.node === b.node) continue;
      const both = cut(a.box, b.box);
      const least = Math.min(a.box.bottom - a.box.top, b.box.bottom - b.box.top) / 3;
      if (both.right - both.left > 2 && both.bottom - both.top > least) found.add(`"${a.text}" lies over "${b.text}"`);
    }
  });
  return [...found].slice(0, 10);)js";

// What is cut at its side by a box that nobody can scroll, or that nobody should have to; words that a line's end cuts.
// Letters and hyphens alone are words; names of variants and hashes may be broken anywhere.
constexpr const char* cutTexts = R"js((() => {
  const found = new Set();
  const walker = document.createTreeWalker(document.body, NodeFilter.SHOW_TEXT);
  const scrolls = (e) => e.matches("pre, .scroll:not(:has(.stacked))");
  for (let node = walker.nextNode(); node; node = walker.nextNode()) {
    const parent = node.parentElement;
    if (!node.data.trim() || !parent.checkVisibility() || parent.closest(".heard, .skip, .hint, option, legend, script, noscript")) continue;
    const range = document.createRange();
    range.selectNodeContents(node);
    const boxes = [...range.getClientRects()];
    for (let e = parent; e && !scrolls(e); e = e.parentElement) {
      const by = e.getBoundingClientRect();
      if (getComputedStyle(e).overflowX !== "visible" && boxes.some((box) => box.right > by.right + 1 || box.left < by.left - 1))
        found.add(`"${node.data.trim().slice(0, 40)}" is cut`);
    }
    for (const word of node.data.matchAll(/(?<![^\s(])[A-Za-z]{2,14}(?=[\s.,;:)-]|$)/g)) {
      range.setStart(node, word.index);
      range.setEnd(node, word.index + word[0].length);
      const tops = [...range.getClientRects()].filter((box) => box.width > 0).map((box) => box.top);
      if (tops.some((top) => top > tops[0] + 3)) found.add(`"${word[0]}" is broken`);
    }
  }
  return [...found].slice(0, 10);
})())js";

// Colours as numbers, one over the other; what is drawn with an opacity of its own lets through what is behind it.
constexpr const char* faint = R"js(
  const numbers = (colour) => {
    const parts = colour.match(/[\d.]+(e-?\d+)?/g).map(Number);
    const scale = colour.startsWith("color(") ? 255 : 1;
    return [parts[0] * scale, parts[1] * scale, parts[2] * scale, parts.length > 3 ? parts[3] : 1];
  };
  const over = (front, back) => front.slice(0, 3).map((c, i) => c * front[3] + back[i] * (1 - front[3]));
  const behind = (e) => {
    if (!e) return [255, 255, 255];
    const style = getComputedStyle(e);
    const own = numbers(style.backgroundColor);
    return own[3] === 1 ? own.slice(0, 3) : over(own, behind(e.parentElement));
  };
  const light = ([r, g, b]) => {
    const [x, y, z] = [r, g, b].map((c) => c / 255).map((c) => (c <= 0.03928 ? c / 12.92 : ((c + 0.055) / 1.055) ** 2.4));
    return 0.2126 * x + 0.7152 * y + 0.0722 * z;
  };
  const found = new Set();
  for (const { text, parent } of boxes) {
    if (parent.closest(":disabled, label:has(:disabled)")) continue;
    const style = getComputedStyle(parent);
    const back = behind(parent);
    const ink = numbers(parent instanceof SVGElement ? style.fill : style.color);
    for (let e = parent; e; e = e.parentElement) ink[3] *= Number(getComputedStyle(e).opacity);
    const [a, b] = [light(over(ink, back)), light(back)].sort((x, y) => y - x);
    const size = Number.parseFloat(style.fontSize);
    const large = size >= 24 || (size >= 18.66 && Number(style.fontWeight) >= 700);
    const contrast = (a + 0.05) / (b + 0.05);
    if (contrast < (large ? 3 : 4.5)) found.add(`"${text}" has a contrast of ${contrast.toFixed(2)}`);
  }
  return [...found].slice(0, 10);)js";

// What has the focus now, once; "end" when the tab key has led around.
constexpr const char* focused = R"js((() => {
  const e = document.activeElement;
  const seen = (window.seenByTab = window.seenByTab || new Set());
  if (!e || e === document.body || seen.has(e)) return "end";
  seen.add(e);
  const isMarked = (x) => x && getComputedStyle(x).outlineStyle !== "none" && Number.parseFloat(getComputedStyle(x).outlineWidth) >= 2;
  return isMarked(e) || isMarked(e.nextElementSibling) ? "" : "no visible focus: " + e.outerHTML.slice(0, 120);
})())js";

constexpr const char* unreached = R"js((() => {
  const seen = [...window.seenByTab];
  const isOfGroup = (e) => e.type === "radio" && seen.some((s) => s.type === "radio" && s.name === e.name);
  return [...document.querySelectorAll("a[href], button, select, input, textarea, summary, [tabindex]")]
    .filter((e) => e.tabIndex >= 0 && !e.disabled && e.checkVisibility() && !seen.includes(e) && !isOfGroup(e))
    .map((e) => "the tab key does not lead to " + e.outerHTML.slice(0, 120)).slice(0, 10);
})())js";

std::string ofTexts(const char* check) { return fmt::format("(() => {{ scrollTo(0, 0); {} {} }})()", textBoxes, check); }

void settle(Tab& tab) { tab.value("new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)))"); }

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
    settle(tab);
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

Sentences overlaps(Tab& tab, int width, int height) {
    tab.resize(width, height);
    settle(tab);
    Sentences found;
    append(found, tab.value(ofTexts(overlapping)));
    return found;
}

Sentences cut(Tab& tab, int width, int height) {
    tab.resize(width, height);
    settle(tab);
    Sentences found;
    append(found, tab.value(cutTexts));
    return found;
}

Sentences violations(Tab& tab, const std::string& axe) {
    tab.value(axe + "; 0");
    Sentences found;
    append(found, tab.value(R"js(axe.run().then((result) => [].concat(...result.violations.map((rule) =>
        rule.nodes.slice(0, 3).map((node) => rule.id + ": " + node.html.slice(0, 160))))))js"));
    return found;
}

Sentences lowContrast(Tab& tab) {
    Sentences found;
    append(found, tab.value(ofTexts(faint)));
    return found;
}

Sentences keyboardFaults(Tab& tab) {
    Sentences faults;
    for (std::string said; said != "end";) {
        tab.press("Tab");
        said = tab.value(focused);
        if (!said.empty() && said != "end") faults.push_back(said);
    }
    append(faults, tab.value(unreached));
    return faults;
}

Browser& chromium() {
    static Browser browser;
    return browser;
}

} // namespace shadowbench::browser
