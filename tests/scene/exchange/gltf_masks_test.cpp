// Materials with holes (alphaMode MASK): what is left of their triangles.
#include "base/base64.h"
#include "base/image_formats.h"
#include "scene/exchange/export.h"
#include "scene/meshes/alpha_mask.h"
#include "scene/meshes/import.h"
#include "tests/scene/exchange/foreign_gltf.h"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <functional>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>

namespace shadowbench {
namespace {

double areaOf(const Mesh& mesh) {
    double area = 0;
    for (const glm::uvec3& t : mesh.triangles) {
        const glm::dvec3 a(mesh.positions[t.x]), b(mesh.positions[t.y]), c(mesh.positions[t.z]);
        area += 0.5 * glm::length(glm::cross(b - a, c - a));
    }
    return area;
}

/// Two triangles of a square of 1 m, and the places of its corners in a texture that covers it.
struct Card {
    Mesh mesh{{{0, 0, 0}, {1, 0, 0}, {1, 0, 1}, {0, 0, 1}}, {{0, 1, 2}, {0, 2, 3}}};
    std::vector<glm::vec2> uv{{0, 0}, {1, 0}, {1, 1}, {0, 1}};

    [[nodiscard]] Mesh cutBy(const AlphaMask& mask) const {
        return cutByMask({mesh, uv, std::make_shared<const AlphaMask>(mask)});
    }
};

AlphaMask maskOf(int size, double cutoff, const std::function<double(double, double)>& alpha) {
    AlphaMask mask{Image<float>(size, size), cutoff};
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x) mask.alpha(x, y) = static_cast<float>(alpha((x + 0.5) / size, (y + 0.5) / size));
    return mask;
}

TEST(AlphaMask, TexelsOfTheNearestFilterAreSquares) {
    const Card card;
    AlphaMask mask = maskOf(4, 0.5, [](double u, double v) { return u < 0.5 && v < 0.25 ? 0.5 : 0.49; });
    mask.nearest = true;
    const Mesh left = card.cutBy(mask);
    EXPECT_EQ(areaOf(left), 0.125) << "two texels of sixteen, one at the very cutoff";
    for (const glm::vec3& p : left.positions) EXPECT_TRUE(p.x <= 0.5F && p.z <= 0.25F && p.y == 0);
}

TEST(AlphaMask, BetweenCentresTheOutlineOfALinearAlphaIsExact) {
    const Card card;
    AlphaMask mask = maskOf(8, 0.5, [](double u, double v) { return 0.75 * u + 0.5 * v - 0.1; });
    mask.u = mask.v = AlphaMask::Wrap::Clamp;
    const Mesh left = card.cutBy(mask);
    // Within the outermost centres alpha is what it was made of; beyond, it is that of the border.
    const auto alphaAt = [&](const glm::vec3& p) {
        const double u = std::clamp<double>(p.x, 1 / 16.0, 15 / 16.0), v = std::clamp<double>(p.z, 1 / 16.0, 15 / 16.0);
        return 0.75 * u + 0.5 * v - 0.1;
    };
    double most = 1;
    for (const glm::vec3& p : left.positions) most = std::min(most, alphaAt(p));
    EXPECT_NEAR(most, 0.5, 1e-6) << "nothing below the cutoff, and something at it";
    double numeric = 0;
    constexpr int steps = 2000;
    for (int i = 0; i < steps * steps; ++i)
        numeric += alphaAt({(i % steps + 0.5) / steps, 0, (i / steps + 0.5) / steps}) >= 0.5 ? 1.0 / steps / steps : 0;
    EXPECT_NEAR(areaOf(left), numeric, 2e-4);
}

TEST(AlphaMask, ADiskHasItsAreaAtEachCutoff) {
    const Card card;
    for (const double radius : {0.2, 0.3, 0.4}) {
        const AlphaMask mask =
            maskOf(64, 1 - radius, [](double u, double v) { return 1 - glm::length(glm::dvec2(u - 0.5, v - 0.5)); });
        EXPECT_NEAR(areaOf(card.cutBy(mask)), glm::pi<double>() * radius * radius, 1e-3) << radius;
    }
}

TEST(AlphaMask, OppositeCornersAreJoinedWhereTheSaddleIsSolid) {
    const Card card;
    const auto checker = [](double high, double low) {
        AlphaMask mask{Image<float>(2, 2), 0.5};
        mask.alpha(0, 0) = mask.alpha(1, 1) = static_cast<float>(high);
        mask.alpha(1, 0) = mask.alpha(0, 1) = static_cast<float>(low);
        mask.u = mask.v = AlphaMask::Wrap::Clamp;
        return mask;
    };
    const auto solid = [&](const Mesh& mesh) { // at the middle
        for (const glm::uvec3& t : mesh.triangles) {
            const glm::dvec2 m(0.5, 0.5);
            int left = 0;
            for (int i = 0; i < 3; ++i) {
                const glm::vec3 a = mesh.positions[t[i]], b = mesh.positions[t[(i + 1) % 3]];
                left += (b.x - a.x) * (m.y - a.z) - (b.z - a.z) * (m.x - a.x) >= 0 ? 1 : -1;
            }
            if (std::abs(left) == 3) return true;
        }
        return false;
    };
    EXPECT_TRUE(solid(card.cutBy(checker(0.9, 0.3))));
    EXPECT_FALSE(solid(card.cutBy(checker(0.7, 0.1))));
}

/// An alpha test asks for each point by itself.
TEST(AlphaMask, IsWhatAnAlphaTestDrawsButForTheBowOfOutlinesWithinACell) {
    const Card card;
    AlphaMask mask = maskOf(24, 0.5, [](double u, double v) { return 0.5 + 0.5 * std::sin(11 * u + 5) * std::cos(8 * v); });
    mask.u = mask.v = AlphaMask::Wrap::Clamp;
    const Mesh left = card.cutBy(mask);
    const auto tested = [&](const glm::dvec2& uv) {
        const glm::dvec2 texel = uv * 24.0 - 0.5, low = glm::floor(texel), in = texel - low;
        const auto alpha = [&](int x, int y) {
            return mask.alpha(std::clamp(static_cast<int>(low.x) + x, 0, 23),
                              std::clamp(static_cast<int>(low.y) + y, 0, 23));
        };
        return (1 - in.y) * ((1 - in.x) * alpha(0, 0) + in.x * alpha(1, 0)) +
                   in.y * ((1 - in.x) * alpha(0, 1) + in.x * alpha(1, 1)) >=
               0.5;
    };
    const auto covered = [&](const glm::dvec2& p) {
        return std::ranges::any_of(left.triangles, [&](const glm::uvec3& t) {
            int sides = 0;
            for (int i = 0; i < 3; ++i) {
                const glm::dvec3 a(left.positions[t[i]]), b(left.positions[t[(i + 1) % 3]]);
                sides += (b.x - a.x) * (p.y - a.z) - (b.z - a.z) * (p.x - a.x) >= 0 ? 1 : -1;
            }
            return std::abs(sides) == 3;
        });
    };
    int different = 0, solid = 0;
    constexpr int steps = 150;
    for (int i = 0; i < steps * steps; ++i) {
        const glm::dvec2 p((i % steps + 0.5) / steps, (i / steps + 0.5) / steps);
        solid += tested(p) ? 1 : 0;
        different += tested(p) != covered(p) ? 1 : 0;
    }
    EXPECT_GT(solid, steps * steps / 4);
    EXPECT_LT(different, steps * steps / 200); // bows of a hundredth of a texel, more where two outlines cross
}

TEST(AlphaMask, RepeatsMirrorsAndStopsAtTheBorder) {
    Card card;
    for (glm::vec2& uv : card.uv) uv = 2.0F * uv - 0.5F;
    AlphaMask mask = maskOf(4, 0.5, [](double u, double) { return u < 0.25 ? 1.0 : 0.0; }); // the first column of texels
    mask.nearest = true;
    EXPECT_NEAR(areaOf(card.cutBy(mask)), 0.25, 1e-9) << "from 0 to 1/4 and from 1 to 5/4 of −1/2 to 3/2";
    mask.u = AlphaMask::Wrap::Mirror;
    EXPECT_NEAR(areaOf(card.cutBy(mask)), 0.25, 1e-9) << "from −1/4 to 1/4";
    mask.u = AlphaMask::Wrap::Clamp;
    EXPECT_NEAR(areaOf(card.cutBy(mask)), 0.375, 1e-9) << "from −1/2 to 1/4";
}

TEST(AlphaMask, KeepsTheSideThatFacesOut) {
    Card mirrored;
    for (glm::vec2& uv : mirrored.uv) uv.x = 1 - uv.x;
    const AlphaMask mask = maskOf(16, 0.5, [](double u, double v) { return u + v < 0.9 ? 1.0 : 0.0; });
    for (const Card& card : {Card(), mirrored})
        for (const Mesh left = card.cutBy(mask); const glm::uvec3& t : left.triangles) {
            const glm::vec3 a = left.positions[t.x], b = left.positions[t.y], c = left.positions[t.z];
            EXPECT_LT(glm::cross(b - a, c - a).y, 0) << "as the card's";
        }
}

TEST(AlphaMask, ATriangleWithoutAreaInTheTextureIsKeptOrLeftOutAsAWhole) {
    Card card;
    card.uv.assign(4, {0.75, 0.5});
    const auto half = [](double u, double) { return u < 0.5 ? 0.0 : 1.0; };
    EXPECT_EQ(areaOf(card.cutBy(maskOf(8, 0.5, half))), 1);
    card.uv.assign(4, {0.25, 0.5});
    EXPECT_TRUE(card.cutBy(maskOf(8, 0.5, half)).triangles.empty());
}

TEST(AlphaMask, NumbersThatNoTextureHasAreRefused) {
    Card card;
    const AlphaMask mask = maskOf(4, 0.5, [](double, double) { return 1.0; });
    for (const float far : {1e30F, std::numeric_limits<float>::quiet_NaN(), 4000.0F}) {
        card.uv[1].x = card.uv[2].y = far;
        EXPECT_THROW(static_cast<void>(card.cutBy(mask)), BadInput) << far;
    }
}

class GltfMasks : public ForeignGltf {
protected:
    GltfMasks() {
        const float uv[] = {0, 0, 0.5F, 1, 1, 0};
        bin.append(reinterpret_cast<const char*>(uv), sizeof uv);
        writeFile(folder_.path() / "other.bin", bin);
        gltf["buffers"][0]["byteLength"] = bin.size();
        gltf["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", 48}, {"byteLength", sizeof uv}});
        gltf["accessors"].push_back({{"bufferView", 2}, {"componentType", 5126}, {"count", 3}, {"type", "VEC2"}});
        gltf["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_0"] = 2;
        gltf["meshes"][0]["primitives"][0]["material"] = 0;
        gltf["materials"] = Json::parse(R"([{"name": "Leaves", "alphaMode": "MASK",
                                             "pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}])");
        gltf["textures"] = Json::parse(R"([{"source": 0, "sampler": 0}])");
        gltf["samplers"] = Json::parse(R"([{"magFilter": 9728}])");
        gltf["images"] = Json::parse(R"([{"uri": "leaf.png"}])");
        writeFile(folder_.path() / "leaf.png", png());
    }

    /// 2 × 2 texels of red; those of the upper row, at v = 0, are solid.
    static constexpr const char* inBase64 =
        "iVBORw0KGgoAAAANSUhEUgAAAAIAAAACCAYAAABytg0kAAAAEklEQVR42mP4z8DwH4SBkAGMAUHQBfsM2jl8AAAAAElFTkSuQmCC";
    static std::string png() { return *fromBase64(inBase64); }

    [[nodiscard]] double area() const { return areaOf(*loaded().objects[0].levels[0].mesh); }
};

