#include "base/words.h"
#include "techniques/contract/applicability.h"
#include "techniques/folder/keys.h"
#include "techniques/folder/reading.h"

#include <algorithm>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace shadowbench::techniques {
namespace {

constexpr int mostCascades = 8;

/// A word, or the parameter whose choices are among them.
template <std::size_t count>
FolderWord wordOf(const TomlValue& value, const Words<bool, count>& words, const TechniqueFolder& read) {
    const std::vector<std::string> all = words.all();
    const auto parameter = std::ranges::find(read.entry.parameters, value.text(), &Parameter::name);
    if (std::ranges::count(all, value.text()) > 0 || parameter == read.entry.parameters.end())
        return {value.oneOf(all), false};
    const auto* choices = std::get_if<OneOf>(&parameter->domain);
    const auto known = [&](const std::string& word) { return std::ranges::count(all, word) > 0; };
    if (choices == nullptr || !std::ranges::all_of(choices->values, known))
        value.fail(fmt::format("{} must be a parameter with choices among {}", parameter->name, fmt::join(all, ", ")));
    return {value.text(), true};
}

FolderCascades cascadesOf(const TomlValue& value, const TechniqueFolder& read) {
    value.only(keysOf(KeyTable::Cascades));
    FolderCascades cascades{.count = amountWithin(value.get("count"), IntegerRange{0, mostCascades}, read)};
    for (const char* key : {"warp", "stable"})
        if (const auto hard = value.find(key); hard && read.entry.answer == Answer::Soft)
            hard->fail("is of maps of a light's centre alone: leave it out of a technique whose answer is soft");
    if (const auto lambda = value.find("lambda")) cascades.lambda = amountWithin(*lambda, RealRange{0, 1}, read);
    if (const auto blend = value.find("blend")) cascades.blend = amountWithin(*blend, RealRange{0, 0.5}, read);
    if (const auto latency = value.find("latency")) {
        cascades.latency = amountWithin(*latency, IntegerRange{0, 1}, read);
        if (cascades.latency != Amount(0.0) && !read.entry.temporal)
            latency->fail("fits slices to what the frame before showed: say history = true above");
    }
    if (const auto fit = value.find("fit")) cascades.fit = wordOf(*fit, cascadeFits, read);
    if (const auto warp = value.find("warp")) cascades.warp = wordOf(*warp, cascadeWarps, read);
    if (const auto stable = value.find("stable")) cascades.stable = wordOf(*stable, cascadeTexels, read);
    return cascades;
}

std::optional<std::string> contradictoryFit(const CascadeRule& rule) {
    if (rule.stable && (rule.visible || rule.warped))
        return "texels that stay in place need a map that neither what is seen nor a warp changes: stable=texels goes with "
               "fit=view and warp=none";
    if (rule.late && !rule.visible) return "only what is seen is known a frame late: latency=1 goes with fit=visible";
    return std::nullopt;
}

} // namespace

void readView(const TomlValue& root, TechniqueFolder& read) {
    if (const auto view = root.find("view")) read.view = views.named(view->oneOf(views.all()));
    if (read.view == FolderView::Sample && read.entry.answer != Answer::Soft)
        root.get("view").fail("a light-sample is of a technique whose answer is soft");
    if (read.view == FolderView::Cube) read.entry.notApplicable = lightWithoutPosition;
    const auto cascades = root.find("cascades");
    if (cascades.has_value() != (read.view == FolderView::Cascades))
        (cascades ? *cascades : root.get("view")).fail("view = \"cascades\" and [cascades] are said together");
    if (!cascades) return;
    read.cascades = cascadesOf(*cascades, read);
    read.entry.contradiction = [rule = read.cascades](const Parameters& values) {
        return contradictoryFit(cascadeRule(rule, values));
    };
    const Parameters defaults = parseParameters("", read.entry.parameters, read.entry.id);
    if (const auto why = read.entry.contradiction(defaults)) cascades->fail(*why);
}

FolderView viewOf(const TechniqueFolder& folder, const Parameters& values) {
    const bool none = folder.view == FolderView::Cascades && valueOf(folder.cascades.count, values) == 0;
    return none ? FolderView::Scene : folder.view;
}

CascadeRule cascadeRule(const FolderCascades& cascades, const Parameters& values) {
    const auto word = [&](const FolderWord& each) { return each.ofParameter ? values.text(each.text) : each.text; };
    return {.slices = static_cast<int>(valueOf(cascades.count, values)),
            .lambda = valueOf(cascades.lambda, values),
            .blend = valueOf(cascades.blend, values),
            .visible = cascadeFits.named(word(cascades.fit)),
            .warped = cascadeWarps.named(word(cascades.warp)),
            .stable = cascadeTexels.named(word(cascades.stable)),
            .late = valueOf(cascades.latency, values) > 0};
}

} // namespace shadowbench::techniques
