#include "techniques/environment/transfer_entry.h"

#include <algorithm>
#include <fmt/format.h>

namespace shadowbench::techniques {

std::optional<std::string> movingSurfaces(const Scene& scene) {
    const auto moving = std::ranges::find_if(scene.objects, [](const Object& object) { return !object.still(); });
    if (moving == scene.objects.end()) return std::nullopt;
    return fmt::format("precomputes the transfer of surfaces that stand still; in {} one moves", scene.id);
}

std::vector<Parameter> withPoints(std::vector<Parameter> own, int defaultPoints) {
    own.push_back({"points", std::to_string(defaultPoints), IntegerRange{64, 1048576},
                   "with a transfer vector on the surfaces, at most, beside one a triangle smaller than their spacing", ""});
    return own;
}

std::vector<Figure> withTransferFigures(std::vector<Figure> own) {
    own.push_back({"points", "points of the surfaces with a transfer vector"});
    own.push_back({"spacing", "of the points, metres at most"});
    own.push_back({"rays", "of the precomputation, which is in the cost of the first frame alone"});
    return own;
}

std::map<std::string, double> withTransferFigures(std::map<std::string, double> own, const SurfacePoints& points,
                                                  std::size_t raysOfEach) {
    const auto count = static_cast<double>(points.points.size());
    own["points"] = count;
    own["spacing"] = points.spacing;
    own["rays"] = count * static_cast<double>(raysOfEach);
    return own;
}

} // namespace shadowbench::techniques
