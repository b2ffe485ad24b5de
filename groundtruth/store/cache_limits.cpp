#include "groundtruth/store/cache_limits.h"

#include "base/error.h"

#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <fmt/format.h>
#include <optional>

namespace shadowbench::groundtruth {
namespace {

struct Unit {
    char letter;
    double size;
};
constexpr std::array byteUnits{Unit{'k', 0x1p10}, Unit{'m', 0x1p20}, Unit{'g', 0x1p30}, Unit{'t', 0x1p40}};
constexpr std::array timeUnits{Unit{'s', 1}, Unit{'m', 60}, Unit{'h', 3600}, Unit{'d', 86400}, Unit{'w', 604800}};

constexpr double most = 0x1p53; // beyond it a double is no longer exact

/// A number ≥ 0 and the lower-case word behind it.
struct Quantity {
    double number;
    std::string unit;
};

std::optional<Quantity> parse(std::string_view text) {
    double number = 0;
    const auto [rest, failure] = std::from_chars(text.data(), text.data() + text.size(), number, std::chars_format::fixed);
    if (failure != std::errc{} || !(number >= 0) || !std::isfinite(number)) return std::nullopt;
    std::string unit;
    for (const char* c = rest; c != text.data() + text.size(); ++c)
        if (*c != ' ' || !unit.empty()) unit += static_cast<char>(std::tolower(static_cast<unsigned char>(*c)));
    return Quantity{number, unit};
}

template <std::size_t count>
std::optional<double> sizeOf(const std::array<Unit, count>& units, char letter) {
    for (const Unit& unit : units)
        if (unit.letter == letter) return unit.size;
    return std::nullopt;
}

} // namespace

std::uintmax_t bytesOf(std::string_view text) {
    std::optional<Quantity> quantity = parse(text);
    std::optional<double> scale;
    if (quantity) {
        std::string& unit = quantity->unit;
        if (unit.ends_with("ib"))
            unit.resize(unit.size() - 2);
        else if (unit.ends_with('b'))
            unit.resize(unit.size() - 1);
        scale = unit.empty() ? 1.0 : unit.size() == 1 ? sizeOf(byteUnits, unit.front()) : std::nullopt;
    }
    if (!scale || quantity->number * *scale > most)
        throw BadInput(fmt::format("\"{}\" is not a size: write a number and K, M, G or T, such as 500M or 4G", text));
    return static_cast<std::uintmax_t>(quantity->number * *scale);
}

std::chrono::seconds durationOf(std::string_view text) {
    const std::optional<Quantity> quantity = parse(text);
    const std::optional<double> scale =
        quantity && quantity->unit.size() == 1 ? sizeOf(timeUnits, quantity->unit.front()) : std::nullopt;
    constexpr double longest = 1e9; // seconds, 32 years: file times reach that far back
    if (!scale || quantity->number * *scale > longest)
        throw BadInput(fmt::format(
            "\"{}\" is not a time span: write a number and s, m (minutes), h, d or w, such as 12h or 30d", text));
    return std::chrono::seconds(static_cast<std::int64_t>(quantity->number * *scale));
}

std::string bytesText(std::uintmax_t bytes) {
    double value = static_cast<double>(bytes);
    if (value < 1024) return fmt::format("{} B", bytes);
    std::string_view unit;
    for (const std::string_view next : {"KiB", "MiB", "GiB", "TiB"}) {
        if (value < 1024) break;
        value /= 1024;
        unit = next;
    }
    return fmt::format("{:.1f} {}", value, unit);
}

std::string durationText(std::chrono::seconds duration) {
    const auto seconds = duration.count();
    if (seconds >= 86400) return fmt::format("{} d", seconds / 86400);
    if (seconds >= 3600) return fmt::format("{} h", seconds / 3600);
    if (seconds >= 60) return fmt::format("{} min", seconds / 60);
    return fmt::format("{} s", seconds);
}

} // namespace shadowbench::groundtruth
