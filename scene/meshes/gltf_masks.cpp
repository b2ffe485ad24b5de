#include "scene/meshes/gltf_masks.h"

#include "base/error.h"
#include "base/image_formats.h"
#include "base/json_text.h"
#include "base/limits.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <utility>
#include <vector>

namespace shadowbench {
namespace {

constexpr int nearestFilter = 9728, mirroredRepeat = 33648, clampToEdge = 33071; // glTF's numbers, as OpenGL's

AlphaMask::Wrap wrapOf(const GltfJson& sampler, const char* name) {
    const std::size_t number = gltfWhole(sampler, name, 0);
    if (number == mirroredRepeat) return AlphaMask::Wrap::Mirror;
    return number == clampToEdge ? AlphaMask::Wrap::Clamp : AlphaMask::Wrap::Repeat;
}

/// JPEG knows no alpha.
Image<float> alphaOf(const std::string& bytes) {
    const Image<float> solid(1, 1, 1.0F);
    if (bytes.starts_with("\xFF\xD8")) return solid;
    if (!bytes.starts_with("\x89PNG")) throw BadInput("its texture is neither PNG nor JPEG");
    const ImageHeader header = png::headerOf(bytes);
    if (static_cast<std::uint64_t>(header.width) * static_cast<std::uint64_t>(header.height) > limitOf(Limit::Pixels))
        throw BadInput(
            fmt::format("its texture has {} × {} pixels, {}", header.width, header.height, beyond(Limit::Pixels)));
    return header.alpha < 0 ? solid : png::channelOf(bytes, header.alpha);
}

/// Which of `size` texels in a row a texel of `smaller` in its place covers, with the share of each.
std::vector<std::pair<int, double>> coveredBy(int texel, int smaller, int size) {
    const double step = static_cast<double>(size) / smaller, begin = texel * step, end = begin + step;
    std::vector<std::pair<int, double>> covered;
    for (int i = static_cast<int>(begin); i < std::min(static_cast<int>(std::ceil(end)), size); ++i)
        covered.emplace_back(i, (std::min(end, i + 1.0) - std::max<double>(begin, i)) / step);
    return covered;
}

/// The same in at most `texels` per side, each the mean of what it covers.
Image<float> reduced(const Image<float>& alpha, int texels) {
    const int largest = std::max(alpha.width(), alpha.height());
    if (texels == 0 || largest <= texels) return alpha;
    const auto sideOf = [&](int side) {
        return std::max(1, static_cast<int>(std::lround(static_cast<double>(side) * texels / largest)));
    };
    Image<float> smaller(sideOf(alpha.width()), sideOf(alpha.height()));
    for (int y = 0; y < smaller.height(); ++y)
        for (int x = 0; x < smaller.width(); ++x) {
            double sum = 0;
            for (const auto& [row, high] : coveredBy(y, smaller.height(), alpha.height()))
                for (const auto& [column, wide] : coveredBy(x, smaller.width(), alpha.width()))
                    sum += high * wide * alpha(column, row);
            smaller(x, y) = static_cast<float>(sum);
        }
    return smaller;
}

} // namespace

const std::optional<GltfMask>& GltfMasks::of(const GltfJson& primitive) {
    static const std::optional<GltfMask> none;
    if (!primitive.contains("material")) return none;
    const auto number = wholeNumber<std::size_t>(primitive["material"]);
    const auto [known, isNew] = known_.try_emplace(number);
    if (!isNew) return known->second;
    const GltfJson& material = buffers_.entry("materials", number);
    if (material.value("alphaMode", std::string()) != "MASK") return none;
    try {
        return known->second = read(material);
    } catch (const BadInput& error) {
        throw BadInput(fmt::format("material \"{}\" with alphaMode MASK: {}", material.value("name", std::to_string(number)),
                                   error.what()));
    }
}

GltfMask GltfMasks::read(const GltfJson& material) {
    AlphaMask mask{.alpha = Image<float>(1, 1, 1.0F), .cutoff = material.value("alphaCutoff", 0.5)};
    std::string coordinates;
    const GltfJson factors = material.value("pbrMetallicRoughness", GltfJson::object());
    if (factors.contains("baseColorTexture")) coordinates = readTexture(factors["baseColorTexture"], mask);
    if (factors.contains("baseColorFactor"))
        for (float& alpha : mask.alpha) alpha *= factors["baseColorFactor"].at(3).get<float>();
    return {std::make_shared<const AlphaMask>(std::move(mask)), coordinates};
}

std::string GltfMasks::readTexture(const GltfJson& use, AlphaMask& mask) {
    if (use.contains(GltfJson::json_pointer("/extensions/KHR_texture_transform")))
        throw BadInput("KHR_texture_transform is not read; apply it to the texture's coordinates");
    const GltfJson& texture = buffers_.entry("textures", wholeNumber<std::size_t>(use.at("index")));
    if (!texture.contains("source")) throw BadInput("its texture is neither PNG nor JPEG");
    mask.alpha = reduced(alphaOf(buffers_.image(wholeNumber<std::size_t>(texture["source"]))), texels_);
    if (texture.contains("sampler")) {
        const GltfJson& sampler = buffers_.entry("samplers", wholeNumber<std::size_t>(texture["sampler"]));
        mask.nearest = gltfWhole(sampler, "magFilter", 0) == nearestFilter;
        mask.u = wrapOf(sampler, "wrapS");
        mask.v = wrapOf(sampler, "wrapT");
    }
    return fmt::format("TEXCOORD_{}", gltfWhole(use, "texCoord", 0));
}

} // namespace shadowbench