TEST_F(GltfMasks, LeaveWhatTheirTextureHasSolid) {
    const double whole = 2; // of the triangle, 2 m wide and deep
    // Its side is at v = 0, its tip at v = 1.
    EXPECT_NEAR(area(), 0.75 * whole, 1e-6);
    gltf["materials"][0]["pbrMetallicRoughness"]["baseColorFactor"] = {1, 1, 1, 0.4};
    expectRefused("its mask leaves nothing of it; is its alphaCutoff as it should be?");
    gltf["materials"][0]["alphaCutoff"] = 0.3;
    EXPECT_NEAR(area(), 0.75 * whole, 1e-6);
    gltf["materials"][0]["alphaMode"] = "OPAQUE";
    EXPECT_EQ(area(), whole);
}

TEST_F(GltfMasks, TexturesLieBesideTheFileWithinItAndInDataUris) {
    const double beside = area();
    gltf["images"][0] = {{"uri", fmt::format("data:image/png;base64,{}", inBase64)}};
    EXPECT_EQ(area(), beside);
    gltf["images"][0] = {{"bufferView", 3}, {"mimeType", "image/png"}};
    gltf["bufferViews"].push_back({{"buffer", 0}, {"byteOffset", bin.size()}, {"byteLength", png().size()}});
    gltf["buffers"][0] = {{"byteLength", bin.size() + png().size()}};
    EXPECT_EQ(areaOf(*loaded("other.glb", glbOf(gltf.dump(), bin + png())).objects[0].levels[0].mesh), beside);
}

