#include "groundtruth/store/golden.h"

#include "base/error.h"
#include "base/hash.h"
#include "base/image_io.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <set>
#include <vector>

namespace shadowbench::groundtruth {
namespace {

static_assert(std::endian::native == std::endian::little, "hashes are defined over little-endian numbers");

constexpr std::uint32_t largestId = 1U << 24; // that a float holds, with all below

std::string_view bytesOf(const void* data, std::size_t bytes) { return {static_cast<const char*>(data), bytes}; }

template <typename T>
std::string hashOf(const Image<T>& image) {
    const std::uint64_t size[2]{static_cast<std::uint64_t>(image.width()), static_cast<std::uint64_t>(image.height())};
    const Hash128 ofSize = hash128(bytesOf(size, sizeof size));
    return hash128(bytesOf(image.data(), image.size() * sizeof(T)), ofSize.low).text();
}

/// Fully shadowed, in between, fully lit.
int label(float visibility) { return visibility <= 0 ? 0 : visibility < 1 ? 1 : 2; }

void count(float before, float after, Difference::Values& values) {
    if (before == after) return;
    ++values.pixels;
    const double change = std::abs(static_cast<double>(after) - static_cast<double>(before));
    if (std::isfinite(change)) values.largest = std::max(values.largest, change);
}

void append(std::vector<std::string>& parts, std::string_view what, const Difference::Values& values,
            std::string_view unit) {
    if (values.pixels > 0)
        parts.push_back(fmt::format("{} of {} pixels by up to {:.3g}{}", what, values.pixels, values.largest, unit));
}

std::string textOf(const std::string& version) { return version; }
std::string textOf(double measured) { return fmt::format("{:.6g}", measured); }

/// The names whose values differ as written, a missing one as "none".
template <typename Value>
void appendChanges(std::vector<std::string>& parts, const std::map<std::string, Value>& before,
                   const std::map<std::string, Value>& after) {
    std::set<std::string> names;
    for (const auto& [name, value] : before) names.insert(name);
    for (const auto& [name, value] : after) names.insert(name);
    const auto text = [](const std::map<std::string, Value>& values, const std::string& name) {
        const auto found = values.find(name);
        return found == values.end() ? std::string("none") : textOf(found->second);
    };
    for (const std::string& name : names)
        if (const std::string from = text(before, name), to = text(after, name); from != to)
            parts.push_back(fmt::format("{} {} → {}", name, from, to));
}

template <typename T>
Image<float> asFloats(const Image<T>& image) {
    Image<float> result(image.width(), image.height());
    std::ranges::transform(image, result.begin(), [](T value) { return static_cast<float>(value); });
    return result;
}

} // namespace

ContentHashes contentHashes(const Reference& reference) {
    return {hashOf(reference.visibility), hashOf(reference.sigma), hashOf(reference.surface), hashOf(reference.id),
            hashOf(reference.edgeDistance)};
}

std::string contentOf(const ContentHashes& hashes) {
    return hash128(fmt::format("{} {} {} {}", hashes.visibility, hashes.surface, hashes.id, hashes.edgeDistance)).text();
}

Difference difference(const Reference& before, const Reference& after) {
    Difference result;
    result.size = !before.visibility.sameSize(after.visibility);
    if (result.size) return result;
    for (std::size_t i = 0; i < before.visibility.size(); ++i) {
        result.labels += before.surface[i] != after.surface[i] || label(before.visibility[i]) != label(after.visibility[i]);
        result.ids += before.id[i] != after.id[i];
        count(before.visibility[i], after.visibility[i], result.visibility);
        count(before.sigma[i], after.sigma[i], result.sigma);
        count(before.edgeDistance[i], after.edgeDistance[i], result.edgeDistance);
    }
    return result;
}

std::string describe(const Difference& difference) {
    if (difference.size) return "the image's size";
    std::vector<std::string> parts;
    if (difference.labels > 0) parts.push_back(fmt::format("{} labels", difference.labels));
    if (difference.ids > 0) parts.push_back(fmt::format("{} surface ids", difference.ids));
    append(parts, "visibility", difference.visibility, "");
    append(parts, "σ", difference.sigma, "");
    append(parts, "edge distance", difference.edgeDistance, " px");
    return fmt::format("{}", fmt::join(parts, ", "));
}

std::string describeChange(const Provenance& before, const Provenance& after) {
    std::vector<std::string> parts;
    if (before.oracle != after.oracle) parts.push_back(fmt::format("oracle {} → {}", before.oracle, after.oracle));
    if (before.samples != after.samples) parts.push_back(fmt::format("samples {} → {}", before.samples, after.samples));
    appendChanges(parts, before.tools, after.tools);
    appendChanges(parts, before.measured, after.measured);
    return fmt::format("{}", fmt::join(parts, ", "));
}

void writeGolden(const Reference& reference, const std::filesystem::path& file) {
    const Image<float> surface = asFloats(reference.surface), id = asFloats(reference.id);
    if (std::ranges::any_of(reference.id, [](std::uint32_t value) { return value > largestId; }))
        throw InternalError(fmt::format("cannot write {}: it has surface ids above 2²⁴", file.string()));
    writeExr(file, {{"V", &reference.visibility},
                    {"sigma", &reference.sigma},
                    {"edge_distance", &reference.edgeDistance},
                    {"surface", &surface},
                    {"id", &id}});
}

Reference readGolden(const std::filesystem::path& file) {
    Reference reference;
    reference.visibility = readChannel(file, "V");
    reference.sigma = readChannel(file, "sigma");
    reference.edgeDistance = readChannel(file, "edge_distance");
    const Image<float> surface = readChannel(file, "surface"), id = readChannel(file, "id");
    reference.surface = Image<Surface>(surface.width(), surface.height());
    reference.id = Image<std::uint32_t>(id.width(), id.height());
    for (std::size_t i = 0; i < surface.size(); ++i) {
        const bool valid = surface[i] >= 0 && surface[i] <= static_cast<float>(Surface::OnEdge) && id[i] >= 0 &&
                           id[i] <= static_cast<float>(largestId);
        if (!valid)
            throw BadInput(fmt::format("{} holds no golden reference: pixel {} has no valid surface", file.string(), i));
        reference.surface[i] = static_cast<Surface>(surface[i]);
        reference.id[i] = static_cast<std::uint32_t>(id[i]);
    }
    return reference;
}

} // namespace shadowbench::groundtruth
