// The pages' scales of colours are told apart with every kind of colour vision, and do not go by colour alone.
#include "base/files.h"
#include "base/temporary_folder.h"
#include "report/families.h"
#include "site/pages.h"
#include "tests/browser/checks.h"
#include "tests/browser/large_run.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <gtest/gtest.h>

namespace shadowbench::browser {
namespace {

/// Machado, Oliveira and Fernandes 2009, table 1, severity 1: what is seen of linear RGB, by rows; the first sees all.
struct Vision {
    const char* name;
    std::array<glm::dvec3, 3> rows;
};
const Vision visions[] = {
    {"trichromatic", {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}},
    {"protanopic", {{{0.152286, 1.052583, -0.204868}, {0.114503, 0.786281, 0.099216}, {-0.003882, -0.048116, 1.051998}}}},
    {"deuteranopic", {{{0.367322, 0.860646, -0.227968}, {0.280085, 0.672501, 0.047413}, {-0.011820, 0.042940, 0.968881}}}},
    {"tritanopic", {{{1.255528, -0.076749, -0.178779}, {-0.078411, 0.930809, 0.147602}, {0.004733, 0.691367, 0.303900}}}},
};

double linear(double encoded) { return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4); }

/// CIE 1976 L*a*b* under D65 of sRGB in [0, 255].
glm::dvec3 labOf(const glm::dvec3& colour, const Vision& vision) {
    const glm::dvec3 rgb(linear(colour.x / 255), linear(colour.y / 255), linear(colour.z / 255));
    const auto seen = [&](int i) { return std::clamp(glm::dot(vision.rows[static_cast<std::size_t>(i)], rgb), 0.0, 1.0); };
    const glm::dvec3 s(seen(0), seen(1), seen(2));
    const glm::dvec3 xyz(glm::dot(glm::dvec3(0.4124, 0.3576, 0.1805), s) / 0.9505,
                         glm::dot(glm::dvec3(0.2126, 0.7152, 0.0722), s),
                         glm::dot(glm::dvec3(0.0193, 0.1192, 0.9505), s) / 1.089);
    const auto f = [](double t) { return t > 0.008856 ? std::cbrt(t) : 7.787 * t + 16.0 / 116; };
    return {116 * f(xyz.y) - 16, 500 * (f(xyz.x) - f(xyz.y)), 200 * (f(xyz.y) - f(xyz.z))};
}

glm::dvec3 vectorOf(const nlohmann::json& colour) { return {colour[0], colour[1], colour[2]}; }

// A difference of two and a half is just seen side by side; one of twice that is seen across a table.
constexpr double seenApart = 5;

TEST(Colours, OfTheHeatMapAreToldApartAndItsBestHasAMarkToo) {
    const TemporaryFolder folder;
    site::SiteWriter site(folder.path(), {});
    site::addChoosePage(largeRun(20, 5), {}, site);
    site.writeAssets();
    for (const bool dark : {false, true}) {
        const auto tab = chromium().tab({.dark = dark});
        tab->open(folder.path() / "choose.html");
        const auto steps = tab->value(R"js(['h0', 'h1', 'h2', 'h3', 'h4'].map((kind) => {
            const cell = document.querySelector('td.' + kind);
            return getComputedStyle(cell).backgroundColor.match(/\d+/g).map(Number);
        }))js");
        for (const Vision& vision : visions)
            for (std::size_t i = 0; i + 1 < steps.size(); ++i)
                EXPECT_GT(glm::distance(labOf(vectorOf(steps[i]), vision), labOf(vectorOf(steps[i + 1]), vision)), seenApart)
                    << vision.name << ", step " << i << (dark ? ", dark" : ", light");
        EXPECT_NE(tab->value("getComputedStyle(document.querySelector('td.h0'), '::before').content"), "none");
    }
}

double contrast(const glm::dvec3& a, const glm::dvec3& b) {
    const auto light = [](const glm::dvec3& c) {
        return 0.2126 * linear(c.x) + 0.7152 * linear(c.y) + 0.0722 * linear(c.z);
    };
    const auto [low, high] = std::minmax({light(a), light(b)});
    return (high + 0.05) / (low + 0.05);
}

std::vector<Record> ofManyFamilies() {
    std::vector<Record> records;
    for (const char* technique : {"pcss", "volume-zfail", "temporal-sampling", "prt-sh", "external:engine", "mine"})
        records.push_back(test::hardCell(technique, 0.01 + 0.01 * static_cast<double>(records.size()),
                                         1 + static_cast<double>(records.size())));
    return records;
}