/// A second part with the mask of the first, and one of whose material all has one alpha.
TEST_F(GltfMasks, AreExportedAsCardsOfWhichTheTrianglesAreLeft) {
    gltf["materials"].push_back(
        Json::parse(R"({"alphaMode": "MASK", "pbrMetallicRoughness": {"baseColorFactor": [1, 1, 1, 1]}})"));
    gltf["meshes"].push_back(gltf["meshes"][0]);
    gltf["meshes"].push_back(gltf["meshes"][0]);
    gltf["meshes"][2]["primitives"][0]["material"] = 1;
    for (const int mesh : {1, 2}) {
        gltf["meshes"][mesh]["name"] = mesh == 1 ? "again" : "whole";
        gltf["scenes"][0]["nodes"].push_back(gltf["nodes"].size());
        gltf["nodes"].push_back({{"mesh", mesh}, {"translation", {3 * mesh, 1, 0}}});
    }
    const Scene scene = loaded();
    const std::filesystem::path out = folder_.path() / "out";
    exchange::exportScene(scene, out);
    const Json cards = Json::parse(readFile(out / "cards.gltf"));
    EXPECT_EQ(cards["images"].size(), 1U) << "of a mask that two parts share";
    EXPECT_EQ(png::channelOf(readFile(out / cards["images"][0]["uri"].get<std::string>()), 3), png::channelOf(png(), 3));
    EXPECT_EQ(std::ranges::count_if(cards["materials"], [](const Json& m) { return m.contains("alphaMode"); }), 2);
    const std::map<std::string, Mesh> parts = importParts(out / "cards.gltf");
    EXPECT_EQ(std::ranges::count_if(parts, [](const auto& part) { return part.second.cards != nullptr; }), 2);
    for (const Object& object : scene.objects) {
        EXPECT_EQ(parts.at(object.name).positions, object.levels[0].mesh->positions) << object.name;
        EXPECT_EQ(parts.at(object.name).triangles, object.levels[0].mesh->triangles) << object.name;
    }
}

