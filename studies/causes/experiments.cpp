#include "studies/causes/experiments.h"

#include <algorithm>
#include <array>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <span>
#include <string_view>
#include <vector>

namespace shadowbench::causes {
namespace {

using techniques::Answer;
using techniques::IntegerRange;
using techniques::OneOf;
using techniques::Parameter;
using techniques::RealRange;

constexpr std::array filters{std::string_view("kernel"), std::string_view("radius"), std::string_view("sigma"),
                             std::string_view("filter")};
constexpr std::array samples{std::string_view("n"),      std::string_view("taps"),      std::string_view("samples"),
                             std::string_view("bits"),   std::string_view("texels"),    std::string_view("window"),
                             std::string_view("passes"), std::string_view("directions")};
/// A technique that has both keeps pages of such a density in a map, whose side is memory.
constexpr std::array texels{std::string_view("density"), std::string_view("map")};

const Parameter* declared(const Entry& entry, std::string_view name) {
    const auto found = std::ranges::find(entry.parameters, name, &Parameter::name);
    return found == entry.parameters.end() ? nullptr : &*found;
}

Parameters with(const Parameters& row, std::string_view name, const std::string& value) {
    auto all = row.all();
    std::ranges::find(all, name, &std::pair<std::string, std::string>::first)->second = value;
    return Parameters(std::move(all));
}

bool same(const Parameters& a, const Parameters& b) { return a.all() == b.all(); }

std::optional<Parameters> ifOther(const Parameters& row, Parameters changed) {
    if (same(row, changed)) return {};
    return changed;
}

/// The largest that an experiment still takes seconds with.
constexpr int mostSamples = 256;

std::string least(const Parameter& parameter) {
    if (const auto* range = std::get_if<IntegerRange>(&parameter.domain)) return fmt::format("{}", range->low);
    if (const auto* range = std::get_if<RealRange>(&parameter.domain)) return fmt::format("{}", range->low);
    return std::get<OneOf>(parameter.domain).values.front();
}

std::string most(const Parameter& parameter, const std::string& now) {
    if (const auto* range = std::get_if<IntegerRange>(&parameter.domain))
        return fmt::format("{}", std::min(range->high, std::max(mostSamples, std::stoi(now))));
    if (const auto* words = std::get_if<OneOf>(&parameter.domain)) return words->values.back();
    return now;
}

/// The next value of a parameter that is halved or doubled; the same at its limit.
std::string next(const Parameter& parameter, const std::string& now, bool up) {
    if (const auto* range = std::get_if<IntegerRange>(&parameter.domain)) {
        const int value = std::stoi(now);
        return fmt::format("{}", up ? std::min(2 * value, range->high) : std::max(value / 2, range->low));
    }
    if (const auto* range = std::get_if<RealRange>(&parameter.domain)) {
        const double value = std::stod(now);
        return fmt::format("{}", up ? std::min(2 * value, range->high) : std::max(value / 2, range->low));
    }
    const auto& words = std::get<OneOf>(parameter.domain).values;
    const auto at = std::ranges::find(words, now);
    if (up) return at + 1 == words.end() ? now : *(at + 1);
    return at == words.begin() ? now : *(at - 1);
}

/// "map=2048", of the first of `names` that the technique has and that is not at its limit.
std::string nextOf(std::span<const std::string_view> names, const Entry& entry, const Parameters& row, bool up) {
    for (const std::string_view name : names) {
        const Parameter* parameter = declared(entry, name);
        if (parameter == nullptr) continue;
        const std::string value = next(*parameter, row.text(name), up);
        if (value != row.text(name)) return fmt::format("{}={}", name, value);
    }
    return "";
}

int finestMap(const Entry& entry) {
    if (declared(entry, "n") != nullptr) return 2048; // a map a sample
    return entry.temporal || entry.answer != Answer::Hard ? 4096 : 8192;
}

/// A bias by texel, as many times larger as texels are finer.
Parameters withBiasOf(Parameters row, const Entry& entry, double times) {
    if (declared(entry, "bias") == nullptr || row.text("bias") == "none" || row.text("bias") == "constant") return row;
    return with(row, "factor", fmt::format("{}", times * row.real("factor")));
}

Parameters atLeastDefault(Parameters row, const Entry& entry, std::string_view name) {
    const Parameter* parameter = declared(entry, name);
    if (parameter == nullptr || row.real(name) >= std::stod(parameter->defaultValue)) return row;
    return with(row, name, fmt::format("{}", std::stod(parameter->defaultValue)));
}

/// "bias=slope,factor=2": those that differ.
std::string changes(const Parameters& from, const Parameters& to) {
    std::vector<std::string> words;
    for (const auto& [name, value] : to.all())
        if (from.text(name) != value) words.push_back(name + "=" + value);
    return fmt::format("{}", fmt::join(words, ","));
}

std::string firstOf(std::initializer_list<std::string> choices) {
    for (const std::string& choice : choices)
        if (!choice.empty()) return choice;
    return "";
}

/// The parameter that says how large the row's bias is.
std::string_view sizeOfBias(const Entry& entry, const Parameters& row) {
    return declared(entry, "factor") && row.text("bias") != "constant" ? "factor" : "units";
}

/// "factor=1": of one parameter.
std::string nextOf(std::string_view name, const Entry& entry, const Parameters& row, bool up) {
    return nextOf(std::span(&name, 1), entry, row, up);
}

/// Of pages both, since each may be what limits them.
std::string finerTexels(const Entry& entry, const Parameters& row) {
    const std::string density = nextOf("density", entry, row, true), page = nextOf("page", entry, row, true);
    const bool hasRoom = !page.empty() && 2 * row.integer("page") <= row.integer("map");
    return !density.empty() && hasRoom ? density + "," + page : nextOf(texels, entry, row, true);
}

/// A bias that suffices, or more of it.
std::string moreBias(const Entry& entry, const Parameters& row) {
    if (const auto enough = withEnoughBias(entry, row)) return changes(row, *enough);
    return nextOf(sizeOfBias(entry, row), entry, row, true);
}

/// The default's bias, where the row has more; else of variances half of the least; else finer texels, which need less; else
/// half of it.
std::string lessBias(const Entry& entry, const Parameters& row) {
    const auto own = withOwnBias(entry, row);
    const std::string less = own && !withEnoughBias(entry, row) ? changes(row, *own) : "";
    return firstOf({less, nextOf("variance", entry, row, false), finerTexels(entry, row),
                    nextOf(sizeOfBias(entry, row), entry, row, false)});
}

} // namespace

std::optional<Parameters> withAllCasters(const Entry& entry, const Parameters& row) {
    const Parameter* behind = declared(entry, "behind");
    if (behind == nullptr || row.text("behind") != "lost") return {};
    return with(row, "behind", behind->defaultValue);
}

std::optional<Parameters> withLeastFilter(const Entry& entry, const Parameters& row) {
    Parameters changed = row;
    for (const std::string_view name : filters)
        if (const Parameter* parameter = declared(entry, name)) changed = with(changed, name, least(*parameter));
    return ifOther(row, std::move(changed));
}

std::optional<Parameters> withEnoughBias(const Entry& entry, const Parameters& row) {
    const Parameter* bias = declared(entry, "bias");
    if (bias == nullptr) return {};
    Parameters changed = row;
    const std::string& kind = row.text("bias");
    if (kind == "none" || (kind == "constant" && bias->defaultValue == "slope"))
        changed = with(changed, "bias", bias->defaultValue);
    if (changed.text("bias") != "constant") changed = atLeastDefault(std::move(changed), entry, "factor");
    return ifOther(row, atLeastDefault(std::move(changed), entry, "units"));
}

std::optional<Parameters> withFineTexels(const Entry& entry, const Parameters& row) {
    if (const Parameter* density = declared(entry, "density")) {
        constexpr double times = 8; // pages are drawn one by one
        const double now = row.real("density");
        const double fine = std::min(times * now, std::get<RealRange>(density->domain).high);
        if (fine <= now) return {};
        const Parameters dense = withBiasOf(with(row, "density", fmt::format("{}", fine)), entry, fine / now);
        const Parameter* page = declared(entry, "page"); // of so many texels at the last level, however dense they should be
        if (page == nullptr) return dense;
        const int largest = std::min(std::get<IntegerRange>(page->domain).high, row.integer("map"));
        return with(dense, "page", fmt::format("{}", largest));
    }
    if (const Parameter* map = declared(entry, "map")) {
        const int now = row.integer("map");
        const int fine = std::min(std::get<IntegerRange>(map->domain).high, finestMap(entry));
        if (fine <= now) return {};
        return withBiasOf(with(row, "map", fmt::format("{}", fine)), entry, static_cast<double>(fine) / now);
    }
    return {};
}

std::optional<Parameters> withOwnBias(const Entry& entry, const Parameters& row) {
    if (declared(entry, "bias") == nullptr) return {};
    Parameters changed = row;
    for (const std::string_view name : {"bias", "factor", "units"})
        if (name != "bias" || row.text("bias") != "normal-offset")
            changed = with(changed, name, declared(entry, name)->defaultValue);
    return ifOther(row, std::move(changed));
}

std::optional<Parameters> withLessBias(const Entry& entry, const Parameters& row) {
    constexpr double part = 0.25;
    Parameters changed = row;
    if (declared(entry, "bias") != nullptr)
        for (const std::string_view name : {"factor", "units"})
            changed = with(changed, name, fmt::format("{}", part * row.real(name)));
    if (declared(entry, "variance") != nullptr) // the square of a depth
        changed = with(changed, "variance", fmt::format("{}", part * part * row.real("variance")));
    return ifOther(row, std::move(changed));
}

std::optional<Parameters> withMoreSamples(const Entry& entry, const Parameters& row) {
    Parameters changed = row;
    for (const std::string_view name : samples)
        if (const Parameter* parameter = declared(entry, name))
            changed = with(changed, name, most(*parameter, row.text(name)));
    return ifOther(row, std::move(changed));
}

std::string changeAgainst(Cause cause, const Entry& entry, const Parameters& row) {
    switch (cause) {
    case Cause::Geometry:
        return "finer casters";
    case Cause::Outside:
        if (const auto all = withAllCasters(entry, row)) return changes(row, *all);
        return "fit the map to all receivers";
    case Cause::Leak:
        if (const Parameter* bleeding = declared(entry, "bleeding"); bleeding != nullptr && row.real("bleeding") < 0.2)
            return "bleeding=0.2";
        return nextOf(filters, entry, row, false);
    case Cause::History:
        return "hold the history back";
    case Cause::Filter:
        return nextOf(filters, entry, row, false);
    case Cause::SmallBias:
        return moreBias(entry, row);
    case Cause::Undersampled:
        return finerTexels(entry, row);
    case Cause::LargeBias:
        return lessBias(entry, row);
    case Cause::FewSamples:
        return nextOf(samples, entry, row, true);
    case Cause::Fusion:
    case Cause::Method:
        break;
    }
    return "";
}

} // namespace shadowbench::causes