constexpr const char* familyColours = R"js([...document.querySelectorAll('#all .key .family')].map((family) => {
    const numbers = (colour) => colour.match(/\d+/g).map(Number);
    return { id: family.dataset.family, colour: numbers(getComputedStyle(family, '::before').backgroundColor),
      paper: numbers(getComputedStyle(document.body).backgroundColor) };
}))js";

TEST(Colours, OfFamiliesAreOneEachToldApartAndTheSameAsInCharts) {
    const TemporaryFolder folder;
    site::SiteWriter site(folder.path(), {});
    site::Table table{.id = "all", .caption = "families", .columns = {{.title = "technique"}}};
    for (const report::Family& family : report::families())
        table.rows.push_back({{{family.title}}, {{"family", family.id}}});
    site.add({"index.html", "Families", site.table("index.html", table)});
    site.writeAssets();
    for (const bool dark : {false, true}) {
        const auto tab = chromium().tab({.dark = dark});
        tab->open(folder.path() / "index.html");
        const nlohmann::json shown = tab->value(familyColours);
        ASSERT_EQ(shown.size(), report::families().size());
        for (std::size_t i = 0; i < shown.size(); ++i) {
            const report::Family& family = report::families()[i];
            const glm::dvec3 colour = vectorOf(shown[i]["colour"]);
            EXPECT_EQ(shown[i]["id"], family.id);
            EXPECT_GE(contrast(colour, vectorOf(shown[i]["paper"])), 3) << family.id << (dark ? ", dark" : ", light");
            if (!dark) {
                EXPECT_EQ(fmt::format("#{:02X}{:02X}{:02X}", int(colour.x), int(colour.y), int(colour.z)), family.colour);
            }
            for (std::size_t k = 0; k < i; ++k)
                for (const Vision& vision : visions)
                    EXPECT_GT(glm::distance(labOf(colour, vision), labOf(vectorOf(shown[k]["colour"]), vision)),
                              4 * seenApart)
                        << vision.name << ", " << family.id << " and " << shown[k]["id"] << (dark ? ", dark" : ", light");
        }
    }
}

TEST(Colours, OfFamiliesDoNotChangeFromTableToChartOrPageToPage) {
    const TemporaryFolder folder;
    site::SiteWriter site(folder.path(), {});
    const std::vector<Record> few = ofManyFamilies();
    const std::filesystem::path chart = folder.path() / ("pareto-" + few.front().scene + ".svg");
    writeFile(chart, R"(<svg xmlns="http://www.w3.org/2000/svg" width="9" height="9"/>)");
    site::addScenePage(few, few.front().scene, {}, {chart}, site);
    site.writeAssets();
    const auto tab = chromium().tab();
    tab->open(folder.path() / "scenes" / (few.front().scene + ".html"));
    tab->waitFor("document.querySelector('svg.plot')");
    const auto dots = tab->value(R"js([...document.querySelectorAll('svg.plot .dot')].map((dot) => {
        const row = document.querySelector(`#errors tr[data-family="${dot.dataset.family}"] th`);
        return [getComputedStyle(dot).stroke, getComputedStyle(row, '::before').backgroundColor,
          getComputedStyle(document.querySelector(`.chart .family[data-family="${dot.dataset.family}"]`), '::before').backgroundColor];
    }))js");
    EXPECT_GE(dots.size(), 6U);
    for (const auto& dot : dots) {
        EXPECT_EQ(dot[0], dot[1]);
        EXPECT_EQ(dot[0], dot[2]);
    }
}

TEST(Colours, OfFalseShadowAndLeakAreToldApartAtEveryStrength) {
    const glm::dvec3 none(24), falseShadow(255, 150, 40), leak(80, 170, 255); // site/viewer/colours.js
    for (const Vision& vision : visions)
        for (const double strength : {0.25, 0.5, 0.75, 1.0}) {
            const glm::dvec3 dark = labOf(none + strength * (falseShadow - none), vision),
                             bright = labOf(none + strength * (leak - none), vision);
            EXPECT_GT(glm::distance(dark, bright), 2 * seenApart) << vision.name << " " << strength;
            EXPECT_GT(glm::distance(dark, labOf(none, vision)), 2 * seenApart) << vision.name << " " << strength;
        }
}

} // namespace
} // namespace shadowbench::browser