TEST_F(GltfMasks, HaveCardsInTheScenesUnitAndNoneWhereTheMeshIsSimplified) {
    writeFile(folder_.path() / "other.gltf", gltf.dump());
    const auto meshOf = [&](const std::string& more) {
        return loaded("level.toml",
                      "title = \"t\"\ncamera = { eye = [0, 4, 6], target = [0, 0, 0], fovy = 45, near = 0.5, far = 40 }\n"
                      "light = { kind = \"point\", centre = [1, 6, 2] }\nsize = [32, 32]\n[[object]]\n"
                      "mesh = { file = \"other.gltf\", part = \"tri\"" +
                          more + " }\n")
            .objects[0]
            .levels[0]
            .mesh;
    };
    const auto mesh = meshOf(", unit = \"ft\", up = \"z\"");
    const Mesh &cards = mesh->cards->mesh, again = cutByMask(*mesh->cards);
    EXPECT_EQ(cards.positions[1], glm::vec3(0, 0.3048F, 0)) << "the file has it at z";
    EXPECT_NEAR(areaOf(again), areaOf(*mesh), 1e-6);
    EXPECT_EQ(meshOf(", simplify = 4")->cards, nullptr);
}

/// As a level of its mipmap: the means of what smaller texels cover.
TEST_F(GltfMasks, HaveAsManyTexelsAsTheSceneFileTakes) {
    constexpr const char* of = "gltf = \"other.gltf\"\nmask_texels = ";
    const auto areaThrough = [&](const std::string& lines) { return areaOf(*through(lines).objects[0].levels[0].mesh); };
    EXPECT_EQ(areaThrough(of + std::string("2")), area()) << "of two texels";
    EXPECT_EQ(areaThrough(of + std::string("1")), 2) << "half of the texel is solid, as the cutoff asks";
    gltf["materials"][0]["alphaCutoff"] = 0.51;
    expectWithin(refusalOf([&] { return through(of + std::string("1")); }), "its mask leaves nothing of it");
    expectWithin(refusalOf([&] { return through(of + std::string("0")); }),
                 "level.toml:2: mask_texels: expected a whole number from 1");
    expectWithin(refusalOf([&] { return through("mask_texels = 2"); }), "mask_texels: belongs to gltf = ");
}

