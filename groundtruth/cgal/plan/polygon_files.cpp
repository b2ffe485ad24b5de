#include "groundtruth/cgal/plan/polygon_files.h"

#include "base/error.h"
#include "base/files.h"
#include "groundtruth/cgal/plan/plane_box.h"

#include <algorithm>
#include <fmt/format.h>
#include <map>
#include <string_view>

namespace shadowbench::groundtruth::plan {
namespace {

using Ring = std::vector<glm::dvec2>;

std::string wktRing(const Ring& ring) {
    std::string text;
    for (const glm::dvec2& p : ring) text += fmt::format("{:.17g} {:.17g}, ", p.x, p.y);
    return fmt::format("({}{:.17g} {:.17g})", text, ring.front().x, ring.front().y);
}

std::string wktPolygon(const PlanarPolygon& polygon) {
    std::string text = wktRing(polygon.outer);
    for (const Ring& hole : polygon.holes) text += ", " + wktRing(hole);
    return "(" + text + ")";
}

void addPath(const Ring& ring, std::string& path) {
    for (std::size_t i = 0; i < ring.size(); ++i)
        path += fmt::format("{}{:.9g} {:.9g}", i == 0 ? 'M' : 'L', ring[i].x, ring[i].y);
    path += 'Z';
}

std::string pathOf(const ReceiverRegion& region) {
    std::string path;
    for (const PlanarPolygon& polygon : region.polygons) {
        addPath(polygon.outer, path);
        for (const Ring& hole : polygon.holes) addPath(hole, path);
    }
    return path;
}

PlaneBox boxOf(const ReceiverRegion& region) {
    PlaneBox box;
    for (const PlanarPolygon& polygon : region.polygons)
        for (const glm::dvec2& p : polygon.outer) box.add(p);
    return box;
}

std::string descriptionOf(const PlaneAxes& axes) {
    constexpr std::string_view names = "xyz";
    const auto name = [&](int axis) { return names[static_cast<std::size_t>(axis)]; };
    const glm::dvec3 height = axes.height + 0.0; // no negative zero
    return fmt::format("Metres; {} to the right, {} {}; {} = {:.9g} {:+.9g} {} {:+.9g} {}", name(axes.u), name(axes.v),
                       axes.v == 1 ? "up" : "down", name(axes.dropped), height.x, height.y, name(axes.u), height.z,
                       name(axes.v));
}

/// Names without extension: one per receiver, numbered where a surface has several.
std::vector<std::string> stems(std::string_view kind, const std::vector<hard::PlanarReceiver>& receivers) {
    std::map<std::uint32_t, int> planes;
    std::vector<std::string> names;
    for (const hard::PlanarReceiver& receiver : receivers) {
        const int plane = ++planes[receiver.id];
        names.push_back(plane == 1 ? fmt::format("{}-{}", kind, receiver.id)
                                   : fmt::format("{}-{}-{}", kind, receiver.id, plane));
    }
    return names;
}

void writePicture(const std::filesystem::path& stem, const PolygonPicture& picture,
                  std::vector<std::filesystem::path>& written) {
    const auto write = [&](const char* extension, const std::string& text) {
        written.push_back(std::filesystem::path(stem) += extension);
        writeFile(written.back(), text);
    };
    write(".wkt", wkt(picture.region.polygons) + "\n");
    write(".svg", svg(picture));
}

} // namespace

std::string wkt(const std::vector<PlanarPolygon>& polygons) {
    if (polygons.empty()) return "MULTIPOLYGON EMPTY";
    std::string text;
    for (const PlanarPolygon& polygon : polygons) text += (text.empty() ? "" : ", ") + wktPolygon(polygon);
    return "MULTIPOLYGON (" + text + ")";
}

std::string svg(const PolygonPicture& picture) {
    const PlaneAxes& axes = picture.region.axes;
    const bool flipped = axes.v == 1;
    const PlaneBox box = boxOf(picture.receiver);
    const double margin = 0.02 * std::max(box.size().x, box.size().y);
    const glm::dvec2 size = box.size() + 2 * margin;
    const double top = flipped ? -box.high.y : box.low.y;
    constexpr double width = 800; // pixels

    std::string text = fmt::format("<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{:.0f}\" height=\"{:.0f}\" "
                                   "viewBox=\"{:.9g} {:.9g} {:.9g} {:.9g}\">\n",
                                   width, width * size.y / size.x, box.low.x - margin, top - margin, size.x, size.y);
    text += fmt::format("<title>{}</title>\n<desc>{}</desc>\n", picture.title, descriptionOf(axes));
    text += fmt::format("<g fill-rule=\"evenodd\"{}>\n", flipped ? " transform=\"scale(1 -1)\"" : "");
    text += fmt::format("<path fill=\"#f4f1ea\" stroke=\"#888\" stroke-width=\"{:.3g}\" d=\"{}\"/>\n", 0.1 * margin,
                        pathOf(picture.receiver));
    text += fmt::format("<path fill=\"{}\" d=\"{}\"/>\n", picture.fill, pathOf(picture.region));
    if (picture.lightFoot && box.contains(*picture.lightFoot))
        text += fmt::format("<circle fill=\"#c05000\" cx=\"{:.9g}\" cy=\"{:.9g}\" r=\"{:.3g}\"/>\n", picture.lightFoot->x,
                            picture.lightFoot->y, 0.4 * margin);
    return text + "</g>\n</svg>\n";
}

std::vector<std::filesystem::path> writeShadowPolygons(const Snapshot& snapshot, const PrimaryHits& primary,
                                                       const std::filesystem::path& folder) {
    if (snapshot.light.isEnvironment())
        throw BadInput("shadow polygons need a light in one place or direction, and this one is an environment, all around");
    Snapshot hard = snapshot;
    hard.light = snapshot.light.centreOnly();
    const std::vector<hard::PlanarReceiver> receivers = hard::planarReceivers(hard, primary);
    if (receivers.empty())
        throw BadInput("shadow polygons need a planar receiver, and none of this scene's covers enough of the image");
    const std::vector<ShadowPolygons> shadows = shadowPolygons(hard, receivers);
    const std::vector<std::string> names = stems("shadow", receivers);
    std::vector<std::filesystem::path> written;
    for (std::size_t i = 0; i < receivers.size(); ++i)
        writePicture(folder / names[i],
                     {fmt::format("Shadow on surface {}", receivers[i].id), "#4a5568", shadows[i].receiver,
                      shadows[i].shadow, shadows[i].lightFoot},
                     written);
    return written;
}

std::vector<std::filesystem::path> writeVisiblePolygons(const Snapshot& snapshot, const PrimaryHits& primary,
                                                        const std::filesystem::path& folder) {
    const std::vector<hard::PlanarReceiver> receivers = planReceivers(snapshot, hard::planarReceivers(snapshot, primary));
    if (receivers.empty())
        throw BadInput("a plan view needs a horizontal receiver, and none of this scene's covers enough of the image");
    const std::vector<std::string> names = stems("visible", receivers);
    std::vector<std::filesystem::path> written;
    for (std::size_t i = 0; i < receivers.size(); ++i) {
        const PlanView view = planView(snapshot, receivers[i]);
        writePicture(folder / names[i],
                     {fmt::format("Seen by the light on surface {}", receivers[i].id), "#ffd966", view.receiver,
                      view.visible, view.light},
                     written);
    }
    return written;
}

} // namespace shadowbench::groundtruth::plan
