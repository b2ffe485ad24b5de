#include "report/run_text.h"

#include "base/shell_word.h"
#include "report/summary.h"
#include "scene/load/load.h"
#include "techniques/catalog.h"

#include <algorithm>
#include <cctype>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <string_view>

namespace shadowbench::report {
namespace {

/// Distinct descriptions in order of first occurrence, joined.
template <typename Describe>
std::string distinct(const std::vector<Record>& records, const Describe& describe) {
    std::vector<std::string> found;
    for (const Record& record : records) {
        const std::string text = describe(record);
        if (!text.empty() && std::find(found.begin(), found.end(), text) == found.end()) found.push_back(text);
    }
    return fmt::format("{}", fmt::join(found, "; "));
}

std::string environment(const Record& record) {
    const Environment& e = record.environment;
    if (e.renderer.empty()) return "";
    std::string how; // a rasteriser in software draws
    if (e.vectorBits > 0)
        how = fmt::format(", {}, {} bit vectors",
                          e.rasterThreads == 0 ? "no raster threads" : fmt::format("{} raster threads", e.rasterThreads),
                          e.vectorBits);
    if (e.platform == "egl") how += ", through EGL";
    return fmt::format("{}, OpenGL {}{}, {}, {}", e.renderer, e.gl, how, e.cpu, e.compiler);
}

std::string tools(const std::optional<ReferenceInfo>& reference) {
    std::string text;
    if (!reference) return text;
    for (const auto& [tool, version] : reference->tools)
        text += fmt::format("{}{} {}", text.empty() ? "" : ", ", tool, version);
    return text;
}

std::string truths(const Record& record) {
    std::string text;
    for (const std::optional<ReferenceInfo>& reference : {record.reference, record.softReference}) {
        if (!reference) continue;
        const std::string by = tools(reference);
        text += fmt::format("{}{}{}", text.empty() ? "" : " and ", truth(*reference), by.empty() ? "" : " by " + by);
    }
    return text;
}

std::string commit(const Record& record) { return record.commit + (record.dirty ? " with uncommitted changes" : ""); }

/// Words of `chosen` as repeated options; nothing if they are all there are.
std::string options(const std::string& option, const std::vector<std::string>& chosen, const std::vector<std::string>& all) {
    if (std::is_permutation(chosen.begin(), chosen.end(), all.begin(), all.end())) return "";
    std::string text;
    for (const std::string& word : chosen) text += " " + option + " " + shellWord(word);
    return text;
}

} // namespace

std::string runCommand(const std::vector<Record>& records) {
    std::vector<std::string> variants, everyVariant, external;
    for (const Record& record : records) {
        std::vector<std::string>& known = isExternal(record) ? external : variants;
        const bool isMade = record.external || !isExternal(record); // `score` has no part in a run
        if (isMade && std::find(known.begin(), known.end(), record.variant) == known.end()) known.push_back(record.variant);
    }
    for (const techniques::Variant& variant : techniques::matchVariants("*")) everyVariant.push_back(variant.name);
    std::string chosen = options("--technique", variants, everyVariant);
    if (!external.empty()) {
        if (!chosen.empty() || variants.empty()) chosen += options("--technique", external, {});
        chosen += " --external RENDERERS.toml";
    }
    return "./bench run" + options("--scene", scenes(records), standardScenes()) + chosen + " --profile " +
           shellWord(records.front().profile) + (records.front().environment.platform == "egl" ? " --gl egl" : "");
}

std::string commitsOf(const std::vector<Record>& records) { return distinct(records, commit); }

std::string environmentsOf(const std::vector<Record>& records) { return distinct(records, environment); }

/// The truths of a scene; the longest description is the one of a hard technique beside a soft truth, which names both.
std::string sceneTruth(const std::vector<Record>& records, const std::string& scene) {
    std::string longest;
    for (const std::size_t i : ofScene(records, scene)) {
        const std::string text = truths(records[i]);
        if (text.size() > longest.size()) longest = text;
    }
    return longest;
}

} // namespace shadowbench::report
