#include "techniques/modern/sm-clipmap/clipmap.h"

#include "techniques/shared/light_views/cube_view.h"
#include "techniques/shared/light_views/light_planes.h"
#include "techniques/shared/light_views/visible_part.h"
#include "techniques/shared/maps/depth_map.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/trigonometric.hpp>

namespace shadowbench::techniques {
namespace {

/// The square of `metres` from the world's origin on. Depths are those of `fitToScene`.
LightView sunPlane(const Light& sun, const Snapshot& snapshot, double metres) {
    const LightView whole = fitToScene(sun, snapshot);
    const glm::dvec2 origin = 0.5 * glm::dvec2(whole.clipFromWorld * glm::dvec4(0, 0, 0, 1)) + 0.5;
    return partOf(whole, origin, origin + metres / whole.span);
}

} // namespace

Clipmap::Clipmap(const ClipmapRule& rule, const Light& light, const Snapshot& snapshot, glm::ivec2 size)
    : rule_(rule), light_(light.homogeneous()) {
    const Camera& camera = snapshot.camera;
    const glm::dvec3 forward = camera.basis().forward;
    const double pixel = 2 * std::tan(glm::radians(camera.fovy) / 2) / size.y; // at a depth of a metre
    pixelFromWorld_ = pixel / rule.density * glm::dvec4(forward, -glm::dot(forward, camera.eye));
    if (light.kind == LightKind::Directional) {
        planes_ = {sunPlane(light, snapshot, rule.texels)};
        aroundEye(snapshot, static_cast<double>(size.x) / size.y);
    } else {
        planes_ = lightPlanes(light, snapshot);
        overPlanes();
    }
}

void Clipmap::aroundEye(const Snapshot& snapshot, double aspect) {
    const glm::dvec2 eye = onPlane(0, snapshot.camera.eye);
    double reach = 0, longest = 0; // of what the camera sees, in pages of level 0, and of what is asked for, in metres
    for (const glm::dvec3& p : visiblePart(snapshot.bounds(), snapshot.camera, aspect)) {
        const glm::dvec2 away = glm::abs(onPlane(0, p) - eye);
        reach = std::max({reach, away.x, away.y});
        longest = std::max(longest, glm::dot(pixelFromWorld_, glm::dvec4(p, 1)));
    }
    if (reach == 0) reach = longest = 1;    // nothing is seen
    const double held = 0.5 * (side() - 1); // to each side of the eye, which lies half a page from a window's middle at most
    constexpr double rounding = 1.001;      // positions of pixels are of 32 bits
    const double wide = std::ceil(std::log2(rounding * reach / held)), coarse = std::floor(std::log2(longest));
    const int coarsest = static_cast<int>(std::max(wide, coarse));
    for (int level = coarsest - rule_.levels + 1; level <= coarsest; ++level) {
        const glm::ivec2 middle(glm::round(std::exp2(-level) * eye));
        windows_.push_back({level, middle - side() / 2, side()});
    }
}

void Clipmap::overPlanes() {
    const int finest = -std::min(rule_.levels - 1, std::countr_zero(static_cast<unsigned>(side())));
    for (int level = finest; level <= 0; ++level) windows_.push_back({level, {0, 0}, 1 << -level});
}

glm::dvec2 Clipmap::onPlane(int plane, const glm::dvec3& world) const {
    const glm::dvec4 h = planes_[static_cast<std::size_t>(plane)].clipFromWorld * glm::dvec4(world, 1);
    return 0.5 * glm::dvec2(h) / h.w + 0.5;
}

/// Dot with (p, 1): metres along a texel of the finest level, where a plane's texels are not square along the longer side.
glm::dvec4 Clipmap::texelFromWorld(int plane) const {
    const LightView& view = planes_[static_cast<std::size_t>(plane)];
    const double texel = std::exp2(windows_.front().level) * std::max(view.span.x, view.span.y) / rule_.texels;
    return texel * (view.perspective ? view.depthFromWorld : glm::dvec4(0, 0, 0, 1));
}

LightView Clipmap::viewOf(const Page& page) const {
    const double pages = std::exp2(page.level); // of level 0
    const glm::dvec2 low = pages * glm::dvec2(page.at);
    return partOf(planes_[static_cast<std::size_t>(page.plane)], low, low + pages);
}

std::size_t Clipmap::entries() const {
    const auto across = static_cast<std::size_t>(side());
    return planes_.size() * windows_.size() * across * across;
}

Page Clipmap::pageOf(std::size_t entry) const {
    const auto across = static_cast<std::size_t>(side());
    const std::size_t row = entry / across, square = row / across;
    const PageWindow& window = windows_[square % windows_.size()];
    const glm::ivec2 offset(static_cast<int>(entry % across), static_cast<int>(row % across));
    return {static_cast<int>(square / windows_.size()), window.level, window.first + offset};
}

std::optional<std::size_t> Clipmap::entryOf(int plane, std::size_t window, const glm::ivec2& at) const {
    const glm::ivec2 offset = at - windows_[window].first;
    const int pages = windows_[window].pages;
    if (std::min(offset.x, offset.y) < 0 || std::max(offset.x, offset.y) >= pages) return std::nullopt;
    const auto across = static_cast<std::size_t>(side());
    const std::size_t square = static_cast<std::size_t>(plane) * windows_.size() + window;
    return (square * across + static_cast<std::size_t>(offset.y)) * across + static_cast<std::size_t>(offset.x);
}

PointInPages Clipmap::placeOf(const glm::dvec3& world) const {
    const int plane = planes_.size() == 1 ? 0 : static_cast<int>(cubeSide(world - glm::dvec3(light_)));
    PointInPages point{plane, glm::clamp(onPlane(plane, world), ends().x, ends().y), 0};
    const glm::dvec4 p(world, 1);
    const double finer = std::log2(glm::dot(pixelFromWorld_, p) / glm::dot(texelFromWorld(plane), p));
    const std::size_t last = windows_.size() - 1;
    point.window = static_cast<std::size_t>(std::clamp(std::floor(finer), 0.0, static_cast<double>(last)));
    while (point.window < last && !entryOf(plane, point.window, glm::ivec2(glm::floor(inWindow(point, point.window)))))
        ++point.window;
    return point;
}

glm::dvec2 Clipmap::inWindow(const PointInPages& point, std::size_t window) const {
    return std::exp2(-windows_[window].level) * point.at;
}

void Clipmap::bindTo(gl::Program& program) const {
    const double pages = std::exp2(-windows_.front().level); // of the finest level along one of level 0
    const glm::dmat4 finestFromMap = glm::scale(glm::dmat4(1), glm::dvec3(pages, pages, 1));
    std::vector<glm::mat4> finestFromWorld;
    std::vector<glm::vec4> texels, squares;
    for (std::size_t plane = 0; plane < planes_.size(); ++plane) {
        finestFromWorld.emplace_back(finestFromMap * mapFromClip() * planes_[plane].clipFromWorld);
        texels.emplace_back(texelFromWorld(static_cast<int>(plane)));
    }
    for (const PageWindow& window : windows_) squares.emplace_back(window.first, window.pages, 0);
    program.set("planes", static_cast<int>(planes_.size()))
        .set("light", glm::vec3(light_))
        .set("finestFromWorld", finestFromWorld)
        .set("texelFromWorld", texels)
        .set("pixelFromWorld", glm::vec4(pixelFromWorld_))
        .set("windows", squares)
        .set("levels", static_cast<int>(windows_.size()))
        .set("side", side())
        .set("ends", glm::vec2(pages * ends()));
}

/// Least and greatest column and row of level 0 at which points lie: of another light those that rounding puts beside its
/// plane lie at the rim.
glm::dvec2 Clipmap::ends() const {
    return planes_.front().perspective ? glm::dvec2(0, 1 - 0x1p-20) : glm::dvec2(-1e30, 1e30);
}

} // namespace shadowbench::techniques
