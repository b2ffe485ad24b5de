#include "groundtruth/cgal/hard/pixel_area.h"

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <glm/vec4.hpp>
#include <limits>
#include <utility>

namespace shadowbench::groundtruth::hard {
namespace {

constexpr std::size_t mostTriangles = 256; // of one pixel that are worth cutting
constexpr double leastArea = 1e-14;        // px²; smaller pieces are left out
constexpr double wholeSquare = 1 - 1e-12;  // px²; from here on a polygon covers the square
constexpr double nearestToLight = 1e-9;    // of the height of a point light above the receiver: casters reach up to there

/// Height above a plane beside the position.
using Caster = Corners<glm::dvec4>;

bool covers(const ImagePolygon& polygon) { return polygon.area() > wholeSquare; }

/// Any two directions at right angles to `axis` and to each other.
std::pair<glm::dvec3, glm::dvec3> across(const glm::dvec3& axis) {
    const glm::dvec3 other = std::abs(axis.x) < 0.5 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
    const glm::dvec3 first = glm::normalize(glm::cross(axis, other));
    return {first, glm::cross(axis, first)};
}

/// The range of some values.
struct Extent {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    void add(double value) {
        low = std::min(low, value);
        high = std::max(high, value);
    }
};

} // namespace

PixelAreas::PixelAreas(const SceneTriangles& scene, const Camera& camera, const glm::dvec4& light, glm::ivec2 size)
    : scene_(scene), eye_(camera.eye), near_(camera.near), far_(camera.far), light_(light) {
    const Camera::Basis basis = camera.basis();
    const double tangent = std::tan(0.5 * glm::radians(camera.fovy));
    const double tangentX = tangent * size.x / size.y;
    rowX_ = 0.5 * size.x * (basis.forward + 1 / tangentX * basis.right);
    rowY_ = 0.5 * size.y * (basis.forward - 1 / tangent * basis.up);
    rowDepth_ = basis.forward;
    ray_ = basis.forward - tangentX * basis.right + tangent * basis.up;
    rayPerX_ = 2 * tangentX / size.x * basis.right;
    rayPerY_ = -2 * tangent / size.y * basis.up;
    slack_ = 1e-9 * (scene.reachFrom(eye_) + (light.w == 0 ? 0 : glm::length(glm::dvec3(light) - eye_)));
}

glm::dvec3 PixelAreas::inImage(const glm::dvec3& world) const {
    const glm::dvec3 offset = world - eye_;
    return {glm::dot(rowX_, offset), glm::dot(rowY_, offset), glm::dot(rowDepth_, offset)};
}

glm::dvec3 PixelAreas::inWorld(const Patch& patch, glm::dvec2 at) const {
    return eye_ + 1 / patch.nearness(at.x, at.y) * (ray_ + at.x * rayPerX_ + at.y * rayPerY_);
}

/// What lies behind the rectangle, between the near and the far plane.
Shaft PixelAreas::eyeShaft(const ImageRectangle& rectangle) const {
    Shaft shaft;
    const auto add = [&](const glm::dvec3& normal, double offset) {
        shaft.add({normal, offset - glm::dot(normal, eye_), slack_ * glm::length(normal)});
    };
    add(rowX_ - rectangle.low.x * rowDepth_, 0);
    add(rectangle.high.x * rowDepth_ - rowX_, 0);
    add(rowY_ - rectangle.low.y * rowDepth_, 0);
    add(rectangle.high.y * rowDepth_ - rowY_, 0);
    add(rowDepth_, -near_);
    add(-rowDepth_, far_);
    return shaft;
}

std::optional<PixelAreas::SeenTriangle> PixelAreas::seen(const Triangle& triangle, const ImageRectangle& rectangle) const {
    Corners<glm::dvec3> image;
    for (const glm::dvec3& vertex : triangle) image.add(inImage(vertex));
    image = clipped(image, [&](const glm::dvec3& p) { return p.z - near_; });
    image = clipped(image, [&](const glm::dvec3& p) { return far_ - p.z; });
    SeenTriangle result{};
    result.triangle = triangle;
    result.image = HomogeneousPolygon(image);
    if (!result.image.mayMeet(rectangle)) return std::nullopt;

    result.normal = glm::normalize(glm::cross(triangle[1] - triangle[0], triangle[2] - triangle[0]));
    const double distance = glm::dot(result.normal, triangle[0] - eye_);
    result.inverseDepth =
        glm::dvec3(glm::dot(result.normal, rayPerX_), glm::dot(result.normal, rayPerY_), glm::dot(result.normal, ray_)) /
        distance;
    result.lightSide = side(triangle, light_);
    result.facesLight = result.lightSide != 0 && result.lightSide == side(triangle, glm::dvec4(eye_, 1));
    if (result.lightSide < 0) result.normal = -result.normal;
    return result;
}

/// Where casters of shadows on the patch can lie: between its plane and the light, in the light's view within a rectangle
/// around the patch.
Shaft PixelAreas::lightShaft(const SeenTriangle& seen, const Patch& patch) const {
    Shaft shaft;
    const glm::dvec3 origin = seen.triangle[0];
    shaft.add({seen.normal, -glm::dot(seen.normal, origin), slack_});
    const glm::dvec3 light(light_);
    if (light_.w != 0) shaft.add({-seen.normal, glm::dot(seen.normal, light), slack_});

    Corners<glm::dvec3> corners;
    glm::dvec3 middle(0);
    for (const glm::dvec2& corner : patch.outline.corners()) {
        const glm::dvec3 at = inWorld(patch, corner);
        corners.add(at);
        middle += 1.0 / static_cast<double>(patch.outline.corners().size()) * at;
    }
    const glm::dvec3 axis = glm::normalize(light_.w == 0 ? light : light - middle);
    const auto [first, second] = across(axis);
    for (const glm::dvec3& direction : {first, second}) {
        Extent extent;
        for (const glm::dvec3& corner : corners) {
            const double below = light_.w == 0 ? 1 : glm::dot(axis, light - corner);
            if (below <= 0) return shaft; // the part is as near to the light as it is large
            extent.add(glm::dot(direction, light_.w == 0 ? corner : corner - light) / below);
        }
        // Of a directional light a position along `direction`; of a point light a slope, so both planes hold the light.
        if (light_.w == 0) {
            shaft.add({direction, -extent.low, slack_});
            shaft.add({-direction, extent.high, slack_});
        } else {
            const glm::dvec3 low = direction + extent.low * axis, high = -direction - extent.high * axis;
            shaft.add({low, -glm::dot(low, light), slack_ * glm::length(low)});
            shaft.add({high, -glm::dot(high, light), slack_ * glm::length(high)});
        }
    }
    return shaft;
}

/// The shadow of a caster's part between the plane and the light, from the light onto the plane and from there into the
/// image: the point H v − h l of weight H − h w, with heights H of the light and h of the vertex v.
HomogeneousPolygon PixelAreas::shadow(const Triangle& caster, const SeenTriangle& seen) const {
    const glm::dvec3 origin = seen.triangle[0];
    Caster above;
    bool rises = false;
    for (const glm::dvec3& vertex : caster) {
        const int exact = seen.lightSide * side(seen.triangle, glm::dvec4(vertex, 1));
        const glm::dvec3 offset = vertex - origin;
        above.add(glm::dvec4(offset, exact * std::abs(glm::dot(seen.normal, offset))));
        rises |= exact > 0;
    }
    if (!rises) return {};
    const glm::dvec3 toLight = light_.w == 0 ? glm::dvec3(light_) : glm::dvec3(light_) - origin;
    const double lightHeight = glm::dot(seen.normal, toLight);
    above = clipped(above, [](const glm::dvec4& v) { return v.w; });
    if (light_.w != 0) above = clipped(above, [&](const glm::dvec4& v) { return (1 - nearestToLight) * lightHeight - v.w; });
    Corners<glm::dvec3> image;
    for (const glm::dvec4& v : above)
        image.add(inImage(origin + 1 / (lightHeight - v.w * light_.w) * (lightHeight * glm::dvec3(v) - v.w * toLight)));
    return HomogeneousPolygon(clipped(image, [&](const glm::dvec3& p) { return p.z - 0.5 * near_; }));
}

PixelAreas::Tile::Tile(const PixelAreas& areas, const ImageRectangle& rectangle) : areas_(areas) {
    areas.scene_.visitShaft(areas.eyeShaft(rectangle), [&](TriangleName name) {
        std::optional<SeenTriangle> seen = areas.seen(areas.scene_.triangle(name), rectangle);
        if (!seen) return;
        seen->surface = areas.scene_.instances()[name.instance].id;
        triangles_.push_back(std::move(*seen));
    });
}

void PixelAreas::Tile::addShadows(const ImageRectangle& square, SeenTriangle& seen, Patch& patch) const {
    const bool keeps = !seen.image.isWithin(square); // other pixels may ask for the same shadows
    HomogeneousPolygon own;
    areas_.scene_.visitShaft(areas_.lightShaft(seen, patch), [&](TriangleName caster) {
        if (patch.shadowed) return;
        HomogeneousPolygon* shadow = &own;
        bool isNew = true;
        if (keeps) {
            const auto [kept, added] = seen.shadows.try_emplace(std::uint64_t{caster.instance} << 32U | caster.triangle);
            shadow = &kept->second;
            isNew = added;
        }
        if (isNew) *shadow = areas_.shadow(areas_.scene_.triangle(caster), seen);
        if (!shadow->mayMeet(square)) return;
        const ImagePolygon inPixel = shadow->in(square);
        if (inPixel.area() < leastArea) return;
        patch.shadowed = covers(inPixel);
        patch.shadows.push_back(inPixel);
    });
}

std::optional<AreaShares> PixelAreas::Tile::of(glm::ivec2 pixel, std::uint32_t surface) {
    struct Candidate {
        SeenTriangle* seen;
        Patch patch;
        Extent nearness; // inverse depths of the patch
    };
    const ImageRectangle square = pixelSquare(pixel);
    std::vector<Candidate> candidates;
    double hiddenBelow = 0; // inverse depth behind which a patch that fills the square hides all
    for (SeenTriangle& seen : triangles_) {
        if (!seen.image.mayMeet(square)) continue;
        Candidate here{&seen, {}, {}};
        here.patch.outline = seen.image.in(square);
        here.patch.inverseDepth = seen.inverseDepth;
        if (here.patch.outline.area() < leastArea) continue;
        for (const glm::dvec2& corner : here.patch.outline.corners())
            here.nearness.add(here.patch.nearness(corner.x, corner.y));
        if (here.nearness.high < hiddenBelow) continue;
        here.patch.counts = seen.facesLight && seen.surface == surface;
        if (covers(here.patch.outline)) hiddenBelow = std::max(hiddenBelow, here.nearness.low);
        candidates.push_back(std::move(here));
    }
    std::erase_if(candidates, [&](const Candidate& c) { return c.nearness.high < hiddenBelow; });
    if (candidates.size() > mostTriangles) return std::nullopt;

    std::vector<Patch> patches;
    for (auto& [seen, patch, nearness] : candidates) {
        if (patch.counts) addShadows(square, *seen, patch);
        patches.push_back(std::move(patch));
    }
    return shares(patches, square);
}

} // namespace shadowbench::groundtruth::hard