/// 3 × 2 texels in 2 × 1: each has one whole column and half of the middle one.
TEST_F(GltfMasks, OfAnySizeAreMeansOfWhatTheirTexelsCover) {
    std::vector<std::uint8_t> pixels;
    for (const int alpha : {0, 60, 240, 120, 180, 240})
        pixels.insert(pixels.end(), {9, 9, 9, static_cast<std::uint8_t>(alpha)});
    writeFile(folder_.path() / "leaf.png", png::encoded(3, 2, 4, pixels));
    gltf["materials"][0]["alphaCutoff"] = 0.1;
    const Scene scene = through("gltf = \"other.gltf\"\nmask_texels = 2");
    const Image<float>& alpha = scene.objects[0].levels[0].mesh->cards->mask->alpha;
    ASSERT_EQ(std::pair(alpha.width(), alpha.height()), std::pair(2, 1));
    EXPECT_NEAR(alpha[0], (0 + 120 + 0.5 * (60 + 180)) / 3 / 255, 1e-6);
    EXPECT_NEAR(alpha[1], (240 + 240 + 0.5 * (60 + 180)) / 3 / 255, 1e-6);
}

TEST_F(GltfMasks, WhatCannotBeReadIsNamedWithItsMaterial) {
    const Json whole = gltf;
    const auto expect = [&](const std::string& reason) {
        expectRefused("mesh \"tri\": material \"Leaves\" with alphaMode MASK: " + reason);
        gltf = whole;
    };
    writeFile(folder_.path() / "leaf.png", "GIF89a");
    expect("its texture is neither PNG nor JPEG");
    gltf["images"][0]["uri"] = "leaf.webp"; // which nobody hands over
    std::filesystem::remove(folder_.path() / "leaf.png");
    expectRefused("leaf.webp");
    gltf = whole;
    writeFile(folder_.path() / "leaf.png", png());
    gltf["textures"][0].erase("source");
    expect("its texture is neither PNG nor JPEG");
    gltf["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"]["extensions"]["KHR_texture_transform"] = Json::object();
    expect("KHR_texture_transform is not read");
    gltf["materials"][0]["alphaCutoff"] = 1.5;
    expectRefused("mesh \"tri\": its mask leaves nothing of it");
    gltf = whole;
    gltf["materials"][0]["alphaMode"] = "BLEND";
    std::filesystem::remove(folder_.path() / "leaf.png");
    EXPECT_EQ(area(), 2) << "a texture that no mask needs is not looked for";
}

} // namespace
} // namespace shadowbench
